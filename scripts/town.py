# SPDX-License-Identifier: GPL-2.0-or-later
# A town: yade -n -x scripts/town.py town.yaml [--quake | --record FILE_OR_PREFIX] [--snow METRES]; all options: -h.
"O" in globals() or exit("error: this script runs in YADE: yade -n -x town.py")
from timber_houses.api.script import main_town, th, yt  # noqa: F401  (th, yt: for the prompt)
run = main_town()
