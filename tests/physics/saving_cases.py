# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 8: save, load and continue gives the bits of the uninterrupted run."""
import os
import tempfile

import small_scene
import yade.wrapper as yw
import yade_timber as yt
from planar_scene import advance
from rows import Registry, Row
from yade.minieigenHP import Vector3
from yade_timber.scene.engines import find_engine

case = Registry()
O = yw.Omega()
CUTS = (0.05, 0.17, 0.3)
"""Times of saving: while the block slides, while it touches the column, after springs have broken. [s]"""
END = 0.4
"""[s]"""


def load():
    """The small scene under ground motion, with joints that break when the block hits the column."""
    shake = yw.GroundMotionEngine(step=0.01, acceleration=[Vector3(0.8 * (k % 7 - 3), 0.3 * (k % 5 - 2), 0) for k in range(30)], start=0.02)
    small_scene.load(strength=60.0, ground_motion=shake)


def outcome():
    """Positions, orientations and velocities to the last bit, energies and breaks."""
    breaks = [(b.time, b.joint, b.spring, b.cause, b.force) for b in find_engine(yw.JointEngine).breaks]
    return small_scene.as_hex(), {name: value.hex() for name, value in yt.energy().items()}, breaks


@case
def save_load_continue():
    """The run is saved and loaded at one of three times and continued to its end."""
    load()
    advance(END)
    uninterrupted = outcome()
    rows = [Row("8", "save and load: springs broken in the run (> 0) [-]", 1, float(len(uninterrupted[2]) > 0), bound=0)]
    for cut in CUTS:
        load()
        advance(cut)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.bin.gz")
            O.save(path)
            O.reset()
            O.load(path)
        O.run(round(END / O.dt) - O.iter, True)
        state, energies, breaks = outcome()
        different = sum(a != b for a, b in zip(state, uninterrupted[0]))
        different += sum(energies[name] != uninterrupted[1][name] for name in energies) + (breaks != uninterrupted[2])
        rows.append(Row("8", f"saved and loaded at {cut:g} s: numbers that differ [-]", 0, different, bound=0, dt=1e-4, note="all bits of positions, velocities, energies, breaks"))
    return rows
