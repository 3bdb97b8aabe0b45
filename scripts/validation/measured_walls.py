# SPDX-License-Identifier: GPL-2.0-or-later
"""Measured walls. Tests of 1.82 m with pinned feet unless `length` says otherwise; loads in kN, drifts in rad, du in
mm.

`model`: wall types of the rack that stand for them, in YAML, shears in N/m. The points are the tests' means: P at
1/120, Py at its drift where it follows, the largest load and 0.8 of it at du; drifts of the largest load that the sheet
does not give are those of `mean`, 1/30.
"""

from dataclasses import dataclass

import numpy as np

from timber_houses.house.wall_types import RATED_DRIFT

HEIGHT = 2.73
"""Of all walls. [m]"""


@dataclass(frozen=True)
class Test:
    """Loads [kN], drift of the largest load [rad], drift at the end or at 0.8 of the largest load [rad]; nan: not
    given.
    """

    code: float = np.nan
    yielding: float = np.nan
    ultimate: float = np.nan
    largest: float = np.nan
    largest_drift: float = np.nan
    ultimate_drift: float = np.nan
    multiplier: float = np.nan


@dataclass(frozen=True)
class Wall:
    name: str
    source: str
    length: float  # [m]
    tests: tuple
    code_drift: float = RATED_DRIFT  # drift of the load `code` [rad]
    is_tail_known: bool = True  # ultimate_drift: at 0.8 of the largest load, not only the end of the test

    def mean(self, name):
        """Mean of a value of the tests that have it, or nan."""
        known = [value for test in self.tests if np.isfinite(value := getattr(test, name))]
        return float(np.mean(known)) if known else np.nan

    def spread(self, name):
        known = [value for test in self.tests if np.isfinite(value := getattr(test, name))]
        return (min(known), max(known)) if known else (np.nan, np.nan)

    def envelope(self):
        """[(drift [rad], shear [N/m])] of the means."""
        shear = 1e3 / self.length
        top = self.mean("largest_drift")
        top = 1 / 30 if np.isnan(top) else top
        points = [(self.code_drift, self.mean("code") * shear)]
        if np.isfinite(self.mean("yielding")):
            points.append((1 / 80, self.mean("yielding") * shear))
        points.append((top, self.mean("largest") * shear))
        end = self.mean("ultimate_drift")
        return [*points, ((top + 1 / 60) if np.isnan(end) else end, 0.8 * self.mean("largest") * shear)]


def _drift(du):
    return du / 1e3 / HEIGHT


RAFTON = "in-plane shear tests of Rafton board, data sheet of the maker"
WALLS = (
    Wall(
        "R-50F",
        RAFTON,
        1.82,
        (Test(11.0, 17.98, 29.41, 31.95, ultimate_drift=_drift(219.7), multiplier=2.7),
         Test(12.1, 13.87, 20.44, 23.16, ultimate_drift=_drift(102.6), multiplier=2.1),
         Test(11.7, 16.19, 22.44, 24.20, ultimate_drift=_drift(133.2), multiplier=2.5)),
    ),
    Wall(
        "R-26F",
        RAFTON,
        1.82,
        (Test(9.8, 14.74, 20.76, 23.01, ultimate_drift=_drift(128.4), multiplier=2.1),
         Test(14.2, 15.03, 18.97, 24.21, ultimate_drift=_drift(123.5), multiplier=2.6),
         Test(12.0, 14.27, 22.97, 25.23, ultimate_drift=_drift(106.3), multiplier=2.3)),
    ),
    Wall("particle board 9 mm, AEP", "tests of particle board of 9 mm, published by the makers' association", 1.82,
         (Test(29.3, largest=43.7, largest_drift=1 / 24, ultimate_drift=1 / 11, multiplier=5.52),),
         is_tail_known=False),
    Wall("particle board 9 mm, AGP", "as AEP", 1.82,
         (Test(22.7, largest=30.5, largest_drift=1 / 43, ultimate_drift=1 / 9),), is_tail_known=False),
    Wall(
        "mud on bamboo",
        "tests in three years of a mud wall of 0.91 m x 2.73 m",
        0.91,
        (Test(2.74, largest=7.63, largest_drift=1 / 20, multiplier=2.74 / 0.91 / 1.96),
         Test(2.7, largest=8.8, largest_drift=1 / 30, multiplier=2.7 / 0.91 / 1.96),
         Test(3.3, largest=10.2, largest_drift=1 / 20, multiplier=3.3 / 0.91 / 1.96)),
        code_drift=1 / 150,
    ),
    Wall("LVL 105 mm", "tests of LVL walls of 105 mm x 1015 mm x 2730 mm", 1.015,
         (Test(35.1, largest=41.1), Test(28.5, largest=42.2), Test(36.1, largest=41.8))),
)
"""Of mud the multiplier is that of the load at 1/150. The load `code` of LVL is the sheet's first one; its drift is
taken to be RATED_DRIFT.
"""
