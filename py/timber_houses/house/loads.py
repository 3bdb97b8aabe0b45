# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads in kN per m2: of roof surface and floor with the slab itself, of outer wall beside its columns.

A load becomes mass of its member, spread evenly: of the slab, or of the columns at both ends of a bay.
"""
import numpy as np

from ..base.gravity import mass_of
from .geometry import polygon_area
from .plan import ROUNDING, outer_bays
from .structure import OUTWARD


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


def upper_area(element):
    """Area of the faces that look upwards: of a slab, the surface of roof or floor. [m2]"""
    return sum(abs(polygon_area(face.points @ face.axes.T)) for face in element.solid.faces if face.normal[2] > 1e-6)


def projected_area(element):
    """Horizontal projection of the faces that look upwards. [m2]"""
    return sum(abs(polygon_area(face.points @ face.axes.T)) * face.normal[2] for face in element.solid.faces
               if face.normal[2] > 1e-6)


def _hang_walls(structure, members, load, earlier):
    """Add the weight [kN/m2] of the outer walls to the columns in them.

    A wall that faces one of the earlier structures without a gap is common to both and counts there.
    """
    columns = {column.name: column for column in members if column.kind == "column"}
    added = dict.fromkeys(columns, 0.0)
    for storey in structure.storeys:
        for nodes, side in outer_bays(structure, storey):
            if not any(_is_common(structure, other, storey, nodes, side) for other in earlier):
                ends = [columns[f"{structure.name}.column{storey}.x{x:g}y{y:g}"] for x, y in nodes]
                for column in ends:
                    half = load * bay_length(*ends) * storey_height(structure, storey) / 2
                    added[column.name] += mass_of(half)
    for name, mass in added.items():
        if mass:
            columns[name].set_mass(columns[name].mass + mass)


def _is_common(structure, other, storey, nodes, side):
    """Whether an outer bay lies against the floor of another structure at the middle of its height."""
    layer = structure.storeys[storey]
    beside = [k for k, its in other.storeys.items() if its.z0 <= (layer.z0 + layer.z1) / 2 <= its.z1]
    clear = structure.table["margin"] + other.table["margin"] + 10 * ROUNDING
    middle = np.mean([[structure.position(axis, node) for axis, node in zip("xy", pair)] for pair in nodes], axis=0)
    return any(other.plans[k].has_floor(middle + clear * np.array(OUTWARD[side])) for k in beside)


def bay_length(low, high):
    """Horizontal distance between the axes of two columns. [m]"""
    return float(np.hypot(*(high.solid.centroid - low.solid.centroid)[:2]))


def storey_height(structure, storey):
    """From the foot of a storey's columns to that of the next storey, or to the roof. [m]"""
    layer = structure.storeys[storey]
    above = structure.layers[structure.layers.index(layer) + 1:]
    top = next((other.z0 for other in above if other.kind in ("columns", "roof")), above[-1].z1 if above else layer.z1)
    return top - layer.z0
