# SPDX-License-Identifier: GPL-2.0-or-later
"""Batches: a parameter table with one run per row, and one table of results.

    table.py    file -> rows, each with a name that follows from its content
    tasks.py    row -> task of the driver, after all rows have been checked
    collect.py  results of the runs -> runs.csv
"""
from .collect import RUNS, write_runs
from .table import BatchError, Row, read_table
from .tasks import check_rows, run_rows

__all__ = ["RUNS", "BatchError", "Row", "check_rows", "read_table", "run_rows", "write_runs"]
