#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Jolt (jolt-physics 1.1.0): a spring of 1000 N/m without damping loses nearly all its energy in 30 periods.
# Guess: a DistanceConstraint with mStiffness 1000 and mDamping 0 lets 10 kg swing for ever, or nearly so at 1/1000 s.
# Seen: 2 % of the amplitude is left after 19 s (30 periods) at 1/240 s, 41 % at 1/1000 s.
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
const amplitude = (dt) => { // in the last second over that of the start
  const settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(1);
  settings.mMaxWorkerThreads = 0;
  const layers = new J.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new J.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  const jolt = new J.JoltInterface(settings), system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
  system.SetGravity(new J.Vec3(0, 0, 0));
  const add = (x, type, velocity) => {
    const c = new J.BodyCreationSettings(new J.BoxShape(new J.Vec3(0.1, 0.1, 0.1), 0.001, null), new J.RVec3(x, 0, 0), up, type, 0);
    Object.assign(c, { mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: false });
    c.mOverrideMassProperties = J.EOverrideMassProperties_CalculateInertia;
    c.mMassPropertiesOverride.mMass = 10;
    c.mLinearVelocity = new J.Vec3(velocity, 0, 0);
    const body = bodies.CreateBody(c);
    bodies.AddBody(body.GetID(), J.EActivation_Activate);
    return body;
  };
  const anchor = add(-1, J.EMotionType_Static, 0), mass = add(0, J.EMotionType_Dynamic, 1); // 0.1 m times 10 rad/s
  const spring = new J.DistanceConstraintSettings();
  spring.mPoint1 = new J.RVec3(-1, 0, 0);
  spring.mPoint2 = new J.RVec3(0, 0, 0);
  spring.mMinDistance = spring.mMaxDistance = 1;
  spring.mLimitsSpringSettings.mMode = J.ESpringMode_StiffnessAndDamping;
  spring.mLimitsSpringSettings.mStiffness = 1000;
  spring.mLimitsSpringSettings.mDamping = 0;
  system.AddConstraint(spring.Create(anchor, mass));
  let largest = 0;
  for (let i = 0; i < 19 / dt; i++) {
    jolt.Step(dt, 1);
    if (i * dt > 18) largest = Math.max(largest, Math.abs(mass.GetPosition().GetX()) / 0.1);
  }
  return largest;
};
near('1/240 s', amplitude(1 / 240), 0.023, 0.003);
near('1/1000 s', amplitude(1 / 1000), 0.405, 0.01);
JS
node run.mjs
