# SPDX-License-Identifier: GPL-2.0-or-later
"""Summary of a run, the content of summary.json, and of a town. Meaning and units of all keys: docs/results.md."""
import json
from pathlib import Path

from yade_timber.atomic_write import write_text

from ..base.errors import RunError
from ..base.json_types import decode, encode, optional, others, table
from ..base.record_file import read_record
from .events import Event, StructureFallen
from .verdict import Structure

NAME = "summary.json"
ANEW = "repeat the run with this version of the package"
Drifts = dict[str, dict[str, float | None]]
"""{storey: {direction: drift [-], None where there is none}}"""


class Components(dict):
    """{direction: value}, the values also as attributes: `shear.ns`."""

    @classmethod
    def decoded(cls, value, path):
        return cls(decode(dict[str, float], value, path))

    def __getattr__(self, direction):
        if direction not in self:
            raise AttributeError(f"no direction {direction!r}; there are {', '.join(self)}")
        return self[direction]


Weight = table("Weight", total_kn=float, snow_kn=float, floor_area_m2=float, per_floor_area_kn_m2=float | None,
               storeys=dict[str, dict[str, Components]])
Diagnosis = table(
    "Diagnosis", iw=float | None, iw_at=str | None, judgement=str | None, wall_quantity_ratio=float | None,
    wall_quantity_at=str | None, broken_from_start=int, structures=dict, sentence=str, disagreement=str)
OtherWalls = table("OtherWalls", level=str, verdict=str, peak_drift=Drifts)
Walls = table("Walls", level=str, other=OtherWalls | None)
PartOfRecord = table("PartOfRecord", source=str, start_s=float, duration_s=float, scale=float, pga_gal=Components)
Record = table("Record", source=str, pga_gal=Components, scale=float, dt=float, interpolation_error=float,
               onset_s=float | None, note=str | None, sequence=list[PartOfRecord] | None, strong_end_s=optional(float))
ColumnDrifts = table("ColumnDrifts", largest=Drifts, median=Drifts)
"""Peak drifts at the columns of the main structure: at any of them; of the median over them."""
Columns = table("Columns", total=int, fallen=int, loose=int)
Energy = table("Energy", input=float, kinetic=float, elastic=float, dissipated=dict[str, float], created=float | None,
               residual=float, residual_fraction=float | None, ground_motion=float, gravity_released=float)
Solver = table("Solver", sweeps_mean=float, sweeps_max=int, unconverged_steps=int, worst_change_j=float,
               uncarried_overlap_m=optional(float))
Versions = table("Versions", yade=str, package=str)
Mode = table("Mode", period_s=float | None, direction=str, mass_share=Components, shape=dict[str, Components])
ModesAt = table("ModesAt", time_s=float, modes=list[Mode])
Shear = table("Shear", sustained=Components, peak=Components)
StoreyQuantities = table("StoreyQuantities", mass_above_kg=float, shear=Shear,
                         shear_coefficient=dict[str, float | None], acceleration=Components)
LargestUtilisation = table("LargestUtilisation", joint=str, value=float)
LargestForce = table("LargestForce", joint=str, force=float)
LargestUplift = table("LargestUplift", column=str, uplift_m=float)
Ensemble = table("Ensemble", run=int, runs=int, outcomes=dict[str, int], peak_drift_standing=list[float] | None)
Modes = table("Modes", before=ModesAt | None, after=ModesAt | None)
Quantities = table(
    "Quantities", until_s=float | None, modes=Modes, mass_kg=float, base_shear=Shear, acceleration_band_hz=list[float],
    ground_acceleration=Components, storeys=dict[str, StoreyQuantities], largest_utilisation=LargestUtilisation | None,
    largest_pull=LargestForce | None, largest_shear=LargestForce | None,
    largest_uplift=LargestUplift | None)
JointCounts = table("JointCounts", total=int, column_beam=int, brace_beam=int, others=others(int),
                    wall_sheets=optional(int))
"""total: without those of walls; others: other kinds that occur. Sheets: None in a house without walls."""
Broken = table("Broken", total=int, column_beam=int, brace_beam=int, by_side=dict[str, int], by_storey=dict[str, int],
               by_place=dict[str, dict[str, JointCounts]], partly_broken=int, springs=int, damaged_at_start=JointCounts,
               others=others(int), wall_sheets=optional(int), wall_sheets_partly=optional(int))
Values = table(
    "Values", scenario=str, model=str, earthquake=bool, snow=bool, snow_depth_m=float, snow_mass_kg=float,
    weight=Weight, diagnosis=Diagnosis, joint_damping=float | None, walls=Walls | None, record=Record | None, dt=float,
    duration_s=float, until_collapse=bool, cut_off=str | None, steps=int, wall_s=float, skipped_s=float,
    real_time_factor=float | None, threads=int, elements=int, joints=JointCounts, broken=Broken, columns=Columns,
    leans_from_s=float | None, tilt_time_s=float | None, tilt_direction=str | None, collapsed=bool,
    collapse_time_s=float | None, fallen_structures=list[str], leaning_structures=list[str], peak_drift=Drifts,
    residual_drift=Drifts, final_amplitude=Drifts, still_moving=bool, events=list[Event], energy=Energy, solver=Solver,
    versions=Versions, structures=dict[str, Structure], quantities=Quantities, verdict=str, sentence=str,
    made_from=dict, ensemble=optional(Ensemble), column_drift=optional(ColumnDrifts))
TownSummary = table("TownSummary", model=str, verdict=str, verdicts=list[str], collapsed=bool,
                    collapse_time_s=float | None, tilt_time_s=float | None, dt=float, record=Record | None,
                    versions=Versions, events=list[Event], ensemble=optional(Ensemble))
"""Of a town, for sentences and pictures. Times: of the first house that tilts or collapses; events have lots."""


class Summary(Values):
    """Results of a run."""

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
        counts = self.broken, self.joints
        return tuple(count.total for count in counts), tuple(count.wall_sheets or 0 for count in counts)


def _largest(drifts):
    """(drift, storey, 'ns' | 'ew') of the largest of Drifts, zero without any."""
    values = ((value, storey, direction) for storey, pair in drifts.items() for direction, value in pair.items()
              if value is not None)
    return max(values, default=(0.0, "storey1", "ns"))


def parse(text):
    """Summary or TownSummary of a text of JSON. Raises ValueError."""
    entries = json.loads(text)
    kind = TownSummary if isinstance(entries, dict) and "verdicts" in entries else Summary
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
