#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Rapier 0.21.0: the stiffness of a joint's position motor is per unit of mass unless the model is set.
# Guess: a mass of 10 kg on a prismatic motor of 1000 N/m sags by m g / k = 98.1 mm.
# Seen: 9.81 mm, as 1 kg does; with MotorModel.ForceBased 98.1 mm.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund @dimforge/rapier3d-compat@0.21.0 >/dev/null
cat >run.mjs <<'JS'
import R from '@dimforge/rapier3d-compat';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
await R.init();
const sag = (mass, model) => { // [mm] after 10 s on a motor of 1000 N/m and 200 N s/m
  const world = new R.World({ x: 0, y: 0, z: -9.81 });
  world.timestep = 1 / 240;
  const base = world.createRigidBody(R.RigidBodyDesc.fixed());
  const body = world.createRigidBody(R.RigidBodyDesc.dynamic().setCanSleep(false));
  world.createCollider(R.ColliderDesc.cuboid(0.1, 0.1, 0.1).setMass(mass).setCollisionGroups(0), body);
  const origin = { x: 0, y: 0, z: 0 };
  const joint = world.createImpulseJoint(R.JointData.prismatic(origin, origin, { x: 0, y: 0, z: 1 }), base, body, true);
  if (model !== undefined) joint.configureMotorModel(model);
  joint.configureMotorPosition(0, 1000, 200);
  for (let i = 0; i < 2400; i++) world.step();
  return -1000 * body.translation().z;
};
near('1 kg [mm]', sag(1), 9.81, 0.01);
near('10 kg [mm]', sag(10), 9.81, 0.01);
near('10 kg, force based [mm]', sag(10, R.MotorModel.ForceBased), 98.1, 0.1);
JS
node run.mjs
