# SPDX-License-Identifier: GPL-2.0-or-later
"""Weight and mass."""
GRAVITY = 9.81  # acceleration of gravity, that of the scene (pkg/Gravity.hpp). [m/s2]


def mass_of(weight):
    """Mass [kg] of a weight [kN]."""
    return 1000 * weight / GRAVITY


def weight_of(mass):
    """Weight [kN] of a mass [kg]."""
    return mass * GRAVITY / 1000
