# SPDX-License-Identifier: GPL-2.0-or-later
# Any house: yade -n -x scripts/house.py my_house.yaml [--quake | --record FILE_OR_PREFIX] [--snow METRES]; all options: -h.
import yade_timber as yt
from yade_timber.run.runner import main_house

run = main_house()
