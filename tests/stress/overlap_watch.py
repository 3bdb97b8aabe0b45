# SPDX-License-Identifier: GPL-2.0-or-later
"""Largest overlaps of the bodies of the scene that is loaded, and how much of them no load explains."""
import itertools
import math

import numpy as np
import yade.wrapper as yw
from true_overlap import Core, overlap

O = yw.Omega()

SHARE = 0.1
"""Overlap that no load explains, over the smaller rounding radius. [-]"""
TRAVEL = 2
"""Relative displacement of fast bodies that counts as explained overlap. [steps]"""
INTERVAL = 0.5
"""Time between two measurements. [s]"""


def bodies():
    """All but those that were erased."""
    return [b for b in O.bodies if b is not None]


class Overlaps:
    """Extremes of all measurements so far."""

    def __init__(self):
        self.cores = {}  # body id -> (shape, Core)
        self.deepest, self.unexplained = 0.0, -math.inf  # overlap, excess over its bound [m]
        self.pair = ""  # that has the excess
        self.next = 0.0  # time of the next measurement [s]

    def placed(self):
        """Body id -> placed core."""
        return {b.id: self.core(b).placed(np.array(b.state.pos), np.array(b.state.ori.toRotationMatrix()).reshape(3, 3))
                for b in bodies()}

    def core(self, body):
        if body.id not in self.cores or self.cores[body.id][0] is not body.shape:
            self.cores[body.id] = body.shape, Core(np.array(body.shape.vertices), body.shape.radius)
        return self.cores[body.id][1]

    def measure(self):
        """Take the scene as it is now."""
        cores = self.placed()
        for i, j in near(cores):
            depth = overlap(cores[i], cores[j])
            self.deepest = max(self.deepest, depth)
            excess = depth - explained(i, j) if depth > 0 else -math.inf
            if excess > self.unexplained:
                self.unexplained, self.pair = excess, f"{i}-{j} of {1e3 * depth:.2f} mm at {O.time:.1f} s"
        self.next = O.time + INTERVAL

    def measure_at_intervals(self):
        if O.time >= self.next:
            self.measure()


def near(cores):
    """Pairs of bodies, at least one of them free, whose bounding boxes overlap. cores: body id -> placed core"""
    boxes = {k: (c.corners.min(0) - c.radius, c.corners.max(0) + c.radius) for k, c in cores.items()}
    free = {k: O.bodies[k].dynamic for k in cores}
    for i, j in itertools.combinations(cores, 2):
        if free[i] or free[j]:
            (low, high), (other_low, other_high) = boxes[i], boxes[j]
            if (low <= other_high).all() and (other_low <= high).all():
                yield i, j


def explained(i, j):
    """Largest overlap of a pair that its load, its motion in some steps and the tolerance explain. [m]"""
    a, b = O.bodies[i], O.bodies[j]
    speed = (a.state.vel - b.state.vel).norm() + sum(
        s.state.angVel.norm() * max(v.norm() for v in s.shape.vertices) for s in (a, b))
    return overlap_of_load(a, b) + TRAVEL * O.dt * speed + SHARE * min(a.shape.radius, b.shape.radius)


def overlap_of_load(a, b):
    """Overlap at which the law has the elastic force of the most loaded point of a pair, Hertz's, of snow linear, and
    the largest plastic overlap of a point. [m]
    """
    if not (O.interactions.has(a.id, b.id) and O.interactions[a.id, b.id].isReal):
        return 0.0
    points = O.interactions[a.id, b.id].phys.points
    force = max((point[1] for point in points), default=0.0)
    crushed = max((point[4] for point in points), default=0.0)
    snow = [m.material.stiffnessPerMass * m.state.mass for m in (a, b) if isinstance(m.material, yw.SnowMat)]
    if snow:
        return force / min(snow)
    modulus = 1 / sum((1 - m.material.poisson**2) / m.material.young for m in (a, b))
    radius = 1 / sum((3 * m.state.mass / m.material.density / (4 * math.pi)) ** (-1 / 3) for m in (a, b))
    return crushed + (force / (4 / 3 * modulus * math.sqrt(radius))) ** (2 / 3)
