# SPDX-License-Identifier: GPL-2.0-or-later
"""Roof slabs and the snow on them. Lengths in m; outline = the grid's rectangle plus the structure's margin.

Hip roof (paper, 3.4): all slopes are equal, so hips run at 45 degrees in plan and the ridge lies along the longer side.
Each slab is the part of the outline that is nearest to its own eave, between two parallel planes and above the level of
the wall plates: the long slopes come out as hexahedra, the hip ends, whose three corners are cut off, as octahedra.
"""

from dataclasses import dataclass

import numpy as np

from .errors import HouseError
from .geometry import box, halfspace_vertices

OUTWARD = {"west": (-1, 0), "east": (1, 0), "south": (0, -1), "north": (0, 1)}


@dataclass(frozen=True, eq=False)
class HipPlan:
    """Plan and slope of a hip roof: corners (2,) of the outline, eave level z [m], rise over run."""

    low: np.ndarray
    high: np.ndarray
    eave: float
    slope: float
    cut: float

    def distance(self, side):
        """(d, e): a point p of the plan lies e - d . p [m] inside the eave of `side`."""
        d = np.array(OUTWARD[side], float)
        return d, max(d @ self.low, d @ self.high)

    @property
    def half(self):
        """Horizontal run from eave to ridge [m]."""
        return (self.high - self.low).min() / 2

    def top(self, side):
        """Plane of the slab's upper face: slope * d . p + z <= eave + slope * e."""
        d, e = self.distance(side)
        return (*(self.slope * d), 1.0), self.eave + self.slope * e

    def outline(self, side):
        """Vertical planes of a slab, its own eave not among them: hips, ridge, and the three corner cuts of a hip end."""
        d, e = self.distance(side)
        hip_end = self._is_hip_end(side)
        planes = []
        for other in OUTWARD:
            if other == side or (hip_end and OUTWARD[other] == tuple(-d)):
                continue
            d2, e2 = self.distance(other)
            planes.append(((*(d2 - d), 0.0), e2 - e))
        return planes + (self._corner_cuts(side) if hip_end else [])

    def _is_hip_end(self, side):
        """Hip ends are the sides that the ridge points at; on a square plan, all four."""
        length = np.abs(np.array(OUTWARD[side])) @ (self.high - self.low)
        return length >= (self.high - self.low).max() - 1e-9

    def _corner_cuts(self, side):
        d, e = self.distance(side)
        t = np.abs(d[::-1])
        apex = ((*(-d), 0.0), self.half - self.cut - e)
        return [apex, ((*t, 0.0), t @ self.high - self.cut), ((*(-t), 0.0), -(t @ self.low) - self.cut)]


def hip_plan(structure, layer):
    table = layer.table
    low, high = structure.area(table["area"])
    half = (high - low).min() / 2
    rise = table["ridge_height"] - layer.z0
    if rise <= 0:
        raise HouseError(f"{table.at('ridge_height')}: {structure.name}: "
                         f"the ridge ({table['ridge_height']:g} m) must lie above the eaves ({layer.z0:g} m)")
    if table["corner_cut"] >= half / 2:
        raise HouseError(f"{table.at('corner_cut')}: {structure.name}: corner_cut must be below a quarter of the roof's width ({half / 2:g} m)")
    return HipPlan(low, high, layer.z0, rise / half, table["corner_cut"])


def hip_roof(structure, layer):
    """Four slabs of the thickness given (measured across the slope), resting with horizontal eave faces on the wall plates."""
    plan = hip_plan(structure, layer)
    drop = layer.table["thickness"] * np.hypot(1.0, plan.slope)
    slabs = {}
    for side in OUTWARD:
        normal, offset = plan.top(side)
        bottom = (tuple(-v for v in normal), -(offset - drop))
        slabs[side] = halfspace_vertices([(normal, offset), bottom, ((0, 0, -1), -plan.eave), *plan.outline(side)])
    return slabs


def hip_snow(structure, layer, depth):
    """Snow of vertical depth [m] on each slab: the slab's outline, extruded upwards from its upper face."""
    plan = hip_plan(structure, layer)
    clods = {}
    for side in OUTWARD:
        normal, offset = plan.top(side)
        d, e = plan.distance(side)
        planes = [(normal, offset + depth), (tuple(-v for v in normal), -offset), ((*d, 0.0), e), *plan.outline(side)]
        clods[side] = halfspace_vertices(planes)
    return clods


def flat_roof(structure, layer):
    low, high = structure.area(layer.table["area"])
    return {"": box([*low, layer.z0], [*high, layer.z1])}


def flat_snow(structure, layer, depth):
    low, high = structure.area(layer.table["area"])
    return {"": box([*low, layer.z1], [*high, layer.z1 + depth])}


ROOFS = {"hip": (hip_roof, hip_snow), "flat": (flat_roof, flat_snow)}


def lay_roof(structure, layer):
    """Roof elements, one per slab."""
    slabs = ROOFS[layer.table["type"]][0](structure, layer)
    return [_element(structure, layer, "roof", side, vertices, layer.table) for side, vertices in slabs.items()]


def lay_snow(structure, layer, depth, material):
    """Snow elements on this roof; none where the roof says `snow: false` or the depth [m] is zero."""
    if depth == 0 or not layer.table["snow"]:
        return []
    clods = ROOFS[layer.table["type"]][1](structure, layer, depth)
    return [_element(structure, layer, "snow", side, vertices, {"material": material}) for side, vertices in clods.items()]


def _element(structure, layer, kind, side, vertices, table):
    name = f"{kind}.{side}" if side else kind
    return structure.element(kind, name, vertices, table, layer.table.where, storey=layer.storey, side=frozenset(filter(None, [side])))
