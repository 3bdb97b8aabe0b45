# SPDX-License-Identifier: GPL-2.0-or-later
"""Run inside `yade -n -x`: the installed package passes its guard and has registered its classes."""
import yade_timber

assert yade_timber._class_names, "no class registered"
print("yade_timber from", yade_timber.__path__[0])
