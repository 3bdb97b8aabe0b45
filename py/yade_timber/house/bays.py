# SPDX-License-Identifier: GPL-2.0-or-later
"""Bays without a brace: between neighbouring columns on a line of beams."""

from .members import DIRECTION, column_plan
from .structure import ACROSS, Structure


def free_bays(description):
    """Names of the braces that can be added with `changed_house`, e.g. 'main.brace1.EW.y0.3-4'; one for each free bay.

    The foot is at the column nearer to an end of the line (in the middle: at the lower node), as in the corners of houses B and C.
    """
    names = []
    structures = {}
    for name, table in description.data["structures"].items():
        structures[name] = Structure(name, table, description.data["materials"], structures)
        for storey in structures[name].storeys:
            names += _free_in_storey(structures[name], storey)
    return names


def _free_in_storey(structure, storey):
    braced = _braced(structure, storey)
    plan = column_plan(structure, storey)
    names = []
    for line in structure.table["lines"]:
        along = line["along"]
        for at in line["at"]:
            nodes = sorted(node[along == "y"] for node in plan if node[along == "x"] == at and line["from"] <= node[along == "y"] <= line["to"])
            for low, high in zip(nodes, nodes[1:]):
                if (along, at, low, high) not in braced:
                    foot, head = (low, high) if low + high <= line["from"] + line["to"] else (high, low)
                    names.append(f"{structure.name}.brace{storey}.{DIRECTION[along]}.{ACROSS[along]}{at:g}.{foot:g}-{head:g}")
    return names


def _braced(structure, storey):
    """{(along, at, lower node, higher node)} of the bays that have a brace in this storey."""
    lines = [line for line in structure.table["braces"]["lines"] if not line["storeys"] or storey in line["storeys"]]
    return {(line["along"], at, min(run), max(run)) for line in lines for at in line["at"] for run in line["runs"]}
