# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagnosis of houses against sums by hand. Tolerances: results are rounded to three decimals."""
import dataclasses
from functools import cache

import pytest
from summaries import sample_summary
from timber_houses.house import build_house, comparison, diagnose, load_house
from timber_houses.house.diagnosis import brace_multiplier, eccentricity_factor, is_balanced, judgement


@cache
def diagnosis(name, snow=None):
    return diagnose(build_house(load_house(name), snow, check=False))


def side(name, group, storey, direction, snow=None):
    return diagnosis(name, snow)["structures"][group]["storeys"][storey]["directions"][direction]


def test_braced_house():
    """B, storey 1: 4 braces of 45 x 90 in bays of 0.91 m: 7.28 m; floor 8.19 x 7.28 m; 0.31 m by the rule of 2025
    (test_wall_quantity.py) and of a light roof 0.83 kN per m2.
    """
    area = 8.19 * 7.28
    one = side("B", "main", "1", "ew")
    assert one["wall_quantity_m"] == pytest.approx(4 * 2 * 0.91, abs=1e-3)
    assert one["wall_quantity_ratio"] == pytest.approx(7.28 / (0.31 * area), abs=1e-3)
    assert one["iw"] == pytest.approx((1.96 * 7.28 + 0.25 * 0.83 * area) / (0.83 * area), abs=1e-3)


def test_tiled_house():
    """Heavy; E-W, storey 1: plywood in 2 x 4 bays of outer walls and 5 bays of inner ones, all 0.91 m.

    Quasi-bearing gypsum: 0.9 x 0.6 x 0.9 on the outer walls, twice that on both sides of the inner ones.
    """
    one = side("tiled_house", "main", "1", "ew")
    quantity, panels, area = 0.91 * 2.5 * (8 + 5), 0.91 * 0.486 * (8 + 2 * 5), 7.28 * 6.37
    assert (one["bearing_m"], one["quasi_bearing_m"]) == pytest.approx((quantity, panels), abs=1e-3)
    assert one["wall_quantity_m"] == pytest.approx(quantity + panels, abs=1e-3)
    assert one["iw"] == pytest.approx((1.96 * quantity + 0.25 * 1.06 * area) / (1.06 * area), abs=1e-3)


def test_house_that_is_not_symmetric():
    """Side wing: both N-S braces on its east line, 2.275 m from its middle; four E-W ones on lines 3.64 m apart.

    Torsion: E-W 3.64 m x 1.82^2 m2; radius^2 = torsion / 3.64 m of N-S quantity = 1.82^2.
    Mass: floor, beams, roof, columns and the outer walls of 0.26 kN/m2 in the north and south lie symmetric to the
    middle, the east wall 2.275 m east of it; the west one is common with the main wing and weighs there. The four
    braces of storey 2, 45 x 90 x 2878 mm, lie 2.275 m (two) and 1.82 m (two) east of the middle. Tolerance: braces are
    up to 2 % shorter than the diagonal, 2e-4 of Re, and Re is rounded to 5e-4.
    """
    one = side("l_house", "side", "1", "ns")
    assert one["bearing_m"] == pytest.approx(2 * 2 * 0.91, abs=1e-3)
    model = build_house(load_house("l_house"))
    floor, roof = 4.67 * 3.76 * 0.20, sum(slab.volume for slab in model.of_kind("roof", group="side"))
    beams, columns = 2 * 0.12**2 * (2 * 3.76 + 2 * 4.43), 18 * 0.12**2 * 2.73
    brace = 0.045 * 0.09 * 2.878
    wall, length = 260 / 9.81 / 340 * (2.73 + 0.12), 2 * 4.55 + 3.64
    shift = (brace * 2 * (2.275 + 1.82) + wall * 3.64 * 2.275) / (
        floor + roof + beams + columns + wall * length + 4 * brace)
    assert one["eccentricity"] == pytest.approx((2.275 - shift) / 1.82, abs=7e-4)
    assert one["quarters"][0] == 0 and not one["balanced"] and one["ekfl"] == 0.5
    area = 4.55 * 3.64
    assert one["iw"] == pytest.approx(0.5 * (1.96 * 3.64 + 0.25 * 0.83 * area) / (0.83 * area), abs=1e-3)


def test_snow_adds_to_the_required_strength():
    dry, snowy = (side("B", "main", "1", "ew", snow)["qr_kn"] for snow in (0.0, 1.0))
    assert snowy - dry == pytest.approx(0.26 * 8.19 * 7.28, abs=2e-3)
    assert side("B", "main", "1", "ew", 0.5)["qr_kn"] == dry


def test_uplift():
    """B, corner column, storey 1: N = 0.8 x 2 + 0.8 x 2 - 1.0 = 2.2, two fittings of 5.88 kN; C2's broken ones hold
    nothing.
    """
    known = diagnosis("B")["structures"]["main"]["uplift"]
    assert (known["largest_kn"], known["fitting_kn"], known["too_weak"]) == (pytest.approx(
        2.2 * 5.3), pytest.approx(11.76), 0)
    assert diagnosis("C2")["structures"]["main"]["uplift"]["too_weak"] > 0


@pytest.mark.parametrize("n, number, share", [(1.8, 1, 0.67), (2.8, 1, 1), (3.7, 2, 0.67), (4.7, 2, 0.84), (5.6, 2, 1)])
def test_hold_downs_of_an_n_value(tmp_path, n, number, share):
    """Those of docs/house_files.md allow the tension of N, at most 1 kN more; a strength that yields is not allowed."""
    path = tmp_path / "held.yaml"
    rule = f"{{type: hold_down, number: {number}, share: {share}}}"
    path.write_text(f"extends: tiled_house\nname: held\njoints: {{column_ends: {rule}}}\n")
    uplift = diagnose(build_house(load_house(path)))["structures"]["main"]["uplift"]
    assert 5.3 * n <= uplift["fitting_kn"] < 5.3 * n + 1
    assert (uplift["too_weak"] > 0) == (uplift["fitting_kn"] < uplift["largest_kn"])


def test_rules():
    assert [brace_multiplier(section)
            for section in ((0.09, 0.045), (0.03, 0.09), (0.09, 0.09), (0.045, 0.045))] == [2.0, 1.5, 3.0, 0.0]
    assert [eccentricity_factor(value) for value in (0.1, 0.3, 0.5, None)] == [1.0, pytest.approx(1 / 1.499), 0.5, 0.5]
    assert [is_balanced(*case) for case in ((1.1, 3, 1), (0.5, 0.9, 1), (0.4, 0.9, 1), (0.4, 0.9, 0.3), (0, 0, None))
            ] == [True, True, False, True, False]
    assert [judgement(iw)[:5] for iw in (1.5, 1.0, 0.7, 0.69)] == ["will ", "unlik", "may c", "likel"]


def test_headline_is_the_weakest_of_all_structures():
    known = diagnosis("l_house")
    assert (known["iw"], known["iw_at"]) == (side("l_house", "side", "1", "ns")["iw"], "side, storey 1, N-S")
    assert "0.38 (side, storey 1, N-S)" in known["sentence"]


def run_of(iw, collapsed, peak_gal=None, snow=0.0, broken=0):
    record = peak_gal and {"pga_gal": {"ns": peak_gal, "ew": 1.0, "ud": 5000.0}}
    diagnosis = {"structures": {"main": {"storeys": {"1": {"directions": {"ns": {"iw": iw}}}}}},
                 "broken_from_start": broken}
    return sample_summary(collapsed=collapsed, earthquake=bool(peak_gal), record=record, snow_depth_m=snow,
                          diagnosis=diagnosis)


def test_disagreement():
    cases = ((1.2, True, 900), (1.2, False, 900), (0.5, True, 900), (0.5, False, 300), (None, True, 900),
             (0.5, False, None), (1.2, True, None))
    assert [bool(comparison(run_of(iw, fell, peak)))
            for iw, fell, peak in cases] == [True, False, False, True, False, False, True]


def test_a_run_that_left_the_strong_shaking_out_is_no_test():
    shaken = run_of(0.5, False, 900)
    record = dataclasses.replace(shaken.record, onset_s=18.8, strong_end_s=27.0)
    assert comparison(shaken.changed(record=record, duration_s=30.0)).startswith("Main stands")
    assert [comparison(shaken.changed(record=record, duration_s=t)) for t in (0.0, 18.0, 26.0)] == ["", "", ""]


def test_disagreement_names_this_run():
    assert comparison(run_of(0.5, False, 300)) == (
        "Main stands although its Iw is 0.50; this run: peak acceleration 3.0 m/s2, weaker than the 4 m/s2 of the "
        "index's earthquake."
    )
    assert comparison(run_of(1.2, True, 910, 1.0, 8)) == (
        "Main collapsed although its Iw is 1.20; this run: peak acceleration 9.1 m/s2, stronger than the 4 m/s2 of the "
        "index's earthquake; "
        "snow 1 m; 8 joints broken from the start.")
    assert comparison(run_of(1.2, True, snow=2.0)).endswith("this run: no earthquake; snow 2 m.")
