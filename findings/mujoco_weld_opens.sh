#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# MuJoCo 3.14.0: how far a weld opens under a force depends on the mass of its body, not on a stiffness.
# Guess: a weld to the world is rigid, or yields by the same distance under 100 N whatever it holds.
# Seen: 20.2 mm at 0.1 kg, 2.2 mm at 1 kg, 0.57 mm at 10 kg (own weight included).
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
const opening = (mass) => { // [mm] after 10 s under 100 N and the weight
  const model = M.MjModel.from_xml_string(`<mujoco><worldbody><body name="b" pos="0 0 1"><freejoint/>
    <geom type="box" size="0.1 0.1 0.1" mass="${mass}"/></body></worldbody>
    <equality><weld body1="b"/></equality></mujoco>`);
  const data = new M.MjData(model);
  data.xfrc_applied[8] = -100;
  for (let i = 0; i < 5000; i++) M.mj_step(model, data);
  return 1000 * (1 - data.qpos[2]);
};
near('0.1 kg [mm]', opening(0.1), 20.2, 0.3);
near('1 kg [mm]', opening(1), 2.2, 0.05);
near('10 kg [mm]', opening(10), 0.57, 0.02);
JS
node run.mjs
