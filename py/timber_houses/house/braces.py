# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagonal braces: hexagonal prisms (8 faces) in the bay between two neighbouring columns. Lengths in m."""
import numpy as np

from .errors import HouseError
from .members import column_plan, line_name, nodes_on_line, require_column
from .structure import ACROSS, in_storey


def lay_braces(structure, layer):
    """Braces of one storey. A run [foot, head] leans from the foot of one column to the head of another."""
    plan, lines = column_plan(structure, layer.storey), in_storey(structure.table["braces"]["lines"], layer.storey)
    return [_brace(structure, layer, (line["along"], at, *run), line["runs"].at(i), plan)
            for line in lines for at in line["at"] for i, run in enumerate(line["runs"])]


def _brace(structure, layer, place, where, plan):
    """place: direction of the grid line, its node, nodes of the columns at foot and head; where: file:line"""
    table, (along, at, foot, head) = structure.table["braces"], place
    name = f"brace{layer.storey}.{line_name(along, at)}.{foot:g}-{head:g}"
    ends = _clear_bay(structure, layer.storey, place, where, nodes_on_line(plan, along, at))
    band = brace_planes(ends, (layer.z0, layer.z1), table["width"])
    across, centre = "xy".index(ACROSS[along]), structure.position(ACROSS[along], at)
    planes = [(np.insert(np.asarray(normal, float), across, 0), offset) for normal, offset in band]
    planes += [(sign * np.eye(3)[across], sign * centre + table["thickness"] / 2) for sign in (1, -1)]
    return structure.element("brace", name, structure.cut(name, planes, where), table, where, storey=layer.storey,
                             side=structure.outer_sides(layer.storey, along, at, foot, head),
                             section=(table["width"], table["thickness"]))


def _clear_bay(structure, storey, place, where, on_line):
    """Positions [m] along the wall of the column faces that foot and head of the brace touch. on_line: `nodes_on_line`
    """
    along, at, foot, head = place
    bay = (f"{where}: {structure.name}: brace [{foot:g}, {head:g}] along {along} at {ACROSS[along]} node {at:g}, storey"
           f" {storey} has no bay")
    for node in (foot, head):
        require_column(on_line, node, bay)
    between = [n for n in on_line if min(foot, head) < n < max(foot, head)]
    if foot == head or between:
        reason = f"a column stands between, at node {between[0]:g}" if between else "foot and head are the same column"
        raise HouseError(f"{bay}: {reason}; a brace runs between neighbouring columns")
    lean = np.sign(head - foot)
    return (structure.position(along, foot) + lean * on_line[foot] / 2,
            structure.position(along, head) - lean * on_line[head] / 2)


def brace_planes(ends, levels, width):
    """Planes ((2,) normal, offset [m]) in the wall's plane (u along the wall, z): a band of `width` about the diagonal
    from (ends[0], levels[0]) to (ends[1], levels[1]), cut by the bay's horizontal and vertical planes."""
    foot, head = np.array([ends[0], levels[0]]), np.array([ends[1], levels[1]])
    axis = (head - foot) / np.linalg.norm(head - foot)
    normal = np.array([-axis[1], axis[0]])
    band = [(normal, normal @ foot + width / 2), (-normal, -normal @ foot + width / 2)]
    bay = [((1, 0), max(ends)), ((-1, 0), -min(ends)), ((0, 1), levels[1]), ((0, -1), -levels[0])]
    return band + bay
