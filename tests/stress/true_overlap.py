# SPDX-License-Identifier: GPL-2.0-or-later
"""Overlap of two rounded bodies from their corners and radii alone, by formulas that the package does not use.

The core is the intersection of the half-spaces of the sharp faces, moved inwards by the radius (Qhull). Where cores are
apart their distance is the least one of all pairs of edges and of all corners over faces; where they overlap it is,
negative, the greatest separation along normals of faces and products of edges (separating axes).
"""
import itertools

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection

SAME = 1e-7
"""Corners of a core closer than this share of its size are one, and are in a plane."""


class Core:
    """Core of a body in its own frame, and where it is. corners (n, 3), normals (m, 3), offsets (m,), edges (k, 2): of
    corners."""

    def __init__(self, sharp, radius):
        planes = np.unique(np.round(ConvexHull(sharp).equations, 9), axis=0)
        planes[:, 3] += radius
        corners = HalfspaceIntersection(planes, inner_point(planes)).intersections
        size = np.ptp(corners, axis=0).max()
        _, first = np.unique(np.round(corners / (SAME * size)), axis=0, return_index=True)
        corners = corners[first]
        close = [any(np.linalg.norm(corners[:k] - c, axis=1) < SAME * size) for k, c in enumerate(corners)]
        self.corners, self.normals, self.offsets = corners[~np.array(close)], planes[:, :3], -planes[:, 3]
        inside = np.abs(self.corners @ self.normals.T - self.offsets) < SAME * size
        pairs = itertools.combinations(range(len(self.corners)), 2)
        self.edges = np.array([(i, j) for i, j in pairs if (inside[i] & inside[j]).sum() >= 2])
        self.radius = radius
        self.reach = np.linalg.norm(self.corners, axis=1).max() + radius

    def placed(self, position, rotation):
        """Placed core in the world. rotation (3, 3): body to world"""
        corners, normals = self.corners @ rotation.T + position, self.normals @ rotation.T
        return Placed(corners, normals, self.offsets + normals @ position, corners[self.edges], self.radius)


class Placed:
    """Core in the world frame. edges (k, 2, 3): their ends."""

    def __init__(self, corners, normals, offsets, edges, radius):
        self.corners, self.normals, self.offsets, self.edges, self.radius = corners, normals, offsets, edges, radius


def inner_point(planes):
    """Centre of the largest ball within half-spaces (m, 4) with unit normals."""
    rows = np.column_stack([planes[:, :3], np.ones(len(planes))])
    found = linprog([0, 0, 0, -1], rows, -planes[:, 3], bounds=[(None, None)] * 3 + [(0, None)])
    return found.x[:3]


def face_separation(a, b):
    """Greatest distance of all corners of `b` from a face of `a`, negative within all. [m]"""
    return ((a.normals @ b.corners.T).min(axis=1) - a.offsets).max()


def edge_separation(a, b):
    """Greatest separation along products of edges; -inf without any. [m]"""
    directions = [np.unique(np.round(e[:, 1] - e[:, 0], 12), axis=0) for e in (a.edges, b.edges)]
    axes = np.cross(directions[0][:, None], directions[1][None]).reshape(-1, 3)
    scale = np.linalg.norm(directions[0], axis=1)[:, None] * np.linalg.norm(directions[1], axis=1)[None]
    length = np.linalg.norm(axes, axis=1)
    axes = axes[length > 1e-6 * scale.ravel()] / length[length > 1e-6 * scale.ravel()][:, None]
    if not len(axes):
        return -np.inf
    on_a, on_b = axes @ a.corners.T, axes @ b.corners.T
    return max((on_b.min(1) - on_a.max(1)).max(), (on_a.min(1) - on_b.max(1)).max())


def edge_distance(a, b):
    """Least distance of an edge of `a` from one of `b`, ends included (Ericson, Real-Time Collision Detection, 5.1.9).
    [m]"""
    p, q = a.edges[:, None, 0], b.edges[None, :, 0]
    d, e, r = a.edges[:, None, 1] - p, b.edges[None, :, 1] - q, p - q
    dot = lambda x, y: (x * y).sum(axis=-1)
    dd, ee, de, dr, er = dot(d, d), dot(e, e), dot(d, e), dot(d, r), dot(e, r)
    determinant = dd * ee - de * de
    skew = determinant > 1e-12 * dd * ee
    s = np.where(skew, np.clip((de * er - dr * ee) / np.where(skew, determinant, 1), 0, 1), 0)
    t = (de * s + er) / ee
    s = np.where(t < 0, np.clip(-dr / dd, 0, 1), np.where(t > 1, np.clip((de - dr) / dd, 0, 1), s))
    gap = r + s[..., None] * d - np.clip(t, 0, 1)[..., None] * e
    return np.sqrt(dot(gap, gap).min())


def corner_distance(a, b, within):
    """Least height of a corner of `b` over a face of `a` that it is above, inf for none below `within`. [m]"""
    heights = a.normals @ b.corners.T - a.offsets[:, None]
    least = np.inf
    for face, corner in np.argwhere((heights > 0) & (heights < within)):
        foot = b.corners[corner] - heights[face, corner] * a.normals[face]
        if (a.normals @ foot - a.offsets).max() < 1e-9:
            least = min(least, heights[face, corner])
    return least


def overlap(a, b):
    """Overlap of two placed cores with their radii [m]; -inf where they do not touch."""
    reach = a.radius + b.radius
    faces = max(face_separation(a, b), face_separation(b, a))
    if faces > reach:
        return -np.inf
    if faces <= 0:
        axes = max(faces, edge_separation(a, b))
        if axes <= 0:
            return reach - axes
    return reach - min(edge_distance(a, b), corner_distance(a, b, reach), corner_distance(b, a, reach))
