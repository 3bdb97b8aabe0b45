# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars and plates of a frame as convex solids: ends, sections, cuts, copies. Lengths in m, world frame.

A bar is the prism of its section about the line from -> to, between its end faces. An end at another member, and a cut
through a bar's axis near its end, replace the square end face. A plane is its normal (3,) and its offset [m]: what lies
beyond it, on the side to which the normal points, is removed."""
from dataclasses import dataclass

import numpy as np

from ..base.remedies import nearest
from .geometry import SAME, SNAP_DIGITS, cross, halfspace_vertices, polygon_area, polyhedron
from .parser import Table
from .schema import fail

SHORTEST = 1e-3  # distance of the ends of a bar, at least. [m]

OBLIQUE = 0.1
"""Least component along a bar of the normal of a plane that replaces its end face: up to 84 degrees from square. [-]"""
WARPED = 1e-3  # largest distance of a plate's corners from their plane. [m]
LEVEL = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Part:
    """A bar, or a plate without an axis. vertices (n, 3); axis (2, 3): its ends; top (n, 3): a plate's upper face"""

    vertices: np.ndarray
    axis: np.ndarray | None = None
    top: np.ndarray | None = None

    @property
    def solid(self):
        return polyhedron(self.vertices)

    def moved(self, matrix, shift):
        """matrix (3, 3), shift (3,)"""
        return Part(*(None if points is None else np.round(points @ matrix.T + shift, SNAP_DIGITS) + 0.0
                      for points in (self.vertices, self.axis, self.top)))


class Parts:
    """{name: [Part of each copy]} of the tables of members and plates. A part is made when it is first asked for:
    parts refer to one another in any order. Raises HouseError."""

    def __init__(self, members, plates):
        self.tables, self.plates, self.made, self.asked = {**members, **plates}, plates, {}, []

    def __getitem__(self, name):
        if name not in self.made:
            self.asked.append(name)
            table = self.tables[name]
            part = self._plate(table) if name in self.plates else self._bar(table)
            self.made[name] = [part.moved(*place) for place in placements(table["repeat"], table.path)]
            self.asked.pop()
        return self.made[name]

    def find(self, reference, table, key):
        """Part of 'NAME', the first copy, or 'NAME.3'; HouseError without one, or where two refer to each other. table,
        key: of the entry with the reference"""
        name, _, number = reference.partition(".")
        if name not in self.tables:
            table.refuse(key, f"no member '{reference}', {nearest(name, self.tables)[:300]}")
        if name in self.asked:
            table.refuse(key, f"{name} refers back to {self.asked[-1]}; give one of them by points")
        copies = self[name]
        if not (number or "1").isdecimal() or not 1 <= int(number or 1) <= len(copies):
            table.refuse(key, f"no member '{reference}'; {name} has {len(copies)} copies: {name}.1, ...")
        return copies[int(number or 1) - 1]

    # --- bars ---------------------------------------------------------------------------------------------------------

    def _bar(self, table):
        if not is_convex(outline(table)):
            table.refuse("profile", "is not a convex polygon; give its corners in order")
        ends = np.array([self._point(table[key]) for key in ("from", "to")])
        length = float(np.linalg.norm(ends[1] - ends[0]))
        if length < SHORTEST:
            table.refuse("to", "lies at its other end; give two points apart")
        along = (ends[1] - ends[0]) / length
        planes = sides(outline(table), along, table["roll"], ends[0]) + self._end_planes(table, ends, along)
        try:
            return Part(halfspace_vertices(planes), ends)
        except ValueError as problem:
            table.refuse(None, f"no volume is left between its faces ({problem}); check its ends and cuts")

    def _end_planes(self, table, ends, along):
        """Planes of cuts, and of the square end faces that none of them replaces."""
        planes, replaced = [], set()
        reach, length = float(np.ptp(outline(table), axis=0).max()), (ends[1] - ends[0]) @ along
        for k, key in enumerate(("from", "to")):
            if isinstance(table[key], Table) and table[key]["flush"]:
                planes.append(self._entered(table, key, ends[1 - k], ends[k]))
                replaced |= {k} if abs(planes[-1][0] @ along) > OBLIQUE else set()
        for cut in table["cuts"]:
            normal, offset = self._cut(cut, ends.mean(0))
            planes.append((normal, offset))
            if cut["normal"] is None and abs(normal @ along) > OBLIQUE:
                crossing = (offset - normal @ ends[0]) / (normal @ along)
                replaced |= {int(crossing > length / 2)} if -reach < crossing < length + reach else set()
        caps = [(-along, -along @ ends[0]), (along, along @ ends[1])]
        return planes + [cap for k, cap in enumerate(caps) if k not in replaced]

    def _point(self, end):
        """(3,) end of a bar."""
        if not isinstance(end, Table):
            return np.array(end)
        axis = self._bar_of(end["of"], end, "of").axis
        start, far = axis if end["end"] == "from" else axis[::-1]
        length = float(np.linalg.norm(far - start))
        if not -SHORTEST <= end["at"] <= length + SHORTEST:
            end.refuse("at", f"{end['at']:g} lies beyond the end of {end['of']} ({length:.4g} m); give a place on its"
                       " axis, or an offset")
        return start + end["at"] * (far - start) / length + end["offset"]

    def _bar_of(self, reference, table, key):
        part = self.find(reference, table, key)
        if part.axis is None:
            table.refuse(key, f"'{reference}' is a plate; name a member")
        return part

    def _entered(self, table, key, start, point):
        """Plane of the face by which the line from the other end of a bar reaches the member at its end."""
        end = table[key]
        solid = self.find(end["of"], end, "of").solid
        rates = solid.face_normals @ (point - start)
        gaps = np.array([face.offset - face.normal @ start for face in solid.faces])
        facing = rates < -SAME
        entry = np.where(facing, gaps / np.where(facing, rates, 1.0), -np.inf)
        if entry.max() <= 0:
            fail(end.at("of"), end.path, f"the other end lies within or behind '{end['of']}'; move one of the ends, or"
                 " add flush: false")
        face = solid.faces[int(entry.argmax())]
        return -face.normal, -face.offset

    def _cut(self, cut, middle):
        """Plane of a cut. middle: of the bar's axis, which remains unless the cut has a normal"""
        if cut["normal"] is not None or cut["point"] is not None:
            if None in (cut["normal"], cut["point"]) or not np.linalg.norm(cut["normal"]):
                cut.refuse(None, "a cut by a plane needs 'point' and a 'normal' that is not zero")
            normal = cut["normal"] / np.linalg.norm(cut["normal"])
            return normal, normal @ cut["point"]
        if cut["by"] is not None:
            faces = self.find(cut["by"], cut, "by").solid.faces
            face = max(faces, key=lambda face: face.normal @ middle - face.offset)
            if face.normal @ middle < face.offset:
                fail(cut.at("by"), cut.path, f"the middle of {self.asked[-1]} lies within '{cut['by']}'; move one of"
                     " them")
            return -face.normal, -face.offset
        axis = next(axis for axis in "xyz" if cut[axis] is not None)
        sign = 1.0 if cut[axis] >= middle["xyz".index(axis)] else -1.0
        return sign * np.eye(3)["xyz".index(axis)], sign * cut[axis]

    # --- plates -------------------------------------------------------------------------------------------------------

    def _plate(self, table):
        if table["corners"] and table["overhang"]:
            table.refuse("overhang", "belongs to 'over'; change the corners instead")
        corners = self._covering(table) if table["over"] else np.array(table["corners"])
        _, _, axes = np.linalg.svd(corners - corners.mean(0), full_matrices=False)
        normal, off = axes[2], (corners - corners.mean(0)) @ axes[2]
        if np.abs(off).max() > WARPED or np.linalg.matrix_rank(corners - corners[0], 1e-3) < 2:
            table.refuse("corners", f"do not span a plane (off by {1e3 * np.abs(off).max():.3g} mm, at most"
                         f" {1e3 * WARPED:g}); correct them")
        corners = corners - off[:, None] * normal
        turns = cross(corners - corners[0], np.roll(corners, -1, 0) - corners[0]).sum(0)
        through = table["thickness"] * turns / np.linalg.norm(turns)
        if abs(normal @ LEVEL) > OBLIQUE:
            through = table["thickness"] / abs(normal @ LEVEL) * LEVEL
        return Part(np.vstack([corners, corners + through]), None, corners + through)

    def _covering(self, table):
        """(4, 3) corners of a plate on the upper faces of two bars, from the outer edge of one to that of the other."""
        bars = [self._bar_of(name, table, "over") for name in table["over"]]
        alongs = [(bar.axis[1] - bar.axis[0]) / np.linalg.norm(bar.axis[1] - bar.axis[0]) for bar in bars]
        first, last = (max((face for face in bar.solid.faces if abs(face.normal @ along) < OBLIQUE),
                           key=lambda face: face.normal[2]) for bar, along in zip(bars, alongs))
        along, points = alongs[0], np.vstack([first.points, last.points])
        if np.abs(points @ first.normal - first.offset).max() > WARPED:
            table.refuse("over", "the upper faces of the two members are not in one plane; give corners")
        across = cross(first.normal, along)
        u, v = points @ along, points @ across
        low, high = v.min() - table["overhang"], v.max() + table["overhang"]
        return np.array([a * along + b * across + first.offset * first.normal
                         for a, b in ((u.min(), low), (u.max(), low), (u.max(), high), (u.min(), high))])


def outline(table):
    """(n, 2) corners of a bar's section, across and along its depth, about its axis. [m]"""
    if table["profile"] is not None:
        return np.array(table["profile"])
    (width, depth), square = table["section"], np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return square * np.array([width, depth]) / 2


def is_convex(corners):
    """Whether a polygon (n, 2) turns one way at all corners, once around."""
    edges = np.roll(corners, -1, 0) - corners
    following = np.roll(edges, -1, 0)
    turns = np.arctan2(edges[:, 0] * following[:, 1] - edges[:, 1] * following[:, 0], (edges * following).sum(1))
    return bool((np.abs(turns) > SAME).all() and abs(abs(turns.sum()) - 2 * np.pi) < 1e-6
                and (np.sign(turns) == np.sign(turns[0])).all())


def section_axes(along, roll):
    """Unit vectors of width and depth of a bar. along: unit vector; roll: right-handed about it [degrees]"""
    across = cross(LEVEL, along)
    width, depth = np.array([[1.0, 0, 0], [0.0, 1, 0]])
    if np.linalg.norm(across) >= 1e-6:  # not vertical
        width = across / np.linalg.norm(across)
        depth = cross(along, width)
    cosine, sine = turned(roll)
    return cosine * width + sine * cross(along, width), cosine * depth + sine * cross(along, depth)


def turned(degrees):
    """(cosine, sine) of an angle, exact at right angles."""
    return np.round([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))], 15) + 0.0


def sides(corners, along, roll, point):
    """Planes of the faces along a bar through a point. corners (n, 2): of its section, in any sense"""
    axes = np.array(section_axes(along, roll))
    if polygon_area(corners) < 0:
        corners = corners[::-1]
    edges = np.roll(corners, -1, 0) - corners
    normals = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
    return [(normal @ axes, normal @ axes @ point + normal @ corner) for normal, corner in zip(normals, corners)]


STEPS = {"by": ("count",), "turn": ("count", "about"), "mirror": ("at",)}
"""Forms of a step of `repeat`, and the keys that belong to them."""


def placements(steps, path):
    """[(matrix (3, 3), shift (3,))] of the copies of a part: each step repeats all that the steps before it made.
    path: of the part, for messages"""
    places = [(np.eye(3), np.zeros(3))]
    for step in steps:
        form = next(form for form in STEPS if step[form] is not None)
        for key in step.entries:
            if key not in (form, *STEPS[form]):
                fail(step.at(key), f"{path}.repeat.{key}", f"does not belong to '{form}'; remove it")
        matrix, shift = _step(step)
        last = places
        for _ in range(1, 2 if step["mirror"] else step["count"]):
            last = [(matrix @ m, matrix @ s + shift) for m, s in last]
            places = places + last
    return places


def _step(step):
    if step["by"] is not None:
        return np.eye(3), np.array(step["by"])
    matrix = np.eye(3)
    if step["mirror"] is not None:
        axis = "xy".index(step["mirror"])
        matrix[axis, axis] = -1.0
        return matrix, 2 * step["at"] * np.eye(3)[axis]
    cosine, sine = turned(step["turn"])
    matrix[:2, :2] = [[cosine, -sine], [sine, cosine]]
    about = np.array([*step["about"], 0.0])
    return matrix, about - matrix @ about
