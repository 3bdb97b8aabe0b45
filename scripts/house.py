# SPDX-License-Identifier: GPL-2.0-or-later
# Any house: yade -n -x scripts/house.py my_house.yaml [--quake | --record FILE_OR_PREFIX] [--snow METRES]; all options:
# -h.
"O" in globals() or exit("error: this script runs in YADE: yade -n -x house.py")
from timber_houses.api.script import main_house, th, yt  # noqa: F401  (th, yt: for the prompt)
run = main_house()
