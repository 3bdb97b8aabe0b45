# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of numbers over time, and the time history of a run: storey drifts, broken joints and energies at each sample.

`History` is the one place that knows the columns of history.csv:

    history = History.read("results/modelA_quake/history.csv")
    history.time                          # (F,) [s]
    history.storeys                       # (1, 2)
    history.drift(1, "ns")                # (F,) [-]; directions: "ns", "ew"
    history.energy("kinetic")             # (F,) [J]
    history.broken_joints                 # (F,) [-]
    history.column("drop1")               # any column, with or without its unit

Columns: time [s]; for each storey k: drift_nsk [-], drift_ewk [-], dropk [m]; broken_joints [-], broken_springs [-];
one column [J] for each term of `yade_timber.energy()`."""
from collections import namedtuple

import numpy as np

from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.table import csv_text, read_csv

NAME, BREAKS = "history.csv", "breaks.csv"
DIRECTIONS = ("ns", "ew")
NORTH_EAST = slice(1, None, -1)  # components of a vector (east, north, up) in the order of DIRECTIONS
FIRST_GROUP = "x0 [m]"  # column of Sampler at which the groups begin, six columns each


class Series(namedtuple("Table", "columns rows")):
    """A table, also as a CSV file. columns: names with units, among them 'time [s]'; rows: (F, C) float array, one a
    sample."""

    __slots__ = ()

    def __new__(cls, columns, rows):
        columns = tuple(columns)
        return super().__new__(cls, columns, np.asarray(rows, float).reshape(-1, len(columns)))

    def __repr__(self):
        return (f"<{type(self).__name__}: {self.samples}"
                f" samples{f', up to {self.time[-1]:g} s' if self.samples else ''}, {len(self.columns)} columns>")

    @classmethod
    def read(cls, path):
        """Table of a CSV file. Raises RunError with file and line when it is none."""
        header, lines = read_csv(path)
        rows = []
        for number, line in enumerate(lines, 2):
            try:
                rows.append([float(value) for value in line])
            except ValueError:
                raise RunError(f"{path}:{number}: not a row of numbers") from None
            if len(line) != len(header):
                raise RunError(f"{path}:{number}: {len(line)} values; the header names {len(header)} columns")
        if "time [s]" not in header:
            raise RunError(f"{path}:1: no column 'time [s]'")
        return cls(header, rows)

    def text(self):
        return csv_text(self.columns, self.rows.tolist())

    def write(self, path):
        """Write the CSV file. Raises OSError."""
        write_text(path, self.text())

    @property
    def samples(self):
        """Number of rows F."""
        return len(self.rows)

    def column(self, name):
        """(F,) values of a column, named with its unit ('drop1 [m]') or without ('drop1'). Raises KeyError."""
        for k, column in enumerate(self.columns):
            if name in (column, column.partition(" [")[0]):
                return self.rows[:, k]
        raise KeyError(name)

    @property
    def time(self):
        """(F,) [s]"""
        return self.column("time [s]")


class History(Series):
    """The table history.csv."""

    __slots__ = ()

    @property
    def storeys(self):
        """Numbers of the storeys, from below: (1, 2, ...)."""
        return tuple(int(name[len("drift_ns") :].partition(" ")[0]) for name in self.columns
                     if name.startswith("drift_ns"))

    def drift(self, storey, direction):
        """(F,) drift of a storey in direction 'ns' (north > 0) or 'ew' (east > 0). [-] Raises KeyError."""
        if storey not in self.storeys or direction not in DIRECTIONS:
            raise KeyError(f"drift({storey!r}, {direction!r}): storeys are {', '.join(map(str, self.storeys))};"
                           f" directions {', '.join(DIRECTIONS)}")
        return self.column(f"drift_{direction}{storey}")

    def drifts(self):
        """(storey, direction, (F,) drift) of each storey and direction, in the order of the columns."""
        return [(storey, direction, self.drift(storey, direction)) for storey in self.storeys
                for direction in DIRECTIONS]

    def largest_drift(self):
        """(F,) largest absolute drift of any storey and direction at each sample. [-]"""
        return np.abs([values for _, _, values in self.drifts()]).max(0) if self.storeys else np.zeros(self.samples)

    def energy(self, term):
        """(F,) term of the energy balance. [J]"""
        return self.column(f"{term} [J]")

    def row_at(self, time):
        """Number of the last sample at or before a time [s], at least 0."""
        return max(0, int(np.searchsorted(self.time, time, side="right")) - 1)

    @property
    def broken_joints(self):
        """(F,) number of joints without a spring left, those damaged before the start included. [-]"""
        return self.column("broken_joints")

    @property
    def broken_springs(self):
        """(F,) number of springs that broke during the run. [-]"""
        return self.column("broken_springs")


class Samples(Series):
    """Of the engine Sampler: time [s], broken_joints, broken_springs, energies [J]; of each group displacement [m] and
    momentum [kg m/s], east, north, up."""

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


def drifts(displacement, heights, stacked=True):
    """(F, L, 2) drifts of storeys, north-south and east-west [-]. displacement: (F, L, 3) of the levels from below [m];
    heights: (L,) of the storeys [m]; stacked: (L - 1, 1) bool, whether a level is above the one before"""
    moved = displacement[:, :, NORTH_EAST]
    steps = moved.copy()
    np.subtract(moved[:, 1:], moved[:, :-1], out=steps[:, 1:], where=stacked)
    return steps / np.asarray(heights, float)[:, None]
