#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Bullet (ammojs3 0.0.11): a convex hull's inertia is that of its bounding box enlarged by the collision margin.
# Guess: the hull of the corners of a cube of 0.2 m has the cube's inertia, m a^2 / 6, as btBoxShape does.
# Seen: 4.84 times as much; the default margin of 0.04 m is added twice on every side, ((0.2 + 0.24) / 0.2)^2.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund ammojs3@0.0.11 >/dev/null
cat >run.mjs <<'JS'
import ammo from 'ammojs3';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const A = await ammo(), inertia = new A.btVector3(0, 0, 0), exact = 0.04 / 6;
const hull = new A.btConvexHullShape();
const ends = [-0.1, 0.1];
for (const x of ends) for (const y of ends) for (const z of ends) hull.addPoint(new A.btVector3(x, y, z), true);
hull.calculateLocalInertia(1, inertia);
near('hull over exact', inertia.x() / exact, 4.84, 0.01);
new A.btBoxShape(new A.btVector3(0.1, 0.1, 0.1)).calculateLocalInertia(1, inertia);
near('box over exact', inertia.x() / exact, 1, 1e-4);
JS
node run.mjs
