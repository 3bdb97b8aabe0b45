# SPDX-License-Identifier: GPL-2.0-or-later
"""Samples of a run, as the engine Sampler takes them. Needs no YADE."""
import numpy as np

from .history import DIRECTIONS, History
from .series import Series

NORTH_EAST = slice(1, None, -1)  # components of a vector (east, north, up) in the order of DIRECTIONS
FIRST_GROUP = "x0 [m]"  # column of Sampler at which the groups begin, six columns each


class Samples(Series):
    """time [s], broken_joints, broken_springs, energies [J]; of each group displacement [m] and momentum [kg m/s],
    east, north, up."""

    __slots__ = ()

    @property
    def first(self):
        """Number of the columns before the groups."""
        return self.columns.index(FIRST_GROUP) if FIRST_GROUP in self.columns else len(self.columns)

    @property
    def groups(self):
        """(F, G, 2, 3) displacement and momentum of each group."""
        return self.rows[:, self.first:].reshape(self.samples, (len(self.columns) - self.first) // 6, 2, 3)

    @property
    def displacement(self):
        """(F, G, 3) [m], NaN for a group without a body."""
        return self.groups[:, :, 0]

    def momenta(self, groups):
        """(F, 1 + 3 P) time [s], momenta of a slice of the groups [kg m/s]."""
        chosen = self.groups[:, groups, 1]
        return np.column_stack([self.time, chosen.reshape(self.samples, 3 * chosen.shape[1])])

    def history(self, groups, heights):
        """History of storeys; without samples of a scene whose numbers have failed. groups: slice of those of their
        levels, from below; heights: of the storeys [m]"""
        moved = self.displacement[:, groups]
        drift, parts, names = drifts(moved, heights), [self.time], []
        for k in range(moved.shape[1]):
            parts += [drift[:, k], -moved[:, k, 2]]
            names += [*(f"drift_{direction}{k + 1} [-]" for direction in DIRECTIONS), f"drop{k + 1} [m]"]
        table = np.column_stack([*parts, self.rows[:, 1:self.first]])
        return History(["time [s]", *names, *self.columns[1:self.first]], table[np.isfinite(table).all(1)])


def drifts(displacement, heights, lowest=0):
    """(F, L, 2) drifts of storeys, north-south and east-west [-]. displacement: (F, L, 3) of the levels from below [m];
    heights: of the storeys [m]; lowest: numbers of the levels of storeys 1"""
    moved = displacement[:, :, NORTH_EAST]
    steps = np.diff(moved, axis=1, prepend=0.0)
    steps[:, lowest] = moved[:, lowest]
    return steps / np.array(heights, float)[:, None]
