# SPDX-License-Identifier: GPL-2.0-or-later
"""Drift at the columns: inclinations in the monitor, and the sentence and verdict that follow from them."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from summaries import sample_summary
from yade import O
from yade.minieigenHP import Quaternion
from timber_houses.recording.verdict import FALLEN_ANGLE, REPAIRABLE, UNSAFE, Structure
from timber_houses.text import english, lines

EAST, NORTH = (0, 1, 0), (-1, 0, 0)
"""Axes about which a column leans to the east and to the north."""


def monitored(*leans, joined=True):
    """HouseMonitor of a floor and columns of storey 1 that lean by (axis, angle) at a sample."""
    O.reset()
    ground = O.bodies.append(yt.box((9, 9, 0.2), (0, 0, -0.1), fixed=True))
    floor = O.bodies.append(yt.box((9, 9, 0.2), (0, 0, 3.5), fixed=True))
    columns = [O.bodies.append(yt.box((0.1, 0.1, 2.7), (k, 0, 1.4), fixed=True)) for k in range(len(leans))]
    monitor = yw.HouseMonitor(interval=0, bodies=[floor], levels=[1], heights=[2.7], columnBodies=columns,
                              columnStoreys=[1] * len(columns), fallenAngle=FALLEN_ANGLE)
    O.engines = yt.engines(monitor=monitor)
    for column in columns[:None if joined else -1]:
        yt.connect(ground, column, [(O.bodies[column].state.pos[0], 0, 0)])
    for column, (axis, angle) in zip(columns, leans):
        O.bodies[column].state.ori = Quaternion(axis, angle)
    O.dt = 1e-4
    O.step()
    return monitor


def test_largest_and_median():
    """Peaks are ns1, ew1. Of an even number the median is the mean of the middle two; signs count in the median."""
    monitor = monitored((EAST, 0.03), (EAST, 0.01), (EAST, -0.04))
    assert monitor.columnPeak == pytest.approx([0, math.sin(0.04)])
    assert monitor.medianPeak == pytest.approx([0, math.sin(0.01)])
    monitor = monitored((NORTH, 0.03), (NORTH, 0.01), (NORTH, -0.01), (NORTH, 0.02))
    assert monitor.columnPeak == pytest.approx([math.sin(0.03), 0])
    assert monitor.medianPeak == pytest.approx([(math.sin(0.01) + math.sin(0.02)) / 2, 0])
    O.bodies[2].state.ori = Quaternion(NORTH, 0.0)
    O.step()
    assert monitor.columnPeak[0] == pytest.approx(math.sin(0.03))  # a peak stays


def test_lost_columns_do_not_count():
    assert monitored((EAST, 0.01), (EAST, 0.9)).columnPeak == pytest.approx([0, math.sin(0.01)])
    assert monitored((EAST, 0.01), (EAST, 0.2), joined=False).columnPeak == pytest.approx([0, math.sin(0.01)])
    assert monitored((EAST, 0.9)).columnPeak == [0, 0]


def test_sentence_and_lines_state_torsion():
    """1/85 at the centre, 1/12 at a column."""
    drifts = {"peak_drift": {"storey1": {"ns": 1 / 85, "ew": 0.0}},
              "column_drift": {"largest": {"storey1": {"ns": 1 / 12, "ew": 0.0}},
                               "median": {"storey1": {"ns": 1 / 80, "ew": 0.0}}}}
    summary = sample_summary(**drifts)
    assert ("peak storey drift 1/85 N-S in storey 1, beyond the damage limit of 1/120, 1/12 N-S at a column (median"
            " 1/80), beyond the safety limit") in english.sentence(summary)
    assert ("Largest storey drift 1/85 N-S in storey 1 of the centre, 1/12 N-S at a column (median 1/80)"
            in lines.drifts(summary))
    drifts["column_drift"]["largest"]["storey1"]["ns"] = 1 / 84
    assert "column" not in english.sentence(sample_summary(**drifts))


def test_verdict_takes_the_drift_at_the_columns():
    assert Structure(peak_drift=1 / 85, column_drift=1 / 12).verdict == UNSAFE
    assert Structure(peak_drift=1 / 150, column_drift=1 / 100).verdict == REPAIRABLE
