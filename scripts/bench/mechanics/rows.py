# SPDX-License-Identifier: GPL-2.0-or-later
"""A row of the table: scenes, what is measured in their trajectories, its closed form and its bound. Needs no YADE."""
import math
from dataclasses import dataclass
from typing import Callable

EXACT = 0.01
"""Bound of rows whose result is a ratio: 1 %."""
STANDS = 1.0
"""Bound of rows in which nothing should move [mm]."""


@dataclass(frozen=True)
class Row:
    """scenes(radius): scenes for bodies with this rounding radius of edges [m] (0: sharp). measure(*trajectories):
    the number. expected(radius): its closed form. bound: largest error; relative to the closed form where `relative`.
    fault(scene): the scene with one parameter falsified, whose measure must be outside the bound.
    """

    key: str
    title: str
    unit: str
    scenes: Callable
    measure: Callable
    expected: Callable
    bound: float
    source: str
    fault: Callable
    relative: bool = False
    needs: frozenset = frozenset()

    def error(self, value, radius=0.0):
        """Error in units of the bound; infinite for a value that is no number."""
        if not math.isfinite(value):
            return math.inf
        expected = self.expected(radius)
        return abs(value - expected) / (self.bound * (abs(expected) if self.relative else 1.0))


def constant(value):
    """A closed form that does not depend on the rounding."""
    return lambda radius: value


TABLE = []
"""Every row, in the order of the page."""


def add(**row):
    TABLE.append(Row(**row))


def table():
    """All rows; the families register theirs when they are imported."""
    from mechanics import falling, friction, joints, loads, rocking, stacks  # noqa: F401

    return TABLE
