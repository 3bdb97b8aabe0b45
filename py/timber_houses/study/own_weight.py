# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a house bears its own weight and snow: a short run without a motion, in its own YADE process."""
import subprocess
import tempfile
from pathlib import Path

from ..base.errors import RunError
from ..recording.summary import Summary
from ..run import request_file
from ..run.options import RunOptions
from ..text.english import sentence
from .driver import ENTRY, Task, command

TIME = 3.0  # simulated time of the run. A sound house is at rest after 1 s, and time at rest costs little. [s]


def check_own_weight(house, snow):
    """The result as a sentence. house: name or file; snow: depth [m] or None. Raises RunError."""
    with tempfile.TemporaryDirectory() as folder:
        task = Task(Path(folder), RunOptions(house=str(house), snow=snow, duration=TIME, no_frames=True))
        request_file.write(task.request())
        done = subprocess.run([*command(ENTRY), folder], stdin=subprocess.DEVNULL, capture_output=True)
        if done.returncode:
            raise RunError(task.error or f"exit status {done.returncode}")
        return sentence(Summary.read(folder))
