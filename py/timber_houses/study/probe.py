# SPDX-License-Identifier: GPL-2.0-or-later
"""Single runs, in YADE processes of their own: how long runs will take, from a second of strong shaking of the house
that they are about; whether a house bears its own weight and snow; the verdict with walls of the other level."""
import math
import tempfile
import time
import warnings
from dataclasses import replace
from pathlib import Path

from ..base.errors import RunError
from ..base.options import options as options_of
from ..base.processors import processors
from ..house import LEVELS, has_rated_walls
from ..motion import MotionRequest, onset, trim, write_csv
from ..recording.summary_parts import OtherWalls
from ..run.options import RunOptions
from ..text.english import counted, sentence
from .driver import Task, about, run_missing

PART = 1.0  # part of the motion that is computed, about the time at which half of its energy has arrived. [s]
SETTLING = 3.0  # simulated time without a motion: a sound house is at rest after 1 s, time at rest costs little. [s]
FEW = 30.0  # simulated time of all runs, per run at a time, up to which none is computed. [s]


def estimate(task, count, jobs=None):
    """A line about the computing time of `count` runs as long as that of a Task, `jobs` at a time. Raises RunError,
    RecordError."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the runs tell them
        motion = task.options.requested_motion()
    duration, jobs = task.options.simulated(motion), min(jobs or processors(), count)
    runs = f"{counted(count, 'run')} of at most {duration:g} s"
    if motion is None:
        return f"{runs}: the first one tells the computing time, which depends on when the house comes to rest"
    if count * duration <= FEW * jobs:
        return f"{runs}: too short for an estimate of the computing time"
    with tempfile.TemporaryDirectory() as folder:
        probe = Task(Path(folder), _part(task.options, motion, folder))
        since = time.monotonic()
        summary = run_missing([probe], 1, lambda line: None)[probe]
        taken = time.monotonic() - since
        if summary is None:
            return f"{runs}: no estimate of the computing time: {probe.error or 'its run was stopped'}"
    one = taken - summary.wall_s + summary.wall_s / summary.duration_s * duration
    return (f"{runs}, {about(one)} each: {about(one * math.ceil(count / jobs))}, {jobs} at a time (from {PART:g} s of"
            f" the strongest shaking, computed in {taken:.0f} s)")


def _part(options, motion, folder):
    """Options of a run under the part of its motion, a GroundMotion before its factor, with the strongest shaking."""
    start, record = max(0.0, onset(motion, 0.5) - PART / 2), Path(folder) / "part.csv"
    write_csv(trim(motion, start, start + PART), record)
    own = {name: each.default for name, each in options_of(MotionRequest).items()}
    own |= {"record": str(record), "scale": options.factor, "out": None, "duration": PART, "until_collapse": False}
    return replace(options, **own, no_frames=True)


def check_own_weight(house, snow):
    """The result of a short run without a motion, as a sentence. house: name or file; snow: depth [m] or None. Raises
    RunError."""
    with tempfile.TemporaryDirectory() as folder:
        task = Task(Path(folder), RunOptions(house=str(house), snow=snow, duration=SETTLING, no_frames=True))
        summary = run_missing([task], 1, lambda line: None)[task]
        if summary is None:
            raise RunError(task.error or "its run was stopped")
        return sentence(summary)


def with_other_walls(options, data):
    """OtherWalls of the summary, for a report with both verdicts, from a run in the folder walls_LEVEL; None without
    rated walls. data: of the house's Description. Raises RunError."""
    if not has_rated_walls(data):
        return None
    (level,) = set(LEVELS) - {options.walls or data["law"]["wall_level"]}
    task = Task(options.folder / f"walls_{level}", replace(options, walls=level, no_frames=True))
    summary = run_missing([task], 1, options.say)[task]
    if summary is None:
        raise RunError(f"the run with walls of the level {level} has no results: {task.error or task.folder}")
    return OtherWalls(level=level, verdict=summary.verdict, peak_drift=summary.peak_drift)
