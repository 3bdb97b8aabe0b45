# SPDX-License-Identifier: GPL-2.0-or-later
"""The wall rack of scripts/validation: monotonic push and a few cycles of walls of tests, beside the tests' loads; the
usual evaluation.
"""
import numpy as np
import pytest
from evaluation import evaluate
from measured_walls import HEIGHT, WALLS
from rack import Rack, envelope

BOARDS = [wall for wall in WALLS if wall.name.startswith("R-")]


def yaml_points(points):
    return "{envelope: [" + ", ".join(f"[{drift:.7f}, {shear:.3f}]" for drift, shear in points) + "]}"


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.name)
def test_points_of_measured_walls(tmp_path, wall):
    """One push to failure: the loads of the sheets to 1 %."""
    rack = Rack(tmp_path, yaml_points(wall.envelope()), length=wall.length, height=HEIGHT)
    curve = envelope(rack.test(drifts=(), step=2e-4))
    assert np.interp(wall.code_drift, *curve.T) == pytest.approx(1e3 * wall.mean("code"), rel=0.01)
    assert curve[:, 1].max() == pytest.approx(1e3 * wall.mean("largest"), rel=0.01)
    if wall.is_tail_known and np.isfinite(wall.mean("ultimate_drift")):
        assert np.interp(wall.mean("ultimate_drift"), *curve.T) == pytest.approx(0.8e3 * wall.mean("largest"), rel=0.01)


@pytest.mark.parametrize("wall", BOARDS, ids=lambda wall: wall.name)
def test_mean_level_beside_the_boards(tmp_path, wall):
    """Three cycles at 1/120, 1/50 and 1/20, then a push: with the mean of the tests' multipliers alone, each load lies
    within the three tests, or within 15 % of their mean; the design level has less than 60 % of the largest load."""
    design = Rack(tmp_path, f"{{multiplier: {wall.mean('multiplier'):.4f}}}", length=wall.length, level="design")
    assert envelope(design.test(drifts=(), step=1e-3))[:, 1].max() < 0.6e3 * wall.mean("largest")
    rack = Rack(tmp_path, f"{{multiplier: {wall.mean('multiplier'):.4f}}}", length=wall.length)
    found = evaluate(envelope(rack.test(drifts=(1 / 120, 1 / 50, 1 / 20), step=5e-4)))
    for name, load in (("code", found.code_load), ("yielding", found.yield_load), ("ultimate", found.ultimate_load),
                       ("largest", found.largest_load)):
        low, high = wall.spread(name)
        assert low <= load / 1e3 <= high or load == pytest.approx(1e3 * wall.mean(name), rel=0.15), name


def test_pinching(tmp_path):
    """Law slip, third cycle at 1/30 of the level mean: from the unloaded state there is 20 % of the peak's load within
    the slack, then the way back to the peak.
    """
    rack = Rack(tmp_path, "{multiplier: 2.5, friction_share: 0.2}")
    peak = rack.path(0, 1 / 30, -1 / 30, 1 / 30, -1 / 30, 1 / 30)[-1][1]
    assert peak == pytest.approx(2.8 * 4900 * 0.91, rel=0.01)
    rack.path(1 / 30, -1 / 30, 0)
    slack = 1 / 30 - 2.8 / (1.4 * 120)
    assert rack.drift(0.8 * slack) == pytest.approx(0.2 * peak, rel=0.01)
    assert rack.drift(1 / 30) == pytest.approx(peak, rel=0.01)


def test_evaluation_of_a_bilinear_wall():
    """Elastic to 10 kN at 1/100, constant to 1/20, linear to zero at 1/10: its own bilinear curve, less the triangle
    behind 1/20.
    """
    curve = [(0, 0), (0.01, 10.0), (0.05, 10.0), (0.1, 0)]
    found = evaluate([(drift, np.interp(drift, *np.transpose(curve))) for drift in np.linspace(0, 0.1, 10001)])
    assert (found.yield_load, found.largest_load, found.ultimate_drift) == pytest.approx((10, 10, 0.06), rel=1e-3)
    area = 0.05 + 0.4 + 0.09
    assert found.ultimate_load * (0.06 - found.ultimate_load / 1000 / 2) == pytest.approx(area, rel=1e-3)
    assert found.code_load == pytest.approx(10 / 1.2, rel=1e-3)
    assert found.ductility == pytest.approx(0.06 * 1000 / found.ultimate_load, rel=1e-3)


def test_evaluation_of_a_curved_wall():
    """Two lines, 0 to 4 and to 10 kN, of slopes 800 and 300 kN/rad, to 1/40; the lines through 0.1 and 0.4, 0.4 and 0.9
    are the curve's own: Py = 4.
    """
    found = evaluate([(0, 0), (0.005, 4), (0.025, 10), (0.05, 5), (0.1, 0)])
    assert found.yield_load == pytest.approx(4, rel=1e-9)
    assert found.ultimate_drift == pytest.approx(0.035)
