# SPDX-License-Identifier: GPL-2.0-or-later
# A town: yade -n -x scripts/town.py town.yaml [--quake | --record FILE_OR_PREFIX] [--snow METRES]; all options: -h.
import sys

if "yade.wrapper" not in sys.modules:
    sys.exit(f"error: this script runs in YADE: yade -n -x {sys.argv[0]}")

import yade_timber as yt  # noqa: E402, F401  (for the live session)
from yade_timber.api.script import main_town

run = main_town()
