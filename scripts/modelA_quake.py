# SPDX-License-Identifier: GPL-2.0-or-later
# House A, earthquake (paper, section 4.1).
import yade_timber as yt
from yade_timber.run.runner import main

run = main("A", earthquake=True)
