# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests between two ensembles: p values by hand and of scipy, differences that are shown."""
import runpy
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats
from summaries import sample_summary
from timber_research import SCRIPTS, two_ensembles


def summary(verdict="unsafe", drift=0.1, falls=None):
    """What the tests read of a run with a largest drift [-]; falls: collapse time [s]"""
    drifts = {"storey1": {"ns": drift, "ew": drift / 2}, "storey2": {"ns": None, "ew": None}}
    return sample_summary(verdict=verdict, collapsed=falls is not None, collapse_time_s=falls, peak_drift=drifts,
                          residual_drift=drifts, broken={"springs": 3})


def ensembles(shift=1.0, spread=0.1, falls=(4, 4)):
    """Two lists of 16 summaries: lognormal drifts, those of the second times `shift`; the first runs collapse."""
    random = np.random.default_rng(5)
    made = []
    for factor, fallen in zip((1.0, shift), falls):
        drifts = 0.05 * factor * np.exp(spread * random.standard_normal(16))
        made.append([
            summary("collapsed", 1.0, 9.0 + 0.1 * k) if k < fallen else summary(drift=float(d))
            for k, d in enumerate(drifts)
        ])
    return made


def by_test(found, quantity):
    return {entry.test: entry for entry in found if entry.quantity == quantity}


def test_p_values_are_those_of_scipy():
    first, second = ensembles(1.2)
    found = by_test(two_ensembles.compare("A", first, second), "largest drift [-]")
    a, b = ([run.peak_drift["storey1"]["ns"] for run in runs if not run.collapsed] for runs in (first, second))
    assert found["Mann-Whitney"].p == stats.mannwhitneyu(a, b).pvalue and len(a) == 12
    assert found["Brown-Forsythe"].p == stats.levene(np.log(a), np.log(b)).pvalue
    assert found["Mann-Whitney"].ratio[0] == pytest.approx(np.median(b) / np.median(a))


def test_mann_whitney_by_hand():
    """4 values below 4 others: 2 of the 70 arrangements are as extreme."""
    assert two_ensembles.mann_whitney([1, 2, 3, 4], [5, 6, 7, 8]) == pytest.approx(2 / 70)
    assert two_ensembles.mann_whitney([1, 1], [1, 1]) is None and two_ensembles.brown_forsythe([1, 1], [2, 2]) is None


def test_fisher_by_hand():
    """0 of 4 and 4 of 4: 2 of the 70 tables with these margins are as extreme."""
    assert two_ensembles.fisher((0, 4), (4, 4)) == pytest.approx(2 / 70)


def test_equal_distributions_agree_and_others_differ():
    """A median 1.5 times as large at a scatter of 10 %, and 15 collapses instead of 1, are found in 16 runs; the same
    distribution gives none.
    """
    same = two_ensembles.rows(two_ensembles.compare("A", *ensembles()))
    assert {row[-1] for row in same} == {"no difference shown", "no test"}
    found = dict(((row[1], row[6]), row[-1]) for row in two_ensembles.rows(two_ensembles.compare("A", *ensembles(1.5))))
    assert found["largest drift [-]", "Mann-Whitney"] == "differ"
    assert found["collapsed", "Fisher"] == "no difference shown"
    assert found["largest drift [-]", "Brown-Forsythe"] == "no difference shown"
    fallen = by_test(two_ensembles.compare("A", *ensembles(falls=(1, 15))), "collapsed")["Fisher"]
    assert fallen.p < 1e-4 and (fallen.first, fallen.second) == ("1 of 16", "15 of 16")


def test_the_interval_of_the_ratio_contains_it():
    first, second = ensembles(1.5)
    middle, low, high = by_test(two_ensembles.compare("A", first, second), "largest drift [-]")["Mann-Whitney"].ratio
    assert low < middle < high and 1.3 < low < 1.5 < high < 1.7


def test_few_or_equal_values_have_no_test():
    found = two_ensembles.compare("A", [summary()] * 3, [summary()] * 3)
    assert {entry.p for entry in found} == {None} and set(two_ensembles.corrected(found)) == {None}
    assert two_ensembles.compare("A", [], []) == []


def test_the_study_plans_runs_at_both_steps(tmp_path):
    """Each run has its step, disturbance and part of the motion."""
    study = runpy.run_path(str(SCRIPTS.parent / "research" / "ensemble_steps.py"))
    options = SimpleNamespace(runs=2, start=15.0, end=29.0, dt=1e-4, cases="modelC2_snow", out=tmp_path)
    planned = study["plan"](options)
    small, default = (planned["modelC2_snow", name][1].request() for name in study["NAMES"])
    assert (small.dt, small.disturb, small.end, small.until_collapse) == (1e-4, 2, 29.0, True)
    assert small == replace(default, dt=1e-4, out=tmp_path / "modelC2_snow" / "small" / "runs" / "002")
    assert study["collect"](planned) == ([], {name: [] for name in study["NAMES"]}, 0)
