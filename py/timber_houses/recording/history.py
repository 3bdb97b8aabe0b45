# SPDX-License-Identifier: GPL-2.0-or-later
"""The time history of a run: storey drifts, broken joints and energies at each sample.

`History` is the one place that knows the columns of history.csv:

    history = History.read("results/modelA_quake/history.csv")
    history.time                          # (F,) [s]
    history.storeys                       # (1, 2)
    history.drift(1, "ns")                # (F,) [-]; directions: "ns", "ew"
    history.energy("kinetic")             # (F,) [J]
    history.broken_joints                 # (F,) [-]
    history.column("drop1")               # any column, with or without its unit

Columns: time [s]; for each storey k: drift_nsk [-], drift_ewk [-], dropk [m]; broken_joints [-], broken_springs [-];
one column [J] for each term of `yade_timber.energy()`."""
import numpy as np

from .series import Series

NAME, BREAKS = "history.csv", "breaks.csv"
DIRECTIONS = ("ns", "ew")


class History(Series):
    """The table history.csv."""

    __slots__ = ()

    @property
    def storeys(self):
        """Numbers of the storeys, from below: (1, 2, ...)."""
        return tuple(int(name[len("drift_ns") :].partition(" ")[0]) for name in self.columns
                     if name.startswith("drift_ns"))

    def drift(self, storey, direction):
        """(F,) drift of a storey in direction 'ns' (north > 0) or 'ew' (east > 0). [-] Raises KeyError."""
        if storey not in self.storeys or direction not in DIRECTIONS:
            raise KeyError(f"drift({storey!r}, {direction!r}): storeys are {', '.join(map(str, self.storeys))};"
                           f" directions {', '.join(DIRECTIONS)}")
        return self.column(f"drift_{direction}{storey}")

    def drifts(self):
        """(storey, direction, (F,) drift) of each storey and direction, in the order of the columns."""
        return [(storey, direction, self.drift(storey, direction)) for storey in self.storeys
                for direction in DIRECTIONS]

    def largest_drift(self):
        """(F,) largest absolute drift of any storey and direction at each sample. [-]"""
        return np.abs([values for _, _, values in self.drifts()]).max(0) if self.storeys else np.zeros(self.samples)

    def energy(self, term):
        """(F,) term of the energy balance. [J]"""
        return self.column(f"{term} [J]")

    def row_at(self, time):
        """Number of the last sample at or before a time [s], at least 0."""
        return max(0, int(np.searchsorted(self.time, time, side="right")) - 1)

    @property
    def broken_joints(self):
        """(F,) number of joints without a spring left, those damaged before the start included. [-]"""
        return self.column("broken_joints")

    @property
    def broken_springs(self):
        """(F,) number of springs that broke during the run. [-]"""
        return self.column("broken_springs")
