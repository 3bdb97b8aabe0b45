# SPDX-License-Identifier: GPL-2.0-or-later
"""The usual evaluation of a wall test: yield load, ultimate load of the equivalent bilinear curve, ductility, allowable
shear.

Yield load Py: the line through 0.1 and 0.4 of the largest load meets the tangent of the envelope that is parallel to
the line through 0.4 and 0.9. The bilinear curve has the stiffness Py / dy and, up to the drift du at 0.8 of the largest
load, the area under the envelope.
Source: test method for walls of the Japanese performance evaluation bodies, as in the data sheets of
docs/validation/walls.csv.
"""

from dataclasses import dataclass

import numpy as np

from timber_houses.house.wall_types import RATED_DRIFT

TEST_END = 1 / 15
"""Drift at which a test without loss of load ends. [rad]"""
STRAIGHT = 1e-3
"""Relative difference of the two slopes below which an envelope is straight up to its largest load, which then is the
yield load. [-]
"""


@dataclass(frozen=True)
class Evaluation:
    """Loads [N], drifts [rad], ductility [-]."""

    code_load: float
    yield_load: float
    ultimate_load: float
    largest_load: float
    largest_drift: float
    ultimate_drift: float
    ductility: float

    @property
    def allowable(self):
        """The least of the four loads. [N]"""
        return min(self.yield_load, 2 / 3 * self.largest_load, self.code_load,
                   0.2 * (2 * self.ductility - 1) ** 0.5 * self.ultimate_load)


def evaluate(envelope, end=None):
    """Evaluation of an envelope, (n, 2) drift [rad] and load [N] from the origin. end: last drift of the test, where
    the load did not fall to 0.8 of the largest one [rad]."""
    drift, load = np.asarray(envelope, float).T
    top = int(load.argmax())
    loads = np.maximum.accumulate(load[: top + 1])
    rising = lambda share: np.interp(share * load[top], loads, drift[: top + 1])
    tenth, low, high = rising(0.1), rising(0.4), rising(0.9)
    first, second = 0.3 * load[top] / (low - tenth), 0.5 * load[top] / (high - low)
    intercept = (load - second * drift)[: top + 1].max()
    start = 0.1 * load[top] - first * tenth
    meet = np.inf if first - second < STRAIGHT * first else first * (intercept - start) / (first - second) + start
    yield_load = min(meet, load[top])
    stiffness = yield_load / rising(yield_load / load[top])
    ultimate = _end(drift, load, top, end)
    area = _area(drift, load, ultimate)
    ultimate_load = stiffness * (ultimate - np.sqrt(ultimate**2 - 2 * area / stiffness))
    return Evaluation(float(np.interp(RATED_DRIFT, drift, load)), float(yield_load), float(ultimate_load),
                      float(load[top]), float(drift[top]), float(ultimate), float(ultimate * stiffness / ultimate_load))


def _end(drift, load, top, end):
    """Drift at 0.8 of the largest load beyond it, at most that of the end of the test."""
    below = np.flatnonzero(load[top:] <= 0.8 * load[top])
    if not below.size:
        return drift[-1] if end is None else end
    k = top + below[0]
    found = np.interp(0.8 * load[top], load[[k, k - 1]], drift[[k, k - 1]])
    return found if end is None else min(found, end)


def _area(drift, load, to):
    inside = drift < to
    x = np.append(drift[inside], to)
    return np.trapz(np.interp(x, drift, load), x)
