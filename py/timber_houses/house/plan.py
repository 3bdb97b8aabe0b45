# SPDX-License-Identifier: GPL-2.0-or-later
"""Plan of a storey of any shape: cells between grid lines, with or without floor. Lengths in m, as laid: upright.

A cell has floor if a slab above the storey (floor or roof) covers it, without eaves, and columns of the storey stand on
its south-west, south-east, north-west and north-east: roofs and floors that project beyond the columns do not count."""
from dataclasses import dataclass
from itertools import product

import numpy as np

from .layout import ENDS

ROUNDING = 1e-6  # of positions. [m]


@dataclass(frozen=True, eq=False)
class FloorPlan:
    """edges: positions (m + 1,), (n + 1,) of the lines between the cells; floor: (m, n) bool; columns: {(x, y) as
    laid: name}"""

    edges: tuple
    floor: np.ndarray
    columns: dict

    @property
    def area(self):
        """[m2]"""
        return self.area_between(0, -np.inf, np.inf)

    def area_between(self, axis, low, high):
        """Floor area between two positions along an axis. [m2]"""
        lengths = [np.diff(edges) for edges in self.edges]
        lengths[axis] = np.diff(np.clip(self.edges[axis], low, high))
        return float(lengths[0] @ self.floor @ lengths[1])

    @property
    def bounds(self):
        """(2, 2) lowest and highest corner of the floor, zero without any."""
        if not self.floor.any():
            return np.zeros((2, 2))
        used = [np.flatnonzero(self.floor.any(1 - axis)) for axis in (0, 1)]
        return np.array([[edges[cells[0]] for edges, cells in zip(self.edges, used)],
                         [edges[cells[-1] + 1] for edges, cells in zip(self.edges, used)]])

    def moved(self, shift):
        """The plan of a leaning storey. shift: (2,) [m]"""
        return FloorPlan(tuple(edges + by for edges, by in zip(self.edges, shift)), self.floor, self.columns)

    def has_floor(self, point):
        """Whether a point (2,) lies in a cell with floor."""
        cell = [int(np.searchsorted(edges, at)) - 1 for edges, at in zip(self.edges, point)]
        return all(0 <= k < size for k, size in zip(cell, self.floor.shape)) and bool(self.floor[tuple(cell)])

    def sides(self, along, at, start, end):
        """Side of the house of a stretch of a line, whose outer wall it is: floor on one hand only, all along. along:
        'x' or 'y'; at: position of the line; start, end: of the stretch. Empty inside and off the floor."""
        axis = "xy".index(along)
        edges = np.clip(self.edges[axis], start, end)
        hands = set()  # (floor on the lower hand, on the higher) of the middles of the parts between cells
        for middle in (edges[:-1] + edges[1:])[np.diff(edges) > ROUNDING] / 2:
            points = [(middle, at + aside)[::1 if axis == 0 else -1] for aside in (-2 * ROUNDING, 2 * ROUNDING)]
            hands.add(tuple(self.has_floor(point) for point in points))
        low, high = ENDS["yx"[axis]]
        return {frozenset({(False, True)}): frozenset({low}), frozenset({(True, False)}): frozenset({high})
                }.get(frozenset(hands), frozenset())

    def sides_at(self, x, y):
        """Sides of the house whose outer walls meet at a point."""
        found = frozenset()
        for along, (at, middle) in (("x", (y, x)), ("y", (x, y))):
            for start, end in ((middle - 2 * ROUNDING, middle), (middle, middle + 2 * ROUNDING)):
                found |= self.sides(along, at, start, end)
        return found

    def is_corner(self, x, y):
        """Whether a point is a projecting corner of the outline: one of the four cells around it has floor."""
        return sum(self.has_floor((x + i, y + j)) for i, j in product((-ROUNDING, ROUNDING), repeat=2)) == 1


def floor_plan(columns, slabs):
    """FloorPlan of a storey. columns: {(x, y): name}; slabs: [(low, high) corners (2,)] of those above it"""
    places = np.array(list(columns)).reshape(-1, 2)
    found = [np.sort([*places[:, axis], *(corner[axis] for slab in slabs for corner in slab)]) for axis in (0, 1)]
    edges = tuple(each[np.diff(each, prepend=-np.inf) > ROUNDING] for each in found)
    middles = [(e[:-1] + e[1:]) / 2 for e in edges]
    floor = np.array([[_carried((x, y), places) and _covered((x, y), slabs) for y in middles[1]] for x in middles[0]],
                     bool)
    return FloorPlan(edges, floor.reshape([max(0, len(e) - 1) for e in edges]), columns)


def outer_bays(plan):
    """[(((x, y), (x, y)), side)] of neighbouring columns in the outer walls of a storey, also of its re-entrant ones.
    """
    bays = []
    for axis, along in enumerate("xy"):
        for at in sorted({place[1 - axis] for place in plan.columns}):
            row = sorted((place for place in plan.columns if place[1 - axis] == at), key=lambda place: place[axis])
            for low, high in zip(row, row[1:]):
                bays += [((low, high), side) for side in plan.sides(along, at, low[axis], high[axis])]
    return bays


def _covered(point, slabs):
    """Whether one of the slabs lies over a point; without any, every point counts as covered."""
    return not slabs or any((low <= point).all() and (point <= high).all() for low, high in slabs)


def _carried(point, columns):
    """Whether columns stand in all four quadrants about a point."""
    east, north = (columns >= point).T
    return all((ew & ns).any() for ew in (east, ~east) for ns in (north, ~north))
