# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases of the benchmarks of error against run time: builders build(dt, options) and the curves that are compared."""
import math

import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from yade.minieigenHP import Quaternion, Vector3
from timber_houses.motion import GroundMotion, default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines

O = yw.Omega()

SAMPLE = 1e-3
"""Simulated time between samples [s]; a multiple of every time step."""
REFERENCE = {"sweeps": 500, "tolerance": 1e-6}
"""Solver options of the reference runs."""
UNBREAKABLE = 1e12
"""Strength of joints in cases without breaks [N]."""
STRONG = 17.6
"""Start of the strong part of the synthetic motion [s]."""
STOREYS = 2
"""Of the houses."""


def plate():
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))


def build_impact(dt, options):
    """A slightly tilted cube falls at 1 m/s."""
    O.reset()
    plate()
    rotation = Quaternion(Vector3(1, 0.3, 0).normalized(), 0.02)
    cube = yt.box((0.2, 0.2, 0.2), (0, 0, 0.1035), orientation=rotation)
    O.bodies.append(cube)
    yt.set_velocity(cube, (0, 0, -1))
    O.dt, O.engines = dt, yt.engines(**options)


def build_rocking(dt, options):
    """A slender block released at a tilt of 0.1 rad."""
    O.reset()
    plate()
    rotation = Quaternion(Vector3(0, 1, 0), 0.1)
    centre = rotation * Vector3(-0.1, 0, 0.4)
    O.bodies.append(yt.box((0.2, 0.3, 0.8), (0.1 + centre[0], 0, centre[2]), orientation=rotation))
    O.dt, O.engines = dt, yt.engines(**options)


def build_frame(dt, options):
    """Two columns and a beam, joined, under a ground acceleration of 3 m/s2 at 2 Hz."""
    O.reset()
    plate()
    ids = [O.bodies.append(yt.box((0.12, 0.12, 1.2), (x, 0, 0.6))) for x in (-0.6, 0.6)]
    ids.append(O.bodies.append(yt.box((1.32, 0.12, 0.12), (0, 0, 1.26))))
    times = np.arange(0, 2, 0.01)
    sway = np.column_stack([3 * np.sin(4 * np.pi * times), 0 * times, 0 * times])
    O.dt, O.engines = dt, yt.engines(ground_motion=GroundMotion(0.01, sway, "sine"), **options)
    for column, x in zip(ids, (-0.6, 0.6)):
        for other, z in ((0, 0.0), (ids[2], 1.2)):
            yt.connect(other, column, [(x + a, b, z) for a in (-0.06, 0.06) for b in (-0.06, 0.06)],
                       strength=UNBREAKABLE)


def build_house(house, strength=None):
    """A house in the strong part of the synthetic motion."""

    def build(dt, options):
        motion = default_motion()
        cut = GroundMotion(motion.dt, motion.acceleration[round(STRONG / motion.dt) :], "strong part")
        scenario.build(scenario.Scenario("precision", house, cut, dt=dt, options={"skip_rest": 0, **options}))
        for joint in engines.find_engine(yw.JointEngine).joints if strength else []:
            joint.strength = strength

    return build


def path():
    """Position of the last body [m]. Its velocity is discontinuous in impacts: a small shift in time would appear as a
    large error.
    """
    return {"path": [*O.bodies[len(O.bodies) - 1].state.pos]}


def drifts():
    """Displacement of the beam, or storey drifts."""
    sampler = engines.find_engine(yw.Sampler)
    if sampler is None:
        return {"drift": [*O.bodies[len(O.bodies) - 1].state.displ()]}
    levels = [[O.bodies[b].state.displ() for b, group in zip(sampler.bodies, sampler.groups) if group == level]
              for level in range(STOREYS)]  # the first groups
    means = np.array([np.mean([[*d][:2] for d in level], axis=0) for level in levels])
    return {"drift": np.diff(means, axis=0, prepend=0.0).ravel()}


def joint_forces():
    """Force of each joint [N]."""
    return [sum(f.norm() for f in joint.forces) for joint in engines.find_engine(yw.JointEngine).joints]


CASES = {  # build, curves, duration [s], smallest time step [s], whether joint forces are compared
    "impact": (build_impact, path, 0.03, 1e-6, False),
    "rocking block": (build_rocking, path, 1.0, 1e-6, False),
    "jointed frame": (build_frame, drifts, 1.0, 1e-6, True),
    "standing house C": (build_house("C", UNBREAKABLE), drifts, 0.5, 1e-5, True),
    "collapsing house A": (build_house("A"), drifts, 2.0, 1e-5, False),
}


def error(found, reference):
    """Largest difference over the largest reference value (of a curve: largest displacement from its start); infinite
    if the run failed.
    """
    if found is None or not np.isfinite(found).all():
        return math.inf
    scale = abs(reference - reference[0]).max() if reference.ndim > 1 else abs(reference).max()
    return abs(found - reference).max() / scale
