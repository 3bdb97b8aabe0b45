# SPDX-License-Identifier: GPL-2.0-or-later
# House B, 1 m of snow on the roof, no earthquake (paper, section 4.2).
import yade_timber as yt
from yade_timber.run.runner import main

run = main("B", snow=True)
