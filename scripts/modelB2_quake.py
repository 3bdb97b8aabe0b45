# SPDX-License-Identifier: GPL-2.0-or-later
# House B2, earthquake (paper, section 4.3).
import yade_timber as yt
from yade_timber.run.runner import main

run = main("B2", earthquake=True)
