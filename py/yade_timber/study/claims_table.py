# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of claims and of the runs behind them, for people (Markdown) and programs (CSV, JSON). Needs no YADE."""
import csv
import io
import json
import statistics

from . import campaign
from .claims import RUNS, damage, drift_text, judge, leaning, time_text
from ..base.atomic_write import write_text

MIDDLE = "middle"
"""Name of the case that is the middle of others."""
WORDS = {True: "holds", False: "does not hold", None: "not known"}
RUN_COLUMNS = ("run", "fate", "leans from", "tilt (1/10)", "collapse", "peak drift 1 N-S", "1 E-W", "2 N-S", "2 E-W", "residual 1", "residual 2",
               "springs broken", "joints broken", "column-beam", "brace-beam", "storey 1", "storey 2", "north", "south", "east", "west",
               "columns fallen", "loose", "wall time [s]")


def run_row(name, run):
    """Values of RUN_COLUMNS for a summary."""
    broken, columns = run["broken"], run["columns"]
    peaks = [run["peak_drift"][storey][way] or 0.0 for storey in ("storey1", "storey2") for way in ("ns", "ew")]
    leans = [leaning(run, storey) for storey in ("storey1", "storey2")]
    times = [run["leans_from_s"], run["tilt_time_s"], run["collapse_time_s"]]
    return [
        name,
        "collapsed" if run["collapsed"] else "stands",
        *map(time_text, times),
        *map(drift_text, peaks + leans),
        damage(run),
        broken["total"],
        broken["column_beam"],
        broken["brace_beam"],
        *(broken["by_storey"].get(storey, 0) for storey in "12"),
        *(broken["by_side"][side] for side in ("north", "south", "east", "west")),
        columns["fallen"],
        columns["loose"],
        round(run["wall_s"]),
    ]


def run_rows(summaries):
    return [run_row(name, summaries[name]) for name in RUNS if name in summaries]


def markdown(results, summaries):
    """Both tables as Markdown: claims, then runs."""
    counted = sum(r.holds is True for r in results)
    wall = sum(run["wall_s"] for run in summaries.values())
    lines = [f"{counted} of {len(results)} claims hold. {len(summaries)} runs, {wall / 60:.1f} min of computing in all.", ""]
    lines += table(("claim", "", "words", "numbers"), [(r.name, WORDS[r.holds], r.claim, r.numbers) for r in results])
    return "\n".join([*lines, "", *table(RUN_COLUMNS, run_rows(summaries))]) + "\n"


def compare(words, results):
    """Cases against claims as Markdown, and in how many of them each claim holds. words: {case: what it is}; results: {case: list of Result}."""
    signs = {True: "x", False: "-", None: ""}
    names = [r.name for r in next(iter(results.values()))]
    rows = [(case, words[case], sum(r.holds is True for r in found), *(signs[r.holds] for r in found)) for case, found in results.items()]
    known = [[r.holds for r in same if r.holds is not None] for same in zip(*(found for case, found in results.items() if case != MIDDLE))]
    rows.append(("all", "cases in which it holds, of those that ran", "", *(f"{sum(holds)}/{len(holds)}" for holds in known)))
    return "\n".join(["x: the claim holds; -: it does not; empty: not run.", "", *table(("case", "what", "hold", *names), rows)]) + "\n"


def table(header, rows):
    """Lines of a Markdown table."""
    return ["| " + " | ".join(map(str, row)) + " |" for row in (header, ["---"] * len(header), *rows)]


def comma_separated(header, rows):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([header, *rows])
    return text.getvalue()


def write(folder, results, summaries):
    """Write claims.md, claims.csv, runs.csv, claims.json to the folder; returns their paths. Raises OSError."""
    contents = {
        "claims.md": markdown(results, summaries),
        "claims.csv": comma_separated(("claim", "holds", "words", "numbers"), [(r.name, WORDS[r.holds], r.claim, r.numbers) for r in results]),
        "runs.csv": comma_separated(RUN_COLUMNS, run_rows(summaries)),
        "claims.json": json.dumps([r.__dict__ for r in results], indent=1) + "\n",
    }
    for name, text in contents.items():
        write_text(folder / name, text)
    return [folder / name for name in contents]


def middle(values):
    """What is in the middle of the same part of several summaries: of tables entry by entry, of numbers their median (of counts the lower one), of all else what most of them have."""
    if all(isinstance(value, dict) for value in values):
        return {key: middle([value[key] for value in values]) for key in values[0] if all(key in value for value in values)}
    numbers = [value for value in values if isinstance(value, (int, float)) and not isinstance(value, bool)]
    if 2 * len(numbers) <= len(values):
        return max(values, key=values.count)
    return statistics.median_low(numbers) if all(isinstance(number, int) for number in numbers) else statistics.median(numbers)


def middles(found):
    """{run: middle of its summaries}, of the runs that all of these cases have. found: list of {run: summary}."""
    return {run: middle([some[run] for some in found]) for run in RUNS if all(run in some for some in found)}


def study(words, tasks, scripts, jobs, folder, name, together=()):
    """Do the runs of a study, print and write its table and those of each case; returns the exit status: 1 when runs failed.

    words    {case: what it is}
    tasks    {case: list of Task}
    scripts  folder of the run scripts
    together cases whose middle is judged, too, as the case MIDDLE
    """
    done = campaign.run_missing(list(dict.fromkeys(task for some in tasks.values() for task in some)), scripts, jobs)
    found = {case: {task.folder.name: done[task] for task in some if done[task] is not None} for case, some in tasks.items()}
    if together:
        found[MIDDLE] = middles([found[case] for case in together])
    results = {case: judge(summaries) for case, summaries in found.items()}
    text = compare({**words, MIDDLE: f"middle of {', '.join(together)}: medians, and the fate that most have"}, results)
    print(text)
    write_text(folder / name, text)
    for case, summaries in found.items():
        (folder / case).mkdir(parents=True, exist_ok=True)
        write(folder / case, results[case], summaries)
    return int(None in done.values())
