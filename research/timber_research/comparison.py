# SPDX-License-Identifier: GPL-2.0-or-later
"""The claims under several ground motions: in how many of them each holds, and what becomes of each house. Needs no
YADE.
"""
from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text

from . import report
from .claims import RUNS, drift_text, judge, parse_run, sway, time_text
from .report import markdown_table

SIGNS = {True: "x", False: "-", None: ""}
OUTCOME = (
    "Largest sway N-S, E-W of a house that stands; direction and time after the onset of strong shaking of a collapse."
)
HOUSES = tuple(parse_run(run)[0] for run in RUNS if run.endswith("_quake"))


def write(cases, summaries, folder):
    """Write robustness.md, motions.csv, sways.csv, and the tables of each case to a folder of its own; returns the text
    of robustness.md. Raises OSError.

    cases: {name: description}; summaries: {case: {run name: summary}}; runs may be missing
    """
    results = {case: judge(summaries[case]) for case in cases}
    claims, sways = claims_table(results), houses_table(cases, summaries)
    write_text(folder / "motions.csv", csv_text(*claims))
    write_text(folder / "sways.csv", csv_text(*sways))
    text = (
        "\n".join(
            ["x: the claim holds; -: it does not; empty: not run.", "", *markdown_table(*claims), "", OUTCOME, "",
             *markdown_table(*sways)]
        )
        + "\n"
    )
    write_text(folder / "robustness.md", text)
    for case in cases:
        report.write(folder / case, results[case], summaries[case])
    return text


def claims_table(results):
    """(heads, rows): each claim, the number of motions in which it holds of those judged, and a sign for each motion.
    results: {case: list of Result}.
    """
    rows = []
    for same in zip(*results.values()):
        judged = [result.holds for result in same if result.holds is not None]
        rows.append(
            (f"{same[0].name}: {same[0].claim}", f"{sum(judged)} of {len(judged)}",
             *(SIGNS[result.holds] for result in same))
        )
    return ("claim", "motions", *results), rows


def houses_table(cases, summaries):
    """(heads, rows): outcome of each house in the earthquake without snow."""
    rows = [(case, about, *(outcome(summaries[case].get(f"model{house}_quake")) for house in HOUSES))
            for case, about in cases.items()]
    return ("motion", "description", *HOUSES), rows


def outcome(run):
    """'1/12, 1/10', or 'falls N-S, 6.2 s', of a summary; empty for a missing one."""
    if run is None:
        return ""
    if run.collapsed:
        direction = {"ns": " N-S", "ew": " E-W"}.get(run.tilt_direction, "")
        return f"falls{direction}, {time_text(run.collapse_time_s - run.record.onset_s)}"
    return f"{drift_text(sway(run, 'ns'))}, {drift_text(sway(run, 'ew'))}"
