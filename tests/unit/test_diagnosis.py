# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagnosis of houses against sums by hand. Tolerances: results are rounded to three decimals."""

import sys
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "py"))

from yade_timber.house import build_house, comparison, diagnose, load_house  # noqa: E402
from yade_timber.house.diagnosis import brace_multiplier, eccentricity_factor, is_balanced, judgement  # noqa: E402


@cache
def diagnosis(name, snow=None):
    return diagnose(build_house(load_house(name), snow, check=False))


def side(name, group, storey, direction, snow=None):
    return diagnosis(name, snow)["structures"][group]["storeys"][storey]["directions"][direction]


def test_braced_house():
    """B, storey 1: 4 braces of 45 x 90 in bays of 0.91 m: 7.28 m; floor 8.19 x 7.28 m; light roof: 0.29 m and 0.83 kN per m2."""
    area = 8.19 * 7.28
    one = side("B", "main", "1", "ew")
    assert one["wall_quantity_m"] == pytest.approx(4 * 2 * 0.91, abs=1e-3)
    assert one["wall_quantity_ratio"] == pytest.approx(7.28 / (0.29 * area), abs=1e-3)
    assert one["iw"] == pytest.approx((1.96 * 7.28 + 0.25 * 0.83 * area) / (0.83 * area), abs=1e-3)


def test_tiled_house():
    """Heavy; E-W, storey 1: outer walls 2 x 4 bays of 4.4, inner walls 5 bays of 3.4, all 0.91 m."""
    one = side("tiled_house", "main", "1", "ew")
    quantity, area = 0.91 * (8 * 4.4 + 5 * 3.4), 7.28 * 6.37
    assert one["wall_quantity_m"] == pytest.approx(quantity, abs=1e-3)
    assert one["wall_quantity_ratio"] == pytest.approx(quantity / (0.33 * area), abs=1e-3)
    assert one["iw"] == pytest.approx((1.96 * quantity + 0.25 * 1.06 * area) / (1.06 * area), abs=1e-3)


def test_house_that_is_not_symmetric():
    """Side wing: both N-S braces on its east line, 2.275 m from its middle; four E-W ones on lines 3.64 m apart.

    Torsion: E-W 3.64 m x 1.82^2 m2; radius^2 = torsion / 3.64 m of N-S quantity = 1.82^2; Re = 2.275 / 1.82 = 1.25.
    """
    one = side("l_house", "side", "1", "ns")
    assert one["wall_quantity_m"] == pytest.approx(2 * 2 * 0.91, abs=1e-3)
    assert one["eccentricity"] == pytest.approx(1.25, abs=0.02)  # the floor is not quite symmetric: it ends flush with the main wing
    assert one["quarters"][0] == 0 and not one["balanced"] and one["ekfl"] == 0.5
    area = 4.55 * 3.64
    assert one["iw"] == pytest.approx(0.5 * (1.96 * 3.64 + 0.25 * 0.83 * area) / (0.83 * area), abs=1e-3)


def test_snow_adds_to_the_required_strength():
    dry, snowy = (side("B", "main", "1", "ew", snow)["qr_kn"] for snow in (0.0, 1.0))
    assert snowy - dry == pytest.approx(0.26 * 8.19 * 7.28, abs=2e-3)
    assert side("B", "main", "1", "ew", 0.5)["qr_kn"] == dry


def test_uplift():
    """B, corner column, storey 1: N = 0.8 x 2 + 0.8 x 2 - 1.0 = 2.2, two fittings of 5.88 kN; C2's broken ones hold nothing."""
    known = diagnosis("B")["structures"]["main"]["uplift"]
    assert (known["largest_kn"], known["fitting_kn"], known["too_weak"]) == (pytest.approx(2.2 * 5.3), pytest.approx(11.76), 0)
    assert diagnosis("C2")["structures"]["main"]["uplift"]["too_weak"] > 0


def test_rules():
    assert [brace_multiplier(section) for section in ((0.09, 0.045), (0.03, 0.09), (0.09, 0.09), (0.045, 0.045))] == [2.0, 1.5, 3.0, 0.0]
    assert [eccentricity_factor(value) for value in (0.1, 0.3, 0.5, None)] == [1.0, pytest.approx(1 / 1.499), 0.5, 0.5]
    assert [is_balanced(*case) for case in ((1.1, 3, 1), (0.5, 0.9, 1), (0.4, 0.9, 1), (0.4, 0.9, 0.3), (0, 0, None))] == [True, True, False, True, False]
    assert [judgement(iw)[:5] for iw in (1.5, 1.0, 0.7, 0.69)] == ["will ", "unlik", "may c", "likel"]


def test_disagreement():
    assert [bool(comparison({"iw": iw}, fell)) for iw, fell in ((1.2, True), (1.2, False), (0.5, True), (0.5, False), (None, True))] \
        == [True, False, False, True, False]
