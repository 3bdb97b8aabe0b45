# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a house bears its own weight and snow: a short run without a motion, in its own YADE process."""
import tempfile
from pathlib import Path

from ..base.errors import RunError
from ..run.options import RunOptions
from ..text.english import sentence
from .driver import Task, run_missing

TIME = 3.0  # simulated time of the run. A sound house is at rest after 1 s, and time at rest costs little. [s]


def check_own_weight(house, snow):
    """The result as a sentence. house: name or file; snow: depth [m] or None. Raises RunError."""
    with tempfile.TemporaryDirectory() as folder:
        task = Task(Path(folder), RunOptions(house=str(house), snow=snow, duration=TIME, no_frames=True))
        summary = run_missing([task], 1, lambda line: None)[task]
        if summary is None:
            raise RunError(task.error or "its run was stopped")
        return sentence(summary)
