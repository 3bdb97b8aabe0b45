#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Jolt (jolt-physics 1.1.0): a column that leans beyond its critical angle can be put to sleep and never falls.
# Guess: released at 1.1 times the angle at which its weight is over its edge, a column of 0.105 x 2.73 m passes 1
# rad after 2.7 s, asleep or not.
# Seen: with sleeping allowed, the default, it still leans after 20 s, at 1/60 and 1/240 s; without it passes 1
# rad after 2.68 s.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund jolt-physics@1.1.0 >/dev/null
cat >run.mjs <<'JS'
import init from 'jolt-physics';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const J = await init(), settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(2);
settings.mMaxWorkerThreads = 0;
pairs.EnableCollision(0, 1);
const layers = new J.BroadPhaseLayerInterfaceTable(2, 2);
for (const k of [0, 1]) layers.MapObjectToBroadPhaseLayer(k, new J.BroadPhaseLayer(k));
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
const jolt = new J.JoltInterface(settings), bodies = jolt.GetPhysicsSystem().GetBodyInterface();
const add = (half, place, turn, moves, sleeps) => {
  const type = moves ? J.EMotionType_Dynamic : J.EMotionType_Static;
  const shape = new J.BoxShape(new J.Vec3(...half), 0.001, null);
  const c = new J.BodyCreationSettings(shape, new J.RVec3(...place), turn, type, moves ? 1 : 0);
  Object.assign(c, { mFriction: 1, mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: sleeps });
  const body = bodies.CreateBody(c);
  bodies.AddBody(body.GetID(), moves ? J.EActivation_Activate : J.EActivation_DontActivate);
  return body;
};
add([10, 0.5, 10], [0, -0.5, 0], new J.Quat(0, 0, 0, 1), false, true);
const b = 0.105, h = 2.73, lean = 1.1 * Math.atan(b / h), cos = Math.cos(lean), sin = Math.sin(lean);
const fall = (dt, sleeps) => { // time until it passes 1 rad [s]; -1: not within 20 s
  const turn = new J.Quat(0, 0, Math.sin(-lean / 2), Math.cos(lean / 2));
  const place = [b / 2 * (1 - cos) + h / 2 * sin, b / 2 * sin + h / 2 * cos, 0];
  const column = add([b / 2, h / 2, b / 2], place, turn, true, sleeps);
  let time = -1;
  for (let i = 0; i < 20 / dt && time < 0; i++) {
    jolt.Step(dt, 1);
    if (2 * Math.atan2(Math.abs(column.GetRotation().GetZ()), column.GetRotation().GetW()) > 1) time = i * dt;
  }
  bodies.RemoveBody(column.GetID());
  return time;
};
for (const dt of [1 / 60, 1 / 240]) {
  near(`step 1/${1 / dt} s, may sleep: falls at [s]`, fall(dt, true), -1, 0);
  near(`step 1/${1 / dt} s, may not sleep: falls at [s]`, fall(dt, false), 2.68, 0.03);
}
JS
node run.mjs
