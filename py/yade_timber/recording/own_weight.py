# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage of a house by its own weight and snow, before the shaking begins. Needs no YADE."""
import numpy as np

from . import verdict
from .sentences import counted, own_weight, ratio

HARMFUL = 0.5
"""Ground acceleration below which no sound house is damaged: half of the design earthquake that it must bear without damage. [m/s2]"""


def start_of_shaking(motion):
    """Time at which the shaking first reaches HARMFUL [s]; None without such shaking. motion: frames.Motion or None"""
    shaken = np.flatnonzero(np.abs(motion.acceleration).max(1) >= HARMFUL) if motion else ()
    return float(motion.time[shaken[0]]) if len(shaken) else None


def damage_before_shaking(structures, has_snow):
    """'damaged before the shaking, by its own weight: 12 joints broken, peak drift 1/45'; empty for a house without damage.

    structures: {name: facts}, as verdict.judge takes them
    """
    main = next(iter(structures))
    parts = [("" if name == main else f"{name}: ") + _damage(facts) for name, facts in structures.items() if verdict.judge(facts) != verdict.UNDAMAGED]
    return f"damaged before the shaking, by {own_weight(has_snow)}: {'; '.join(parts)}" if parts else ""


def _damage(facts):
    if facts["collapsed"]:
        return "collapsed"
    joints = [f"{counted(facts[key], 'joint')} {text}" for key, text in (("broken", "broken"), ("partly_broken", "partly broken")) if facts[key]]
    lost = [f"{counted(facts['columns_lost'], 'column')} lost"] if facts["columns_lost"] else []
    return ", ".join([*joints, *lost, f"peak drift {ratio(facts['peak_drift'])}"])
