# SPDX-License-Identifier: GPL-2.0-or-later
"""The claims under several ground motions: in how many of them each holds, and what becomes of each house. Needs no YADE."""
from yade_timber.base.atomic_write import write_text

from . import report
from .claims import RUNS, drift_text, judge, parse_run, sway, time_text
from .report import markdown_table

SIGNS = {True: "x", False: "-", None: ""}
HOUSES = tuple(parse_run(run)[0] for run in RUNS if run.endswith("_quake"))


def write(cases, summaries, folder):
    """Write robustness.md, and the tables of each case to a folder of its own; returns the text of robustness.md. Raises OSError.

    cases: {name: description}; summaries: {case: {run name: summary}}; runs may be missing
    """
    results = {case: judge(summaries[case]) for case in cases}
    text = "\n".join([*claims_table(results), "", *houses_table(cases, summaries)]) + "\n"
    write_text(folder / "robustness.md", text)
    for case in cases:
        report.write(folder / case, results[case], summaries[case])
    return text


def claims_table(results):
    """Lines of a table: each claim, the number of motions in which it holds of those known, and a sign for each motion. results: {case: list of Result}."""
    rows = []
    for same in zip(*results.values()):
        known = [result.holds for result in same if result.holds is not None]
        rows.append((f"{same[0].name}: {same[0].claim}", f"{sum(known)} of {len(known)}", *(SIGNS[result.holds] for result in same)))
    return ["x: the claim holds; -: it does not; empty: not run.", "", *markdown_table(("claim", "motions", *results), rows)]


def houses_table(cases, summaries):
    """Lines of a table: outcome of each house in the earthquake without snow."""
    rows = [(case, about, *(outcome(summaries[case].get(f"model{house}_quake")) for house in HOUSES)) for case, about in cases.items()]
    return ["Largest sway N-S, E-W of a house that stands; direction and time after the onset of strong shaking of a collapse.", "",
            *markdown_table(("motion", "", *HOUSES), rows)]  # fmt: skip


def outcome(run):
    """'1/12, 1/10', or 'falls N-S, 6.2 s', of a summary; empty for a missing one."""
    if run is None:
        return ""
    if run["collapsed"]:
        direction = {"ns": " N-S", "ew": " E-W"}.get(run["tilt_direction"], "")
        return f"falls{direction}, {time_text(run['collapse_time_s'] - run['record']['onset_s'])}"
    return f"{drift_text(sway(run, 'ns'))}, {drift_text(sway(run, 'ew'))}"
