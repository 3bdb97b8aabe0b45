# SPDX-License-Identifier: GPL-2.0-or-later
"""Description of a scene, and the trajectories that every program returns for it. Needs no YADE.

Frames and units: z up; m, kg, s, N; orientations are unit quaternions (w, x, y, z) from the body's axes to the world's.
"""
import json
import math
from dataclasses import asdict, dataclass, field

import numpy as np

G = 9.81
"""[m/s2]"""
UPRIGHT = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Body:
    """A box of these extents, or the hull of these corners (relative to the position, which is the centroid)."""

    name: str
    position: tuple
    extents: tuple = None
    corners: tuple = None
    mass: float = None  # None: fixed
    orientation: tuple = UPRIGHT
    velocity: tuple = (0.0, 0.0, 0.0)
    spin: tuple = (0.0, 0.0, 0.0)
    shaken: bool = False  # moves as Scene.shaking says
    force_rate: float = 0.0  # growth of a force on the centroid along +x [N/s]
    torque: float = 0.0  # about z [N m]


@dataclass(frozen=True)
class Joint:
    """Between two bodies that are named; "ball": one point, "hinge": two points of its axis, "weld": four points,
    "spring": along x between the centroids, unstretched at the start.
    """

    kind: str
    first: str
    second: str
    points: tuple
    stiffness: float = 1e8  # of each point, for programs whose joints are springs [N/m]
    strength: float = None  # force at which it breaks [N]; None: never


@dataclass(frozen=True)
class Scene:
    """Bodies that touch have this friction coefficient and this restitution."""

    name: str
    duration: float
    bodies: tuple
    joints: tuple = ()
    friction: float = 0.5
    restitution: float = 0.0
    gravity: float = G
    shaking: tuple = None  # (peak acceleration [m/s2], frequency [Hz]) along x: a = A sin(2 pi f t)
    removed: int = 0  # bodies that are added and removed before the first step
    sample: float = 0.005  # between the samples of a trajectory [s]
    radius: float = 0.0  # rounding of edges for which the scene was made [m]
    weighed: str = None  # body whose vertical contact force is to be reported

    def body(self, name):
        return next(body for body in self.bodies if body.name == name)

    def as_json(self):
        return json.dumps(asdict(self))


def shaking_motion(shaking, time):
    """(displacement [m], velocity [m/s]) of a shaken body that has the mean velocity 0."""
    acceleration, frequency = shaking
    omega = 2 * math.pi * frequency
    return -acceleration / omega**2 * np.sin(omega * time), -acceleration / omega * np.cos(omega * time)


def box_inertia(mass, extents):
    """Principal moments of inertia. [kg m2]"""
    x, y, z = np.square(extents)
    return mass / 12 * np.array([y + z, x + z, x + y])


def hull_volume(corners):
    """Volume of a convex body [m3]."""
    from scipy.spatial import ConvexHull

    return ConvexHull(np.asarray(corners)).volume


@dataclass
class Trajectory:
    """Samples of one run: times (n,), and of each body positions (n, 3), orientations (n, 4), velocities and spins
    (n, 3). support: vertical contact force on a named body [N], where the program reports it. broken: time at which the
    scene's joint broke [s].
    """

    scene: Scene
    times: np.ndarray
    position: dict
    orientation: dict
    velocity: dict
    spin: dict
    support: np.ndarray = None
    broken: float = math.nan
    finite: bool = field(init=False)

    def __post_init__(self):
        self.times = np.asarray(self.times, float)
        for name in ("position", "orientation", "velocity", "spin"):
            setattr(self, name, {body: np.asarray(rows, float) for body, rows in getattr(self, name).items()})
        self.finite = all(np.isfinite(rows).all() for rows in self.position.values())

    def at(self, time):
        """Index of the sample nearest to this time."""
        return int(np.argmin(abs(self.times - time)))


class Recorder:
    """Collects a trajectory in a program that is driven from Python. state(name): position, orientation, velocity and
    spin.
    """

    def __init__(self, scene, state):
        self.scene, self.state, self.times, self.support, self.broken = scene, state, [], [], math.nan
        self.rows = {body.name: ([], [], [], []) for body in scene.bodies}

    def sample(self, time, support=None):
        self.times.append(time)
        self.support.append(math.nan if support is None else support)
        for name, columns in self.rows.items():
            for column, value in zip(columns, self.state(name)):
                column.append([float(x) for x in value])

    def trajectory(self):
        columns = [{name: rows[k] for name, rows in self.rows.items()} for k in range(4)]
        return Trajectory(self.scene, self.times, *columns, np.array(self.support), self.broken)


def sampling(scene, dt):
    """(steps between two samples, steps of the run)."""
    return max(1, round(scene.sample / dt)), round(scene.duration / dt)
