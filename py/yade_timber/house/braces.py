# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagonal braces: hexagonal prisms (8 faces) in the bay between two neighbouring columns. Lengths in m."""
from dataclasses import dataclass

import numpy as np

from .errors import HouseError
from .members import DIRECTION, column_plan, nodes_on_line, require_column
from .structure import ACROSS


@dataclass(frozen=True)
class Diagonal:
    """One brace on the grid line `along` x or y at node `at`, from a column's foot at `foot` to a head at `head`."""

    along: str
    at: float
    foot: float
    head: float
    storey: int
    where: str

    @property
    def name(self):
        return f"brace{self.storey}.{DIRECTION[self.along]}.{ACROSS[self.along]}{self.at:g}.{self.foot:g}-{self.head:g}"


def lay_braces(structure, layer):
    """Braces of one storey. A run [foot, head] leans from the foot of one column to the head of another."""
    plan, elements = column_plan(structure, layer.storey), []
    for line in structure.table["braces"]["lines"]:
        structure.check_storeys(line["storeys"], line.at("storeys"), "braces")
        if line["storeys"] and layer.storey not in line["storeys"]:
            continue
        for at in line["at"]:
            for i, (foot, head) in enumerate(line["runs"]):
                diagonal = Diagonal(line["along"], at, foot, head, layer.storey, line["runs"].at(i))
                elements.append(_brace(structure, layer, diagonal, plan))
    return elements


def _brace(structure, layer, diagonal, plan):
    table, across = structure.table["braces"], ACROSS[diagonal.along]
    planes = brace_planes(_clear_bay(structure, diagonal, plan), (layer.z0, layer.z1), table["width"])
    planes = _extruded(planes, diagonal.along, structure.axes[across](diagonal.at), table["thickness"])
    vertices = structure.cut(diagonal.name, planes, diagonal.where)
    return structure.element("brace", diagonal.name, vertices, table, diagonal.where, storey=layer.storey,
                             side=structure.sides(**{across: diagonal.at}),
                             section=(table["width"], table["thickness"]))


def _clear_bay(structure, diagonal, plan):
    """Positions [m] along the wall of the column faces that foot and head of the brace touch."""
    along, foot, head = diagonal.along, diagonal.foot, diagonal.head
    on_line = nodes_on_line(plan, along, diagonal.at)
    place = (f"{diagonal.where}: {structure.name}: brace [{foot:g}, {head:g}] along {along} at {ACROSS[along]} node"
             f" {diagonal.at:g}, storey {diagonal.storey}")
    for node in (foot, head):
        require_column(on_line, node, f"{place} has no bay")
    between = [n for n in on_line if min(foot, head) < n < max(foot, head)]
    if foot == head or between:
        reason = f"a column stands between, at node {between[0]:g}" if between else "foot and head are the same column"
        raise HouseError(f"{place} has no bay: {reason}; a brace runs between neighbouring columns")
    axis, lean = structure.axes[along], np.sign(head - foot)
    return axis(foot) + lean * on_line[foot] / 2, axis(head) - lean * on_line[head] / 2


def brace_planes(ends, levels, width):
    """Planes ((2,) normal, offset [m]) in the wall's plane (u along the wall, z): a band of `width` about the diagonal
    from (ends[0], levels[0]) to (ends[1], levels[1]), cut by the bay's horizontal and vertical planes."""
    foot, head = np.array([ends[0], levels[0]]), np.array([ends[1], levels[1]])
    axis = (head - foot) / np.linalg.norm(head - foot)
    normal = np.array([-axis[1], axis[0]])
    band = [(normal, normal @ foot + width / 2), (-normal, -normal @ foot + width / 2)]
    bay = [((1, 0), max(ends)), ((-1, 0), -min(ends)), ((0, 1), levels[1]), ((0, -1), -levels[0])]
    return band + bay


def _extruded(planes, along, centre, thickness):
    """Planes of the section given by `planes`, `thickness` [m] wide about `centre` [m] across the wall."""
    lift = (lambda n: (n[0], 0, n[1])) if along == "x" else (lambda n: (0, n[0], n[1]))
    across = (0, 1, 0) if along == "x" else (1, 0, 0)
    sides = [(across, centre + thickness / 2), (tuple(-v for v in across), -centre + thickness / 2)]
    return [(lift(normal), offset) for normal, offset in planes] + sides
