# SPDX-License-Identifier: GPL-2.0-or-later
"""Straight members of one structure: foundation strips, sills, beams, columns, floor slabs, braces. Lengths in m."""
from functools import partial

import numpy as np

from .errors import HouseError
from .geometry import box
from .layout import ACROSS
from .limits import MAX_ELEMENTS, MAX_LINES

DIRECTION = {"x": "EW", "y": "NS"}


def in_storey(lines, storey):
    """Those of the tables with a list of storeys that are in a storey; an empty list stands for all."""
    return [line for line in lines if not line["storeys"] or storey in line["storeys"]]


def require_few(count, where, name):
    """HouseError for more than MAX_ELEMENTS elements."""
    if count > MAX_ELEMENTS:
        raise HouseError(f"{where}: {name}: more than {MAX_ELEMENTS} elements; make the house smaller")


def line_name(along, at):
    """'EW.y0' of the line along x at y node 0."""
    return f"{DIRECTION[along]}.{ACROSS[along]}{at:g}"


def lay_strips(structure, layer, kind):
    """Members along the lines of the layer or structure: one piece per line; `cut` lines end where they cross."""
    table, elements = layer.table, []
    lines = _single_lines(structure, table["lines"] if table["lines"] is not None else structure.table["lines"])
    for line in lines:
        for number, (start, end) in enumerate(_pieces(structure, line, lines, table["width"]), 1):
            piece = f".{number}" if line["cut"] else ""
            name = f"{kind}{layer.storey or ''}.{line_name(line['along'], line['at'])}{piece}"
            elements.append(_strip(structure, layer, kind, name, line, start, end))
    return elements


def _single_lines(structure, lines):
    """Line tables with several positions `at` -> one plain dict per position, checked against the grid."""
    single = []
    for line in lines:
        across = ACROSS[line["along"]]
        structure.check_nodes(line["along"], (line["from"], line["to"]), line.at("from"))
        structure.check_nodes(across, line["at"], line.at("at"))
        if line["from"] >= line["to"]:
            raise HouseError(f"{line.at('from')}: {structure.name}: a line runs from {line['from']:g} to"
                             f" {line['to']:g}; 'from' must be below 'to'")
        single += [{**line, "at": at, "where": line.where} for at in line["at"]]
        if len(single) > MAX_LINES:
            raise HouseError(f"{line.at('at')}: structures.{structure.name}: more than {MAX_LINES} lines in one list;"
                             " remove some")
    return single


def _pieces(structure, line, lines, width):
    """Ends [m] of the pieces of a line: half a width beyond a free end's node, half a width before a crossed line."""
    crossings = sorted(other["at"] for other in lines if line["cut"] and _crosses(line, other))
    marks = sorted({line["from"], line["to"], *crossings})
    half, position = width / 2, partial(structure.position, line["along"])
    return [(position(start) + (half if start in crossings else -half),
             position(end) + (-half if end in crossings else half)) for start, end in zip(marks, marks[1:])]


def _crosses(line, other):
    """True when uncut line `other` runs across `line` within both lines' spans."""
    across = other["along"] != line["along"] and not other["cut"]
    return across and line["from"] <= other["at"] <= line["to"] and other["from"] <= line["at"] <= other["to"]


def _strip(structure, layer, kind, name, line, start, end):
    """Box along a line from `start` to `end` [m], centred on it."""
    across, width = ACROSS[line["along"]], layer.table["width"]
    centre = structure.position(across, line["at"])
    span = {line["along"]: (start, end), across: (centre - width / 2, centre + width / 2)}
    low, high = ([span["x"][i], span["y"][i], z] for i, z in ((0, layer.z0), (1, layer.z1)))
    plan = structure.plans.get(max(layer.storey, 1))  # of the storey below or above
    return structure.element(kind, name, box(low, high), layer.table, line["where"], fixed=layer.table["fixed"],
                             storey=layer.storey, section=(width, layer.z1 - layer.z0),
                             side=plan.sides(line["along"], centre, start, end) if plan else frozenset())


def lay_floors(structure, layer):
    """Floor slabs: one per area (default: the whole grid), extended by the margin; neighbours share a grid line."""
    areas = layer.table["areas"] or [None]
    elements = []
    for number, area in enumerate(areas, 1):
        low, high = structure.area(area, [other for other in areas if other is not area])
        name = f"floor{layer.storey}" + (f".{number}" if len(areas) > 1 else "")
        elements.append(structure.element("floor", name, box([*low, layer.z0], [*high, layer.z1]), layer.table,
                                          layer.table.where, storey=layer.storey))
    return elements


def lay_columns(structure, layer):
    """Square columns of one storey on their nodes, in the order of the column groups."""
    elements, plan = [], structure.plans[layer.storey]
    for (x, y), (section, where) in column_plan(structure, layer.storey).items():
        centre = np.array([structure.position("x", x), structure.position("y", y)])
        vertices = box([*(centre - section / 2), layer.z0], [*(centre + section / 2), layer.z1])
        elements.append(structure.element("column", f"column{layer.storey}.x{x:g}y{y:g}", vertices, layer.table, where,
                                          storey=layer.storey, side=plan.sides_at(*centre.tolist()),
                                          section=(section, section)))
    return elements


def column_plan(structure, storey):
    """{(x node, y node): (section [m], file:line)} of one storey; groups given by lines fill only free nodes."""
    plan = {}
    for group in in_storey(structure.table["columns"], storey):
        for x, y in _group_nodes(structure, group):
            if (x, y) not in plan:
                plan[x, y] = (group["section"], group.where)
                number = structure.table["columns"].index(group) + 1
                require_few(len(plan), group.where, f"structures.{structure.name}.columns[{number}]")
            elif group["lines"] is None:
                raise HouseError(f"{group.where}: {structure.name}: a second column at node x {x:g}, y {y:g} of storey"
                                 f" {storey} (first in {plan[x, y][1]}); remove one of them")
    return plan


def nodes_on_line(plan, along, at):
    """{node along a grid line at node `at`: section [m]} of the columns of a plan, in order."""
    axis = "xy".index(along)
    return {node[axis]: section for node, (section, _) in sorted(plan.items()) if node[1 - axis] == at}


def require_column(on_line, node, place):
    """HouseError for a node without a column. on_line: from `nodes_on_line`; place: beginning of the message"""
    if node not in on_line:
        nodes = ", ".join(f"{other:g}" for other in on_line) or "none"
        raise HouseError(f"{place}: no column at node {node:g}; nodes with columns on this line: {nodes}")


def _group_nodes(structure, group):
    if group["at"] is not None:
        nodes = [tuple(pair) for pair in group["at"]]
    elif group["grid"] is not None:
        nodes = [(x, y) for y in group["grid"]["y"] for x in group["grid"]["x"]]
    else:
        nodes = []  # every whole node along the lines, both ends included
        for line in _single_lines(structure, group["lines"]):
            along = np.arange(np.ceil(line["from"]), np.floor(line["to"]) + 1).tolist()
            nodes += [(n, line["at"]) if line["along"] == "x" else (line["at"], n) for n in along]
    for axis, values in zip("xy", zip(*nodes)):
        structure.check_nodes(axis, values, group.where)
    return nodes


def lay_braces(structure, layer):
    """Braces of one storey: hexagonal prisms (8 faces) in bays between neighbouring columns. A run [foot, head] leans
    from the foot of one column to the head of another."""
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
