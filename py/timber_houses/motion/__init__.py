# SPDX-License-Identifier: GPL-2.0-or-later
"""Ground motion: readers, processing, measures, synthetic motion. Columns ew, ns, ud = x east, y north, z up; m/s2."""
from .measures import (JmaIntensity, Spectrum, arias, displacement, jma_intensity, onset, pga, pgd, pgv,
                       response_spectrum, significant_duration, velocity)
from .processing import (highpass, interpolation_error, remove_polynomial, resample, scaled, scaled_to_intensity,
                         scaled_to_pga, shaking_window, trim, turned)
from .readers import DEFAULT_RECORD, default_motion, read_motion
from .record import GAL, GroundMotion, RecordError, RecordWarning, constant_note, write_csv
from .request import MotionRequest, add_motion_options, motion_request
from .sequence import joined, with_then
from .synthetic import synthetic_motion

__all__ = ["DEFAULT_RECORD", "GAL", "GroundMotion", "JmaIntensity", "MotionRequest", "RecordError", "RecordWarning",
           "Spectrum", "add_motion_options", "arias", "constant_note", "default_motion", "displacement", "highpass",
           "interpolation_error", "jma_intensity", "joined", "motion_request", "onset", "pga", "pgd", "pgv",
           "read_motion", "remove_polynomial", "resample", "response_spectrum", "scaled", "scaled_to_intensity",
           "scaled_to_pga", "shaking_window", "significant_duration", "synthetic_motion", "trim", "turned", "velocity",
           "with_then", "write_csv"]
