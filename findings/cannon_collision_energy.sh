#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# cannon-es 0.20.0: the energy after a head-on collision of two equal boxes with restitution 1 depends on the time step, up and down.
# Guess: 1 at every step, or a loss that vanishes with the step.
# Seen: 1.00 at 1/60 s, 1.32 at 1/240 s, 0.61 at 1/1000 s.
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
const energy = (dt) => { // after over before
  const world = new C.World({ gravity: new C.Vec3(0, 0, 0) }), material = new C.Material();
  world.addContactMaterial(new C.ContactMaterial(material, material, { friction: 0, restitution: 1 }));
  const bodies = [-1, 1].map((side) => new C.Body({ mass: 10, shape: new C.Box(new C.Vec3(0.25, 0.25, 0.25)), material,
    linearDamping: 0, angularDamping: 0, position: new C.Vec3(0.275 * side, 0, 0), velocity: new C.Vec3(-side, 0, 0) }));
  bodies.forEach((body) => world.addBody(body));
  for (let i = 0; i < 0.2 / dt; i++) world.step(dt);
  return bodies.reduce((sum, body) => sum + body.velocity.x ** 2, 0) / 2;
};
near('1/60 s', energy(1 / 60), 1.0, 0.01);
near('1/240 s', energy(1 / 240), 1.32, 0.01);
near('1/1000 s', energy(1 / 1000), 0.61, 0.01);
JS
node run.mjs
