#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# cannon-es 0.20.0: a box brakes several times harder than its coefficient of friction states.
# Guess: at 5 m/s with a coefficient of 0.3 and no damping it slides v^2 / (2 mu g) = 4.25 m on a plane.
# Seen: 1.23 m at 1/60 s, 1.38 m at 1/240 s.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund cannon-es@0.20.0 >/dev/null
cat >run.mjs <<'JS'
import * as C from 'cannon-es';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const way = (dt) => { // [m] in 4 s
  const world = new C.World({ gravity: new C.Vec3(0, 0, -9.81) }), material = new C.Material();
  world.addContactMaterial(new C.ContactMaterial(material, material, { friction: 0.3, restitution: 0 }));
  world.addBody(new C.Body({ mass: 0, shape: new C.Plane(), material }));
  const box = new C.Body({ mass: 1, shape: new C.Box(new C.Vec3(0.1, 0.1, 0.1)), material,
    linearDamping: 0, angularDamping: 0, position: new C.Vec3(0, 0, 0.1), velocity: new C.Vec3(5, 0, 0) });
  world.addBody(box);
  for (let i = 0; i < 4 / dt; i++) world.step(dt);
  return box.position.x;
};
near('1/60 s [m]', way(1 / 60), 1.227, 0.01);
near('1/240 s [m]', way(1 / 240), 1.380, 0.01);
JS
node run.mjs
