# SPDX-License-Identifier: GPL-2.0-or-later
from mechanics.programs.npm_engine import engine_program


def program():
    return engine_program("bullet", "Bullet", "ammojs3", "defaults; one step a call", one_a_scene=True)
