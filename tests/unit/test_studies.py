# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Evaluation of finished runs by the fragility study: intervals, fitted curves, bands, picture. The batch tests cover
the runs.
"""
import numpy as np
import pytest
from scipy import stats
import fragility


def runs(house, scale, collapses, failed=0):
    """Runs of one point: finished ones (collapses: list of bool) and failed ones."""
    same = {"house": house, "snow": 0.0, "scale": scale}
    done = [{**same, "status": "done", "collapsed": fell, "collapse_time_s": 9.0 if fell else None}
            for fell in collapses]
    return done + [{**same, "status": "failed", "collapsed": None, "collapse_time_s": None}] * failed


def test_point_counts_and_interval():
    """3 of 10: Clopper and Pearson (1934) give 0.0667 to 0.6525 at 95 %. Failed runs do not count."""
    (point,) = fragility.points(runs("B", 0.8, [True] * 3 + [False] * 7, failed=2))
    assert (point["runs"], point["collapsed"], point["failed"], point["median_collapse_time_s"]) == (10, 3, 2, 9.0)
    assert (point["low"], point["high"]) == pytest.approx((0.0667, 0.6525), abs=1e-4)
    (none,) = fragility.points(runs("B", 0.8, [], failed=1))
    assert np.isnan(none["share"]) and (none["low"], none["high"]) == (0.0, 1.0)


def test_fit_recovers_a_known_curve():
    """Shares of a lognormal curve with median 0.9 and deviation 0.3, 10 000 runs per point: rounding of the counts
    changes them by 0.1 %.
    """
    scales = [0.4, 0.6, 0.8, 1.0, 1.3, 1.6]
    curve = [{"scale": s, "runs": 10000, "collapsed": round(10000 * stats.norm.cdf(np.log(s / 0.9) / 0.3))}
             for s in scales]
    assert fragility.fit(curve) == pytest.approx((0.9, 0.3), rel=1e-3)


@pytest.mark.parametrize(
    "collapsed, text",
    [((0, 0, 0), "none collapses"), ((20, 20, 20), "all collapse"), ((0, 0, 4), "fewer than half collapse up to 2"),
     ((16, 20, 20), "more than half collapse from 0.5 on"), ((0, 8, 20), "half collapse at 1.0")],
)
def test_no_extrapolation_beyond_the_strengths_run(collapsed, text):
    assert fragility.median_text(
        [{"scale": s, "runs": 20, "collapsed": c} for s, c in zip((0.5, 1.0, 2.0), collapsed)]).startswith(text)


def test_no_fit_without_a_transition():
    assert fragility.fit([{"scale": s, "runs": 5, "collapsed": 0} for s in (0.5, 1.0)]) is None
    assert fragility.fit([{"scale": s, "runs": 5, "collapsed": 5} for s in (0.5, 1.0)]) is None
    step = [{"scale": s, "runs": 5, "collapsed": 5 * (s > 0.7)} for s in (0.5, 1.0)]
    assert 0.5 < fragility.fit(step)[0] < 1.0 and fragility.fit(step)[1] == pytest.approx(fragility.SPREAD[0], rel=0.2)


def test_fragility_picture(tmp_path):
    found = [
        run for house in "AB" for scale, fell in ((0.5, 4), (1.0, 16))
        for run in runs(house, scale, [True] * fell + [False] * (20 - fell))
    ]
    fragility.plot(fragility.points(found), [0.0], tmp_path / "fragility.png")
    assert (tmp_path / "fragility.png").stat().st_size > 10000


def test_no_curve_from_few_motions():
    """19 motions at one point: neither a curve nor a median."""
    curve = [{"scale": s, "runs": n, "collapsed": c} for s, n, c in ((0.5, 20, 1), (1.0, 19, 10))]
    assert not fragility.has_curve(curve) and fragility.median_text(curve) == "19 motions a point; a curve needs 20"


@pytest.mark.rare
def test_the_band_covers_the_true_median():
    """Samples of a curve of median 0.9: the 95 % interval of the median holds it in 8 of 10 or more with a probability
    of 98.8 %.
    """
    random, scales = np.random.default_rng(3), np.array([0.5, 0.7, 0.9, 1.2, 1.5])
    held = 0
    for _ in range(10):
        collapsed = random.binomial(20, fragility.share_at((0.9, 0.3), scales))
        curve = [{"scale": s, "runs": 20, "collapsed": int(c)} for s, c in zip(scales, collapsed)]
        low, high = fragility.band([median for median, _ in fragility.resampled(curve, fragility.fit(curve))])
        assert low < fragility.fit(curve)[0] < high
        held += low <= 0.9 <= high
    assert held >= 8
