# SPDX-License-Identifier: GPL-2.0-or-later
"""Table of errors: every physics case against closed forms, conservation laws and independent solutions.

    yade -n -x scripts/bench/accuracy_study.py [--only NAME ...] [--out FOLDER]

Writes accuracy.csv to FOLDER (default results/accuracy); scripts/bench/write_pages.py makes page and figure of it. Exit
status 1 if an error exceeds its bound. The cases are those of tests/physics, which explain each bound.
"""
import csv
import io
import math
import sys
import time
from pathlib import Path

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "physics")]

from cases import all_cases
from rows import Row
from timber_houses.base.atomic_write import write_text
from timber_houses.base.errors import RunError
from timber_houses.study.options import Parser, results_folder, run_script

HEADS = ("section", "quantity", "expected", "computed", "error", "bound", "dt [s]", "order", "within", "note")


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME",
                        help="files of cases (impact, friction, ...) or single cases")
    parser.add_argument("--out", type=results_folder, default="results/accuracy",
                        help="folder of the results (default %(default)s)")
    return parser.parse_args()


def rows_of(function):
    """Rows of one case; a case that fails to run gives one row, which does not pass."""
    start = time.monotonic()
    try:
        rows = function()
    except Exception as error:  # shown in the table; the other cases run
        rows = [Row("?", function.__name__, math.nan, math.nan,
                    note=f"did not run: {type(error).__name__}: {error}".splitlines()[0])]
    passed = sum(row.passes for row in rows)
    print(f"{function.__name__:45} {passed:3} of {len(rows):3} within bounds {time.monotonic() - start:7.1f} s",
          flush=True)
    return rows


def comma_separated(rows):
    """The table as CSV with all digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADS)
    for r in rows:
        numbers = map(repr, (r.expected, r.got, r.error, r.bound))
        writer.writerow((r.item, r.quantity, *numbers, r.dt or "", r.order or "", r.passes, r.note))
    return text.getvalue()


def main():
    options = arguments()
    wanted = [f for f in all_cases()
              if not options.only or {f.__name__, f.__module__.removesuffix("_cases")} & set(options.only)]
    if not wanted:
        known = sorted({f.__module__.removesuffix("_cases") for f in all_cases()})
        raise RunError(f"--only: no such cases; tests/physics has the files {', '.join(known)}")
    rows = sorted((row for function in wanted for row in rows_of(function)), key=lambda row: row.item)
    write_text(options.out / "accuracy.csv", comma_separated(rows))
    failed = [row for row in rows if not row.passes]
    for row in failed:
        print(f"out of bounds: {row.item}. {row.quantity}: error {row.error:.2g}, bound {row.bound:.2g}; {row.note}")
    print(f"{len(rows)} rows, {len(failed)} out of bounds; written to {options.out}")
    return int(bool(failed))


run_script(main)
