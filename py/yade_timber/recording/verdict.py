# SPDX-License-Identifier: GPL-2.0-or-later
"""Verdict on each structure of a run: undamaged, repairable, unsafe or collapsed. Needs no YADE.

collapsed   a level has come down by half its storey
unsafe      a storey drift reached the safety limit, or a column has fallen or lost its last joint
repairable  a storey drift reached the damage limit, or springs of joints broke
undamaged   none of these

Peak drifts decide, since a frame that swings back may have lost its strength. A structure leans when its residual drift exceeds the tilt.
"""
from dataclasses import dataclass

UNDAMAGED, REPAIRABLE, UNSAFE, COLLAPSED = STATES = ("undamaged", "repairable", "unsafe", "collapsed")
"""From the best to the worst."""


@dataclass(frozen=True)
class Limit:
    """drift [-]; name; source."""

    drift: float
    name: str
    source: str

    @property
    def text(self):
        """'1/30 safety limit'."""
        return f"1/{round(1 / self.drift)} {self.name}"


DAMAGE = Limit(1 / 120, "damage limit", "Building Standard Law of Japan, Enforcement Order, Article 82-2: 1/200, eased to 1/120 where finishes allow it")
SAFETY = Limit(1 / 30, "safety limit", "Japan Building Disaster Prevention Association, seismic diagnosis of wooden houses; limit strength calculation")
TILT = Limit(1 / 10, "tilt", "this package: the weight of the upper storey begins to pull the house over")
LIMITS = (DAMAGE, SAFETY, TILT)


def judge(facts):
    """One of STATES. facts: an entry of `structures` of a summary: peak_drift [-], broken, partly_broken, columns_lost, collapsed."""
    if facts["collapsed"]:
        return COLLAPSED
    if facts["peak_drift"] >= SAFETY.drift or facts["columns_lost"]:
        return UNSAFE
    if facts["peak_drift"] >= DAMAGE.drift or facts["broken"] or facts["partly_broken"]:
        return REPAIRABLE
    return UNDAMAGED


def leans(facts):
    """Whether a structure that stands ends with a lean beyond the tilt."""
    return not facts["collapsed"] and facts["residual_drift"] >= TILT.drift


def passed(drift):
    """The highest Limit that a drift reaches, or None."""
    return max((limit for limit in LIMITS if drift >= limit.drift), key=lambda limit: limit.drift, default=None)
