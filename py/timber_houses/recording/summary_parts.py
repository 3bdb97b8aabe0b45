# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of the summary of a run. Meaning and units of all keys: docs/results.md."""
from dataclasses import dataclass

from ..base.json_types import decode, further, optional

Drifts = dict[str, dict[str, float | None]]  # {storey: {direction: drift [-], None where there is none}}


class Components(dict):
    """{direction: value}, the values also as attributes: `shear.ns`."""

    @classmethod
    def decoded(cls, value, path):
        return cls(decode(dict[str, float], value, path))

    def __getattr__(self, direction):
        if direction not in self:
            raise AttributeError(f"no direction {direction!r}; there are {', '.join(self)}")
        return self[direction]


@dataclass(frozen=True)
class Weight:
    total_kn: float
    snow_kn: float
    floor_area_m2: float
    per_floor_area_kn_m2: float | None
    storeys: dict[str, dict[str, Components]]


@dataclass(frozen=True)
class Diagnosis:
    iw: float | None
    iw_at: str | None
    judgement: str | None
    wall_quantity_ratio: float | None
    wall_quantity_at: str | None
    broken_from_start: int
    structures: dict
    sentence: str
    disagreement: str
    rule: str | None = optional()


@dataclass(frozen=True)
class OtherWalls:
    level: str
    verdict: str
    peak_drift: Drifts


@dataclass(frozen=True)
class Walls:
    level: str
    other: OtherWalls | None


@dataclass(frozen=True)
class PartOfRecord:
    source: str
    start_s: float
    duration_s: float
    scale: float
    pga_gal: Components


@dataclass(frozen=True)
class Record:
    source: str
    pga_gal: Components
    scale: float
    dt: float
    interpolation_error: float
    onset_s: float | None
    note: str | None
    sequence: list[PartOfRecord] | None
    strong_end_s: float | None = optional()


@dataclass(frozen=True)
class ColumnDrifts:
    """Peak drifts at the columns of the main structure: at any of them; of the median over them."""

    largest: Drifts
    median: Drifts


@dataclass(frozen=True)
class Columns:
    total: int
    fallen: int
    loose: int


@dataclass(frozen=True)
class Energy:
    input: float
    kinetic: float
    elastic: float
    dissipated: dict[str, float]
    created: float | None
    residual: float
    residual_fraction: float | None
    ground_motion: float
    gravity_released: float


@dataclass(frozen=True)
class Solver:
    sweeps_mean: float
    sweeps_max: int
    unconverged_steps: int
    worst_change_j: float
    uncarried_overlap_m: float | None = optional()


@dataclass(frozen=True)
class Versions:
    yade: str
    package: str


@dataclass(frozen=True)
class Mode:
    period_s: float | None
    direction: str
    mass_share: Components
    shape: dict[str, Components]


@dataclass(frozen=True)
class ModesAt:
    time_s: float
    modes: list[Mode]


@dataclass(frozen=True)
class Shear:
    sustained: Components
    peak: Components


@dataclass(frozen=True)
class StoreyQuantities:
    mass_above_kg: float
    shear: Shear
    shear_coefficient: dict[str, float | None]
    acceleration: Components


@dataclass(frozen=True)
class LargestUtilisation:
    joint: str
    value: float


@dataclass(frozen=True)
class LargestForce:
    joint: str
    force: float


@dataclass(frozen=True)
class LargestUplift:
    column: str
    uplift_m: float


@dataclass(frozen=True)
class Ensemble:
    run: int
    runs: int
    outcomes: dict[str, int]
    peak_drift_standing: list[float] | None


@dataclass(frozen=True)
class Modes:
    before: ModesAt | None
    after: ModesAt | None


@dataclass(frozen=True)
class Quantities:
    until_s: float | None
    modes: Modes
    mass_kg: float
    base_shear: Shear
    acceleration_band_hz: list[float]
    ground_acceleration: Components
    storeys: dict[str, StoreyQuantities]
    largest_utilisation: LargestUtilisation | None
    largest_pull: LargestForce | None
    largest_shear: LargestForce | None
    largest_uplift: LargestUplift | None


@dataclass(frozen=True)
class JointCounts:
    """total: without those of walls; others: other kinds that occur. Sheets: None in a house without walls."""

    total: int
    column_beam: int
    brace_beam: int
    others: dict[str, int] = further()
    wall_sheets: int | None = optional()


@dataclass(frozen=True)
class Broken:
    total: int
    column_beam: int
    brace_beam: int
    by_side: dict[str, int]
    by_storey: dict[str, int]
    by_place: dict[str, dict[str, JointCounts]]
    partly_broken: int
    springs: int
    damaged_at_start: JointCounts
    others: dict[str, int] = further()
    wall_sheets: int | None = optional()
    wall_sheets_partly: int | None = optional()
