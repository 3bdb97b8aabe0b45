# SPDX-License-Identifier: GPL-2.0-or-later
# House A, earthquake (paper, section 4.1).
import sys

if "yade.wrapper" not in sys.modules:
    sys.exit(f"error: this script runs in YADE: yade -n -x {sys.argv[0]}")

import yade_timber as yt  # noqa: E402, F401  (for the live session)
from yade_timber.api.script import main

run = main("A", earthquake=True)
