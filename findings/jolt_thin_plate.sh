#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Jolt (jolt-physics 1.1.0): a convex hull of a steel plate of 1 mm has half the plate's mass and a shifted centre.
# Guess: the hull of the eight corners of a plate of 100 x 200 x 1 mm has its volume and its centre.
# Seen: half the volume, the centre off by 8.3 mm and 16.7 mm; without an error. From 1.2 mm on both are exact. The
# hull's default tolerance is 1 mm, and corners within it are dropped.
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
const J = await init();
const plate = (thickness, tolerance) => { // of 0.1 x 0.2 m: volume over exact, distance of centre and middle [mm]
  const half = [0.05, 0.1, thickness / 2], hull = new J.ConvexHullShapeSettings(), ends = [-1, 1];
  if (tolerance) hull.mHullTolerance = tolerance;
  for (const x of ends) for (const y of ends) for (const z of ends) {
    hull.mPoints.push_back(new J.Vec3(x * half[0], y * half[1], z * half[2]));
  }
  const result = hull.Create();
  if (result.HasError()) throw new Error(result.GetError().c_str());
  const shape = result.Get(), centre = shape.GetCenterOfMass();
  return [shape.GetVolume() / (0.1 * 0.2 * thickness), 1000 * Math.hypot(centre.GetX(), centre.GetY())];
};
for (const [name, [volume, offset], seen] of [
  ['1.0 mm', plate(0.001), [0.5, 18.63]],
  ['1.2 mm', plate(0.0012), [1, 0]],
  ['1.0 mm, tolerance 0.1 mm', plate(0.001, 1e-4), [1, 0]],
]) {
  near(`${name}: volume over exact`, volume, seen[0], 0.001);
  near(`${name}: centre off by [mm]`, offset, seen[1], 0.01);
}
JS
node run.mjs
