# SPDX-License-Identifier: GPL-2.0-or-later
# House C1, earthquake and 1 m of snow on the roof (paper, section 4.4).
import yade_timber as yt
from yade_timber.run.runner import main

run = main("C1", earthquake=True, snow=True)
