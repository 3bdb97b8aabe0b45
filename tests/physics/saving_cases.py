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


def load(strength=60.0, slip=None):
    """The small scene under ground motion, with joints that break when the block hits the column, or yield with a
    SlipLaw.
    """
    shake = yw.GroundMotionEngine(
        step=0.01, acceleration=[Vector3(0.8 * (k % 7 - 3), 0.3 * (k % 5 - 2), 0) for k in range(30)], start=0.02)
    small_scene.load(strength=strength, slip=slip, ground_motion=shake)


def outcome():
    """Positions, orientations and velocities to the last bit, energies, breaks and yielded stretches."""
    engine = find_engine(yw.JointEngine)
    breaks = [(b.time, b.joint, b.spring, b.cause, b.force) for b in engine.breaks]
    breaks += [x.hex() for joint in engine.joints for x in joint.largestStretches]
    return small_scene.as_hex(), {name: value.hex() for name, value in yt.energy().items()}, breaks


@case
def save_load_continue():
    """The run is saved and loaded at one of three times and continued to its end."""
    load()
    advance(END)
    rows = [Row("8", "save and load: springs broken in the run (> 0) [-]", 1,
                float(len(find_engine(yw.JointEngine).breaks) > 0), bound=0)]
    return rows + continued("")


@case
def save_load_continue_yielding():
    """The same with yielding joints: in the first loading, while they unload and in later cycles."""
    load(**small_scene.YIELDING)
    advance(END)
    dissipated, broken = yt.energy()["joint_yield"], len(find_engine(yw.JointEngine).breaks)
    rows = [Row("8", "save and load: yielding joints dissipate (> 0.1 J) and do not break [-]", 1,
                float(dissipated > 0.1 and not broken), bound=0)]
    return rows + continued("yielding joints, ", **small_scene.YIELDING)


def continued(name, **joints):
    """Rows of the numbers that differ from the uninterrupted run."""
    load(**joints)
    advance(END)
    uninterrupted, rows = outcome(), []
    for cut in CUTS:
        load(**joints)
        advance(cut)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.bin.gz")
            O.save(path)
            O.reset()
            O.load(path)
        O.run(round(END / O.dt) - O.iter, True)
        state, energies, breaks = outcome()
        different = sum(a != b for a, b in zip(state, uninterrupted[0]))
        different += sum(energies[term] != uninterrupted[1][term] for term in energies) + (breaks != uninterrupted[2])
        rows.append(Row("8", f"{name}saved and loaded at {cut:g} s: numbers that differ [-]", 0, different, bound=0,
                        dt=1e-4, note="all bits of positions, velocities, energies, breaks"))
    return rows
