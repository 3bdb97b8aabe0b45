# SPDX-License-Identifier: GPL-2.0-or-later
"""Run inside `yade -n -x`: the installed plugin passes its checks and has registered its classes; the application
is beside it.
"""
import timber_houses
import yade_timber

assert yade_timber._class_names, "no class registered"
print("from", yade_timber.__path__[0], "and", timber_houses.__path__[0])
