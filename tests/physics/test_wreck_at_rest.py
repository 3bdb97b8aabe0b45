# SPDX-License-Identifier: GPL-2.0-or-later
"""A run without a given duration ends when its wreck has come to rest and the motion is spent; also a resumed one."""
import numpy as np
import pytest
import timber_houses as th
from test_pushover_run import BOX
from timber_houses.motion import GroundMotion
from timber_houses.run import observer
from timber_houses.run.observer import REST_TIME, SPENT
from timber_houses.text import english, japanese

PUSH, TAIL, LONG = 4.0, 4.0, 30.0
"""Acceleration of 1.5 s [m/s2]; time of a last sample above SPENT; length of the record [s]."""


def shaking():
    """A push that overturns the frame, then a motion of half of SPENT, with one stronger sample at TAIL."""
    time = np.arange(0, LONG, 0.01)
    east = np.where((time > 0.5) & (time < 2.0), PUSH, SPENT / 2 * np.sin(20 * time))
    east[round(TAIL / 0.01)] = 1.1 * SPENT
    return GroundMotion(0.01, np.column_stack([east, 0 * east, 0 * east]))


def run(folder, **options):
    house = folder / "frame.yaml"
    house.write_text(BOX[:BOX.index("    walls:")].replace("number: 4", "number: 1"))
    return th.run(house, motion=shaking(), out=folder / "out", no_views=True, quiet=True, **options).summary


@pytest.mark.filterwarnings("ignore:.*constant part")
def test_the_run_ends_with_the_rest_of_its_wreck(tmp_path, monkeypatch):
    """Bounds, sentence, and the same end when it is resumed from a checkpoint within the rest."""
    found = run(tmp_path, checkpoint=0.5, dt=2.5e-4)
    assert found.collapsed and TAIL < found.rest_s < LONG / 2
    assert found.duration_s == pytest.approx(found.rest_s + REST_TIME, abs=0.051)
    assert f"the run ends at {found.duration_s:.0f} s, since the wreck is at rest" in english.sentence(found)
    assert "瓦礫が静止" in japanese.result(found)
    monkeypatch.setattr(observer, "moving_share", lambda: 0.0)  # the time since when it rests is in the checkpoint
    again = run(tmp_path, checkpoint=0.5, dt=2.5e-4, resume=True)
    assert (again.duration_s, again.rest_s, again.collapse_time_s) == (
        found.duration_s, found.rest_s, found.collapse_time_s)


@pytest.mark.filterwarnings("ignore:.*constant part")
def test_a_given_duration_decides(tmp_path):
    found = run(tmp_path, duration=TAIL + REST_TIME + 3, dt=2.5e-4)
    assert found.collapsed and found.rest_s is None and found.duration_s == TAIL + REST_TIME + 3
