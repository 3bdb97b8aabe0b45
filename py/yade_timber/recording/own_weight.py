# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage of a house by its own weight and snow, before the shaking begins."""
import numpy as np

HARMFUL = 0.5
"""Ground acceleration that damages no sound house: half of the design earthquake. [m/s2]"""


def start_of_shaking(motion):
    """Time at which the shaking first reaches HARMFUL [s]; None without such shaking. motion: frames.Motion or None"""
    shaken = np.flatnonzero(np.abs(motion.acceleration).max(1) >= HARMFUL) if motion else ()
    return float(motion.time[shaken[0]]) if len(shaken) else None
