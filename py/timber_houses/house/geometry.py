# SPDX-License-Identifier: GPL-2.0-or-later
"""Convex polyhedra from vertices or half-spaces; contact polygon and separation of two. Lengths in m, world frame."""
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations

import numpy as np
import scipy  # submodules load on first use; pictures need none

SNAP_DIGITS = 12  # coordinates [m] are rounded to 1e-12, so that vertices computed from different planes become equal
AXES = np.eye(3)
FIRST, SECOND = np.array([1, 2, 0]), np.array([2, 0, 1])  # components of the factors of a cross product
SAME = 1e-9  # [m, or sine of an angle] below this two points, planes or directions count as one
KEPT = 4096
"""Number of polyhedra, and of pairs of them, that are kept: variants of a house, and lots of a town, share most
members. [-]"""


def following(points):
    """(n, ...) the next of each of n points around a polygon."""
    return np.concatenate([points[1:], points[:1]])


def cross(a, b):
    """Cross product of vectors (..., 3); numpy's own takes five times as long for a few of them."""
    return a[..., FIRST] * b[..., SECOND] - a[..., SECOND] * b[..., FIRST]


@dataclass(frozen=True, eq=False)
class Face:
    """A plane face: unit outward normal (3,), offset normal . x [m], vertices (n, 3) counter-clockwise from outside."""

    normal: np.ndarray
    offset: float
    points: np.ndarray

    @cached_property
    def axes(self):
        """(2, 3) `plane_axes`."""
        return np.array(plane_axes(self.normal))


@dataclass(frozen=True, eq=False)
class Polyhedron:
    """Convex polyhedron of vertices (n, 3); raises ValueError when flat or when a vertex is no corner of the hull."""

    vertices: np.ndarray

    @cached_property
    def hull(self):
        try:
            hull = scipy.spatial.ConvexHull(self.vertices)
        except (scipy.spatial.QhullError, ValueError):
            raise ValueError("vertices are flat, too few or not finite") from None
        if len(hull.vertices) != len(self.vertices):
            raise ValueError(f"{len(self.vertices) - len(hull.vertices)} of {len(self.vertices)} vertices lie inside"
                             " the convex hull")
        return hull

    @cached_property
    def faces(self):
        """Faces, coplanar triangles of the hull merged."""
        groups = []
        for simplex, equation in zip(self.hull.simplices, self.hull.equations):
            match = next((g for g in groups if np.abs(g[0] - equation).max() < 1e3 * SAME), None)
            if match is None:
                groups.append((equation, set(simplex)))
            else:
                match[1].update(simplex)
        return [_face(self.vertices[sorted(indices)], equation[:3]) for equation, indices in groups]

    @cached_property
    def face_normals(self):
        """(n, 3) normals of `faces`."""
        return np.array([face.normal for face in self.faces])

    @cached_property
    def normals(self):
        """(n, 3) face normals without parallel repeats."""
        return unique_directions(self.face_normals)

    @cached_property
    def edge_directions(self):
        """(n, 3) unit edge directions without parallel repeats."""
        edges = np.vstack([following(face.points) - face.points for face in self.faces])
        return unique_directions(edges / np.linalg.norm(edges, axis=1)[:, None])

    @cached_property
    def bounds(self):
        """(2, 3) lowest and highest corner of the axis-aligned bounding box."""
        return np.array([self.vertices.min(0), self.vertices.max(0)])

    @property
    def volume(self):
        """[m3]"""
        return self.hull.volume

    @cached_property
    def centroid(self):
        """(3,) centre of volume, from tetrahedra between an inner point and the hull's triangles."""
        inner = self.vertices.mean(0)
        corners = self.vertices[self.hull.simplices] - inner
        volumes = np.abs(np.linalg.det(corners))
        return inner + (corners.sum(1) / 4 * volumes[:, None]).sum(0) / volumes.sum()


def polyhedron(vertices):
    """Polyhedron of vertices (n, 3), the same object for the same numbers."""
    return _polyhedron(np.asarray(vertices, float).tobytes())


@lru_cache(maxsize=KEPT)
def _polyhedron(numbers):
    return Polyhedron(np.frombuffer(numbers).reshape(-1, 3).copy())


def _face(points, normal):
    """Face with its points ordered around `normal` and the normal recomputed from them (Newell)."""
    (u, v), local = plane_axes(normal), points - points.mean(0)
    points = points[np.argsort(np.arctan2(local @ v, local @ u))]
    normal = cross(points, following(points)).sum(0)
    normal = normal / np.linalg.norm(normal)
    return Face(normal, float(np.mean(points @ normal)), points)


def plane_axes(normal):
    """Two unit vectors u, v with u x v = normal."""
    u = cross(AXES[np.argmin(np.abs(normal))], normal)
    u = u / np.linalg.norm(u)
    return u, cross(normal, u)


def unique_directions(vectors):
    """Unit vectors (n, 3) without those parallel (either sense) to an earlier one."""
    sines = np.linalg.norm(cross(vectors[:, None], vectors), axis=2)
    return vectors[~np.tril(sines < SAME, -1).any(1)]


def box(low, high):
    """Vertices (8, 3) of the axis-aligned box from `low` to `high` (3,)."""
    return np.array([[x, y, z] for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])], float)


def halfspace_vertices(planes):
    """Vertices (n, 3) of the region where normal . x <= offset for every (normal (3,), offset [m]) of `planes`. Every
    triple of planes is solved, exact to rounding. Raises ValueError for an empty or flat region."""
    normals = np.array([p[0] for p in planes], float)
    scale = np.linalg.norm(normals, axis=1)
    normals, offsets = normals / scale[:, None], np.array([p[1] for p in planes], float) / scale
    triples = np.array(list(combinations(range(len(planes)), 3)), int).reshape(-1, 3)
    triples = triples[np.abs(np.linalg.det(normals[triples])) >= SAME]
    points = np.linalg.solve(normals[triples], offsets[triples][..., None])[..., 0]
    corners = []
    for point in points[(points @ normals.T <= offsets + SAME).all(1)]:
        if all(np.abs(point - other).max() > SAME for other in corners):
            corners.append(point)
    if len(corners) < 4:
        raise ValueError("the planes enclose no volume")
    return np.round(corners, SNAP_DIGITS) + 0.0


def near_boxes(solids, margin):
    """(k, (n,) numbers above k) for each polyhedron: those whose bounding boxes lie within `margin` [m] of its own."""
    bounds = np.array([solid.bounds for solid in solids])
    low, high = bounds[:, 0] - margin, bounds[:, 1]
    for k in range(len(bounds)):
        yield k, k + 1 + np.flatnonzero(((low[k] <= high[k + 1:]) & (low[k + 1:] <= high[k])).all(1))


def products(a, b):
    """Matrix product a b without BLAS, whose last bits depend on the processor."""
    return np.einsum("ij,jk->ik", a, b)


def polygon_area(points):
    """Signed area [m2] of a plane polygon (n, 2), positive when counter-clockwise."""
    x, y = points.T
    return 0.5 * float(x @ following(y) - y @ following(x))


def clip_convex(subject, clip):
    """Intersection (n, 2) of two counter-clockwise convex polygons (n, 2), (m, 2); (0, 2) when they do not overlap."""
    for a, b in zip(clip, following(clip)):
        subject = _clip_edge(subject, a, b)
        if len(subject) < 3:
            return np.zeros((0, 2))
    return subject


def _clip_edge(polygon, a, b):
    """Part of `polygon` on the left of the line from a to b, without repeated points."""
    direction = (b - a) / np.linalg.norm(b - a)
    height = direction[0] * (polygon[:, 1] - a[1]) - direction[1] * (polygon[:, 0] - a[0])
    height[np.abs(height) < SAME] = 0.0
    points = []
    for i in range(len(polygon)):
        j = (i + 1) % len(polygon)
        if height[i] >= 0:
            points.append(polygon[i])
        if height[i] * height[j] < 0:
            points.append(polygon[i] + (polygon[j] - polygon[i]) * height[i] / (height[i] - height[j]))
    apart = [p for i, p in enumerate(points) if np.abs(p - points[i - 1]).max() > SAME or len(points) == 1]
    return np.array(apart).reshape(-1, 2)


@lru_cache(maxsize=KEPT)
def contact_polygon(a, b, tolerance):
    """Largest flush contact of two polyhedra: (polygon (n, 3), outward normal of a (3,), area [m2]), or None. Flush:
    opposite normals and every vertex of b's face within `tolerance` [m] of the plane of a's face."""
    best = None
    for i, j in np.argwhere(a.face_normals @ b.face_normals.T <= -1 + SAME):
        face_a, face_b = a.faces[i], b.faces[j]
        if np.abs(face_b.points @ face_a.normal - face_a.offset).max() > tolerance:
            continue
        origin, frame = face_a.points[0], face_a.axes
        flat = clip_convex(products(face_a.points - origin, frame.T), products(face_b.points - origin, frame.T)[::-1])
        area = polygon_area(flat)
        if area > (best[2] if best else 0):
            best = origin + products(flat, frame), face_a.normal, area
    for shared in best[:2] if best else ():
        shared.setflags(write=False)
    return best


def separation(a, b):
    """Gap [m] between two polyhedra along the best separating axis; negative: depth by which they overlap."""
    return _separation(a, b)[0]


@lru_cache(maxsize=KEPT)
def _separation(a, b):
    """(gap [m], unit vector from a to b) of the best separating axis. Separating axis theorem: face normals of both and
    cross products of their edges decide exactly for convex bodies."""
    crosses = cross(a.edge_directions[:, None], b.edge_directions[None]).reshape(-1, 3)
    norms = np.linalg.norm(crosses, axis=1)
    crosses = crosses[norms > 1e3 * SAME] / norms[norms > 1e3 * SAME][:, None]
    axes = np.vstack([a.normals, b.normals, crosses])
    on_a, on_b = a.vertices @ axes.T, b.vertices @ axes.T
    ahead, behind = on_b.min(0) - on_a.max(0), on_a.min(0) - on_b.max(0)
    gaps = np.maximum(ahead, behind)
    best = int(gaps.argmax())
    return float(gaps[best]), axes[best] * (1.0 if ahead[best] >= behind[best] else -1.0)


def facing_polygon(a, b, gap):
    """As `contact_polygon`, of two polyhedra that are at most `gap` [m] apart: the common part, midway between them, of
    what lies within `gap` of the nearest points of either along their best separating axis."""
    distance, normal = _separation(a, b)
    if not -SAME <= distance <= gap:
        return None
    frame = np.array(plane_axes(normal))
    heights = a.vertices @ normal, b.vertices @ normal
    flats = [_outline(a.vertices[heights[0] >= heights[0].max() - gap - SAME] @ frame.T),
             _outline(b.vertices[heights[1] <= heights[1].min() + gap + SAME] @ frame.T)]
    flat = clip_convex(*flats) if all(len(points) > 2 for points in flats) else np.zeros((0, 2))
    if len(flat) < 3:
        return None
    return flat @ frame + (heights[0].max() + distance / 2) * normal, normal, polygon_area(flat)


def _outline(points):
    """Corners (n, 2), counter-clockwise, of the convex hull of points in a plane; none of points on a line."""
    try:
        return points[scipy.spatial.ConvexHull(points).vertices]
    except (scipy.spatial.QhullError, ValueError):
        return np.zeros((0, 2))
