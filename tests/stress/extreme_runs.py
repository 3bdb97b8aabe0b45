# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of houses in extreme conditions: records with spikes and steps, vertices in single precision, long shaking."""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.house import build_house, load_house
from timber_houses.motion import GroundMotion, default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines

O = yw.Omega()

GAIN = 1e-3
"""Largest energy gain over the input [-]. Observed: 0.04 %, in six seconds of strong shaking under snow at 5e-4 s."""
LOSS = 0.01
"""Largest energy loss in the balance over the input [-]. Impacts above some 10 m/s of one or two steps lose up to a
tenth of their energy;
observed in complete runs: at most 0.13 % (A, earthquake)."""
SPIKE = 100.0
"""10 g in one sample of 10 ms. [m/s2]"""
STEP = 8.0
"""Ground acceleration that changes its sign from one sample to the next. [m/s2]"""


def rough_record(duration):
    """GroundMotion in samples of 10 ms: steps of STEP that change direction every 0.2 s, and a spike in a new direction
    every 0.1 s.
    """
    count = round(duration / 0.01)
    acceleration = np.zeros((count, 3))
    for k in range(count):
        acceleration[k, k // 20 % 2] = STEP * (-1) ** (k // 40)
        if k % 10 == 5:
            acceleration[k, k // 10 % 3] += SPIKE * (-1) ** (k // 30)
    return GroundMotion(0.01, acceleration, "spikes and steps")


def strong_part(duration):
    """The strongest part of the synthetic motion, repeated."""
    motion = default_motion()
    strong = motion.acceleration[round(17.6 / motion.dt) : round(27.6 / motion.dt)]
    return GroundMotion(motion.dt, np.tile(strong, (int(np.ceil(duration / 10.0)), 1)), "strong part, repeated")


def shaken(house, motion, duration, scale=1.0, snow_depth=0.0, dt=DEFAULT_DT):
    """Run a house; returns (largest ratio of a body's speed to its bound, sampled every 0.05 s [-], energy gained over
    the input [-]).
    """
    scenario.build(scenario.Scenario("extreme", house, motion, snow_depth, scale=scale, dt=dt))
    bounds = speed_bounds(motion, duration, scale)
    fastest = 0.0
    while O.time < duration - O.dt / 2:
        sample = min(O.time + 0.05, duration)
        while O.time < sample - O.dt / 2:
            O.step()
        fastest = max(fastest, max(b.state.vel.norm() / bound for b, bound in zip(O.bodies, bounds)))
    terms = yt.energy()
    energy_input = abs(terms["ground_motion"]) + max(0.0, -terms["gravity"])
    return fastest, yt.energy_residual(terms) / energy_input


def expect_sound(found):
    """Velocities within their bounds, energy gain and loss as well. found: as returned by `shaken`."""
    fastest, gained = found
    assert fastest < 1 and -LOSS < gained < GAIN, found


def speed_bounds(motion, duration, scale=1.0):
    """Bound of each body's velocity: ground velocity, free fall over the height of the house, all springs of its joints
    at their strength [m/s].
    """
    ground = scale * np.linalg.norm(np.cumsum(motion.acceleration, axis=0) * motion.dt, axis=1).max()
    stored = np.zeros(len(O.bodies))  # [J]
    for joint in engines.find_engine(yw.JointEngine).joints:
        if np.isfinite(joint.strength):
            energy = len(joint.broken) * joint.strength**2 / (2 * min(joint.kn, joint.ks))
            stored[[joint.id1, joint.id2]] += energy
    return ground + np.sqrt(2 * 9.81 * 8.0) + np.sqrt(2 * stored / [b.state.mass for b in O.bodies])


def single_precision(house, snow_depth):
    """Names of the elements that vertices in single precision change: refused, another number of faces, another volume.
    """
    model = build_house(load_house(house), snow_depth=snow_depth)
    changed = []
    for element in model.elements:
        exact = yt.polyhedron(element.vertices)
        try:
            rounded = yt.polyhedron(np.asarray(element.vertices, np.float32))
        except ValueError as refusal:
            changed.append(f"{element.name}: {refusal}")
            continue
        faces = len(rounded.shape.faces()) == len(exact.shape.faces())
        if not faces or abs(rounded.state.mass / exact.state.mass - 1) > 1e-4:
            changed.append(element.name)
    return changed


def float32_house(house):
    """The house in YADE with all vertices and joint points rounded to single precision, under its own weight."""
    model = build_house(load_house(house), snow_depth=0.0)
    for element in model.elements:
        element.vertices = np.asarray(element.vertices, np.float32)
    for joint in model.joints:
        joint.points = np.asarray(joint.points, np.float32).astype(float)
    O.reset()
    joints = scenario.add_joints(model, scenario.add_elements(model))
    O.engines = engines.engines(joints=joints, **scenario.law_options(model.law))
    O.dt = DEFAULT_DT


def largest_displacement():
    """Largest displacement of a body from its reference position [m]."""
    return max(b.state.displ().norm() for b in O.bodies)
