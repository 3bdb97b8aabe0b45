# SPDX-License-Identifier: GPL-2.0-or-later
"""The time history of a run: storey drifts, broken joints and energies at each sample. Needs no YADE.

`History` is the one place that knows the columns of history.csv:

    history = History.read("results/modelA_quake/history.csv")
    history.time                          # (F,) [s]
    history.storeys                       # (1, 2)
    history.drift(1, "ns")                # (F,) [-]; directions: "ns", "ew"
    history.energy("kinetic")             # (F,) [J]
    history.broken_joints                 # (F,) [-]
    history.column("drop1")               # any column, with or without its unit

Columns: time [s]; for each storey k: drift_nsk [-], drift_ewk [-], dropk [m]; broken_joints [-], broken_springs [-]; one column [J] for each term
of `yade_timber.energy()`; joint_dashpot only if joints were damped at the first sample.
"""
import csv
from collections import namedtuple

import numpy as np

from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.input_file import require_regular
from ..base.table import csv_text

NAME = "history.csv"
DIRECTIONS = ("ns", "ew")


class History(namedtuple("Table", "columns rows")):
    """columns: names with units, as in history.csv; rows: (F, C) float array, one row a sample."""

    __slots__ = ()

    def __new__(cls, columns, rows):
        columns = tuple(columns)
        return super().__new__(cls, columns, np.asarray(rows, float).reshape(-1, len(columns)))

    def __repr__(self):
        return f"<History: {self.samples} samples{f', up to {self.time[-1]:g} s' if self.samples else ''}, {len(self.columns)} columns>"

    @classmethod
    def read(cls, path):
        """History of a history.csv. Raises RunError with file and line when it is none."""
        require_regular(path)
        try:
            with open(path, newline="", encoding="utf-8") as file:
                header, *lines = csv.reader(file)
        except (OSError, ValueError, csv.Error) as problem:
            raise RunError(f"{path}: cannot be read as a table: {problem}") from None
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
        """Content of history.csv."""
        return csv_text(self.columns, self.rows.tolist())

    def write(self, path):
        """Write history.csv. Raises OSError."""
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

    @property
    def storeys(self):
        """Numbers of the storeys, from below: (1, 2, ...)."""
        return tuple(int(name[len("drift_ns"):].partition(" ")[0]) for name in self.columns if name.startswith("drift_ns"))

    def drift(self, storey, direction):
        """(F,) drift of a storey in direction 'ns' (north > 0) or 'ew' (east > 0) over its height. [-]"""
        return self.column(f"drift_{direction}{storey}")

    def drifts(self):
        """(storey, direction, (F,) drift) of each storey and direction, in the order of the columns."""
        return [(storey, direction, self.drift(storey, direction)) for storey in self.storeys for direction in DIRECTIONS]

    def largest_drift(self):
        """(F,) largest absolute drift of any storey and direction at each sample. [-]"""
        return np.abs([values for _, _, values in self.drifts()]).max(0)

    def energy(self, term):
        """(F,) term of the energy balance. [J]"""
        return self.column(f"{term} [J]")

    @property
    def broken_joints(self):
        """(F,) number of joints without a spring left, those damaged before the start included. [-]"""
        return self.column("broken_joints")

    @property
    def broken_springs(self):
        """(F,) number of springs that broke during the run. [-]"""
        return self.column("broken_springs")
