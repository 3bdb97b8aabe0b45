# SPDX-License-Identifier: GPL-2.0-or-later
"""Verdict on each structure of a run, and the limits of each word with their sources.

collapsed   a level has come down by half its storey
total loss  the residual drift reached the limit of damage certificates
unsafe      a storey drift or the drift at a column reached the safety limit, or a column has fallen or lost its last
            joint
repairable  such a drift reached the damage limit, or springs of joints broke
undamaged   none of these

Peak drifts decide, since a frame that swings back may have lost its strength. A structure leans when its residual drift
exceeds the tilt."""
import math
from dataclasses import dataclass, field

UNDAMAGED, REPAIRABLE, UNSAFE, TOTAL_LOSS, COLLAPSED = STATES = (
    "undamaged", "repairable", "unsafe", "total loss", "collapsed")
"""From the best to the worst."""


@dataclass(frozen=True)
class Limit:
    """drift [-]; name; source."""

    drift: float
    name: str
    source: str

    @property
    def ratio(self):
        """'1/30'."""
        return f"1/{round(1 / self.drift)}"

    @property
    def text(self):
        """'1/30 safety limit'."""
        return f"{self.ratio} {self.name}"


DAMAGE = Limit(1 / 120, "damage limit", "Building Standard Law of Japan, Enforcement Order, Article 82-2: 1/200, eased"
               " to 1/120 where finishes allow it")
SAFETY = Limit(1 / 30, "safety limit", "Japan Building Disaster Prevention Association, seismic diagnosis of wooden"
               " houses; limit strength calculation")
TILT = Limit(1 / 10, "tilt", "this package: the weight of the upper storey begins to overturn the house")
LIMITS = (DAMAGE, SAFETY, TILT)  # of peak drifts
LOSS = Limit(1 / 20, "limit of a total loss", "Cabinet Office of Japan, guidelines for damage certificates of houses:"
             " tilt of outer walls or columns; of the residual drift")
"""The guidelines take the mean tilt at the four corners of storey 1 (compared: excerpt on velocities1.rssing.com)."""
FALL = 1 / 2  # height by which a level of a collapsed structure has come down, over that of its storey. [-]
FALLEN_ANGLE = math.radians(45)  # inclination beyond which a column has fallen. [rad]


@dataclass(frozen=True, kw_only=True)
class Structure:
    """Facts on a structure, and its verdict. Drifts [-]; settled: whether the one at the end is a residual drift;
    numbers of joints and lost columns since the start."""

    verdict: str = field(init=False)
    leans: bool = field(init=False)
    peak_drift: float
    column_drift: float = 0.0
    residual_drift: float = 0.0
    settled: bool = True
    broken: int = 0
    partly_broken: int = 0
    columns_lost: int = 0
    collapsed: bool = False

    def __post_init__(self):
        object.__setattr__(self, "verdict", _judge(self))
        object.__setattr__(self, "leans", not self.collapsed and self.settled and self.residual_drift >= TILT.drift)


def _judge(facts):
    if facts.collapsed:
        return COLLAPSED
    drift = max(facts.peak_drift, facts.column_drift)
    if facts.settled and facts.residual_drift >= LOSS.drift:
        return TOTAL_LOSS
    if drift >= SAFETY.drift or facts.columns_lost:
        return UNSAFE
    if drift >= DAMAGE.drift or facts.broken or facts.partly_broken:
        return REPAIRABLE
    return UNDAMAGED


def passed(drift):
    """The highest Limit that a drift reaches, or None."""
    return max((limit for limit in LIMITS if drift >= limit.drift), key=lambda limit: limit.drift, default=None)
