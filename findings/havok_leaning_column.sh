#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Havok (@babylonjs/havok 1.3.14): a column that leans beyond its critical angle does not fall, though it may not sleep.
# Guess: as in Jolt, sleeping holds it; always active, a column of 0.105 x 2.73 m passes 1 rad after 2.69 s from 1.1
# times the angle at which its weight is over its edge, after 1.99 s from 1.5 times and 1.69 s from twice that angle.
# Seen: from 1.1 times not within 20 s; from 1.5 times after 2.77, 3.37 and 3.83 s at 1/60, 1/240 and 1/1000 s, later
# at smaller steps; from twice after 1.82 to 1.83 s.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund @babylonjs/havok@1.3.14 >/dev/null
cat >run.mjs <<'JS'
import { readFileSync } from 'node:fs';
import load from '@babylonjs/havok';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const wasm = new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url);
const H = await load({ wasmBinary: readFileSync(wasm) });
const add = (world, extents, place, turn, mass) => {
  const body = H.HP_Body_Create()[1], shape = H.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], extents)[1];
  const rule = H.MaterialCombine.GEOMETRIC_MEAN;
  H.HP_Shape_SetMaterial(shape, [1, 1, 0, rule, rule]);
  H.HP_Body_SetShape(body, shape);
  H.HP_Body_SetMotionType(body, mass ? H.MotionType.DYNAMIC : H.MotionType.STATIC);
  H.HP_Body_SetQTransform(body, [place, turn]);
  if (mass) {
    const [centre, , inertia, axes] = H.HP_Shape_BuildMassProperties(shape)[1];
    H.HP_Body_SetMassProperties(body, [centre, mass, inertia, axes]);
    H.HP_Body_SetLinearDamping(body, 0);
    H.HP_Body_SetAngularDamping(body, 0);
    H.HP_Body_SetActivationControl(body, H.ActivationControl.ALWAYS_ACTIVE);
  }
  H.HP_World_AddBody(world, body, false);
  return body;
};
const b = 0.105, h = 2.73;
const fall = (dt, share) => { // time until it passes 1 rad [s]; -1: not within 20 s
  const world = H.HP_World_Create()[1], lean = share * Math.atan(b / h), cos = Math.cos(lean), sin = Math.sin(lean);
  H.HP_World_SetGravity(world, [0, -9.81, 0]);
  H.HP_World_SetIdealStepTime(world, dt);
  add(world, [20, 1, 20], [0, -0.5, 0], [0, 0, 0, 1], 0);
  const place = [b / 2 * (1 - cos) + h / 2 * sin, b / 2 * sin + h / 2 * cos, 0];
  const column = add(world, [b, h, b], place, [0, 0, Math.sin(-lean / 2), Math.cos(lean / 2)], 10);
  let time = -1;
  for (let i = 0; i < 20 / dt && time < 0; i++) {
    H.HP_World_Step(world, dt);
    const [, , z, w] = H.HP_Body_GetOrientation(column)[1];
    if (2 * Math.atan2(Math.abs(z), Math.abs(w)) > 1) time = i * dt;
  }
  H.HP_World_Release(world);
  return time;
};
const steps = [1 / 60, 1 / 240, 1 / 1000];
const seen = { 1.1: [-1, -1, -1], 1.5: [2.767, 3.367, 3.832], 2: [1.817, 1.833, 1.834] };
for (const [share, times] of Object.entries(seen)) {
  steps.forEach((dt, k) => near(`${share} critical, step 1/${Math.round(1 / dt)} s: falls at [s]`, fall(dt, share), times[k], 0.04));
}
JS
node run.mjs
