# SPDX-License-Identifier: GPL-2.0-or-later
"""A small scene with all mechanisms: a column and beam with damped joints, a block that slides into the column,
friction, gravity.

No faces are parallel, flush or symmetric, so that no comparison depends on ties. As a script it runs the scene and
prints the final state as hexadecimal numbers: `yade -j2 -n -x small_scene.py SECONDS [yielding]`.
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt

O = yw.Omega()
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
SIZES = {"plate": (3, 2.5, 0.2), "column": (0.12, 0.14, 1.2), "beam": (0.2, 1.0, 0.15), "block": (0.3, 0.25, 0.2)}
CENTRES = {
    "plate": (0, 0, -0.1), "column": (0.03, 0.02, 0.6 - 3e-6), "beam": (0, 0, 1.275 - 6e-6), "block": (
        0.55, 0.15, 0.1 - 3e-6)
}
"""Centres of the bodies, with overlaps of 3 um: zero overlap would be a tie. [m]"""
ANGLES = {"plate": 0.02, "column": 0.3, "beam": 0.1, "block": -0.4}
"""Rotations about the vertical. [rad]"""
NAMES = tuple(SIZES)
JOINTS = (("plate", "column", 0.0), ("column", "beam", 1.2))
"""Two bodies and the height of the springs [m]."""
YIELDING = {"strength": 60.0, "slip": yt.SlipLaw(0.002, 0.02, 0.3)}
"""Options of joints that yield at 1 mm, when the block hits the column, and soften from 2 mm on."""
DAMPING = 0.05
"""Damping ratio of the joints. [-]"""


def vertical(angle):
    """Rotation matrix about z."""
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


def corners(name):
    """Corners (8, 3) of a body [m]."""
    return (CORNERS * SIZES[name]) @ vertical(ANGLES[name]).T + CENTRES[name]


def joint_points(height):
    """Spring points (4, 3): the column's corners at this height [m]."""
    ends = (CORNERS[::2] * SIZES["column"]) @ vertical(ANGLES["column"]).T + CENTRES["column"]
    return np.column_stack([ends[:, :2], np.full(4, height)])


def append(order=NAMES, rotation=np.eye(3), shift=(0, 0, 0)):
    """Append the scene, rotated by a matrix (which may mirror) and then shifted. Returns {name: body id}."""
    ids, shift = {}, np.asarray(shift, float)
    for name in order:
        ids[name] = O.bodies.append(yt.polyhedron(corners(name) @ rotation.T + shift, fixed=name == "plate", name=name))
    yt.set_velocity(O.bodies[ids["block"]], rotation @ (-2.2, -0.3, 0),
                    np.linalg.det(rotation) * rotation @ (0, 0, 2.0))
    return ids


def join(ids, rotation=np.eye(3), shift=(0, 0, 0), strength=1e12, slip=None):
    """Add the joints, rotated and shifted likewise; strength [N]; slip: SlipLaw."""
    for first, second, height in JOINTS:
        points = joint_points(height) @ rotation.T + np.asarray(shift, float)
        yt.connect(ids[first], ids[second], points, strength=strength, damping_ratio=DAMPING, slip=slip)


def load(order=NAMES, rotation=np.eye(3), shift=(0, 0, 0), strength=1e12, slip=None, dt=1e-4, **options):
    """Empty YADE and load the scene. Returns {name: body id}."""
    O.reset()
    ids = append(order, rotation, shift)
    O.engines = yt.engines(gravity=tuple(rotation @ (0, 0, -9.81)), **options)
    O.dt = dt
    join(ids, rotation, shift, strength, slip)
    return ids


def poses(ids=range(4)):
    """Positions and orientations (n, 7) of these bodies."""
    states = [O.bodies[int(i)].state for i in ids]
    return np.array([list(s.pos) + [s.ori[k] for k in range(4)] for s in states])


def as_hex(ids=range(4)):
    """Positions, orientations, velocities and angular momenta, to the last bit."""
    values = [
        list(s.pos) + [s.ori[k] for k in range(4)] + list(s.vel) + list(s.angMom)
        for s in (O.bodies[int(i)].state for i in ids)
    ]
    return [x.hex() for row in values for x in row]


if __name__ == "__main__":
    import sys

    load(**(YIELDING if "yielding" in sys.argv else {}))
    O.run(round(float(sys.argv[1]) / O.dt), True)
    print("threads", O.numThreads)
    print("state", *as_hex())
