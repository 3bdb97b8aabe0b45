# SPDX-License-Identifier: GPL-2.0-or-later
"""Batches: a parameter table (yade-batch's own format), one run a row, one table of results. `run` alone needs YADE.

    table.py    text file -> rows, each with a name that follows from its content
    run.py      row -> Scenario -> the run's folder, with `run.json` at its end, whether it worked or not
    collect.py  the runs' folders -> runs.csv
    local.py    all rows on this machine, through yade-batch
"""

from .collect import collect, write_runs
from .local import run_table
from .table import BatchError, Row, read_table

__all__ = ["BatchError", "Row", "collect", "read_table", "run_table", "write_runs"]
