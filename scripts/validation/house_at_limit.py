#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The house of 1.5 times the required wall quantity near its limit: factors on a record, at several time steps.

    scripts/validation/house_at_limit.py --record PREFIX_OF_JMA_KOBE --start 6 --end 20 [--to DIR]

Whether a house at its limit collapses differs from motion to motion; the share of collapses must not depend on the
step. Runs can be stopped; the same command continues.
"""
import sys
from itertools import product
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

from wall_grades import house_file

from timber_houses.api.result import load_run
from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.run.options import RunOptions
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import (Parser, add_driver_options, non_negative, positive, record, results_folder,
                                       run_script)

GRADE, LEVEL, RULE = 1.5, "design", "law"
"""The house (wall_grades.py)."""
FACTORS = (0.9, 0.92, 0.94, 0.96, 0.97, 0.98, 0.99, 1.0, 1.005, 1.01, 1.02, 1.03, 1.05)
"""On the record. [-]"""
STEPS = (1e-4, 2e-4, 5e-4)
"""Time steps. [s]"""
HEADS = ("factor on the record", "time step [s]", "collapsed", "peak drift of storey 1 N-S [-]", "E-W [-]")


def parsed():
    options = Parser(__doc__)
    add_driver_options(options, Path("results/limit"))
    options.add_argument("--record", type=record, required=True, metavar="PREFIX", help="recorded motion")
    options.add_argument("--start", type=non_negative, metavar="S",
                         help="start of the part of the motion that is run [s]")
    options.add_argument("--end", type=positive, metavar="S", help="end of that part [s]")
    options.add_argument("--to", type=results_folder, metavar="DIR",
                         help="folder of the table (default: the folder of the runs)")
    return options.parse_args()


def row_of(factor, dt, folder):
    """Row of the table for a run."""
    result = load_run(folder)
    peaks = [abs(result.history.drift(1, direction)).max() for direction in ("ns", "ew")]
    return [f"{factor:g}", f"{dt:g}", int(result.collapsed), *(f"{peak:.4g}" for peak in peaks)]


def main():
    given = parsed()
    given.out.mkdir(parents=True, exist_ok=True)
    house = str(house_file(given.out, GRADE, LEVEL, RULE).resolve())
    tasks = {(factor, dt): Task(given.out / f"{factor:g}_{dt:g}",
                                RunOptions(house=house, record=str(given.record), start=given.start, end=given.end,
                                           scale=factor, dt=dt, until_collapse=True, no_frames=True))
             for factor, dt in product(FACTORS, STEPS)}
    run_missing(list(tasks.values()), given.jobs)
    table = csv_text(HEADS, [row_of(*key, task.folder) for key, task in tasks.items() if task.summary is not None])
    path = (given.to or given.out) / f"{given.out.name}.csv"
    write_text(path, table)
    print(table, f"written: {path}", sep="\n")


if __name__ == "__main__":
    run_script(main)
