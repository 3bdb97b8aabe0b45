# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of claims and runs: Markdown for people, CSV and JSON for programs. Needs no YADE."""
import json

from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text

from .claims import RUNS, damage, drift_text, leaning, time_text

VERDICTS = {True: "holds", False: "does not hold", None: "not known"}
RUN_COLUMNS = ("run", "outcome", "leans from", "tilt (1/10)", "collapse", "peak drift 1 N-S", "1 E-W", "2 N-S", "2 E-W",
               "residual 1", "residual 2", "springs broken", "joints broken", "column-beam", "brace-beam", "storey 1",
               "storey 2", "north", "south", "east", "west", "columns fallen", "loose", "wall time [s]")


def run_row(name, run):
    """Values of RUN_COLUMNS for a summary."""
    broken, columns = run.broken, run.columns
    peaks = [run.peak_drift[storey][direction] or 0.0 for storey in ("storey1", "storey2")
             for direction in ("ns", "ew")]
    leans = [leaning(run, storey) for storey in ("storey1", "storey2")]
    times = [run.leans_from_s, run.tilt_time_s, run.collapse_time_s]
    return [name, "collapsed" if run.collapsed else "stands", *map(time_text, times), *map(drift_text, peaks + leans),
            damage(run), broken.total, broken.column_beam, broken.brace_beam,
            *(broken.by_storey.get(storey, 0) for storey in "12"),
            *(broken.by_side[side] for side in ("north", "south", "east", "west")), columns.fallen, columns.loose,
            round(run.wall_s)]


def run_rows(summaries):
    return [run_row(name, summaries[name]) for name in RUNS if name in summaries]


def markdown(results, summaries):
    """Both tables as Markdown: claims, then runs."""
    holding = sum(r.holds is True for r in results)
    wall = sum(run.wall_s for run in summaries.values())
    lines = [
        f"{holding} of {len(results)} claims hold. {len(summaries)} runs, {wall / 60:.1f} min of computing in total.",
        "",
    ]
    lines += markdown_table(("name", "verdict", "claim", "numbers"),
                            [(r.name, VERDICTS[r.holds], r.claim, r.numbers) for r in results])
    return "\n".join([*lines, "", *markdown_table(RUN_COLUMNS, run_rows(summaries))]) + "\n"


def markdown_table(header, rows):
    """Lines of a Markdown table."""
    return ["| " + " | ".join(map(str, row)) + " |" for row in (header, ["---"] * len(header), *rows)]


def write(folder, results, summaries):
    """Write claims.md, claims.csv, runs.csv, claims.json to the folder; returns their paths. Raises OSError."""
    contents = {
        "claims.md": markdown(results, summaries),
        "claims.csv": csv_text(("claim", "holds", "words", "numbers"),
                               [(r.name, VERDICTS[r.holds], r.claim, r.numbers) for r in results]),
        "runs.csv": csv_text(RUN_COLUMNS, run_rows(summaries)),
        "claims.json": json.dumps([r.__dict__ for r in results], indent=1) + "\n",
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in contents.items():
        write_text(folder / name, text)
    return [folder / name for name in contents]
