# SPDX-License-Identifier: GPL-2.0-or-later
"""A three-component ground acceleration in the axes of the house, and its units."""
import warnings
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

import numpy as np

from ..base.atomic_write import write_text
from ..base.errors import InputError
from ..base.input_file import shown

GAL = 0.01  # one gal (cm/s2) in m/s2
STANDARD_GRAVITY = 9.80665  # one g in m/s2 (the unit of PEER records)
UNITS = {"gal": GAL, "cm/s2": GAL, "cm/s/s": GAL, "cm/s^2": GAL, "cm/sec2": GAL, "cm/sec/sec": GAL, "m/s2": 1.0,
         "m/s/s": 1.0, "m/s^2": 1.0, "g": STANDARD_GRAVITY}
"""Known spellings of acceleration units and their size in m/s2."""
WEAK = 0.01 * GAL, 10 * GAL  # peaks that are none of an earthquake, but usual numbers in m/s2 or g. [m/s2]
MAX_ACCELERATION = 1e3  # largest acceleration of a ground motion. [m/s2] The largest recorded ones are below 50.


class RecordError(InputError):
    """A record that cannot be used; the message is one line: file:line: member: problem; admissible range; remedy."""


class RecordWarning(UserWarning):
    """A usable record that contradicts its own header, exceeds recorded motions or is too weak for any house."""


@dataclass(frozen=True)
class GroundMotion:
    """Ground acceleration sampled at equal steps.

    Parameters
    ----------
    dt : float
        Time step. [s]
    acceleration : (n, 3) array_like
        [m/s2], columns ew, ns, ud: positive towards east, north and up.
    name : str
        Short name.
    source : str
        Files or generator, mapping of the components, processing.
    begins : datetime, optional
        Date and time of the first sample, where the record states it (K-NET, JMA: Japan Standard Time).
    parts : tuple of Part
        Of a sequence: its motions; else empty.

    Raises
    ------
    RecordError
        For dt <= 0, a wrong shape or a value that is not finite.
    """

    dt: float
    acceleration: np.ndarray = field(repr=False)
    name: str = "motion"
    source: str = ""
    begins: datetime | None = None
    parts: tuple = ()

    def __post_init__(self):
        acceleration = np.array(self.acceleration, dtype=float)
        if not (np.isfinite(self.dt) and self.dt > 0.0):
            raise RecordError(f"{self.name}: time step {self.dt} s; it must be finite and > 0")
        if acceleration.ndim != 2 or acceleration.shape[1] != 3 or len(acceleration) < 2:
            raise RecordError(f"{self.name}: acceleration of shape {acceleration.shape}; it must be (n, 3) with n >= 2")
        bad = np.flatnonzero(~np.isfinite(acceleration).all(axis=1))
        if bad.size:
            raise RecordError(f"{self.name}: sample {bad[0]} is not finite; every sample must be a number")
        require_possible(np.abs(acceleration).max(), self.name)
        acceleration.setflags(write=False)
        object.__setattr__(self, "acceleration", acceleration)

    def __len__(self):
        return len(self.acceleration)

    @property
    def duration(self):
        """Number of samples times the time step. [s]"""
        return len(self) * self.dt

    @property
    def time(self):
        """Times of the samples, from zero. (n,) [s]"""
        return np.arange(len(self)) * self.dt

    @property
    def ew(self):
        """East-west component, positive towards east. (n,) [m/s2]"""
        return self.acceleration[:, 0]

    @property
    def ns(self):
        """North-south component, positive towards north. (n,) [m/s2]"""
        return self.acceleration[:, 1]

    @property
    def ud(self):
        """Vertical component, positive upwards. (n,) [m/s2]"""
        return self.acceleration[:, 2]

    @property
    def pga_gal(self):
        """Largest absolute acceleration of each component: {'ns', 'ew', 'ud'}. [gal]"""
        return peaks_gal(self.acceleration)


def interpolated(times, places, columns):
    """(m, k) values at `times` on straight lines between columns (n, k) at `places`."""
    return np.column_stack([np.interp(times, places, column) for column in columns.T])


def subdivided(columns, parts):
    """Each step of (n, k) samples cut into `parts` equal ones along straight lines."""
    if parts == 1:
        return columns
    return interpolated(np.arange((len(columns) - 1) * parts + 1) / parts, np.arange(len(columns)), columns)


def peaks_gal(acceleration):
    """Largest absolute values of (n, 3) accelerations east, north, up [m/s2]: {'ns', 'ew', 'ud'}. [gal]"""
    peak = np.abs(acceleration).max(axis=0) / GAL
    return {"ns": float(peak[1]), "ew": float(peak[0]), "ud": float(peak[2])}


def require_possible(peak, where):
    """Refuse a peak acceleration [m/s2] that no ground motion has."""
    if not peak <= MAX_ACCELERATION:
        raise RecordError(f"{where}: accelerations of up to {peak:.3g} m/s2; at most {MAX_ACCELERATION:g} m/s2; check"
                          " the unit and the scale")


def warn_of_weak_motion(motion, scale=1.0):
    """Warn of a peak that is none of an earthquake but a number in another unit. scale: factor [-]"""
    peak = scale * float(np.abs(motion.acceleration).max())
    if WEAK[0] <= peak < WEAK[1]:
        number = peak / GAL
        warnings.warn(f"{motion.name}: peak {number:.2g} gal, too weak for any damage; did you mean {number:.2g} m/s2"
                      f" ({number / GAL:.0f} gal) or {number:.2g} g ({number * STANDARD_GRAVITY / GAL:.0f} gal)?",
                      RecordWarning, stacklevel=3)


# --- constant part: the zero error of a sensor, or gravity; it acts like a lean or like another weight ----------------

LARGEST_SHARE = 0.02
"""Largest mean of a component that needs no warning, as a share of its peak; that of recorded motions is below 0.01 %
as published, below 1 % in parts of a few seconds. [-]"""
VISIBLE = 1e-3  # smaller means, as a share of the largest acceleration of all components, are noise. [-]
ROUNDING = 1e-9  # what is left of a constant part that was removed. [m/s2]
CONSTANT_AXES = (("N-S", 1, "a lean"), ("E-W", 0, "a lean"), ("up-down", 2, "a change of weight"))
"""Name, column of the accelerations, effect."""


def constant_note(motion, scale=1.0):
    """'constant part of 60 gal N-S (17 % of the peak) acts like a lean of 6.12 %; ...', or ''. scale: factor [-]"""
    pieces = [motion.acceleration]  # of a sequence those of each motion
    if motion.parts:
        ranges = ((round(part.start / motion.dt), round((part.start + part.duration) / motion.dt))
                  for part in motion.parts)
        pieces = [motion.acceleration[first:end] for first, end in ranges if end > first]
    texts = max((list(_constant_texts(samples, scale)) for samples in pieces), key=len, default=[])
    return f"constant part of {', '.join(texts)}; --detrend 0 removes it" if texts else ""


def warn_of_constant_part(motion):
    """Warn when a motion has one; returns the motion."""
    note = constant_note(motion)
    if note:
        warnings.warn(f"{motion.name}: {note}", RecordWarning, stacklevel=3)
    return motion


def _constant_texts(samples, scale):
    means, peaks = scale * samples.mean(axis=0), np.abs(scale * samples).max(axis=0)
    for name, k, effect in CONSTANT_AXES:
        if abs(means[k]) > max(LARGEST_SHARE * peaks[k], VISIBLE * peaks.max(), ROUNDING):
            share, strength = abs(means[k]) / peaks[k], abs(means[k]) / STANDARD_GRAVITY
            gal = means[k] / GAL
            yield (f"{gal:{'.0f' if abs(gal) >= 100 else '.3g'}} gal {name} ({100 * share:.0f} % of the peak) acts like"
                   f" {effect} of {100 * strength:.3g} %")


# --- units and files --------------------------------------------------------------------------------------------------


def unit_factor(unit, where):
    """Size of an acceleration unit in m/s2; `where` (file, line) opens the message of RecordError."""
    key = unit.strip().lower().replace(" ", "").strip("()[]")
    if key not in UNITS:
        raise RecordError(f"{where}: unknown unit {shown(unit)}; admissible: {', '.join(UNITS)}")
    return UNITS[key]


DECIMALS = 2
"""Decimals of the written gal. The rounding, 0.005 gal, shifts the velocity of 40 s by less than 0.02 cm/s."""


def write_csv(motion, path, comments=()):
    """Write `motion` in gal with named columns, whole or not at all. comments: of the header. Raises RecordError."""
    path = Path(path)
    header = [*comments, "units: gal", f"dt: {motion.dt:.10g}", f"samples: {len(motion)}"]
    lines = [f"# {line}" for line in header] + ["ns,ew,ud"]
    rounded = (motion.acceleration[:, [1, 0, 2]] / GAL).tolist()
    lines += [",".join(f"{round(value, DECIMALS) + 0.0}".removesuffix(".0") for value in row) for row in rounded]
    try:
        write_text(path, "\n".join(lines) + "\n")
    except OSError as error:
        raise RecordError(f"{path}: cannot be written ({error.strerror}); give a folder that exists") from None
