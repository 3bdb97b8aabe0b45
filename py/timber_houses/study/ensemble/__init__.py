# SPDX-License-Identifier: GPL-2.0-or-later
"""Ensembles: a scenario run N times with vertices disturbed by at most 1e-9 m.

    runs.py        tasks of the driver, from the first run to the last result
    statistics.py  summaries -> medians and ranges of numbers, shares of outcomes, the run that is shown
    results.py     ensemble.json, ensemble.csv, text for the terminal, results of the run that is shown"""
from .runs import complete, tasks

__all__ = ["complete", "tasks"]
