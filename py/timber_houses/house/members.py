# SPDX-License-Identifier: GPL-2.0-or-later
"""Straight members: foundation strips, sills, beams, columns and floor slabs of one structure. Lengths in m."""
from functools import partial

import numpy as np

from .errors import HouseError
from .geometry import box
from .limits import MAX_LINES
from .structure import ACROSS, in_storey, require_few

DIRECTION = {"x": "EW", "y": "NS"}


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
