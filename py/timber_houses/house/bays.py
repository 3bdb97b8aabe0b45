# SPDX-License-Identifier: GPL-2.0-or-later
"""Bays between neighbouring columns on a line of beams: names of the braces and walls in them, as `changed_house` takes
them, 'main.brace1.EW.y0.3-4', 'main.wall1.EW.y0.3-4.plywood'; and those that can take one."""
import re
from typing import NamedTuple

from .grid import Grid
from .layout import ACROSS
from .members import DIRECTION, column_plan, in_storey, nodes_on_line
from .schema import NAME

_NODE = r"(\d{1,4}(?:\.\d{1,6})?)"
_BAY = re.compile(rf"({NAME})\.(brace|wall)(\d{{1,2}})\.(EW\.y|NS\.x){_NODE}\.{_NODE}-{_NODE}(?:\.({NAME}))?")


class BayName(NamedTuple):
    """A brace or wall by its place: structure, storey, 'x' or 'y' along it, node of its line, nodes of its ends (of a
    brace foot and head), type of a wall's sheathing, '' of a brace."""

    structure: str
    storey: int
    along: str
    at: float
    start: float
    end: float
    type: str = ""

    @classmethod
    def read(cls, text):
        """BayName of a text, None of another text."""
        match = _BAY.fullmatch(text)
        if match is None or (match[2] == "wall") != (match[8] is not None):
            return None
        at, start, end = map(float, match.groups()[4:7])
        return cls(match[1], int(match[3]), "x" if match[4] == "EW.y" else "y", at, start, end, match[8] or "")

    @property
    def line(self):
        """'main.brace1.EW.y0': without bay and type; a whole node before a fraction has its decimal, as x4.0.1.5-3 is
        bay 1.5-3 of line 4."""
        at = f"{self.at:.1f}" if self.at == int(self.at) and self.start != int(self.start) else f"{self.at:g}"
        kind = "wall" if self.type else "brace"
        return f"{self.structure}.{kind}{self.storey}.{DIRECTION[self.along]}.{ACROSS[self.along]}{at}"

    def __str__(self):
        return f"{self.line}.{self.start:g}-{self.end:g}{self.type and f'.{self.type}'}"


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
    return [str(BayName(structure.name, storey, along, at, low, high, kind))
            for structure, storey in _storeys(description) for walled in [_walled(structure, storey)]
            for _, (along, at, low, high) in _bays(structure, storey) if (along, at, low, high) not in walled]


def _storeys(description):
    structures = {}
    for name, table in description.data["structures"].items():
        structures[name] = Grid(name, table, description.data["materials"], structures)
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
    walls = [line for line in in_storey(structure.table["walls"], storey) if line["opening"] != "none" or not only_open]
    return {bay for _, bay in _bays(structure, storey) for wall in walls
            if bay[0] == wall["along"] and bay[1] in wall["at"] and wall["from"] <= bay[2] and bay[3] <= wall["to"]}
