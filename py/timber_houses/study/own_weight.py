# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a house bears its own weight and snow: a short run without a motion, in its own YADE process."""
import subprocess
import tempfile
from pathlib import Path

from ..base.errors import RunError
from ..recording.summary import Summary
from ..run.options import RunOptions
from ..text.english import sentence
from .driver import command, last_error

TIME = 3.0
"""Simulated time of the run. A sound house is at rest after 1 s, and time at rest costs little. [s]"""


def check_own_weight(house, snow, scripts):
    """The result as a sentence. house: name or file; snow: depth [m] or None; scripts: folder. Raises RunError."""
    with tempfile.TemporaryDirectory() as folder:
        options = RunOptions(house=str(house), snow=snow, duration=TIME, no_frames=True, checkpoint=0.0, quiet=True,
                             out=Path(folder))
        done = subprocess.run([*command(scripts / "house.py"), *options.words()], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True)
        if done.returncode:
            raise RunError(last_error(done.stderr, done.returncode))
        return sentence(Summary.read(folder))
