# SPDX-License-Identifier: GPL-2.0-or-later
from mechanics.programs.npm_engine import engine_program


def program():
    return engine_program("jolt", "Jolt", "jolt-physics", "defaults, damping 0, convex radius 1 mm", lacks=(
        ("forces", "the package has no call for contact forces"), ("breaks", "joints have no strength")))
