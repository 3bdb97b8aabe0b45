# SPDX-License-Identifier: GPL-2.0-or-later
from mechanics.programs.npm_engine import engine_program


def program():
    return engine_program("mujoco", "MuJoCo", "@mujoco/mujoco", "defaults",
                          lacks=(("breaks", "constraints have no strength"),))
