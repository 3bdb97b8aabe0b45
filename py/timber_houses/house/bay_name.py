# SPDX-License-Identifier: GPL-2.0-or-later
"""Names of braces and walls in bays: 'main.brace1.EW.y0.3-4', 'main.wall1.EW.y0.3-4.plywood'."""
import re
from typing import NamedTuple

from .members import DIRECTION
from .schema import NAME
from .structure import ACROSS

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
