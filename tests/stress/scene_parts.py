# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of random scenes: ground, container, shaking, masses, engines."""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import GroundMotion

O = yw.Omega()

LIGHT = 10.0
"""Mass of the lightest member from which on DEFAULT_DT is used [kg] (docs/scenes.md)."""
LIGHT_DT = 2e-4
"""[s]"""


def append(body):
    return O.bodies.append(body)


def ground(friction=0.6):
    return append(yt.box((40, 40, 1), (0, 0, -0.5), material=yt.timber(friction=friction), fixed=True))


def container(side, height):
    """Fixed floor and four walls, inner side and height [m]; returns their ids, the floor first."""
    ids, t = [append(yt.box((side, side, 0.2), (0, 0, -0.1), fixed=True))], 0.2
    for sign in (-1, 1):
        at = sign * (side + t) / 2
        ids.append(append(yt.box((t, side, height), (at, 0, height / 2), fixed=True)))
        ids.append(append(yt.box((side + 2 * t, t, height), (0, at, height / 2), fixed=True)))
    return ids


def start(motion=None, **options):
    """Time step and engines of the scene."""
    O.dt = DEFAULT_DT if min(b.state.mass for b in O.bodies if b.dynamic) >= LIGHT else LIGHT_DT
    O.engines = yt.engines(ground_motion=motion, **options)


def shaking(random, peak, duration, vertical=0.5):
    """GroundMotion of a few sines [m/s2] with a taper, of `duration` [s], and its largest velocity [m/s]."""
    t = np.arange(0, duration, 0.01)
    sines = sum(random.normal(size=(3, 1)) * np.sin(2 * np.pi * random.uniform(0.7, 6) * t + random.uniform(0, 6))
                for _ in range(5))
    sines *= np.sin(np.pi * t / duration) * np.array([[1], [1], [vertical]])
    acceleration = peak * sines.T / np.abs(sines).max()
    velocity = np.cumsum(acceleration, axis=0) * 0.01
    return GroundMotion(0.01, acceleration), np.linalg.norm(velocity, axis=1).max()


def masses(random, count):
    """Of `count` bodies over four decades. [kg]"""
    return random.permutation(np.geomspace(0.1, 1000, count) * random.uniform(0.7, 1.4, count))
