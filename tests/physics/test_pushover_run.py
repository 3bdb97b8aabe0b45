# SPDX-License-Identifier: GPL-2.0-or-later
"""A slow push and a free vibration of the solver beside pushover curve and secant period of a box of one storey with a
rigid roof."""
import numpy as np
import pytest
import timber_houses as th
from timber_houses.base.gravity import weight_of
from timber_houses.house import build_house, load_house
from timber_houses.house.pushover import pushover, secant_periods
from timber_houses.motion import GroundMotion
from timber_houses.recording.quantities import Storeys

BOX = """
extends: plated
name: box
loads: {roof: 2.0}
joints: {column_ends: {number: 4}}
structures:
  main:
    place: {origin: [0, 0]}
    grid: {x: {module: 1.0, count: 4}, y: {module: 1.0, count: 3}}
    margin: 0.06
    lines: [{along: y, at: [0, 4], from: 0, to: 3}, {along: x, at: [0, 3], from: 0, to: 4, cut: true}]
    stack:
      - {layer: foundation, height: 0.3, width: 0.12}
      - {layer: sill, height: 0.12, width: 0.12}
      - {layer: columns, height: 2.7}
      - {layer: beams, height: 0.24, width: 0.12}
      - {layer: roof, type: flat, thickness: 0.12, material: roofing}
    columns:
      - {section: 0.12, lines: [{along: x, at: [0, 3], from: 0, to: 4}, {along: y, at: [0, 4], from: 0, to: 3}]}
    walls:
      - {along: x, at: [0, 3], from: 0, to: 2, type: plywood}
      - {along: y, at: [0, 4], from: 0, to: 1, type: plywood}
"""
PEAK, TIME = 7.0, 9.0
"""Of the ground's acceleration, which rises linearly from 1 s on. [m/s2], [s]"""


def test_slow_push(tmp_path):
    """The walls of the curve, and besides them columns of 0.12 m that rock under the weight W: at most W x 0.12 / 2.7.

    The ramp leaves a sway of 1 % of the shear; the slope, free of the columns' constant share, within 3 %.
    """
    (tmp_path / "box.yaml").write_text(BOX)
    time = np.arange(0, TIME + 0.005, 0.01)
    east = PEAK * np.clip((time - 1) / (TIME - 1), 0, None)
    th.run(tmp_path / "box.yaml", motion=GroundMotion(0.01, np.column_stack([east, 0 * east, 0 * east])), duration=TIME,
           out=tmp_path / "out", no_frames=True, quiet=True)
    model, storeys = build_house(load_house(tmp_path / "box.yaml")), Storeys.read(tmp_path / "out" / "storeys.csv")
    history = th.load_run(tmp_path / "out").history
    times, shears = storeys.time, np.abs(storeys.column("shear_ew1")) / 1000
    drifts = np.abs(np.interp(times, history.time, history.drift(1, "ew")))
    curve = np.transpose(pushover(model, "main")[1, "ew"])
    late = times > TIME / 2
    rocking = weight_of(sum(e.mass for e in model.of_kind("roof", "beam"))) * 0.12 / 2.7
    more = shears[late] - np.interp(drifts[late], *curve)
    assert more.min() > -0.01 * shears.max() and more.max() < rocking + 0.01 * shears.max()
    slope = np.polyfit(drifts[late], shears[late], 1)[0]
    assert abs(slope / (curve[1, 1] / curve[0, 1]) - 1) < 0.03


TWO_STOREYS = (BOX.replace("{roof: 2.0}", "{roof: 2.0, floor: 2.0}")
               .replace("      - {layer: roof", "      - {layer: floor, thickness: 0.12}\n"
                        "      - {layer: columns, height: 2.7}\n"
                        "      - {layer: beams, height: 0.24, width: 0.12}\n      - {layer: roof")
               .replace("from: 0, to: 2, type: plywood}", "from: 0, to: 3, type: plywood, storeys: 1}\n"
                        "      - {along: x, at: [0, 3], from: 0, to: 2, type: plywood, storeys: 2}")
               .replace("from: 0, to: 1, type: plywood}", "from: 0, to: 3, type: plywood}"))
"""The walls of both storeys have about the same drift in the lowest mode."""


@pytest.mark.parametrize("house, push", ((BOX, 12.3), (TWO_STOREYS, 8.4)), ids=["one storey", "two storeys"])
def test_free_vibration(tmp_path, house, push):
    """Pushed slowly to about 1/110 [m/s2] and released, houses of one and two storeys swing with the secant period of
    the mean amplitude of a whole swing, the first one at 1/131 and 1/119, within 4 %.

    Observed: 2 % longer, since the sheets have yielded in the push.
    """
    (tmp_path / "box.yaml").write_text(house)
    release, end, step = 2.5, 4.0, 0.01
    time = np.arange(0, end + step / 2, step)
    east = push * np.clip(time - 1, 0, 1) * (time < release)
    th.run(tmp_path / "box.yaml", motion=GroundMotion(step, np.column_stack([east, 0 * east, 0 * east])), duration=end,
           out=tmp_path / "out", no_frames=True, quiet=True)
    model, history = build_house(load_house(tmp_path / "box.yaml")), th.load_run(tmp_path / "out").history
    curves, drift = pushover(model, "main"), history.drift(1, "ew")
    passes = np.flatnonzero((np.diff(np.sign(drift)) != 0) & (history.time[:-1] > release))
    times = history.time[passes] - drift[passes] * np.diff(history.time)[passes] / np.diff(drift)[passes]
    peaks = [np.mean([np.abs(history.drift(storey, "ew")[a:b]).max() for storey in history.storeys])
             for a, b in zip(passes, passes[1:])]
    assert 1 / 150 < (peaks[0] + peaks[1]) / 2 < 1 / 110
    for k in range(3):
        expected = secant_periods(model, "main", curves, (peaks[k] + peaks[k + 1]) / 2)["ew"]
        assert times[k + 2] - times[k] == pytest.approx(expected, rel=0.04)
