# SPDX-License-Identifier: GPL-2.0-or-later
from mechanics.programs.npm_engine import engine_program


def program():
    return engine_program("cannon", "cannon-es", "cannon-es", "defaults, damping 0, bodies created unrotated",
                          lacks=(("breaks", "joints have no strength"),))
