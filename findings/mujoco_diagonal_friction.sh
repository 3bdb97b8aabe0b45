#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# MuJoCo 3.14.0: with the default (pyramidal) cone a box slides farther at 45 degrees to the frame of its contact.
# Guess: the distance v^2 / (2 mu g) does not depend on the direction, within a few per cent.
# Seen: 1.00 of it along x and 1.41 of it (square root of 2) at 45 degrees; with cone="elliptic" 1.00 in both
# directions.
# Needs Node.js 20 and the npm registry. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund @mujoco/mujoco@3.14.0 >/dev/null
cat >run.mjs <<'JS'
import load from '@mujoco/mujoco';
const near = (name, value, seen, tolerance) => {
  console.log(`${name}: ${value.toFixed(4)}, seen ${seen}`);
  if (!(Math.abs(value - seen) <= tolerance)) process.exitCode = 1;
};
const M = await load();
const way = (cone, degrees) => { // over v^2 / (2 mu g)
  const model = M.MjModel.from_xml_string(`<mujoco><option timestep="0.002" cone="${cone}"/><worldbody>
    <geom type="plane" size="50 50 1" friction="0.3 0 0"/>
    <body pos="0 0 0.1"><freejoint/>
      <geom type="box" size="0.1 0.1 0.1" friction="0.3 0 0" mass="1"/></body></worldbody></mujoco>`);
  const data = new M.MjData(model), angle = degrees * Math.PI / 180;
  data.qvel[0] = 5 * Math.cos(angle);
  data.qvel[1] = 5 * Math.sin(angle);
  for (let i = 0; i < 2500; i++) M.mj_step(model, data);
  return Math.hypot(data.qpos[0], data.qpos[1]) / (25 / (2 * 0.3 * 9.81));
};
near('pyramidal, along x', way('pyramidal', 0), 1, 0.01);
near('pyramidal, 45 degrees', way('pyramidal', 45), 1.413, 0.01);
near('elliptic, 45 degrees', way('elliptic', 45), 1, 0.01);
JS
node run.mjs
