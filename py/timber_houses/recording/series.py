# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of numbers over time: CSV files whose columns have names with units."""
from collections import namedtuple

import numpy as np

from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.table import csv_text, read_csv


class Series(namedtuple("Table", "columns rows")):
    """columns: names with units, among them 'time [s]'; rows: (F, C) float array, one row a sample."""

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
