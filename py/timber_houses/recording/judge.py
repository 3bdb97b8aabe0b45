# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak drifts, tilt and fall of each structure of a house, from the samples of its run. Needs no YADE.

A structure tilts when a storey drift exceeds TILT before it falls, and falls when a level comes down by FALL of its
storey. Drifts at columns are those of heads relative to feet, over the length; columns that have fallen (FALLEN_ANGLE)
or have no joint left do not count."""
import math
from dataclasses import dataclass

import numpy as np

from .history import DIRECTIONS
from .samples import NORTH_EAST, drifts
from .verdict import FALL, FALLEN_ANGLE, TILT


@dataclass
class Judged:
    """A structure so far. Drifts [-], each ns1, ew1, ns2, ew2, ...: at the last sample, the largest ones, the largest
    and the largest median at the columns; times [s]."""

    drift: list[float]
    peak: list[float]
    column_peak: list[float]
    median_peak: list[float]
    tilt_s: float | None = None
    tilt_direction: str | None = None
    fall_s: float | None = None

    @classmethod
    def of(cls, storeys):
        return cls(*([0.0] * (2 * storeys) for _ in range(4)))


class Judge:
    """levels: damage.Level in the order of the sampled groups; columns: (structure, storey) of the sampled axes;
    known: {structure: Judged} of a checkpoint"""

    def __init__(self, levels, columns=(), known=None):
        names = list(dict.fromkeys(level.structure for level in levels))
        groups = {name: [k for k, level in enumerate(levels) if level.structure == name] for name in names}
        self._groups, self._heights = groups, {name: [levels[k].height for k in groups[name]] for name in names}
        self._columns = {(name, storey): [k for k, column in enumerate(columns) if column == (name, storey)]
                         for name in names for storey in range(1, len(groups[name]) + 1)}
        self.structures = known or {name: Judged.of(len(groups[name])) for name in names}

    @property
    def main(self):
        return next(iter(self.structures.values()))

    def histories(self, samples):
        """{structure: History} of samples, the main one first."""
        return {name: samples.history(groups, self._heights[name]) for name, groups in self._groups.items()}

    def judge(self, samples, axes):
        """Take account of further samples. samples: Samples; axes: (F, C, 3) of the columns, NaN: without a joint"""
        if not samples.samples:
            return
        displacement = samples.displacement
        for name, judged in self.structures.items():
            moved = displacement[:, self._groups[name]]
            drift = drifts(moved, self._heights[name])
            self._judge(judged, samples.time, drift, -moved[:, :, 2] / self._heights[name])
            for storey in range(len(self._heights[name])):
                chosen = slice(2 * storey, 2 * storey + 2)
                found = at_columns(axes[:, self._columns[name, storey + 1]])
                for peaks, values in zip((judged.column_peak, judged.median_peak), found):
                    peaks[chosen] = np.maximum(peaks[chosen], values).tolist()

    @staticmethod
    def _judge(judged, time, drift, drop):
        """drift: (F, L, 2); drop: (F, L) over the heights of the storeys"""
        size = np.abs(drift)
        judged.drift = np.where(np.isnan(drift[-1]), 0.0, drift[-1]).ravel().tolist()
        judged.peak = np.fmax(judged.peak, np.fmax.reduce(size, 0).ravel()).tolist()
        tilted, fallen = _first((size > TILT.drift).any((1, 2))), _first((drop > FALL).any(1))
        if judged.tilt_s is None and judged.fall_s is None and tilted is not None and tilted <= (
                len(time) if fallen is None else fallen):
            storey = size[tilted, _first((size[tilted] > TILT.drift).any(1))]
            judged.tilt_s, judged.tilt_direction = float(time[tilted]), DIRECTIONS[int(storey[1] >= storey[0])]
        if judged.fall_s is None and fallen is not None:
            judged.fall_s = float(time[fallen])


def _first(flags):
    """Number of the first true one, or None."""
    return int(np.argmax(flags)) if flags.any() else None


def at_columns(axes):
    """(largest, largest median) of the drifts at columns, each (2,) north-south and east-west [-]. axes: (F, C, 3)"""
    stands = axes[..., 2] >= math.cos(FALLEN_ANGLE)  # not of NaN
    some = stands.any(1)
    if not some.any():
        return np.zeros(2), np.zeros(2)
    drift = axes[some][..., NORTH_EAST]
    drift[~stands[some]] = np.nan
    largest, count = np.fmax.reduce(np.abs(drift), (0, 1)), stands[some].sum(1)
    drift.sort(1)  # NaN behind; np.nanmedian takes ten times as long
    frames = np.arange(len(drift))
    return largest, np.abs((drift[frames, (count - 1) // 2] + drift[frames, count // 2]) / 2).max(0)
