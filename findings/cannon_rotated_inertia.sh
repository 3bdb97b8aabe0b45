#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# cannon-es 0.20.0: a body created with a rotation gets the moments of inertia of its bounding box in world axes.
# Guess: a column of 0.1 x 0.1 x 2 m and 1 kg has (0.334, 0.334, 0.0017) kg m2 about its own axes, however it was
# rotated at its creation.
# Seen: created at 45 degrees about y it has (0.185, 0.368, 0.185) kg m2; created upright and rotated afterwards it
# is right.
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
const inertia = (degrees) => new C.Body({ mass: 1, shape: new C.Box(new C.Vec3(0.05, 0.05, 1)),
  quaternion: new C.Quaternion().setFromAxisAngle(new C.Vec3(0, 1, 0), degrees * Math.PI / 180) }).inertia;
near('upright, about z [kg m2]', inertia(0).z, 0.0017, 1e-4);
near('created at 45 degrees, about z [kg m2]', inertia(45).z, 0.1846, 1e-3);
near('created at 90 degrees, about z [kg m2]', inertia(90).z, 0.3342, 1e-3);
JS
node run.mjs
