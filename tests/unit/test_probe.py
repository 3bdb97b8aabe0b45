# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The computing time of many runs, told before the first of them."""
import re
import shutil
import time

import pytest
from timber_houses.motion import DEFAULT_RECORD, onset, read_motion
from timber_houses.run.options import RunOptions, scripted
from timber_houses.study import probe
from timber_houses.study.driver import Task

TEXT = r"40 runs of at most 40 s, about (.+) each: about (.+), 2 at a time \(from 1 s of the strongest shaking, " \
       r"computed in (\d+) s\)"


@pytest.fixture
def probed(monkeypatch):
    """Requests of the probes, which are not run: each takes 3 s, of which 1 s is start-up."""
    requests, clock = [], iter(range(0, 300, 3))

    class Found:
        wall_s, duration_s = 2.0, 1.0

    def run_missing(tasks, jobs, report):
        requests.extend(task.request() for task in tasks)
        requests.extend(read_motion(task.options.record) for task in tasks if task.options.record)
        return {task: Found for task in tasks}

    monkeypatch.setattr(probe, "run_missing", run_missing)
    monkeypatch.setattr(probe, "time", type("Clock", (), {"monotonic": lambda: next(clock)}))
    return requests


def test_start_up_and_steps_make_the_estimate(tmp_path, probed):
    """1 s + 40 x 2 s a run; 40 runs, 2 at a time: 20 x 81 s = 27 min."""
    line = probe.estimate(Task(tmp_path, RunOptions(house="C", quake=True)), 40, 2)
    assert re.fullmatch(TEXT, line).groups() == ("81 s", "27 min", "3")


@pytest.mark.parametrize("options", [
    {"quake": True}, {"quake": True, "pga": 700.0}, {"seed": 4, "start": 14.0, "end": 34.0, "intensity": 6.0},
    {"quake": True, "scale": 0.5, "then": f"{DEFAULT_RECORD}@0.5"}], ids=str)
def test_the_part_has_the_middle_of_the_shaking_as_it_is_run(tmp_path, probed, options):
    """The probe's motion times its factor is the run's motion, to the rounding of gal with two decimals."""
    given = RunOptions(house="C", **options)
    probe.estimate(Task(tmp_path, given), 40, 2)
    request, part = probed
    whole = given.motion(given.dt)
    first = round((onset(whole, 0.5) - probe.PART / 2) / whole.dt)
    expected = whole.acceleration[first : first + len(part)] * given.factor
    assert abs(part.acceleration * request.factor - expected).max() < 1e-4 * given.factor
    assert request.check().duration == probe.PART and request.house == "C"


def test_short_runs_and_runs_without_motion_need_none(tmp_path, probed):
    line = probe.estimate(Task(tmp_path, RunOptions(house="C", quake=True, duration=2.0)), 30, 2)
    assert line == "30 runs of at most 2 s: too short for an estimate of the computing time"
    assert "of at most 30 s: the first one tells" in probe.estimate(Task(tmp_path, RunOptions(house="C")), 99, 2)
    assert not probed


@pytest.mark.skipif(shutil.which("yade") is None, reason="yade is not installed")
def test_a_real_probe(tmp_path):
    """Its time is not longer than the call; none of its files stays behind."""
    since = time.monotonic()
    line = probe.estimate(Task(tmp_path / "run", scripted("modelC_quake", "C", earthquake=True)), 40, 2)
    assert int(re.fullmatch(TEXT, line)[3]) <= time.monotonic() - since + 1
    assert not list(tmp_path.iterdir())
