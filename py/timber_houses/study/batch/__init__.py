# SPDX-License-Identifier: GPL-2.0-or-later
"""Batches: a parameter table with one run per row, and one table of results.

    row.py      a run: options, changes of its house, a name that follows from both
    table.py    file -> rows
    tasks.py    row -> task of the driver, after all rows have been checked
    collect.py  results of the runs -> runs.csv"""
from .collect import RUNS, write_runs
from .row import BatchError, HouseChanges, Row
from .table import read_table
from .tasks import check_rows, run_rows

__all__ = ["RUNS", "BatchError", "HouseChanges", "Row", "check_rows", "read_table", "run_rows", "write_runs"]
