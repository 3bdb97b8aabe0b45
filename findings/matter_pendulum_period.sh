#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# matter-js 0.20.0: every body has four times the moment of inertia of its shape, so that pendulums swing too slowly.
# Guess: m (b^2 + h^2) / 12 for a rectangle, m r^2 / 2 for a circle; a rod hung by its end swings with
# 2 pi sqrt(2 l / (3 g)).
# Seen: 4.00 times both moments; the rod's period is 1.32 times that of theory, as four times its inertia gives.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund matter-js@0.20.0 >/dev/null
cat >run.mjs <<'JS'
import M from 'matter-js';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const board = M.Bodies.rectangle(0, 0, 100, 2000), disc = M.Bodies.circle(0, 0, 100, {}, 200);
near('rectangle: inertia over exact', board.inertia / (board.mass * (100 ** 2 + 2000 ** 2) / 12), 4, 0.001);
near('circle: inertia over exact', disc.inertia / (disc.mass * 100 ** 2 / 2), 4, 0.01);

const dt = 1 / 240, length = 1000, engine = M.Engine.create({ constraintIterations: 20 });
const gravity = engine.gravity.y * engine.gravity.scale * 1e6; // lengths a second squared; the engine's unit is ms
const rod = M.Bodies.rectangle(0, length / 2, 20, length, { frictionAir: 0 });
const pin = M.Constraint.create({ pointA: { x: 0, y: 0 }, bodyB: rod, pointB: { x: 0, y: -length / 2 }, length: 0,
  stiffness: 1 });
M.Composite.add(engine.world, [rod, pin]);
M.Body.rotate(rod, 0.1, { x: 0, y: 0 });
const crossings = [];
for (let i = 0, last = rod.position.x; i < 60 / dt; i++, last = rod.position.x) {
  M.Engine.update(engine, 1000 * dt);
  if (last * rod.position.x < 0) crossings.push(i * dt);
}
const period = 2 * (crossings.at(-1) - crossings[0]) / (crossings.length - 1);
near('rod: period over exact', period / (2 * Math.PI * Math.sqrt(2 * length / (3 * gravity))), 1.323, 0.01);
JS
node run.mjs
