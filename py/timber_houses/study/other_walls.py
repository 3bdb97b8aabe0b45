# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run with rated walls of the other level, for a report with both verdicts."""
from dataclasses import replace

from ..base.errors import RunError
from ..house import LEVELS, has_rated_walls
from ..recording.summary_parts import OtherWalls
from .driver import Task, run_missing


def run(options, data):
    """OtherWalls of the summary, from a run in the folder walls_LEVEL; None without rated walls. data: of the house's
    Description. Raises RunError."""
    if not has_rated_walls(data):
        return None
    (level,) = set(LEVELS) - {options.walls or data["law"]["wall_level"]}
    task = Task(options.folder / f"walls_{level}", replace(options, walls=level, no_frames=True))
    summary = run_missing([task], 1, options.say)[task]
    if summary is None:
        raise RunError(f"the run with walls of the level {level} has no results: {task.error or task.folder}")
    return OtherWalls(level=level, verdict=summary.verdict, peak_drift=summary.peak_drift)
