# SPDX-License-Identifier: GPL-2.0-or-later
"""Summary of a run, the content of summary.json, and of a town. Meaning and units of all keys: docs/results.md."""
import json
from dataclasses import dataclass
from pathlib import Path

from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.json_types import decode, encode, optional
from ..base.record_file import read_record
from .events import Event, StructureFallen
from .summary_parts import (Broken, ColumnDrifts, Columns, Diagnosis, Drifts, Energy, Ensemble, JointCounts,
                            Quantities, Record, Solver, Versions, Walls, Weight)
from .verdict import Structure

NAME = "summary.json"
ANEW = "repeat the run with this version of the package"


@dataclass(frozen=True)
class LotResult:
    """Of a lot of a town. outlines: corners of the parts of its house's plan [m]; result: {language: sentence}"""

    name: str
    house: str
    verdict: str
    outlines: list[list[list[float]]]
    result: dict[str, str]


@dataclass(frozen=True)
class TownSummary:
    """Of a town, for sentences and pictures. Times: of the first house that tilts or collapses; events have lots."""

    model: str
    verdict: str
    lots: list[LotResult]
    collapsed: bool
    collapse_time_s: float | None
    tilt_time_s: float | None
    dt: float
    record: Record | None
    versions: Versions
    events: list[Event]
    ensemble: Ensemble | None = optional()

    @property
    def verdicts(self):
        """Of the houses."""
        return [lot.verdict for lot in self.lots]


@dataclass(frozen=True)
class Summary:
    """Results of a run."""

    scenario: str
    model: str
    earthquake: bool
    snow: bool
    snow_depth_m: float
    snow_mass_kg: float
    weight: Weight
    diagnosis: Diagnosis
    joint_damping: float | None
    walls: Walls | None
    record: Record | None
    dt: float
    duration_s: float
    until_collapse: bool
    cut_off: str | None
    steps: int
    wall_s: float
    skipped_s: float
    real_time_factor: float | None
    threads: int
    elements: int
    joints: JointCounts
    broken: Broken
    columns: Columns
    leans_from_s: float | None
    tilt_time_s: float | None
    tilt_direction: str | None
    collapsed: bool
    collapse_time_s: float | None
    fallen_structures: list[str]
    leaning_structures: list[str]
    peak_drift: Drifts
    residual_drift: Drifts
    final_amplitude: Drifts
    still_moving: bool
    events: list[Event]
    energy: Energy
    solver: Solver
    versions: Versions
    structures: dict[str, Structure]
    quantities: Quantities
    verdict: str
    sentence: str
    made_from: dict
    lot: str | None = optional()
    ensemble: Ensemble | None = optional()
    column_drift: ColumnDrifts | None = optional()
    rest_s: float | None = None
    description: str = ""

    @classmethod
    def read(cls, folder):
        """Of the run in a folder. Raises RunError."""
        path = Path(folder) / NAME
        text = read_record(path, "no finished run is there: an interrupted one has no summary before it is resumed to"
                                 " its end, a town has those of its lots")
        try:
            return parse(text)
        except (ValueError, RecursionError) as problem:
            raise RunError(f"{path}: cannot be read as the summary of a run: {problem}; {ANEW}") from None

    def write(self, folder):
        """Write summary.json; returns its path. Raises OSError."""
        write_text(folder / NAME, json.dumps(encode(self), indent=1, allow_nan=False) + "\n")
        return folder / NAME

    def changed(self, **changes):
        """A Summary with other values; tables are merged."""
        return decode(Summary, _merged(encode(self), encode(changes)), "summary")

    @property
    def main(self):
        """Structure on which the verdict rests."""
        return next(iter(self.structures.values()))

    @property
    def others(self):
        """[(name, Structure)] of the other structures."""
        return list(self.structures.items())[1:]

    def largest_drift(self, key="peak_drift"):
        """(drift, storey, 'ns' | 'ew') of the largest drift, zero without any. key: an entry with Drifts"""
        return _largest(getattr(self, key))

    @property
    def largest_at_columns(self):
        """(drift, storey, 'ns' | 'ew', largest of the medians) at the columns of the main structure; None where it
        is not recorded, as in earlier runs."""
        if self.column_drift is None:
            return None
        drift, storey, direction = _largest(self.column_drift.largest)
        return drift, storey, direction, _largest(self.column_drift.median)[0]

    def main_mode(self, when, direction):
        """The Mode 'before' or 'after' the run that moves most of the mass in a direction, None without one."""
        state = getattr(self.quantities.modes, when)
        modes = [mode for mode in state.modes if mode.direction == direction] if state else ()
        return max(modes, key=lambda mode: mode.mass_share[direction], default=None)

    def first_time(self, kind):
        """Time of the first event of a kind, None without one. [s]"""
        return next((event.time_s for event in self.events if event.kind == kind), None)

    def fall_time(self, name):
        """Time at which a structure other than the main one fell; None if it is not recorded. [s]"""
        return next((event.time_s for event in self.events if event.facts == StructureFallen(name)), None)

    @property
    def missed_shaking(self):
        """(onset, end) of the strong shaking of a run that ends before it, or stands and ends in it [s]; else None."""
        onset = self.record and self.record.onset_s
        end = onset and (self.record.strong_end_s or onset)
        ended = onset and self.duration_s < (onset if self.collapsed else end)
        return (onset, end) if ended else None

    @property
    def partly_broken(self):
        """Number of joints and wall sheets that lost some springs."""
        return self.broken.partly_broken + (self.broken.wall_sheets_partly or 0)

    @property
    def joints_and_sheets(self):
        """((broken, all) of the joints, (broken, all) of the wall sheets); (0, 0) in a house without walls."""
        broken, joints = self.broken, self.joints
        return (broken.total, joints.total), (broken.wall_sheets or 0, joints.wall_sheets or 0)


def _largest(drifts):
    """(drift, storey, 'ns' | 'ew') of the largest of Drifts, zero without any."""
    values = ((value, storey, direction) for storey, pair in drifts.items() for direction, value in pair.items()
              if value is not None)
    return max(values, default=(0.0, "storey1", "ns"))


def parse(text):
    """Summary or TownSummary of a text of JSON. Raises ValueError."""
    entries = json.loads(text)
    kind = TownSummary if isinstance(entries, dict) and "lots" in entries else Summary
    summary = decode(kind, entries, "summary")
    if kind is Summary and not (summary.structures and summary.collapsed == (summary.collapse_time_s is not None)):
        raise ValueError("summary: no structures, or a collapse without its time")
    return summary


def collapse_time(summary):
    """Time at which a house collapsed [s]; None without, for None, and for a town, which has none of its own."""
    return summary.collapse_time_s if isinstance(summary, Summary) else None


def _merged(old, new):
    """The table with other entries; where both have tables, those are merged."""
    both = {key for key, entry in new.items() if isinstance(entry, dict) and isinstance(old.get(key), dict)}
    return {**old, **{key: _merged(old[key], entry) if key in both else entry for key, entry in new.items()}}
