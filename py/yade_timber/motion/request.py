# SPDX-License-Identifier: GPL-2.0-or-later
"""Request for a ground motion: the same names for command-line options and for columns of batch tables."""

import math
from dataclasses import dataclass, field, fields

import numpy as np

from ..base.input_file import shown
from .constant_part import warn_of_constant_part
from .processing import highpass, remove_polynomial, resample, scaled_to_intensity, scaled_to_pga, trim, turned
from .readers import DEFAULT_RECORD, read_unchecked
from .record import RecordError, require_possible
from .sequence import DEFAULT_GAP, following, joined
from .synthetic import DEFAULT_SEED, synthetic_motion


def _option(kind, metavar, text, low=None, high=None):
    """Field of MotionRequest, None unless given; low, high: admissible range of a number, both included."""
    return field(default=None, metadata={"kind": kind, "metavar": metavar, "low": low, "high": high, "help": text})


@dataclass(frozen=True)
class MotionRequest:
    """Source and processing of a ground motion; None: not requested. Processing follows the order of the fields.

    `scale` is applied by the run, which records it beside the motion.
    """

    record: str = _option(
        str, "FILE_OR_PREFIX", "recorded ground motion: K-NET, KiK-net (ASCII, CSV), PEER AT2, JMA CSV, plain CSV; "
        "a file, a prefix, or files separated by commas (default: synthetic, like Ojiya 2004)"
    )
    seed: int = _option(int, "N", f"synthetic motion of another seed (the default motion is seed {DEFAULT_SEED})", 0, 2**31)
    component: str = _option(
        str, "DIRECTIONS", "direction of each of the record's files, where they do not state it: ns, ew, ud or azimuth, separated by commas"
    )
    units: str = _option(str, "UNIT", "unit of the record where it states none: gal, m/s2 or g")
    shortest: bool = _option(bool, None, "cut components of different length at the shortest one instead of refusing them")
    azimuth: float = _option(
        float, "DEG", "direction of the record's north in the house's axes [degrees], clockwise from +y; "
        "with 90 the north component acts along +x (default 0)", -360, 360
    )
    start: float = _option(float, "S", "remove the record before this time [s]", 0, 1e5)
    end: float = _option(float, "S", "remove the record after this time [s]", 0, 1e5)
    detrend: int = _option(int, "ORDER", "baseline: subtract a polynomial of this order from the accelerations (0: the mean)", 0, 8)
    highpass: float = _option(float, "HZ", "baseline: zero-phase high-pass at this frequency [Hz]", 1e-3, 100)
    pga: float = _option(float, "GAL", "scale all components to this peak of the larger horizontal one [gal]", 1e-3, 1e5)
    intensity: float = _option(float, "I", "scale all components to this JMA intensity (not rounded)", 0, 8)
    scale: float = _option(float, "X", "factor on the ground motion (default 1)", 0, 1e6)
    resample: bool = _option(bool, None, "resample at the run's time step, band-limited, instead of linear interpolation between the record's samples")
    then: str = _option(
        str, "RECORDS", "records that follow, as a main shock after a foreshock: record or record@factor, separated by ; "
        "all other options apply to each of them, too"
    )
    gap: float = _option(float, "S", f"quiet between the records of a sequence [s] (default {DEFAULT_GAP:g})", 0, 1000)

    def given(self):
        """Names of the requested fields."""
        return [f.name for f in fields(self) if getattr(self, f.name) is not None and getattr(self, f.name) is not False]

    def check(self, name="--{}"):
        """Raise RecordError for values out of range and contradictions; `name`: format of a field's name in messages."""
        for f in fields(self):
            value, low, high = getattr(self, f.name), f.metadata["low"], f.metadata["high"]
            if value is not None and low is not None and not low <= value <= high:
                raise RecordError(f"{name.format(f.name)} {_shown(value)}: must be {_range(value, low, high)}; {f.metadata['help']}")
        for one, other in (("record", "seed"), ("pga", "intensity"), ("pga", "scale"), ("intensity", "scale")):
            if getattr(self, one) is not None and getattr(self, other) is not None:
                raise RecordError(f"{name.format(one)} and {name.format(other)} exclude each other; give one of them")
        for only in ("component", "units", "shortest"):
            if getattr(self, only) and self.record is None and self.then is None:
                raise RecordError(f"{name.format(only)} belongs to a record; give {name.format('record')}, too")
        if self.gap is not None and self.then is None:
            raise RecordError(f"{name.format('gap')} belongs to a sequence; give {name.format('then')}, too")
        if self.then is not None:
            following(self.then, name.format("then"))
        if self.end is not None and self.end <= (self.start or 0.0):
            raise RecordError(f"{name.format('end')} {self.end:g}: must be > {self.start or 0:g} s, where the motion starts")

    def motion(self, dt, given=None):
        """The requested GroundMotion, before `scale`. dt [s]: time step for `resample`; given: GroundMotion in place of a record. Raises RecordError."""
        first = self._processed(self._source() if given is None else turned(given, self.azimuth or 0.0), dt)
        if self.then is None:
            return first
        records, factors = zip(*following(self.then, "--then"))
        motions = [first, *(self._processed(self._read(record), dt) for record in records)]
        sequence = joined(motions, [1.0, *factors], DEFAULT_GAP if self.gap is None else self.gap)
        self._require_possible(sequence)
        return sequence

    def _processed(self, motion, dt):
        if self.start is not None or self.end is not None:
            motion = trim(motion, self.start or 0.0, self.end)
        if self.detrend is not None:
            motion = remove_polynomial(motion, self.detrend)
        if self.highpass is not None:
            motion = highpass(motion, self.highpass)
        if self.pga is not None:
            motion = scaled_to_pga(motion, self.pga, "level")
        if self.intensity is not None:
            motion = scaled_to_intensity(motion, self.intensity)
        self._require_possible(motion)
        warn_of_constant_part(motion)
        return resample(motion, dt)[0] if self.resample else motion

    def _source(self):
        if self.seed is not None:
            return turned(synthetic_motion(self.seed), self.azimuth or 0.0)
        return self._read(DEFAULT_RECORD if self.record is None else self.record)

    def _read(self, record):
        return read_unchecked(record, self.component, self.units, self.azimuth or 0.0, bool(self.shortest))

    def _require_possible(self, motion):
        require_possible(np.abs(motion.acceleration).max() * (1.0 if self.scale is None else self.scale), motion.name)


def _shown(value):
    return shown(value) if isinstance(value, int) else f"{value:g}"


def _range(value, low, high):
    beyond = high < value < math.inf
    return f">= {low:g}" if high >= 1e5 and not beyond else f"between {low:g} and {high:g}"


def add_motion_options(parser):
    """Give an ArgumentParser one option for each field of MotionRequest."""
    group = parser.add_argument_group("ground motion")
    for f in fields(MotionRequest):
        about = {"help": f.metadata["help"]}
        if f.metadata["kind"] is bool:
            group.add_argument(f"--{f.name}", action="store_true", **about)
        else:
            group.add_argument(f"--{f.name}", type=f.metadata["kind"], metavar=f.metadata["metavar"], **about)


def motion_request(given):
    """MotionRequest, checked, from parsed options (argparse.Namespace). Raises RecordError."""
    request = MotionRequest(**{f.name: getattr(given, f.name) for f in fields(MotionRequest)})
    request.check()
    return request
