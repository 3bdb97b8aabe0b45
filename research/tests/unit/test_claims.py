# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Checks of the claims on constructed summaries: each holds at the paper's result and fails when one number is wrong.
Robustness.
"""
import argparse
import json
import runpy
from pathlib import Path

import pytest
from summaries import sample_summary
from timber_research import claims, comparison, report
from timber_houses.run.options import scripted
from timber_houses.study.driver import Task


def summary(model, snow=False, sway_ns=0.001, sway_ew=0.001, lean=0.0, springs=0, collapse=None, leans=None, fallen=0,
            west=(0, 0), direction=None):
    """A Summary with the entries that claims use."""
    drift = {"ns": sway_ns, "ew": sway_ew}
    place = {"1": {"west": {"total": sum(west), "column_beam": west[0], "brace_beam": west[1]}}}
    sides = dict.fromkeys(("north", "south", "east", "west"), 0)
    return sample_summary(model=model, snow=snow, record={"onset_s": 18.5}, peak_drift={
        "storey1": drift, "storey2": drift
    }, residual_drift={"storey1": {"ns": 0.0, "ew": lean}, "storey2": {"ns": lean, "ew": 0.0}}, broken={
        "springs": springs, "total": springs // 4, "by_place": place, "by_side": sides
    }, columns={"total": 90, "fallen": fallen}, collapsed=collapse is not None, collapse_time_s=collapse,
                          leans_from_s=leans, tilt_time_s=leans and leans + 1, tilt_direction=direction, wall_s=1.0)


def paper_results():
    return {
        "modelA_quake": summary("A", collapse=24.0, leans=18.0, direction="ns"),
        "modelB_quake": summary("B", sway_ns=0.05),
        "modelC_quake": summary("C", sway_ns=0.02),
        "modelA_snow": summary("A", True, collapse=12.0, leans=0.2, direction="ns"),
        "modelB_snow": summary("B", True),
        "modelC_snow": summary("C", True),
        "modelB1_quake": summary("B1", sway_ns=0.03, sway_ew=0.08, springs=20, west=(2, 0)),
        "modelB2_quake": summary("B2", sway_ns=0.07, sway_ew=0.05, springs=18),
        "modelC1_quake": summary("C1", sway_ew=0.03, springs=4),
        "modelC2_quake": summary("C2", sway_ew=0.02),
        "modelB1_snow": summary("B1", True, sway_ew=0.1, lean=0.01, springs=40, fallen=2),
        "modelB2_snow": summary("B2", True, sway_ns=0.1, springs=30),
        "modelC1_snow": summary("C1", True, sway_ew=0.05, springs=9),
        "modelC2_snow": summary("C2", True, sway_ew=0.02, lean=0.004, springs=2),
    }


def holds(runs):
    return {result.name: result.holds for result in claims.judge(runs)}


def test_all_hold_in_the_paper():
    found = holds(paper_results())
    assert len(found) == 14 and all(value is True for value in found.values()), found
    assert set(claims.RUNS) == set(paper_results())


def drift(ns, ew):
    """Peak or residual drifts: these values in storey 1, zero in storey 2."""
    return {"storey1": {"ns": ns, "ew": ew}, "storey2": {"ns": 0.0, "ew": 0.0}}


def broken(springs=0, west=(2, 0)):
    return {"broken": summary("", springs=springs, west=west).broken}


COLLAPSED = {"collapsed": True, "collapse_time_s": 20.0}
STANDING = {"collapsed": False, "collapse_time_s": None}
WRONG = [  # claim, run, change of its summary that violates one condition of the claim
    ("E1", "modelA_quake", STANDING),
    ("E1", "modelA_quake", {"leans_from_s": 17.4}),  # onset of strong shaking: 18.5 s
    ("E1", "modelA_quake", {"leans_from_s": 21.51}),  # a sample too late
    ("E1", "modelA_quake", {"collapse_time_s": 21.4}),
    ("E1", "modelA_quake", {"collapse_time_s": 27.6}),
    ("E2", "modelB_quake", COLLAPSED),
    ("E3", "modelC_quake", COLLAPSED),
    ("S1", "modelA_snow", STANDING),
    ("S1", "modelA_snow", {"leans_from_s": 1.1}),
    ("S1", "modelA_snow", {"collapse_time_s": 5.9}),
    ("S1", "modelA_snow", {"collapse_time_s": 18.1}),
    *((claim, run, change)
      for claim, run in (("S2", "modelB_snow"), ("S3", "modelC_snow"))
      for change in ({"peak_drift": drift(0.009, 0.0)}, {"peak_drift": drift(0.0, 0.009)}, broken(springs=1),
                     COLLAPSED)),
    ("D1", "modelB1_quake", COLLAPSED),
    ("D1", "modelB1_quake", {"peak_drift": drift(0.09, 0.08)}),
    ("D1", "modelB1_quake", {"peak_drift": drift(0.02, 0.033)}),
    ("D1", "modelB1_quake", broken(west=(0, 0))),
    ("D1", "modelB1_quake", broken(west=(2, 1))),
    ("D2", "modelB2_quake", {"peak_drift": drift(0.07, 0.075)}),
    ("D2", "modelB2_quake", {"peak_drift": drift(0.029, 0.02)}),
    ("D2", "modelB2_quake", {"peak_drift": drift(0.09, 0.085)}),
    ("D3", "modelC1_quake", {"peak_drift": drift(0.05, 0.03)}),
    ("D3", "modelC1_quake", {"peak_drift": drift(0.001, 0.008)}),
    ("D3", "modelC1_quake", {"peak_drift": drift(0.001, 0.09)}),
    ("D4", "modelC2_quake", COLLAPSED),
    ("D4", "modelC2_quake", {"peak_drift": drift(0.034, 0.0)}),
    ("D4", "modelC2_quake", {"peak_drift": drift(0.0, 0.034)}),
    ("Q1", "modelB1_snow", COLLAPSED),
    ("Q1", "modelB1_snow", {"columns": {"fallen": 0, "loose": 0}}),
    ("Q1", "modelB1_snow", {"residual_drift": drift(0.0, 0.0)}),
    ("Q1", "modelB1_snow", broken(springs=20)),
    ("Q2", "modelB2_snow", broken(springs=18)),
    ("Q2", "modelB2_quake", COLLAPSED),
    ("Q3", "modelC1_snow", broken(springs=4)),
    ("Q3", "modelC1_snow", broken(springs=41)),
    ("Q4", "modelC2_snow", {"residual_drift": drift(0.1, 0.0)}),  # the first storey alone
    ("Q4", "modelC2_snow", broken(springs=30)),
]
STILL_RIGHT = [  # changes up to the limits of the criteria
    ("E1", "modelA_quake", {"leans_from_s": 17.5, "collapse_time_s": 21.5}),
    ("E1", "modelA_quake", {"leans_from_s": 21.5, "collapse_time_s": 27.5}),
    ("E1", "modelA_quake", {"leans_from_s": 21.5 + 3e-11}),  # rounding of the clock
    ("E1", "modelA_quake", {"tilt_direction": "ew"}),
    ("S1", "modelA_snow", {"leans_from_s": 1.0, "collapse_time_s": 6.0}),
    ("S1", "modelA_snow", {"collapse_time_s": 18.0}),
    ("S2", "modelB_snow", {"peak_drift": drift(0.0083, 0.0083)}),
    ("D1", "modelB1_quake", {"peak_drift": drift(0.02, 0.034)}),
    ("D3", "modelC1_quake", {"peak_drift": drift(0.001, 0.0084)}),
    ("D4", "modelC2_quake", {"peak_drift": drift(0.0333, 0.0333)}),
    ("Q1", "modelB1_snow", {"columns": {"fallen": 0, "loose": 1}}),
    ("Q2", "modelB2_snow", {**COLLAPSED, **broken(springs=1)}),  # a collapse is more damage than none
    ("Q4", "modelC2_snow", {"residual_drift": {**drift(0.0, 0.0), "storey2": {"ns": 0.0, "ew": 0.001}}}),
]


def changed(run, change):
    runs = paper_results()
    return {**runs, run: runs[run].changed(**change)}


@pytest.mark.parametrize("name, run, change", WRONG)
def test_one_wrong_number(name, run, change):
    assert holds(changed(run, change))[name] is False


@pytest.mark.parametrize("name, run, change", STILL_RIGHT)
def test_limits_of_the_criteria(name, run, change):
    assert holds(changed(run, change))[name] is True


def test_row_of_a_run():
    """Each number in its column."""
    sides = {"north": 7, "south": 8, "east": 10, "west": 11}
    run = summary("A", collapse=24.0, leans=18.0, springs=9, direction="ns").changed(
        peak_drift={"storey1": {"ns": 1 / 11, "ew": 1 / 12}, "storey2": {"ns": 1 / 13, "ew": None}},
        residual_drift={"storey1": {"ns": 0.03, "ew": 0.04}, "storey2": {"ns": 0.0, "ew": 0.01}},
        broken={"total": 3, "column_beam": 2, "brace_beam": 1, "by_storey": {"1": 5, "2": 6}, "by_side": sides},
        columns={"fallen": 12, "loose": 13}, wall_s=14.4)
    row = dict(zip(report.RUN_COLUMNS, report.run_row("modelA_quake", run), strict=True))
    assert list(row.values()) == ["modelA_quake", "collapsed", "18.0 s", "19.0 s", "24.0 s", "1/11", "1/12", "1/13",
                                  "<1/1000", "1/20", "1/100", 9, 3, 2, 1, 5, 6, 7, 8, 10, 11, 12, 13, 14]
    assert (row["peak drift 1 N-S"], row["2 E-W"], row["residual 1"], row["storey 2"], row["south"], row["west"],
            row["loose"]) == ("1/11", "<1/1000", "1/20", 6, 8, 11, 13)


def test_missing_run():
    runs = paper_results()
    del runs["modelB1_quake"]
    result = next(r for r in claims.judge(runs) if r.name == "D2")
    assert result.holds is None and "modelB1_quake" in result.numbers


def test_a_house_without_motion():
    """No drift, no tilt, no collapse."""
    runs = {**paper_results(), "modelA_quake": summary("A", sway_ns=None, sway_ew=None)}
    assert holds(runs)["E1"] is False


def test_tables(tmp_path):
    runs = paper_results()
    results = claims.judge(runs)
    paths = report.write(tmp_path, results, runs)
    assert {path.name for path in paths} == {"claims.md", "claims.csv", "runs.csv", "claims.json"}
    text = (tmp_path / "claims.md").read_text()
    assert "14 of 14 claims hold" in text and all(f"| {name} |" in text for name in [*claims.CLAIMS, *claims.RUNS])
    assert len(json.loads((tmp_path / "claims.json").read_text())) == 14


def test_number_of_motions_in_which_a_claim_holds():
    paper, fewer = paper_results(), {name: run for name, run in paper_results().items() if name != "modelB_quake"}
    wrong = paper | {"modelA_quake": summary("A", sway_ns=0.05)}
    _, rows = comparison.claims_table(
        {"one": claims.judge(paper), "two": claims.judge(wrong), "three": claims.judge(fewer)})
    counts = {name.split(":")[0]: cells for name, *cells in rows}
    assert counts["E1"] == ["2 of 3", "x", "-", "x"] and counts["E2"] == ["2 of 2", "x", "x", ""]
    assert all(counts[name][0] == "3 of 3" for name in claims.CLAIMS if name not in ("E1", "E2"))


def test_outcome_of_a_house():
    assert comparison.outcome(paper_results()["modelA_quake"]) == "falls N-S, 5.5 s"
    assert comparison.outcome(paper_results()["modelB2_quake"]) == "1/14, 1/20" and comparison.outcome(None) == ""


def test_robustness_study(tmp_path):
    """Runs without an earthquake are done once; each motion has tables of its own."""
    study = runpy.run_path(str(Path(__file__).resolve().parents[2] / "robustness_study.py"))
    cases = study["all_cases"]([0], ["records/KOBE"])
    tasks = {case: study["tasks_of"](case, options, tmp_path) for case, (_, options) in cases.items()}
    assert {case: len(some) for case, some in tasks.items()} == {"shipped": 14, "seed-0": 11, "KOBE": 11}
    assert tasks["KOBE"]["modelB1_snow"] == Task(tmp_path / "KOBE" / "modelB1_snow",
                                                 scripted("modelB1_snow", "B1", True, True, record="records/KOBE"))
    assert "modelA_snow" in tasks["shipped"] and "modelA_snow" not in tasks["KOBE"]
    text = comparison.write({case: about
                             for case, (about, _) in cases.items()}, dict.fromkeys(cases, paper_results()), tmp_path)
    assert text == (tmp_path / "robustness.md").read_text()
    assert "| E1" in text
    assert "| KOBE | recorded motion | falls N-S" in text
    assert "E1: " in (tmp_path / "motions.csv").read_text()
    assert "KOBE,recorded motion" in (tmp_path / "sways.csv").read_text()
    assert (tmp_path / "seed-0" / "claims.md").is_file()


def test_only_runs_with_an_earthquake_get_motion_options():
    script = runpy.run_path(str(Path(__file__).resolve().parents[2] / "paper_table.py"))
    values = script["run_options"](argparse.Namespace(record=None, seed="3", scale="0.5", start=None, end=None,
                                                      dt="1e-4", duration=None))
    assert values == {"dt": 1e-4, "seed": 3, "scale": 0.5}
    loads = {"modelA_quake": (True, False), "modelA_snow": (False, True)}
    found = {run: script["run_of"](run, "A", *of, values) for run, of in loads.items()}
    assert found == {run: scripted(run, "A", *of, dt=1e-4, **({"seed": 3, "scale": 0.5} if of[0] else {}))
                     for run, of in loads.items()}
