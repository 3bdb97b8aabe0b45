# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared by the studies: options, batch of runs, CSV table, picture. A study can be stopped; the same command
continues.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

import matplotlib.style

matplotlib.use("Agg")
matplotlib.style.use("default")  # whatever the matplotlibrc of the user says

from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.errors import RunError
from timber_houses.base.input_file import is_file
from timber_houses.base.table import csv_text
from timber_houses.study.batch import run_rows, write_runs
from timber_houses.study.options import Parser, add_driver_options, non_negative, positive, results_folder
from timber_houses.study.retrofit.motions import END, START


def parser(about, folder):
    """ArgumentParser with the options of every study."""
    made = Parser(about)
    add_driver_options(made, folder)
    made.add_argument("--start", type=non_negative, default=START, metavar="S",
                      help="start of the part of the motion that is run [s] (default %(default)g)")
    made.add_argument("--end", type=positive, default=END, metavar="S",
                      help="end of that part [s] (default %(default)g)")
    made.add_argument("--dt", type=positive, metavar="S", help="time step [s] (default: that of the run scripts)")
    made.add_argument("--to", type=results_folder, metavar="DIR",
                      help="folder of the study's CSV and PNG (default: the folder of the runs)")
    return made


def house_name(text):
    """Name of a shipped house, or absolute path of a house file. For argparse."""
    return str(Path(text).resolve()) if is_file(text) else text


def run_all(rows, options):
    """Run Rows as a batch; returns the rows of runs.csv. Raises BatchError, RunError, OSError."""
    if not rows:
        raise RunError("the options select no run")
    run_rows(rows, options.out, options.jobs)
    return write_runs(rows, options.out)


def write_table(path, rows):
    """CSV of dicts; numbers with 5 digits."""
    lines = [[f"{value:.5g}" if isinstance(value, float) else value for value in row.values()] for row in rows]
    write_text(path, csv_text(list(rows[0]), lines))
    print(f"written: {path}")


def save(figure, path):
    with written_whole(path) as part:
        figure.savefig(part, dpi=130)
    print(f"written: {path}")
