# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies of random scenes: boxes, prisms and hulls of 4 to 40 corners with a given mass."""
import numpy as np
import yade_timber as yt
from random_pairs import rotation
from yade.minieigenHP import Quaternion, Vector3

LEAST_RADIUS = 5e-4
"""Smallest rounding radius of a hull whose corners are random. [m]"""


def ring(count, radius):
    """Points (count, 2) on a circle."""
    angles = 2 * np.pi * np.arange(count) / count
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def prism(sides, radius, height, yaw=0.0):
    """Corners of an upright prism about the origin [m]; radius of the corners, yaw [rad]."""
    angles = yaw + 2 * np.pi * np.arange(sides) / sides
    rim = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.vstack([np.column_stack([rim, np.full(sides, z)]) for z in (-height / 2, height / 2)])


def hull(random):
    """Corners of a body with 4 to 40 of them, spread over an ellipsoid."""
    count = random.integers(4, 41)
    k = np.arange(count) + 0.5
    z, angle = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    unit = np.column_stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z])
    unit += random.normal(scale=0.25 / count**0.5, size=unit.shape)
    return unit / np.linalg.norm(unit, axis=1)[:, None] * random.uniform(0.45, 1, 3)


def lump(random, reach, turned=True):
    """Corners of a box, prism or hull about the origin, the farthest one at `reach` [m], turned or upright."""
    while True:
        kind = random.choice(("box", "prism", "hull"))
        if kind == "box":
            corners = prism(4, 2**0.5, 2, np.pi / 4) * random.uniform(0.3, 1, 3)
        elif kind == "prism":
            corners = prism(random.integers(3, 17), 1, random.uniform(0.4, 2.0))
        else:
            corners = hull(random)
        corners *= reach / np.linalg.norm(corners, axis=1).max()
        try:
            if yt.polyhedron(corners).shape.radius >= LEAST_RADIUS:
                return corners @ rotation(random).T if turned else corners
        except (ValueError, RuntimeError):
            continue


def solid(corners, centre, mass, friction=0.5):
    """Body of corners about `centre` [m]."""
    density = 340 * mass / yt.polyhedron(corners).state.mass
    return yt.polyhedron(corners + np.array(centre), yt.timber(density=density, friction=friction))


def placed(make, extents, centre, mass, yaw=0.0, pitch=0.0, fixed=False, friction=0.5, bearing=None):
    """Box by `yt.box` of a mass [kg] and a bearing strength [Pa], turned about y, then about z [rad]."""
    material = yt.timber(density=mass / np.prod(extents), friction=friction, bearing=bearing)
    turn = Quaternion(Vector3(0, 0, 1), yaw) * Quaternion(Vector3(0, 1, 0), pitch)
    return make(extents, centre, turn, material, fixed)
