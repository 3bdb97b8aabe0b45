# SPDX-License-Identifier: GPL-2.0-or-later
"""Table and plot of the package's errors: every physics case against closed forms, conservation laws and independent solutions.

    yade -n -x scripts/bench/accuracy_study.py [--only NAME ...] [--out FOLDER]

Writes accuracy.md, accuracy.csv and accuracy.png (error against time step) to FOLDER (default results/accuracy). Exit status 1
if any
error is out of its bound. The cases are those of tests/physics, where each bound is explained.
"""
import argparse
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

ITEMS = {
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
HEADS = ("item", "quantity", "expected", "got", "error", "bound", "dt [s]", "order", "within", "note")


def arguments():
    parser = argparse.ArgumentParser(prog="accuracy_study.py", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--only", nargs="+", default=[], metavar="NAME", help="files of cases (impact, friction, ...) or single cases"
    )
    parser.add_argument("--out", type=Path, default=Path("results/accuracy"), help="folder of the results")
    return parser.parse_args()


def rows_of(function):
    """Rows of one case; a case that fails to run is a row of its own, which does not pass."""
    start = time.monotonic()
    try:
        rows = function()
    except Exception as error:  # the table must show it and go on
        rows = [
            Row("?", function.__name__, math.nan, math.nan, note=f"did not run: {type(error).__name__}: {error}".splitlines()[0])
        ]
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
    """The table by items. Errors are relative, except where the expected value is 0."""
    lines = [
        "# Accuracy",
        "",
        "Errors are relative to the expected value; absolute where it is 0. An empty bound: shown, not judged.",
        "",
    ]
    for item in sorted({row.item for row in rows}):
        lines += [
            f"## {item}. {ITEMS.get(item, 'Not run')}", "", "| " + " | ".join(HEADS[1:]) + " |", "|---" * (len(HEADS) - 1) + "|"
        ]
        lines += ["| " + " | ".join(text.replace("|", "\\|") for text in cells(row)[1:]) + " |" for row in rows if row.item == item]
        lines.append("")
    return "\n".join(lines)


def comma_separated(rows):
    """The same with all digits, for further use."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADS)
    for r in rows:
        writer.writerow(
            (
                r.item,
                r.quantity,
                repr(r.expected),
                repr(r.got),
                repr(r.error),
                repr(r.bound),
                r.dt or "",
                r.order or "",
                r.passes,
                r.note,
            )
        )
    return text.getvalue()


def curves(rows):
    """{item: {quantity: ([dt], [error])}} of all quantities that were run with several steps."""
    found = defaultdict(lambda: defaultdict(lambda: ([], [])))
    for row in rows:
        if row.dt and row.error > 0:
            steps, errors = found[row.item][row.quantity]
            steps.append(row.dt)
            errors.append(row.error)
    several = {item: {q: c for q, c in curve.items() if len(set(c[0])) > 1} for item, curve in found.items()}
    return {item: curve for item, curve in sorted(several.items()) if curve}


def draw(rows, path):
    """Error against time step, a panel for each item, with slopes of order 1 and 2."""
    panels = curves(rows)
    figure, axes = plt.subplots(max(1, len(panels)), 1, figsize=(11, 4.2 * max(1, len(panels))), squeeze=False)
    for axis, (item, quantities) in zip(axes[:, 0], panels.items()):
        for name, (steps, errors) in quantities.items():
            axis.loglog(steps, errors, "o-", markersize=3, label=name)
        steps = sorted({dt for curve in quantities.values() for dt in curve[0]})
        low = min(min(curve[1]) for curve in quantities.values())
        for order, style in ((1, ":"), (2, "--")):
            axis.loglog(steps, [low * (dt / steps[0]) ** order for dt in steps], style, color="0.6", label=f"order {order}")
        axis.set(title=f"{item}. {ITEMS.get(item, '')}", xlabel="time step [s]", ylabel="error [-]")
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
        sys.exit(
            "error: --only: no such cases; tests/physics has the files " + ", ".join(
                sorted({f.__module__.removesuffix("_cases") for f in all_cases()})
            )
        )
    rows = sorted((row for function in wanted for row in rows_of(function)), key=lambda row: row.item)
    options.out.mkdir(parents=True, exist_ok=True)
    write_text(options.out / "accuracy.md", markdown(rows))
    write_text(options.out / "accuracy.csv", comma_separated(rows))
    draw(rows, options.out / "accuracy.png")
    print(markdown(rows))
    failed = sum(not row.passes for row in rows)
    print(f"{len(rows)} rows, {failed} out of bounds; written to {options.out}")
    sys.exit(1 if failed else 0)


main()
