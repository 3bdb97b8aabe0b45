# SPDX-License-Identifier: GPL-2.0-or-later
"""Largest forces of joints and uplifts of column feet, from the tables joints.csv and columns.csv of a run."""
import math
import os
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path

from ..base.errors import RunError
from ..base.table import read_csv

JOINTS, COLUMNS, BREAKS = "joints.csv", "columns.csv", "breaks.csv"


@dataclass(frozen=True)
class Peaks:
    """forces: {joint: (pull, shear) [N]}, but of joints broken at the start; uplift: {standing column: [m]}"""

    forces: dict = field(default_factory=dict)
    uplift: dict = field(default_factory=dict)


def rows(path):
    """List of {column: text} of a CSV file. Raises RunError."""
    header, lines = read_csv(path)
    return [dict(zip_longest(header, line)) for line in lines if line]


def read(folder):
    """Peaks of a run's folder; empty without a table or column, as in older runs. Raises RunError."""
    forces = _values(Path(folder) / JOINTS, "joint", ("pull [N]", "shear [N]"), lambda row: row["state"] != "before")
    uplift = _values(Path(folder) / COLUMNS, "column", ("uplift [m]",), lambda row: row["state"] == "standing")
    return Peaks(forces, {name: value for name, (value,) in uplift.items()})


def _values(path, noun, columns, is_shown):
    """{name: numbers in some columns} of the rows that are shown."""
    table = rows(path) if os.path.lexists(path) else []
    if not table or not {noun, "state", *columns} <= table[0].keys():
        return {}
    return {row[noun]: tuple(_number(row[column], path, number) for column in columns)
            for number, row in enumerate(table, 2) if is_shown(row)}


def _number(text, path, line):
    """Finite number of a cell. Raises RunError with file and line."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise RunError(f"{path}:{line}: not a row of finite numbers")
    return value
