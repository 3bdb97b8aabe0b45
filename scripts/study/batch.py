#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Run a parameter table on this machine through yade-batch: what is missing, one row of results a run in runs.csv.

    scripts/study/batch.py TABLE [-j 2] [--out results/NAME] [--retry] [--collect]

Stop it at any time (Ctrl-C, kill): the same command goes on. Exit status 1 when a run failed or is unfinished.
"""

import argparse
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "py"))  # after the installed package, which the runs are made of

from yade_timber.study.batch import BatchError, read_table, run_table, write_runs  # noqa: E402
from yade_timber.study.batch.collect import RUNS, STATES  # noqa: E402
from yade_timber.study.batch.table import COLUMNS  # noqa: E402


def arguments():
    columns = "\n".join(f"  {name:11} {about}" for name, (_, about) in COLUMNS.items())
    parser = argparse.ArgumentParser(description=__doc__, epilog=f"columns of a table:\n{columns}", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", type=Path, help="text file: a line with the names of the columns, then a line a run")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at a time (default %(default)s)")
    parser.add_argument("--out", type=Path, metavar="DIR", help="folder of the results (default results/<name of the table>)")
    parser.add_argument("--retry", action="store_true", help="run again what failed before")
    parser.add_argument("--collect", action="store_true", help="run nothing; write runs.csv for what is there")
    return parser.parse_args()


def main():
    options = arguments()
    folder = options.out or Path("results") / options.table.stem
    try:
        if options.collect:
            found = write_runs(read_table(options.table), folder)
        else:
            found = run_table(options.table, folder, max(1, options.jobs), HERE / "batch_run.py", options.retry)
    except (BatchError, OSError) as problem:
        sys.exit(f"error: {problem}")
    except KeyboardInterrupt:
        sys.exit(f"stopped; {folder / RUNS} tells what is done, the same command goes on")
    tell(found, folder)
    sys.exit(any(entry["status"] != "done" for entry in found))


def tell(found, folder):
    """Failed runs with their errors, numbers of each state, where the table is."""
    for entry in found:
        if entry["status"] == "failed":
            print(f"failed: {entry['run']} (line {entry['line']}): {entry['error']}")
    states = [entry["status"] for entry in found]
    print(", ".join(f"{states.count(state)} {state}" for state in STATES if state in states), f"-> {folder / RUNS}")


if __name__ == "__main__":
    main()
