# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Evaluation of finished runs by the studies: intervals, fitted curves, ranking, pictures. The batch tests cover the runs."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy import stats

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "py"), str(ROOT / "scripts" / "study")]

import brace  # noqa: E402
import fragility  # noqa: E402


def runs(house, scale, collapses, failed=0):
    """Runs of one point: finished ones (collapses: list of bool) and failed ones."""
    same = {"house": house, "snow": "0", "scale": str(scale)}
    done = [{**same, "status": "done", "collapsed": fell, "collapse_time_s": 9.0 if fell else None} for fell in collapses]
    return done + [{**same, "status": "failed", "collapsed": None, "collapse_time_s": None}] * failed


def test_point_counts_and_interval():
    """3 of 10: Clopper and Pearson (1934) give 0.0667 to 0.6525 at 95 %. Failed runs do not count."""
    (point,) = fragility.points(runs("B", 0.8, [True] * 3 + [False] * 7, failed=2))
    assert (point["runs"], point["collapsed"], point["failed"], point["median_collapse_time_s"]) == (10, 3, 2, 9.0)
    assert (point["low"], point["high"]) == pytest.approx((0.0667, 0.6525), abs=1e-4)
    (none,) = fragility.points(runs("B", 0.8, [], failed=1))
    assert np.isnan(none["share"]) and (none["low"], none["high"]) == (0.0, 1.0)


def test_fit_recovers_a_known_curve():
    """Shares of a lognormal curve with median 0.9 and deviation 0.3, 10 000 runs per point: rounding of the counts changes them by 0.1 %."""
    scales = [0.4, 0.6, 0.8, 1.0, 1.3, 1.6]
    curve = [{"scale": s, "runs": 10000, "collapsed": round(10000 * stats.norm.cdf(np.log(s / 0.9) / 0.3))} for s in scales]
    assert fragility.fit(curve) == pytest.approx((0.9, 0.3), rel=1e-3)


@pytest.mark.parametrize(
    "collapsed, text",
    [((0, 0, 0), "none collapses"), ((5, 5, 5), "all collapse"), ((0, 0, 1), "fewer than half collapse up to 2"), ((4, 5, 5), "more than half collapse from 0.5 on"), ((0, 2, 5), "half collapse at 1.0")],
)
def test_no_extrapolation_beyond_the_strengths_run(collapsed, text):
    assert fragility.median_text([{"scale": s, "runs": 5, "collapsed": c} for s, c in zip((0.5, 1.0, 2.0), collapsed)]).startswith(text)


def test_no_fit_without_a_transition():
    assert fragility.fit([{"scale": s, "runs": 5, "collapsed": 0} for s in (0.5, 1.0)]) is None
    assert fragility.fit([{"scale": s, "runs": 5, "collapsed": 5} for s in (0.5, 1.0)]) is None
    step = [{"scale": s, "runs": 5, "collapsed": 5 * (s > 0.7)} for s in (0.5, 1.0)]
    assert 0.5 < fragility.fit(step)[0] < 1.0 and fragility.fit(step)[1] == pytest.approx(fragility.SPREAD[0], rel=0.2)


def test_fragility_picture(tmp_path):
    found = [run for house in "AB" for scale, fell in ((0.5, 1), (1.0, 4)) for run in runs(house, scale, [True] * fell + [False] * (5 - fell))]
    fragility.plot(fragility.points(found), [0.0], tmp_path / "fragility.png")
    assert (tmp_path / "fragility.png").stat().st_size > 10000


BRACES = ["main.brace1.EW.y0.3-4", "main.brace1.NS.x8.4-5", "main.brace2.NS.x4.1-3"]


def braced(brace, drift, time=None, status="done", changes=None):
    """A finished run with a brace (None: without); time: of collapse [s]."""
    return {"peak_drift": drift, "braces": brace, "set": changes, "status": status, "collapsed": time is not None, "collapse_time_s": time, "broken": 0}


def test_ranking():
    """Smallest mean drift first; collapses last, in the order of their number, then of their time; variants with a failed run are left out."""
    drifts = {None: (0.10, 0.14), "c": (0.2, 2.0), "a": (0.05, 0.07), "d": (0.2, 2.0), "b": (0.12, 0.18), "f": (2.0, 2.0), "e": (0.05, None)}
    times = {("c", 1): 9.0, ("d", 1): 8.0, ("f", 0): 9.5, ("f", 1): 9.5}
    found = [braced(name, pair[k], times.get((name, k)), "failed" if pair[k] is None else "done") for k in (0, 1) for name, pair in drifts.items()]
    found.insert(1, braced(None, 0.2, changes="plumb.drift=1e-4"))
    table, without = brace.ranking(found)
    assert [row["brace"] for row in table] == ["a", "b", "c", "d", "f"] and without == pytest.approx([0.12, 0.2])
    assert [row["change"] for row in table[:2]] == pytest.approx([-0.5, 0.25])
    assert [row["collapses"] for row in table] == [0, 0, 1, 1, 2]


def test_brace_picture(tmp_path):
    found = [braced(None, 0.10), *(braced(name, 0.08 + 0.02 * k) for k, name in enumerate(BRACES))]
    table, without = brace.ranking(found)
    options = SimpleNamespace(house="B", scale=0.6, snow=1.0, seeds=[1])
    brace.plot(table, without, options, tmp_path / "brace.png")
    assert (tmp_path / "brace.png").stat().st_size > 10000


def test_bays_as_text():
    model = brace.build_house(brace.load_house("B"), check=False)
    assert [brace.bay_text(model, name) for name in BRACES] == [
        "storey 1, south wall, 3.2 m east", "storey 1, east wall, 4.1 m north", "storey 2, inner N-S wall, 1.8 m north"]  # fmt: skip
