#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Jolt (jolt-physics 1.1.0): a block that slides on a shaken table is stopped from one step to the next: it falls asleep.
# Guess: with friction 0.2 its velocity never changes faster than by 0.2 g times the step, whether bodies may sleep or not.
# Seen: by 0.002 m/s in a step of 1/1000 s if it may not sleep; by 0.25 m/s, a hundred times as much, if it may (default).
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
const J = await init(), up = new J.Quat(0, 0, 0, 1);
const makeWorld = () => {
  const settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(1);
  settings.mMaxWorkerThreads = 0;
  pairs.EnableCollision(0, 0);
  const layers = new J.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  return new J.JoltInterface(settings);
};
const omega = 4 * Math.PI, start = -0.5 * 9.81 / omega; // of table and block [m/s]
const jerk = (dt, sleeps) => { // largest change of the block's velocity in a step within 3 s [m/s]
  const jolt = makeWorld(), bodies = jolt.GetPhysicsSystem().GetBodyInterface();
  const add = (half, y, type) => {
    const shape = new J.BoxShape(new J.Vec3(...half), 0.001, null);
    const c = new J.BodyCreationSettings(shape, new J.RVec3(0, y, 0), up, type, 0);
    Object.assign(c, { mFriction: 0.2, mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: sleeps });
    c.mLinearVelocity = new J.Vec3(start, 0, 0);
    const body = bodies.CreateBody(c);
    bodies.AddBody(body.GetID(), J.EActivation_Activate);
    return body;
  };
  const table = add([3, 0.5, 1.5], -0.5, J.EMotionType_Kinematic), block = add([0.2, 0.05, 0.2], 0.05, J.EMotionType_Dynamic);
  const place = (t) => start / omega * Math.sin(omega * t);
  let largest = 0;
  for (let i = 0; i < 3 / dt; i++) {
    table.SetLinearVelocity(new J.Vec3((place((i + 1) * dt) - place(i * dt)) / dt, 0, 0));
    const before = block.GetLinearVelocity().GetX();
    jolt.Step(dt, 1);
    largest = Math.max(largest, Math.abs(block.GetLinearVelocity().GetX() - before));
  }
  return largest;
};
near('1/240 s, may not sleep [m/s]', jerk(1 / 240, false), 0.0082, 0.0005);
near('1/240 s, may sleep [m/s]', jerk(1 / 240, true), 0.25, 0.02);
near('1/1000 s, may not sleep [m/s]', jerk(1 / 1000, false), 0.002, 0.0001);
near('1/1000 s, may sleep [m/s]', jerk(1 / 1000, true), 0.25, 0.02);
JS
node run.mjs
