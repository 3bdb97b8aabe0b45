# SPDX-License-Identifier: GPL-2.0-or-later
"""Bays that can take a brace or a wall, between neighbouring columns on a line of beams; for `changed_house`."""
from .bay_name import BayName
from .members import column_plan, nodes_on_line
from .structure import Structure, in_storey


def free_bays(description):
    """Names of the braces that can be added, e.g. 'main.brace1.EW.y0.3-4'; one for each bay without brace or opening.
    The foot is at the column nearer to an end of the line; in the middle at the lower node."""
    names = []
    for structure, storey in _storeys(description):
        lines = in_storey(structure.table["braces"]["lines"], storey)
        taken = {(line["along"], at, min(run), max(run)) for line in lines for at in line["at"] for run in line["runs"]}
        taken |= _walled(structure, storey, only_open=True)
        for line, (along, at, low, high) in _bays(structure, storey):
            if (along, at, low, high) not in taken:
                foot, head = (low, high) if low + high <= line["from"] + line["to"] else (high, low)
                names.append(str(BayName(structure.name, storey, along, at, foot, head)))
    return names


def free_wall_bays(description, kind):
    """Names of walls of a type that can be added, e.g. 'main.wall1.EW.y0.3-4.plywood'; one for each free bay."""
    names = []
    for structure, storey in _storeys(description):
        walled = _walled(structure, storey)
        names += [str(BayName(structure.name, storey, along, at, low, high, kind))
                  for _, (along, at, low, high) in _bays(structure, storey) if (along, at, low, high) not in walled]
    return names


def _storeys(description):
    """(Structure, storey) of all storeys of a house."""
    structures = {}
    for name, table in description.data["structures"].items():
        structures[name] = Structure(name, table, description.data["materials"], structures)
        for storey in structures[name].storeys:
            yield structures[name], storey


def _bays(structure, storey):
    """(line, (along, at, lower node, higher node)) of the bays of a storey."""
    plan = column_plan(structure, storey)
    for line in structure.table["lines"]:
        along = line["along"]
        for at in line["at"]:
            nodes = [node for node in nodes_on_line(plan, along, at) if line["from"] <= node <= line["to"]]
            yield from ((line, (along, at, low, high)) for low, high in zip(nodes, nodes[1:]))


def _walled(structure, storey, only_open=False):
    """{(along, at, lower node, higher node)} of the bays with walls in a storey. only_open: with a window or a door"""
    walls = [line for line in in_storey(structure.table["walls"], storey)
             if line["opening"] != "none" or not only_open]
    return {bay for _, bay in _bays(structure, storey) for wall in walls
            if bay[0] == wall["along"] and bay[1] in wall["at"] and wall["from"] <= bay[2] and bay[3] <= wall["to"]}
