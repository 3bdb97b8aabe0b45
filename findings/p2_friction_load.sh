#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# p2-es 1.2.3: friction does not grow with the load on a block; its bound is mu times the block's own weight.
# Guess: with a coefficient of 0.5 a block of 10 kg that 0, 100 or 1000 N press down starts to slide at 49, 99 or 549 N.
# Seen: at 49 to 50 N in all three cases.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund p2-es@1.2.3 >/dev/null
cat >run.mjs <<'JS'
import * as p2 from 'p2-es';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const dt = 1 / 240;
const way = (load, pull) => { // in 1 s, after 2 s under the load alone [m]
  const world = new p2.World({ gravity: [0, -9.81] });
  Object.assign(world.defaultContactMaterial, { friction: 0.5, restitution: 0 });
  world.solver.iterations = 50;
  const add = (mass, y, width, height) => {
    const body = new p2.Body({ mass, position: [0, y], damping: 0, angularDamping: 0 });
    body.addShape(new p2.Box({ width, height }));
    world.addBody(body);
    return body;
  };
  add(0, -0.5, 100, 1);
  const block = add(10, 0.1, 0.4, 0.2);
  const push = (seconds, force) => {
    for (let i = 0; i < seconds / dt; i++) {
      block.force[0] += force;
      block.force[1] -= load;
      world.step(dt);
    }
    return block.position[0];
  };
  const start = push(2, 0);
  return push(1, pull) - start;
};
const limit = (load) => { // smallest pull that moves it by 10 mm [N]
  let pull = 20;
  while (pull < 600 && way(load, pull) < 0.01) pull += 1;
  return pull;
};
for (const load of [0, 100, 1000]) near(`load ${load} N: slides at [N]`, limit(load), 50, 2);
JS
node run.mjs
