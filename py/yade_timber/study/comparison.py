# SPDX-License-Identifier: GPL-2.0-or-later
"""The claims in several cases (variants, ground motions, time steps): which hold in each, and by the medians of cases. Needs no YADE."""
import statistics

from ..base.atomic_write import write_text
from . import report
from .claims import RUNS, judge
from .driver import run_missing

MEDIAN = "median"
"""Name of the case that consists of the medians of other cases."""


def run_cases(cases, scripts, options, name, median_of=()):
    """Do the runs of all cases, print and write their comparison and the tables of each case; returns the exit status: 1 if runs failed.

    cases      {name: (description, list of Task)}
    scripts    folder of the run scripts
    options    parsed options: out [Path], jobs
    name       file of the comparison, in the folder options.out
    median_of  names of cases whose median is judged as one more case
    """
    done = run_missing([task for _, tasks in cases.values() for task in tasks], scripts, options.jobs)
    summaries = {case: {task.folder.name: done[task] for task in tasks if done[task] is not None} for case, (_, tasks) in cases.items()}
    descriptions = {case: description for case, (description, _) in cases.items()}
    if median_of:
        summaries[MEDIAN] = median_runs([summaries[case] for case in median_of])
        descriptions[MEDIAN] = f"medians of {', '.join(median_of)}; majority of their outcomes"
    results = {case: judge(found) for case, found in summaries.items()}
    text = comparison(descriptions, results)
    print(text)
    write_text(options.out / name, text)
    for case, found in summaries.items():
        report.write(options.out / case, results[case], found)
    return int(None in done.values())


def comparison(descriptions, results):
    """Markdown table of cases against claims, and the number of cases in which each claim holds. results: {case: list of Result}."""
    signs = {True: "x", False: "-", None: ""}
    names = [r.name for r in next(iter(results.values()))]
    rows = [(case, descriptions[case], sum(r.holds is True for r in found), *(signs[r.holds] for r in found)) for case, found in results.items()]
    known = [[r.holds for r in same if r.holds is not None] for same in zip(*(found for case, found in results.items() if case != MEDIAN))]
    rows.append(("all", "cases in which the claim holds, of those run", "", *(f"{sum(holds)}/{len(holds)}" for holds in known)))
    table = report.markdown_table(("case", "description", "claims that hold", *names), rows)
    return "\n".join(["x: the claim holds; -: it does not; empty: not run.", "", *table]) + "\n"


def median_runs(cases):
    """{run: median of its summaries}, for the runs that all cases contain. cases: list of {run: summary}."""
    return {run: median([case[run] for case in cases]) for run in RUNS if all(run in case for case in cases)}


def median(values):
    """Median of the same value in several summaries: of tables entry by entry, of counts the lower median, of other values the most frequent one."""
    if all(isinstance(value, dict) for value in values):
        return {key: median([value[key] for value in values]) for key in values[0] if all(key in value for value in values)}
    numbers = [value for value in values if isinstance(value, (int, float)) and not isinstance(value, bool)]
    if 2 * len(numbers) <= len(values):
        return max(values, key=values.count)
    return statistics.median_low(numbers) if all(isinstance(number, int) for number in numbers) else statistics.median(numbers)
