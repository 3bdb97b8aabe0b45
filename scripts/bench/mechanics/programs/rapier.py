# SPDX-License-Identifier: GPL-2.0-or-later
from mechanics.programs.npm_engine import engine_program


def program():
    return engine_program("rapier", "Rapier", "@dimforge/rapier3d-compat", "defaults, impulse joints",
                          lacks=(("breaks", "joints have no strength"),))
