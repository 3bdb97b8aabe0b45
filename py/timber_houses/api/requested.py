# SPDX-License-Identifier: GPL-2.0-or-later
"""What a process of a study starts: `yade -n -x requested.py FOLDER` completes the run that a folder requests."""
import sys
from pathlib import Path

from timber_houses.api.script import main_requested

main_requested(Path(sys.argv[-1]))
