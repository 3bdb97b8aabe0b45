# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Drifts, tilt and fall of structures from invented samples. Needs no YADE."""
import math

import numpy as np
import pytest
from timber_houses.base.json_types import decode, encode
from timber_houses.recording.damage import Level
from timber_houses.recording.judge import Judge, Judged, at_columns, column_drifts
from timber_houses.recording.history import Samples

HEIGHTS = (2.0, 4.0)
LEVELS = [*(Level("main", [k], [1.0], height) for k, height in enumerate(HEIGHTS)), Level("carport", [2], [1.0], 2.5)]
COLUMNS = ("time [s]", "broken_joints [-]", "broken_springs [-]", "kinetic [J]",
           *(f"{name}{group}" for group in range(3) for name in ("x", "y", "z", "px", "py", "pz")))
COLUMNS = tuple(name if " [" in name else f"{name} [m]" for name in COLUMNS)
LEANS = {"ew": (1.0, 0.0), "ns": (0.0, 1.0)}


def samples(*displacements, start=0.0):
    """Samples 0.01 s apart. displacements: (3, 3) of main's two levels and the carport's [m]"""
    moved = np.array(displacements, float).reshape(-1, 3, 3)
    groups = np.concatenate([moved, np.zeros_like(moved)], axis=2).reshape(len(moved), -1)
    heads = np.column_stack([start + 0.01 * np.arange(len(moved)), np.zeros((len(moved), 3))])
    return Samples(COLUMNS, np.column_stack([heads, groups]))


def judged(*displacements, axes=None, columns=()):
    judge, taken = Judge(LEVELS, columns), samples(*displacements)
    judge.judge(taken, np.zeros((taken.samples, 0, 3)) if axes is None else np.array(axes, float))
    return judge.structures


def test_drift_refers_to_the_height_of_its_own_storey():
    """Levels moved by 0.1 m to the east and 0.3 m to the north over storeys of 2 and 4 m."""
    found = judged([(0.1, 0, -0.9), (0, 0.3, -2.1), (0, 0, 0)])["main"]
    assert found.peak == pytest.approx([0, 0.05, 0.075, 0.025])
    assert found.drift == pytest.approx([0, 0.05, 0.075, -0.025])
    assert found.fall_s == 0 and found.tilt_s is None  # down by more than half a storey of 4 m


@pytest.mark.parametrize("direction", LEANS)
def test_tilt_and_fall(direction):
    """Peaks stay when the house swings back; a tilt after the fall is none."""
    x, y = LEANS[direction]
    lean = [(0.21 * x, 0.21 * y, 0)] * 2 + [(0, 0, 0)]
    still, down = [(0, 0, 0)] * 3, [(0, 0, -1.01), (0, 0, -1.01), (0, 0, 0)]
    found = judged(still, lean, still, down)["main"]
    assert (found.tilt_s, found.tilt_direction, found.fall_s) == (0.01, direction, 0.03)
    assert max(found.peak) == pytest.approx(0.105)
    assert judged(down, lean)["main"].tilt_s is None
    assert judged(still, [(0.19, 0, 0)] * 2 + [(0, 0, -1.25)])["main"].tilt_s is None


def test_structures_are_judged_alike():
    """A carport of 2.5 m that leans and falls alone."""
    found = judged([(0, 0, 0), (0, 0, 0), (0.26, 0, 0)], [(0, 0, 0), (0, 0, 0), (0.26, 0, -1.26)])
    assert found["main"] == Judged.of(2)
    assert (found["carport"].tilt_s, found["carport"].fall_s) == (0.0, 0.01)


def test_samples_may_come_in_parts():
    """Judged one by one, and after a checkpoint, as all at once."""
    moved = np.cumsum(np.random.default_rng(0).normal(0, 0.05, (40, 3, 3)), 0)
    whole = judged(*moved)
    judge = Judge(LEVELS)
    for k, one in enumerate(moved):
        judge.judge(samples(one, start=0.01 * k), np.zeros((1, 0, 3)))
        judge = Judge(LEVELS, known=decode(dict[str, Judged], encode(judge.structures)))
    assert judge.structures == whole


def test_a_removed_level_has_no_drift():
    found = judged([(0.1, 0, 0), (0.1, 0, 0), (np.nan,) * 3])["carport"]
    assert found.peak == found.drift == [0, 0] and found.fall_s is None


def lean(direction, angle):
    """Axis of a column that leans by an angle [rad]."""
    x, y = LEANS[direction]
    return x * math.sin(angle), y * math.sin(angle), math.cos(angle)


def of_columns(axes):
    """Of a single storey."""
    return [found[0] for found in column_drifts(at_columns(axes, np.arange(axes.shape[1])[None]))]


def test_largest_and_median_at_columns():
    """Each ns, ew. Of an even number the median is the mean of the middle two; signs count in the median. Columns that
    have fallen (0.9 rad) or have no joint left do not count."""
    largest, median = of_columns(np.array([[lean("ew", 0.03), lean("ew", 0.01), lean("ew", -0.04)]]))
    assert largest == pytest.approx([0, math.sin(0.04)]) and median == pytest.approx([0, math.sin(0.01)])
    largest, median = of_columns(np.array([[lean("ns", angle) for angle in (0.03, 0.01, -0.01, 0.02)]]))
    assert largest == pytest.approx([math.sin(0.03), 0])
    assert median == pytest.approx([(math.sin(0.01) + math.sin(0.02)) / 2, 0])
    for lost in (lean("ew", 0.9), (np.nan,) * 3):
        assert of_columns(np.array([[lean("ew", 0.01), lost]]))[0] == pytest.approx([0, math.sin(0.01)])
        assert of_columns(np.array([[lost]]))[0].tolist() == pytest.approx([math.nan] * 2, nan_ok=True)


def test_columns_belong_to_storeys():
    """One column in each storey of main, one of the carport."""
    columns = [("main", 2), ("carport", 1), ("main", 1)]
    found = judged(np.zeros((3, 3)), columns=columns, axes=[[lean("ew", 0.02), lean("ns", 0.03), lean("ew", 0.01)]])
    assert found["main"].column_peak == pytest.approx([0, math.sin(0.01), 0, math.sin(0.02)])
    assert found["carport"].column_peak == pytest.approx([math.sin(0.03), 0])


def test_history():
    """Columns of history.csv; samples without finite numbers are left out."""
    taken = samples([(0.1, 0.2, -0.3), (0.1, 0.6, -0.3), (0, 0, 0)], np.full((3, 3), np.nan))
    history = taken.history(slice(2), HEIGHTS)
    assert history.columns[:7] == ("time [s]", "drift_ns1 [-]", "drift_ew1 [-]", "drop1 [m]", "drift_ns2 [-]",
                                   "drift_ew2 [-]", "drop2 [m]")
    assert history.rows[:, 1:7] == pytest.approx(np.array([[0.1, 0.05, 0.3, 0.1, 0, 0.3]]))
    assert history.columns[7:] == COLUMNS[1:4]
