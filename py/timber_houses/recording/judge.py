# SPDX-License-Identifier: GPL-2.0-or-later
"""Peak drifts, tilt and fall of each structure of a house, from the samples of its run. Needs no YADE.

A structure tilts when a storey drift exceeds TILT before it falls, and falls when a level comes down by FALL of its
storey. Drifts at columns are those of heads relative to feet, over the length; columns that have fallen (FALLEN_ANGLE)
or have no joint left do not count."""
import math
from dataclasses import dataclass

import numpy as np

from .history import DIRECTIONS, NORTH_EAST, drifts
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
    """levels: damage.Level in the order of the sampled groups, those of a structure from below; columns: (structure,
    storey) of the sampled axes; known: {structure: Judged} of a checkpoint"""

    def __init__(self, levels, columns=(), known=None):
        names = [level.structure for level in levels]
        self._levels = {name: slice(names.index(name), names.index(name) + names.count(name)) for name in names}
        self._heights = np.array([level.height for level in levels])
        self._stacked = np.array([[above == below] for below, above in zip(names, names[1:])], bool).reshape(-1, 1)
        self._columns = np.full((len(levels), len(columns)), -1)  # of each level's storey; -1: no further one
        for name, chosen in self._levels.items():
            for level in range(chosen.start, chosen.stop):
                found = [k for k, column in enumerate(columns) if column == (name, level - chosen.start + 1)]
                self._columns[level, :len(found)] = found
        self._columns = self._columns[:, :(self._columns >= 0).sum(1).max(initial=0)]
        self.structures = known or {name: Judged.of(names.count(name)) for name in self._levels}

    @property
    def main(self):
        return next(iter(self.structures.values()))

    def histories(self, samples):
        """{structure: History} of samples, the main one first."""
        return {name: samples.history(chosen, self._heights[chosen]) for name, chosen in self._levels.items()}

    def judge(self, samples, axes):
        """Take account of further samples. samples: Samples; axes: (F, C, 3) of the columns, NaN: without a joint"""
        if not samples.samples:
            return
        moved = samples.displacement[:, :len(self._heights)]
        drift, drop = drifts(moved, self._heights, self._stacked), -moved[:, :, 2] / self._heights
        size = np.abs(drift)
        last = np.where(np.isnan(drift[-1]), 0.0, drift[-1])
        peaks = np.array([np.fmax.reduce(size, 0), *column_drifts(at_columns(axes, self._columns))])
        for name, judged in self.structures.items():
            chosen, known = self._levels[name], [judged.peak, judged.column_peak, judged.median_peak]
            judged.drift = last[chosen].ravel().tolist()
            raised = np.fmax(known, peaks[:, chosen].reshape(3, -1))
            judged.peak, judged.column_peak, judged.median_peak = raised.tolist()
        if (size > TILT.drift).any() or (drop > FALL).any():
            for name, judged in self.structures.items():
                self._note_fall(judged, samples.time, size[:, self._levels[name]], drop[:, self._levels[name]])

    @staticmethod
    def _note_fall(judged, time, size, drop):
        """size: (F, L, 2) of the drifts; drop: (F, L) over the heights of the storeys"""
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


def at_columns(axes, columns):
    """(F, L, C, 2) drifts at columns, north-south and east-west [-]; NaN of one that does not count. axes: (F, C, 3);
    columns: (L, C) of each storey, -1: none"""
    stands = axes[..., 2:] >= math.cos(FALLEN_ANGLE)  # not of NaN
    drift = np.where(stands, axes[..., NORTH_EAST], np.nan)[:, columns]
    drift[:, columns < 0] = np.nan
    return drift


def column_drifts(drift):
    """Largest drifts at columns, and largest medians over them: (L, 2) each [-]; NaN without columns that count.
    drift: of at_columns()"""
    frames, levels, columns = drift.shape[:3]
    if not columns:
        return np.full((2, levels, 2), np.nan)
    ordered = np.sort(drift, 2).reshape(-1, columns, 2)  # NaN behind; np.nanmedian is slower
    each, count = np.arange(frames * levels), np.isfinite(drift[..., 0]).sum(2).ravel()
    middle = ordered[each, (count - 1) // 2] + ordered[each, count // 2]  # NaN without a column
    medians = np.abs(middle / 2).reshape(frames, levels, 2)
    return np.fmax.reduce(np.abs(drift), (0, 2)), np.fmax.reduce(medians, 0)
