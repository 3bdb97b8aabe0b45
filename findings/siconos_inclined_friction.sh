#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Siconos 4.4.0 (Debian 12): friction on an inclined face is less than mu; on a level face it is mu.
# Guess: a block with mu = 0.5 rests on a slope of 26 degrees (tan 26 = 0.488) as under gravity tilted by 26 degrees.
# Seen: it slides by 52 mm in 0.5 s on the slope; under tilted gravity it moves by less than 1 mm.
# Needs Debian's python3-siconos, python3-scipy, python3-h5py. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >run.py <<'PY'
import math
import sys

import numpy as np
from siconos.io.mechanics_run import MechanicsHdf5Runner
from siconos.mechanics.collision.tools import Contactor

SLOPE, MASS, G = math.radians(26), 10.0, 9.81


def way(angle, tilt):
    """Of a block in 0.5 s, on a floor turned by an angle, under gravity tilted by another one. [mm]"""
    name = f"turned_{angle:.3f}.hdf5"
    pose = [math.cos(angle / 2), 0, math.sin(angle / 2), 0]
    up = np.array([math.sin(angle), 0, math.cos(angle)])
    with MechanicsHdf5Runner(io_filename=name, mode="w") as out:
        out.add_primitive_shape("plate", "Box", (12, 3, 1))
        out.add_primitive_shape("brick", "Box", (0.4, 0.4, 0.1))
        out.add_Newton_impact_friction_nsl("contact", mu=0.5, e=0.0)
        out.add_object("floor", [Contactor("plate")], translation=-0.5 * up, orientation=pose)
        inertia = MASS / 12 * np.diag([0.17, 0.17, 0.32])
        out.add_object("block", [Contactor("brick")], translation=0.05 * up, orientation=pose, mass=MASS,
                       inertia=inertia)
    with MechanicsHdf5Runner(io_filename=name, mode="r+") as out:
        weight = [MASS * G * math.sin(tilt), 0, -MASS * G * math.cos(tilt)]
        out.run(t0=0, T=0.5, h=1 / 240, output_frequency=1, verbose=False, verbose_progress=False,
                set_external_forces=lambda body: body.setFExtPtr(weight))
        rows = np.array(out.dynamic_data())
        return 1e3 * np.linalg.norm(rows[-1, 2:5] - rows[0, 2:5])


level, inclined = way(0.0, SLOPE), way(SLOPE, 0.0)
print(f"level, gravity tilted: {level:.2f} mm, seen 0.2\ninclined: {inclined:.1f} mm, seen 52")
sys.exit(not (level < 1 and abs(inclined - 52) < 2))
PY
OPENBLAS_NUM_THREADS=1 /usr/bin/python3 run.py | grep mm
