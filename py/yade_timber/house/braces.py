# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagonal braces: hexagonal prisms (8 faces) in the bay between two neighbouring columns. Lengths in m."""

import numpy as np

from .errors import HouseError
from .members import DIRECTION, column_plan
from .structure import ACROSS


def lay_braces(structure, layer):
    """Braces of one storey. A run [foot, head] leans from the foot of the column at node `foot` to the head of the one at `head`."""
    braces, plan, elements = structure.table["braces"], column_plan(structure, layer.storey), []
    for line in braces["lines"]:
        _check_storeys(structure, line)
        if line["storeys"] and layer.storey not in line["storeys"]:
            continue
        for at in line["at"]:
            for i, (foot, head) in enumerate(line["runs"]):
                elements.append(_brace(structure, layer, line, at, foot, head, line["runs"].at(i), plan))
    return elements


def _check_storeys(structure, line):
    for number in line["storeys"]:
        if number not in structure.storeys:
            raise HouseError(f"{line.at('storeys')}: {structure.name}: braces: no storey {number}; the stack has {structure.storeys}")


def _brace(structure, layer, line, at, foot, head, where, plan):
    along, table = line["along"], structure.table["braces"]
    across = ACROSS[along]
    name = f"brace{layer.storey}.{DIRECTION[along]}.{across}{at:g}.{foot:g}-{head:g}"
    ends = _bay(structure, layer.storey, along, at, foot, head, plan, where)
    planes = brace_planes(ends, (layer.z0, layer.z1), table["width"])
    vertices = structure.cut(name, _extruded(planes, along, structure.axes[across](at), table["thickness"]), where)
    return structure.element("brace", name, vertices, table, where, storey=layer.storey,
                             side=structure.sides(**{across: at}), section=(table["width"], table["thickness"]))


def _bay(structure, storey, along, at, foot, head, plan, where):
    """Positions [m] along the wall of the column faces that foot and head of the brace bear on."""
    on_line = {(x if along == "x" else y): section for (x, y), (section, _) in plan.items() if (y if along == "x" else x) == at}
    wall = f"{structure.name}: brace [{foot:g}, {head:g}] along {along} at {ACROSS[along]} node {at:g}, storey {storey}"
    for node in (foot, head):
        if node not in on_line:
            known = ", ".join(f"{n:g}" for n in sorted(on_line)) or "none"
            raise HouseError(f"{where}: {wall} has no bay: no column at node {node:g}; columns of this line stand at {known}")
    between = [n for n in on_line if min(foot, head) < n < max(foot, head)]
    if foot == head or between:
        reason = f"a column stands between, at node {between[0]:g}" if between else "foot and head are the same column"
        raise HouseError(f"{where}: {wall} has no bay: {reason}; a brace runs between neighbouring columns")
    axis, lean = structure.axes[along], np.sign(head - foot)
    return axis(foot) + lean * on_line[foot] / 2, axis(head) - lean * on_line[head] / 2


def brace_planes(ends, levels, width):
    """Planes ((2,) normal, offset [m]) in the wall's plane (u along the wall, z): a band of `width` about the diagonal from
    (ends[0], levels[0]) to (ends[1], levels[1]), cut by the bay's horizontal and vertical planes."""
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
