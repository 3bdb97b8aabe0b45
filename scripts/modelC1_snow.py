# SPDX-License-Identifier: GPL-2.0-or-later
"O" in globals() or exit("error: this script runs in YADE: yade -n -x modelC1_snow.py")
from timber_houses.api.script import main, th, yt  # noqa: F401  (th, yt: for the prompt)
run = main("modelC1_snow")
