#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the rows of a parameter table that are not done, and write runs.csv with one row of results per run.

    scripts/study/batch.py TABLE [-j 2] [--out results/NAME] [--retry] [--collect] [--only RUN]

All rows are checked before the first run. Stop it at any time (Ctrl-C, kill): the same command continues.
Exit status 1 when a run failed or is unfinished.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

from timber_houses.study.batch import RUNS, BatchError, read_table, run_rows, write_runs
from timber_houses.study.batch.table import COLUMNS
from timber_houses.study.driver import STATES
from timber_houses.study.options import Parser, count, results_folder, run_script


def arguments():
    columns = "\n".join(f"  {name:14} {each.metadata['help']}" for name, each in COLUMNS.items())
    parser = Parser(__doc__, epilog=f"columns of a table:\n{columns}")
    parser.add_argument("table", type=Path,
                        help="parameter table: a line with the names of the columns, then one line per run")
    parser.add_argument("-j", "--jobs", type=count, metavar="N", help="runs at a time (default: one per core)")
    parser.add_argument("--out", type=results_folder, metavar="DIR",
                        help="folder of the results (default results/<name of the table>)")
    parser.add_argument("--retry", action="store_true", help="run failed rows again")
    parser.add_argument("--collect", action="store_true", help="run nothing; write runs.csv for the results there are")
    parser.add_argument("--only", metavar="RUN",
                        help="run this row alone (name of the run or line of the table); runs.csv is not written")
    return parser.parse_args()


def main():
    options = arguments()
    rows = read_table(options.table)
    folder = options.out or results_folder(Path("results") / options.table.stem)
    if options.only:
        return run_one(rows, options.only, folder)
    try:
        if not options.collect:
            run_rows(rows, folder, options.jobs, options.retry)
    finally:
        found = write_runs(rows, folder)
    report(found, folder)
    return int(any(run["status"] != "done" for run in found))


def run_one(rows, key, folder):
    """Run the row of that name or line; returns the exit status."""
    chosen = [row for row in rows if key in (row.name, str(row.line))]
    if not chosen:
        raise BatchError(f"--only {key}: no run of that name or line")
    return int(None in run_rows(chosen, folder, jobs=1).values())


def report(found, folder):
    """Print the failed runs with their errors, and the number of runs in each state."""
    for run in found:
        if run["status"] == "failed":
            print(f"failed: {run['run']}: {run['error']}")
    states = [run["status"] for run in found]
    print(", ".join(f"{states.count(state)} {state}" for state in STATES if state in states), f"-> {folder / RUNS}")


if __name__ == "__main__":
    run_script(main)
