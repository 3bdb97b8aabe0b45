# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads in kN per m2: of roof surface and floor with the slab itself, of outer wall beside its columns.

A load becomes mass of its member, spread evenly: of the slab, or of the columns at both ends of a bay."""
import numpy as np

from ..base.gravity import mass_of
from .geometry import polygon_area
from .layout import OUTWARD
from .plan import ROUNDING, outer_bays


def apply_loads(elements, structures, loads):
    """Set the masses of loaded elements. loads: of the house file; a structure's own ones override them key by key."""
    earlier = []
    for structure in structures.values():
        own = structure.table["loads"]
        mine = {key: loads[key] if own[key] is None else own[key] for key in loads}
        members = [element for element in elements if element.group == structure.name]
        for element in members:
            if element.kind in ("roof", "floor") and mine[element.kind] is not None:
                element.set_mass(mass_of(mine[element.kind] * upper_area(element)))
        if mine["wall"]:
            _hang_walls(structure, members, mine["wall"], earlier)
            earlier.append(structure)


def upper_area(element, projected=False):
    """Area of the faces that look upwards: of a slab, the surface of roof or floor; or its horizontal projection. [m2]
    """
    return sum(abs(polygon_area(face.points @ face.axes.T)) * (face.normal[2] if projected else 1.0)
               for face in element.solid.faces if face.normal[2] > 1e-6)


def _hang_walls(structure, members, load, earlier):
    """Add the weight [kN/m2] of the outer walls to the columns in them. A wall that faces one of the earlier structures
    without a gap is common to both and counts there."""
    columns = {column.name: column for column in members if column.kind == "column"}
    added = dict.fromkeys(columns, 0.0)
    for storey, plan in structure.plans.items():
        for places, side in outer_bays(plan):
            if not any(_is_common(structure, other, storey, places, side) for other in earlier):
                ends = [columns[plan.columns[place]] for place in places]
                for column in ends:
                    half = load * bay_length(*ends) * structure.heights[storey] / 2
                    added[column.name] += mass_of(half)
    for name, mass in added.items():
        if mass:
            columns[name].set_mass(columns[name].mass + mass)


def _is_common(structure, other, storey, places, side):
    """Whether an outer bay lies against the floor of another structure at the middle of its height."""
    middle = sum(structure.levels[storey]) / 2
    beside = [k for k, (foot, head) in other.levels.items() if foot <= middle <= head]
    clear = structure.margin + other.margin + 10 * ROUNDING
    point = np.mean(places, axis=0) + clear * np.array(OUTWARD[side])
    return any(other.plans[k].has_floor(point) for k in beside)


def bay_length(low, high):
    """Horizontal distance between the axes of two columns. [m]"""
    return float(np.hypot(*(high.solid.centroid - low.solid.centroid)[:2]))
