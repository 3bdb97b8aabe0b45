#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Fill the tables of docs/mechanics.md from the CSV files in docs/mechanics, and draw their figure:
write_mechanics.py [docs]. Needs no YADE.
"""
import csv
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import TwoSlopeNorm

from mechanics.rows import table

FIRST = "timber"
"""CSV file of the first column."""
MISS, NOT_POSSIBLE, NOT_RUN, FAILED, NEVER = "✗", "–", "?", "fails✗", "never"
DECADES = 2
"""Of error over bound that the colours show, to both sides of 1."""


def columns(folder):
    """{program: {"version", "settings", "radius", "steps": [dt], "cells": {(row, dt): (value or None, note)}}}, this
    package first.
    """
    found = {}
    for path in sorted(folder.glob("*.csv"), key=lambda path: (path.stem != FIRST, path.stem)):
        with open(path, newline="", encoding="utf-8") as file:
            for line in csv.DictReader(file):
                program = found.setdefault(line["program"], {
                    "version": line["version"], "settings": line["settings"], "radius": float(line["radius [m]"]),
                    "steps": [], "cells": {}})
                if line["dt [s]"] not in program["steps"]:
                    program["steps"].append(line["dt [s]"])
                value = float(line["value"]) if line["value"] else None
                program["cells"][line["row"], line["dt [s]"]] = value, line["note"]
    return found


def share(program, row, dt):
    """Error over bound; NaN where the program cannot express the scene, or was not run."""
    value, note = program["cells"].get((row.key, dt), (None, "not run"))
    if value is None:
        return math.inf if note.startswith("failed") else math.nan
    return row.error(value, program["radius"])


def number(value):
    """Three digits; small ones as 0."""
    if not math.isfinite(value):
        return NEVER
    if abs(value) >= 1000:
        return f"{value:.0f}"
    return f"{value:.3g}" if abs(value) >= 0.0005 else "0"


def cell(program, row):
    """Values at the program's steps, with marks for misses."""
    texts = []
    for dt in program["steps"]:
        error, (value, note) = share(program, row, dt), program["cells"].get((row.key, dt), (None, "not run"))
        if math.isnan(error):
            texts.append(NOT_RUN if note.startswith("not run") else NOT_POSSIBLE)
        elif value is None:
            texts.append(FAILED)
        else:
            texts.append(number(value) + ("" if error <= 1 else MISS))
    return texts[0] if len(set(texts)) == 1 else "/".join(texts)


def compact(heads, rows):
    """A Markdown table without spaces beside its bars."""
    lines = ["|" + "|".join(row) + "|" for row in (heads, *rows)]
    return "\n".join([lines[0], "|-" * len(heads) + "|", *lines[1:]])


def step_text(dt):
    """1/60 or 0.0005."""
    dt = float(dt)
    return f"1/{1 / dt:.0f}" if dt > 9e-4 else f"{dt:g}"


def bound_text(row):
    return f"{100 * row.bound:g}%" if row.relative else f"{row.bound:g}"


def result_table(found):
    heads, rows, found = ["scene", "exact±bound", *shown(found)], [], shown(found)
    for row in table():
        exact = f"{number(row.expected(0.0))}±{bound_text(row)}"
        unit = "" if row.unit == "-" else f" [{row.unit}]"
        rows.append([row.title + unit, exact, *(cell(program, row) for program in found.values())])
    rows.append(["misses", "0", *(misses(program) for program in found.values())])
    return compact(heads, rows)


def shown(found):
    """Programs with their defaults; the names of others have a comma."""
    return {name: program for name, program in found.items() if "," not in name}


def errors_at(program, dt):
    """{row: error over bound} of the rows that are possible."""
    errors = {row.key: share(program, row, dt) for row in table()}
    return {key: error for key, error in errors.items() if not math.isnan(error)}


def safe_table(found):
    """What other settings mend, at the program's smallest step."""
    rows = []
    for name, program in found.items():
        if name in shown(found):
            continue
        dt, plain = program["steps"][-1], found[name.split(",")[0]]
        other, before = errors_at(program, dt), errors_at(plain, plain["steps"][-1])
        mended = [key for key in other if other[key] <= 1 < before[key]]
        missed = sum(error > 1 for error in other.values())
        rows.append([name, ", ".join(mended), f"{missed}of{len(other)}"])
    return compact(["setting", "passes besides", "misses"], rows)


def misses(program):
    texts = []
    for dt in program["steps"]:
        errors = errors_at(program, dt).values()
        texts.append(f"{sum(error > 1 for error in errors)}of{len(errors)}")
    return "/".join(texts)


def program_table(found):
    rows = [[name, program["version"], ",".join(map(step_text, program["steps"])), program["settings"]]
            for name, program in shown(found).items()]
    return compact(["program", "version", "steps [s]", "settings"], rows)


def not_possible(found):
    """Reasons, by program, a line each."""
    lines = []
    for name, program in found.items():
        reasons = sorted({note.removeprefix("not possible: ") for _, note in program["cells"].values()
                          if note.startswith("not possible")})
        if reasons and name in shown(found):
            lines.append(f"* {name}: {', '.join(reasons)}.")
    return "\n".join(lines)


def draw(found, path):
    """Error over bound as colour: rows by programs and their steps."""
    rows, heads, edges = table(), [], [0]
    errors = []
    for name, program in found.items():
        for dt in program["steps"]:
            errors.append([share(program, row, dt) for row in rows])
            heads.append(step_text(dt))
        edges.append(len(heads))
    shares = np.array(errors).T
    colours = np.clip(np.log10(np.maximum(shares, 1e-9)), -DECADES, DECADES)
    figure, axis = plt.subplots(figsize=(5 + 0.36 * len(heads), 0.23 * len(rows) + 1.6), layout="constrained")
    axis.set_facecolor("0.85")
    image = axis.imshow(np.ma.masked_invalid(np.where(np.isnan(shares), np.nan, colours)), cmap="RdYlGn_r",
                        norm=TwoSlopeNorm(0, -DECADES, DECADES), aspect="auto")
    axis.set_yticks(range(len(rows)), [row.title for row in rows], fontsize=7)
    axis.set_xticks(range(len(heads)), heads, fontsize=6, rotation=90)
    for name, left, right in zip(found, edges, edges[1:]):
        axis.axvline(right - 0.5, color="white", lw=2)
        axis.text((left + right - 1) / 2, -0.8, name.replace(", ", ",\n"), ha="center", va="bottom", fontsize=6)
    axis.set_xlabel("time step [s]; grey: not possible or not run", fontsize=7)
    bar = figure.colorbar(image, ax=axis, ticks=range(-DECADES, DECADES + 1), shrink=0.5)
    bar.set_ticklabels([f"{10.0**k:g}" for k in range(-DECADES, DECADES + 1)], fontsize=7)
    bar.set_label("error over bound", fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def filled(text, name, block):
    """A page's text with what stands between the marks of a block replaced."""
    before, rest = text.split(f"<!-- {name} -->\n")
    return f"{before}<!-- {name} -->\n{block}\n<!-- /{name} -->{rest.split(f'<!-- /{name} -->')[1]}"


def page(text, found):
    for name, block in (("results", result_table(found)), ("programs", program_table(found)),
                        ("lacks", not_possible(found)), ("safe", safe_table(found))):
        text = filled(text, name, block)
    return text


def main():
    docs = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[3] / "docs")
    found = columns(docs / "mechanics")
    path = docs / "mechanics.md"
    path.write_text(page(path.read_text(encoding="utf-8"), found), encoding="utf-8")
    draw(found, docs / "mechanics/mechanics.png")


if __name__ == "__main__":
    main()
