# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pushover curves beside the sum of the envelopes of the wall types. Tolerance: shears are rounded to 1 N. Names of
modes."""
import numpy as np
import pytest
from test_house_plan import L_WALLS, house_file, write
from timber_houses.house import build_house, diagnose, load_house
from timber_houses.base.gravity import GRAVITY
from timber_houses.house.pushover import pushover, secant_periods
from timber_houses.house.wall_types import envelope
from timber_houses.pictures import report_pictures
from timber_houses.recording.summary_parts import Components, Mode
from timber_houses.text.english import mode_name


def test_sum_of_the_walls(tmp_path):
    """Plywood on 2 + 2 + 2 m and gypsum on 4 m of a storey, E-W, from zero to the loss of strength."""
    walls = L_WALLS + ", {along: x, at: 4, from: 4, to: 8, type: gypsum}"
    house = load_house(write(tmp_path, "l", house_file("L", walls)))
    drifts, shears = np.transpose(pushover(build_house(house), "main")[1, "ew"])
    points = {kind: np.transpose([(0, 0), *envelope(house.data["wall_types"][kind], "mean")])
              for kind in ("plywood", "gypsum")}
    expected = 6.0 * np.interp(drifts, *points["plywood"]) + 4.0 * np.interp(drifts, *points["gypsum"])
    assert shears == pytest.approx(expected / 1000, abs=2e-3)
    assert drifts[-1] == pytest.approx(0.115) and max(shears) > 6 * 2.5 * 1.96 * 2.8
    assert pushover(build_house(house), "main")[1, "ns"] == []


def test_secant_periods():
    """Two storeys by the quadratic of a chain of two masses; none for a house of braces, whose columns bear more."""
    model = build_house(load_house("l_house"))
    periods = diagnose(model)["structures"]["main"]["periods_s"]
    curves, drift = pushover(model, "main"), 1 / 120
    for axis, direction in enumerate(("ew", "ns")):
        masses, stiffness = [], []
        for storey in (1, 2):
            own = [e.mass * (0.5 if e.kind in ("column", "brace") else 1.0) for e in model.elements if e.group == "main"
                   and not e.fixed and (e.storey == storey or e.kind in ("column", "brace") and e.storey == storey + 1)]
            masses.append(sum(own))
        for storey, above in ((1, sum(masses)), (2, masses[1])):
            low, high = model.storey_levels["main"][storey]
            columns = [c for c in model.of_kind("column", group="main") if c.storey == storey]
            width = np.mean([np.ptp(column.vertices[:, axis]) for column in columns])
            shear = 1000 * np.interp(drift, *np.transpose(curves[storey, direction]))
            shear += above * GRAVITY * (width / (high - low) - drift)
            stiffness.append(shear / drift / (high - low))
        (m1, m2), (k1, k2) = masses, stiffness
        half = (k1 + k2) / m1 / 2 + k2 / m2 / 2
        omega2 = half - np.sqrt(half**2 - k1 * k2 / m1 / m2)
        assert periods[direction] == pytest.approx(2 * np.pi / np.sqrt(omega2), abs=1e-3)
    braced = build_house(load_house("B"))
    assert secant_periods(braced, "main", pushover(braced, "main"), drift) == {"ew": None, "ns": None}
    assert "natural periods at a drift of 1/120: N-S 0.37 s, E-W 0.45 s" in diagnose(model)["sentence"]


def test_braces_pull():
    """B, storey 1, E-W: 4 braces. Each end is joined to beam and column by 69.58 kN/m and 6.958 kN: 2 x 69.58 kN/m at
    each end in series and 13.916 kN along the brace, whose clear bay is 0.91 m less half of two columns wide."""
    model = build_house(load_house("B"))
    drift, shear = max(pushover(model, "main")[1, "ew"], key=lambda point: point[1])
    brace = model.element("main.brace1.EW.y0.0-1")
    rise, run = np.ptp(brace.vertices[:, 2]), np.ptp(brace.vertices[:, 0])
    slope = run / np.hypot(rise, run)
    ends = {joint.kind for joint in model.joints if joint.a == brace.name}
    per_end = len(ends)
    assert shear == pytest.approx(4 * per_end * 6.958 * slope, rel=2e-3)
    assert drift == pytest.approx(2 * 0.1 / (slope * rise), rel=2e-3)


def test_figure_of_the_storeys(tmp_path):
    main = diagnose(build_house(load_house(write(tmp_path, "l", house_file("L", L_WALLS)))))["structures"]["main"]
    drawn = report_pictures.pushover("main", main)
    assert [axis.get_title(loc="left")[:14] for axis in drawn.axes] == ["main, storey 1", "main, storey 2"]
    side = main["storeys"]["1"]["directions"]["ew"]
    assert side["demand_kn"] == pytest.approx(1.96 * side["required_quantity_m"], abs=2e-3)
    assert [line.get_ydata()[0] for line in drawn.axes[0].lines if line.get_linestyle() == "--"] == [side["demand_kn"]]
    bare = diagnose(build_house(load_house(write(tmp_path, "bare", house_file("L")))))["structures"]["main"]
    assert report_pictures.pushover("main", bare) is None


def test_a_coupled_mode_has_both_directions():
    names = [mode_name(Mode(0.3, direction, Components(ns=ns, ew=ew, ud=0.0), {}))
             for direction, ns, ew in (("ns", 0.8, 0.05), ("ew", 0.3, 0.5), ("ns", 0.45, 0.44), ("ew", 0.0, 0.9))]
    assert names == ["N-S", "coupled E-W and N-S", "coupled N-S and E-W", "E-W"]
