# SPDX-License-Identifier: GPL-2.0-or-later
"""Ensembles: a scenario run N times with vertices disturbed by at most 1e-9 m.

    runs.py        tasks of the driver; ensemble.json, ensemble.csv, text for the terminal, results of the shown run
    statistics.py  summaries -> medians and ranges of numbers, shares of outcomes, the run that is shown"""
from .runs import complete, tasks

__all__ = ["complete", "tasks"]
