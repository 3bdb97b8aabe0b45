# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads in kN per m2: of roof surface and floor with the slab itself, of outer wall beside its columns.

A load becomes mass of its member, spread evenly: of the slab, or of the columns at both ends of a bay.
"""
from itertools import product

import numpy as np

from ..base.gravity import mass_of
from .geometry import polygon_area
from .structure import ENDS


def apply_loads(elements, structures, loads):
    """Set the masses of loaded elements. loads: of the house file; a structure's own ones override them key by key."""
    for structure in structures.values():
        own = structure.table["loads"]
        mine = {key: loads[key] if own[key] is None else own[key] for key in loads}
        members = [element for element in elements if element.group == structure.name]
        for element in members:
            if element.kind in ("roof", "floor") and mine[element.kind] is not None:
                element.set_mass(mass_of(mine[element.kind] * upper_area(element)))
        if mine["wall"]:
            _hang_walls(structure, members, mine["wall"])


def upper_area(element):
    """Area of the faces that look upwards: of a slab, the surface of roof or floor. [m2]"""
    return sum(abs(polygon_area(face.points @ face.axes.T)) for face in element.solid.faces if face.normal[2] > 1e-6)


def _hang_walls(structure, members, load):
    """Add the weight [kN/m2] of the outer walls to the columns in them."""
    added = {}
    for low, high in outer_bays(members):
        half = load * bay_length(low, high) * storey_height(structure, low.storey) / 2
        for column in (low, high):
            added[column.name] = added.get(column.name, 0.0) + mass_of(half)
    for column in members:
        if column.name in added:
            column.set_mass(column.mass + added[column.name])


def outer_bays(members):
    """[(column, column)] of the bays in the outer walls: neighbouring columns of a storey on one side."""
    bays = []
    columns = [element for element in members if element.kind == "column"]
    for axis, sides in ENDS.items():
        for side, storey in product(sides, sorted({column.storey for column in columns})):
            row = [column for column in columns if side in column.side and column.storey == storey]
            row.sort(key=lambda column: column.solid.centroid["yx".index(axis)])
            bays += zip(row, row[1:])
    return bays


def bay_length(low, high):
    """Horizontal distance between the axes of two columns. [m]"""
    return float(np.hypot(*(high.solid.centroid - low.solid.centroid)[:2]))


def storey_height(structure, storey):
    """From the foot of a storey's columns to that of the next storey, or to the roof. [m]"""
    layer = structure.storeys[storey]
    above = structure.layers[structure.layers.index(layer) + 1:]
    top = next((other.z0 for other in above if other.kind in ("columns", "roof")), above[-1].z1 if above else layer.z1)
    return top - layer.z0
