# SPDX-License-Identifier: GPL-2.0-or-later
"""Table and plot of errors: every physics case against closed forms, conservation laws and independent solutions.

    yade -n -x scripts/bench/accuracy_study.py [--only NAME ...] [--out FOLDER]

Writes accuracy.md, accuracy.csv and accuracy.png (error against time step) to FOLDER (default results/accuracy). Exit status 1 if an
error exceeds its bound. The cases are those of tests/physics, which explain each bound.
"""
import csv
import io
import math
import sys
import time
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "physics")]

from cases import all_cases  # noqa: E402
from rows import Row  # noqa: E402
from yade_timber.base.atomic_write import write_text, written_whole  # noqa: E402
from yade_timber.base.errors import RunError  # noqa: E402
from yade_timber.study.options import Parser, results_folder, run_script  # noqa: E402

SECTIONS = {
    "1": "Contact",
    "2": "Friction",
    "3": "Rocking",
    "4": "Joint",
    "5": "Free motion",
    "6": "Assemblies",
    "7": "Energy balance",
    "8": "Invariance",
    "9": "Independent reference",
}
HEADS = ("section", "quantity", "expected", "computed", "error", "bound", "dt [s]", "order", "within", "note")


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME", help="files of cases (impact, friction, ...) or single cases")
    parser.add_argument("--out", type=results_folder, default="results/accuracy", help="folder of the results (default %(default)s)")
    return parser.parse_args()


def rows_of(function):
    """Rows of one case; a case that fails to run gives one row, which does not pass."""
    start = time.monotonic()
    try:
        rows = function()
    except Exception as error:  # shown in the table; the other cases run
        rows = [Row("?", function.__name__, math.nan, math.nan, note=f"did not run: {type(error).__name__}: {error}".splitlines()[0])]
    passed = sum(row.passes for row in rows)
    print(f"{function.__name__:45} {passed:3} of {len(rows):3} within bounds {time.monotonic() - start:7.1f} s", flush=True)
    return rows


def cells(row):
    """Texts of one line of the table, in the order of HEADS."""
    bound = "" if math.isinf(row.bound) else f"{row.bound:.2g}"
    order = "" if row.order is None or math.isnan(row.order) else f"{row.order:.2f}"
    step = "" if row.dt is None else f"{row.dt:.3g}"
    within = "no" if not row.passes else "yes" if bound else ""
    return row.item, row.quantity, f"{row.expected:.8g}", f"{row.got:.8g}", f"{row.error:.2g}", bound, step, order, within, row.note


def markdown(rows):
    """The page: one table per section."""
    lines = [
        "# Accuracy",
        "",
        "Errors are relative to the expected value, absolute if it is 0. Rows without a bound are for information only.",
        "",
    ]
    for item in sorted({row.item for row in rows}):
        lines += [f"## {item}. {SECTIONS.get(item, 'Not run')}", "", "| " + " | ".join(HEADS[1:]) + " |", "|---" * (len(HEADS) - 1) + "|"]
        lines += ["| " + " | ".join(text.replace("|", "\\|") for text in cells(row)[1:]) + " |" for row in rows if row.item == item]
        lines.append("")
    return "\n".join(lines)


def comma_separated(rows):
    """The table as CSV with all digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADS)
    for r in rows:
        numbers = map(repr, (r.expected, r.got, r.error, r.bound))
        writer.writerow((r.item, r.quantity, *numbers, r.dt or "", r.order or "", r.passes, r.note))
    return text.getvalue()


def curves(rows):
    """{section: {quantity: ([dt], [error])}} of all quantities with several time steps."""
    found = defaultdict(lambda: defaultdict(lambda: ([], [])))
    for row in rows:
        if row.dt and row.error > 0:
            steps, errors = found[row.item][row.quantity]
            steps.append(row.dt)
            errors.append(row.error)
    several = {item: {q: c for q, c in curve.items() if len(set(c[0])) > 1} for item, curve in found.items()}
    return {item: curve for item, curve in sorted(several.items()) if curve}


def draw(rows, path):
    """Error against time step, one panel per section, with slopes of order 1 and 2."""
    panels = curves(rows)
    figure, axes = plt.subplots(max(1, len(panels)), 1, figsize=(11, 4.2 * max(1, len(panels))), squeeze=False)
    for axis, (item, quantities) in zip(axes[:, 0], panels.items()):
        for name, (steps, errors) in quantities.items():
            axis.loglog(steps, errors, "o-", markersize=3, label=name)
        steps = sorted({dt for curve in quantities.values() for dt in curve[0]})
        low = min(min(curve[1]) for curve in quantities.values())
        for order, style in ((1, ":"), (2, "--")):
            axis.loglog(steps, [low * (dt / steps[0]) ** order for dt in steps], style, color="0.6", label=f"order {order}")
        axis.set(title=f"{item}. {SECTIONS.get(item, '')}", xlabel="time step [s]", ylabel="error [-]")
        axis.grid(True, which="major", alpha=0.3)
        axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.tight_layout()
    with written_whole(path) as part:
        figure.savefig(part, dpi=120)
    plt.close(figure)


def main():
    options = arguments()
    wanted = [f for f in all_cases() if not options.only or {f.__name__, f.__module__.removesuffix("_cases")} & set(options.only)]
    if not wanted:
        known = sorted({f.__module__.removesuffix("_cases") for f in all_cases()})
        raise RunError(f"--only: no such cases; tests/physics has the files {', '.join(known)}")
    rows = sorted((row for function in wanted for row in rows_of(function)), key=lambda row: row.item)
    write_text(options.out / "accuracy.md", markdown(rows))
    write_text(options.out / "accuracy.csv", comma_separated(rows))
    draw(rows, options.out / "accuracy.png")
    print(markdown(rows))
    failed = sum(not row.passes for row in rows)
    print(f"{len(rows)} rows, {failed} out of bounds; written to {options.out}")
    return int(failed > 0)


run_script(main)
