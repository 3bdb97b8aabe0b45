#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# manifold-3d 3.5.4: how round a cylinder is depends on the unit of length; in metres a dowel is a square bar.
# Guess: a cylinder's volume is within 1 or 2 % of pi r^2 h at any radius; the number of sides is a matter of angle.
# Seen: 0.637 of it at a radius of 0.012 (4 sides), 0.900 at 1 (8 sides), 0.995 at 12 (36 sides).
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund manifold-3d@3.5.4 >/dev/null
cat >run.mjs <<'JS'
import load from 'manifold-3d';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const module = await load();
module.setup();
const { Manifold } = module;
const share = (radius) => Manifold.cylinder(1, radius).volume() / (Math.PI * radius ** 2);
near('radius 0.012: volume over exact', share(0.012), 0.637, 0.001);
near('radius 1: volume over exact', share(1), 0.9, 0.001);
near('radius 12: volume over exact', share(12), 0.995, 0.001);
const post = Manifold.cube([0.105, 0.105, 1], true); // a hole for a dowel of 24 mm, through a post of 105 mm [m]
const bored = post.subtract(Manifold.cylinder(1, 0.012, -1, 0, true).rotate([90, 0, 0]));
near('bored out, over exact', (post.volume() - bored.volume()) / (Math.PI * 0.012 ** 2 * 0.105), 0.637, 0.001);
JS
node run.mjs
