# SPDX-License-Identifier: GPL-2.0-or-later
"""Batches: a parameter table with one run per row, and one table of results.

    table.py  file -> rows
    rows.py   row -> task of the driver, after all rows have been checked; results -> runs.csv"""
from .rows import RUNS, BatchError, HouseChanges, Row, check_rows, run_rows, write_runs
from .table import read_table

__all__ = ["RUNS", "BatchError", "HouseChanges", "Row", "check_rows", "read_table", "run_rows", "write_runs"]
