# SPDX-License-Identifier: GPL-2.0-or-later
"""A small scene with everything in it: a joined column and beam, a block that slides into the column, friction, gravity.

Nothing in it is parallel, flush or symmetric, so that no comparison rests on ties. As a script it runs the scene and prints
the final placements as hexadecimal numbers: `yade -j2 -n -x small_scene.py SECONDS`.
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from yade.minieigenHP import Vector3
from yade_timber.scene.bodies import angular_momentum

O = yw.Omega()
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
SIZES = {"plate": (3, 2.5, 0.2), "column": (0.12, 0.14, 1.2), "beam": (0.2, 1.0, 0.15), "block": (0.3, 0.25, 0.2)}
CENTRES = {"plate": (0, 0, -0.1), "column": (0.03, 0.02, 0.6 - 3e-6), "beam": (0, 0, 1.275 - 6e-6), "block": (0.55, 0.15, 0.1 - 3e-6)}
"""Pressed together by 3 um: touching at exactly nothing would be a tie. [m]"""
TURNS = {"plate": 0.02, "column": 0.3, "beam": 0.1, "block": -0.4}
"""About the vertical. [rad]"""
NAMES = tuple(SIZES)
JOINTS = (("plate", "column", 0.0), ("column", "beam", 1.2))
"""Two bodies and the height of the springs [m]."""


def vertical(angle):
    """Rotation matrix about z."""
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


def corners(name):
    """Corners (8, 3) of a body [m]."""
    return (CORNERS * SIZES[name]) @ vertical(TURNS[name]).T + CENTRES[name]


def joint_points(height):
    """Spring points (4, 3): the column's corners at this height [m]."""
    ends = (CORNERS[::2] * SIZES["column"]) @ vertical(TURNS["column"]).T + CENTRES["column"]
    return np.column_stack([ends[:, :2], np.full(4, height)])


def append(order=NAMES, turn=np.eye(3), shift=(0, 0, 0)):
    """Append the scene, turned by a matrix (which may mirror) and then shifted. Returns {name: body id}."""
    ids, shift = {}, np.asarray(shift, float)
    for name in order:
        ids[name] = O.bodies.append(yt.polyhedron(corners(name) @ turn.T + shift, fixed=name == "plate", name=name))
    block = O.bodies[ids["block"]].state
    block.vel = Vector3(*(turn @ (-2.2, -0.3, 0)))
    block.angVel = Vector3(*(np.linalg.det(turn) * turn @ (0, 0, 2.0)))
    block.angMom = angular_momentum(O.bodies[ids["block"]])
    return ids


def join(ids, turn=np.eye(3), shift=(0, 0, 0), strength=1e12):
    """Add the joints, turned and shifted likewise; strength [N]."""
    for first, second, height in JOINTS:
        yt.connect(ids[first], ids[second], joint_points(height) @ turn.T + np.asarray(shift, float), strength=strength)


def load(order=NAMES, turn=np.eye(3), shift=(0, 0, 0), strength=1e12, dt=1e-4, **options):
    """Empty YADE and load the scene. Returns {name: body id}."""
    O.reset()
    ids = append(order, turn, shift)
    O.engines = yt.engines(gravity=tuple(turn @ (0, 0, -9.81)), **options)
    O.dt = dt
    join(ids, turn, shift, strength)
    return ids


def placements(ids=range(4)):
    """Positions and orientations (n, 7) of these bodies."""
    states = [O.bodies[int(i)].state for i in ids]
    return np.array([list(s.pos) + [s.ori[k] for k in range(4)] for s in states])


def as_hex(ids=range(4)):
    """Everything that moves, to the last bit."""
    values = [list(s.pos) + [s.ori[k] for k in range(4)] + list(s.vel) + list(s.angMom) for s in (O.bodies[int(i)].state for i in ids)]
    return [x.hex() for row in values for x in row]


if __name__ == "__main__":
    import sys

    load()
    O.run(round(float(sys.argv[1]) / O.dt), True)
    print("threads", O.numThreads)
    print("state", *as_hex())
