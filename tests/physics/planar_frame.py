# SPDX-License-Identifier: GPL-2.0-or-later
"""A plane frame of rounded prisms with contacts and joints, written from the equations of the paper alone.

Pure numpy, without YADE and the package. The frame lies in the plane of x (right) and z (up); angles are positive from
x to z.
Corners of parts are (n, 2) arrays; other vectors in the plane are complex, x + i z, so that a rotation is a product.
Every body is a prism, symmetric about the plane, and no two neighbours have the same width: each contact of a corner
with a side then represents two contact points in space, one on each side of the plane (`SIDES`).
"""
import dataclasses

import numpy as np

SIDES = 2.0
GRAVITY = 9.81
"""[m/s2]"""


@dataclasses.dataclass
class Part:
    """A prism: corners (n, 2) in order, counter-clockwise, x and z [m]; width across the plane [m]."""

    name: str
    corners: np.ndarray
    width: float
    fixed: bool = False


@dataclasses.dataclass
class Tie:
    """A joint: its spring points (n, 2) in the plane [m], each of which represents two springs of `stiffness` [N/m] in
    space.
    """

    first: str
    second: str
    points: np.ndarray
    stiffness: float


@dataclasses.dataclass
class Timber:
    """Material of all parts: density [kg/m3], Young's modulus [Pa], Poisson's ratio [-], friction coefficient [-]."""

    density: float = 340.0
    young: float = 90e3 * 9.8e4
    poisson: float = 0.4
    friction: float = 0.5


def rectangle(x0, z0, x1, z1):
    """Corners (4, 2) of an upright rectangle [m]."""
    return np.array([[x0, z0], [x1, z0], [x1, z1], [x0, z1]], float)


def polygon_moments(corners):
    """Area [m2], centroid (2,) [m] and polar second moment about the centroid [m4] of a polygon."""
    p, q = corners, np.roll(corners, -1, axis=0)
    twice = p[:, 0] * q[:, 1] - q[:, 0] * p[:, 1]
    area = twice.sum() / 2
    centroid = ((p + q) * twice[:, None]).sum(0) / (6 * area)
    polar = ((p * p + p * q + q * q).sum(1) * twice).sum() / 12
    return area, centroid, polar - area * centroid @ centroid


def edge_normals(corners):
    """Unit directions (n, 2) of the sides and their outward normals (n, 2)."""
    along = np.roll(corners, -1, axis=0) - corners
    along = along / np.linalg.norm(along, axis=1)[:, None]
    return along, np.stack([along[:, 1], -along[:, 0]], 1)


def inset(corners, radius):
    """Corners of the inner core: every side moved inwards by the radius."""
    along, normal = edge_normals(corners)
    offset = (normal * corners).sum(1) - radius
    before, offset_before = np.roll(normal, 1, axis=0), np.roll(offset, 1)
    return np.array(
        [np.linalg.solve([n0, n1], [d0, d1]) for n0, n1, d0, d1 in zip(before, normal, offset_before, offset)])


def rounding(part):
    """10 % of the prism's shortest edge (paper, section 2.2). [m]"""
    sides = np.linalg.norm(np.roll(part.corners, -1, axis=0) - part.corners, axis=1)
    return 0.1 * min(sides.min(), part.width)


def dot(a, b):
    """Scalar product of complex vectors."""
    return (a.conj() * b).real


def cross(a, b):
    """a x b of complex vectors, positive from x to z."""
    return (a.conj() * b).imag


def flat(points):
    """(n, 2) array -> (n,) complex."""
    return np.asarray(points)[..., 0] + 1j * np.asarray(points)[..., 1]


class Frame:
    """Masses, contact candidates and springs of a frame as arrays; positions (n,) complex and angles (n,) are those of
    its parts.

    parts: list of Part, ties: list of Tie, pairs: names of parts that may touch, reach: largest initial distance of a
    corner from a side that makes them a candidate [m].
    """

    def __init__(self, parts, ties, pairs, timber=Timber(), reach=0.05):
        self.parts, self.ties, self.timber = parts, ties, timber
        self.index = {p.name: k for k, p in enumerate(parts)}
        moments = [polygon_moments(p.corners) for p in parts]
        volume = np.array([m[0] * p.width for m, p in zip(moments, parts)])
        self.start = flat([m[1] for m in moments])
        self.mass = timber.density * volume
        self.inertia = np.array([timber.density * m[2] * p.width for m, p in zip(moments, parts)])
        self.free = np.array([not p.fixed for p in parts])
        self.sphere = np.cbrt(3 * volume / (4 * np.pi))
        self._find_candidates(pairs, reach)
        self._set_springs(ties)

    def _find_candidates(self, pairs, reach):
        radius = [rounding(p) for p in self.parts]
        cores = [inset(p.corners, r) for p, r in zip(self.parts, radius)]
        rows = []
        for a, b in [(self.index[m], self.index[n]) for pair in pairs for m, n in (pair, pair[::-1])]:
            along, normal = edge_normals(cores[b])
            length = np.linalg.norm(np.roll(cores[b], -1, axis=0) - cores[b], axis=1)
            for corner in cores[a]:
                for tail, t, n, size in zip(cores[b], along, normal, length):
                    if abs((corner - tail)
                           @ n) < reach + radius[a] + radius[b] and -reach < (corner - tail) @ t < size + reach:
                        rows.append((a, b, flat(corner) - self.start[a], flat(tail) - self.start[b], flat(n), size,
                                     radius[a], radius[a] + radius[b]))
        columns = [np.array(c) for c in zip(*rows)]
        self.of, self.on, self.corner, self.edge, self.normal, self.length, self.radius, self.touch = columns
        self.sum_of, self.sum_on = self._sums(self.of), self._sums(self.on)
        self._set_pair_properties()

    def _sums(self, parts):
        """Matrix that sums the forces on each part."""
        return (np.arange(len(self.parts))[:, None] == parts[None, :]).astype(float)

    def _set_pair_properties(self):
        t = self.timber
        modulus = t.young / (2 * (1 - t.poisson**2))  # Eq. 35, equal materials
        radius = 1 / (1 / self.sphere[self.of] + 1 / self.sphere[self.on])  # Eq. 36
        self.hertz = modulus * np.sqrt(radius)
        self.shear_ratio = 1 / (2 * (1 + t.poisson))  # Eq. 40
        inverse = np.where(self.free, 1 / self.mass, 0)
        self.pair_mass = 1 / (inverse[self.of] + inverse[self.on])  # Eq. 43

    def _set_springs(self, ties):
        rows = [(self.index[t.first], self.index[t.second], flat(point), t.stiffness) for t in ties
                for point in t.points]
        columns = list(zip(*rows)) if rows else [[], [], [], []]
        self.spring_a, self.spring_b = np.array(columns[0], int), np.array(columns[1], int)
        self.sum_spring_a, self.sum_spring_b = self._sums(self.spring_a), self._sums(self.spring_b)
        points = np.array(columns[2], complex)
        self.anchor_a, self.anchor_b = points - self.start[self.spring_a], points - self.start[self.spring_b]
        self.spring_k = SIDES * np.array(columns[3], float)

    def overlaps(self, position, angle):
        """Overlap of every candidate (0 if separate) [m], positions of the contacts [m], outward unit normals."""
        rotation = np.exp(1j * angle)
        rotation_on = rotation[self.on]
        x = position[self.of] + rotation[self.of] * self.corner
        normal = rotation_on * self.normal
        gap = normal.conj() * (x - position[self.on] - rotation_on * self.edge
                               )  # height + i times the distance along the side
        overlap = self.touch - gap.real
        near = (overlap > 0) & (gap.real > 0) & (gap.imag >= 0) & (gap.imag <= self.length)
        overlap = np.where(near, overlap, 0.0)
        return overlap, x - (self.radius - overlap / 2) * normal, normal

    def normal_law(self, overlap):
        """Elastic force (Eq. 37) [N] and stiffness (Eq. 39) [N/m] of one contact point."""
        root = self.hertz * np.sqrt(overlap)
        return 4 / 3 * root * overlap, 2 * root

    def add_springs(self, position, angle, force, moment):
        """Adds the joints' forces (Eqs. 25-34) to force (n,) complex [N] and moment (n,) [N m]."""
        rotation = np.exp(1j * angle)
        arm_a, arm_b = rotation[self.spring_a] * self.anchor_a, rotation[self.spring_b] * self.anchor_b
        pull = self.spring_k * (position[self.spring_b] + arm_b - position[self.spring_a] - arm_a)
        force += self.sum_spring_a @ pull - self.sum_spring_b @ pull
        moment += self.sum_spring_a @ cross(arm_a, pull) - self.sum_spring_b @ cross(arm_b, pull)

    def add_contacts(self, position, at, push, force, moment):
        """Adds the forces `push` of single contact points on the corner's part, for both sides of the plane."""
        push = SIDES * push
        force += self.sum_of @ push - self.sum_on @ push
        moment += self.sum_of @ cross(at - position[self.of], push) - self.sum_on @ cross(at - position[self.on], push)


class LinearFrame:
    """Small motions of a frame about its equilibrium under gravity, with sticking contacts; coordinates (x, z, angle)
    of each free part.
    """

    def __init__(self, frame):
        self.frame = frame
        self.bodies = np.flatnonzero(frame.free)
        self.mass = np.stack([frame.mass, frame.mass, frame.inertia], 1)[self.bodies].ravel()
        self.rest = np.zeros(3 * len(self.bodies))
        self.shear_springs = None
        self._find_rest()
        self.stiffness = -self._slope(self.rest)

    def configuration(self, q):
        """Positions and angles (n,) of all parts for coordinates q."""
        position, angle = self.frame.start.copy(), np.zeros(len(self.frame.parts))
        position[self.bodies] += flat(q.reshape(-1, 3))
        angle[self.bodies] += q.reshape(-1, 3)[:, 2]
        return position, angle

    def force(self, q):
        """Generalised forces: gravity, joints, normal springs, tangential springs of the last `stick`."""
        f = self.frame
        position, angle = self.configuration(q)
        force, moment = -1j * GRAVITY * f.mass, np.zeros(len(f.parts))
        overlap, at, normal = f.overlaps(position, angle)
        push = f.normal_law(overlap)[0] * normal
        if self.shear_springs is not None:
            stiffness, on_corner, on_edge = self.shear_springs
            rotation = np.exp(1j * angle)
            moved = position[f.of] + rotation[f.of] * on_corner - position[f.on] - rotation[f.on] * on_edge
            push = push - stiffness * (moved - dot(normal, moved) * normal)
        f.add_contacts(position, at, push, force, moment)
        f.add_springs(position, angle, force, moment)
        return np.stack([force.real, force.imag, moment], 1)[self.bodies].ravel()

    def stick(self, q):
        """Set the tangential springs to the present stiffness; they are unstretched at the points of the first call."""
        f = self.frame
        position, angle = self.configuration(q)
        overlap, at, _ = f.overlaps(position, angle)
        back = np.exp(-1j * angle)
        ends = self.shear_springs[1:] if self.shear_springs else (
            back[f.of] * (at - position[f.of]), back[f.on] * (at - position[f.on])
        )
        self.shear_springs = (f.shear_ratio * f.normal_law(overlap)[1], *ends)

    def _slope(self, q, step=1e-9):
        """Jacobian of `force` by central differences of 1 nm, far below the static overlaps of some um."""
        return np.array([(self.force(q + e) - self.force(q - e)) / (2 * step) for e in step * np.eye(len(q))]).T

    def _find_rest(self):
        """Newton iteration from a vertical displacement of some um, at which all touching points overlap."""
        self.rest.reshape(-1, 3)[:, 1] = -5e-6 * (1 + self.frame.start[self.bodies].imag)
        for _ in range(60):
            self.stick(self.rest)
            change = np.linalg.solve(self._slope(self.rest), -self.force(self.rest))
            self.rest = self.rest + change * min(1.0, 2e-6 / abs(change).max())
            if abs(change).max() < 1e-13:
                return
        raise RuntimeError("no equilibrium found")

    def deflection(self, load):
        """Displacement for generalised loads (3 per free part)."""
        return np.linalg.solve(self.stiffness, load)

    def modes(self):
        """Natural frequencies [Hz], ascending, and mode shapes (columns)."""
        values, shapes = np.linalg.eig(self.stiffness / self.mass[:, None])
        order = np.argsort(values.real)
        return np.sqrt(values.real[order]) / (2 * np.pi), shapes.real[:, order]
