# SPDX-License-Identifier: GPL-2.0-or-later
"""Ground motion: reading records, changing them on request, measuring them, and a seeded synthetic one.

Needs numpy and scipy only, never YADE. Frame everywhere: columns ew, ns, ud = x east, y north, z up; m/s2.
"""

from pathlib import Path

from .measures import (
    JmaIntensity,
    Spectrum,
    arias,
    displacement,
    jma_intensity,
    pga,
    pgd,
    pgv,
    response_spectrum,
    significant_duration,
    velocity,
)
from .processing import (
    highpass,
    remove_polynomial,
    resample,
    scaled,
    scaled_to_intensity,
    scaled_to_pga,
    shaking_window,
    trim,
)
from .readers import read_motion
from .record import GAL, GroundMotion, RecordError, RecordWarning
from .synthetic import synthetic_motion
from .writer import write_csv

DEFAULT_RECORD = Path(__file__).resolve().parent.parent / "data" / "ojiya_like.csv"
"""The synthetic Ojiya-like motion that the package ships: output of the generator for seed 0."""


def default_motion():
    """The shipped synthetic Ojiya-like motion -> GroundMotion."""
    return read_motion(DEFAULT_RECORD)


__all__ = [
    "DEFAULT_RECORD",
    "GAL",
    "GroundMotion",
    "JmaIntensity",
    "RecordError",
    "RecordWarning",
    "Spectrum",
    "arias",
    "default_motion",
    "displacement",
    "highpass",
    "jma_intensity",
    "pga",
    "pgd",
    "pgv",
    "read_motion",
    "remove_polynomial",
    "resample",
    "response_spectrum",
    "scaled",
    "scaled_to_intensity",
    "scaled_to_pga",
    "shaking_window",
    "significant_duration",
    "synthetic_motion",
    "trim",
    "velocity",
    "write_csv",
]
