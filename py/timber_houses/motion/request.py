# SPDX-License-Identifier: GPL-2.0-or-later
"""Request for a ground motion: source and processing as options."""
from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from ..base.errors import InputError
from ..base.options import add_options, check_ranges, command_option, is_given, option, options, read_arguments
from .processing import highpass, remove_polynomial, resample, scaled_to_intensity, scaled_to_pga, trim, turned
from .readers import DEFAULT_RECORD, read_unchecked
from .record import RecordError, require_possible, warn_of_constant_part, warn_of_weak_motion
from .sequence import DEFAULT_GAP, following, joined
from .synthetic import DEFAULT_SEED, synthetic_motion


@dataclass(frozen=True)
class MotionRequest:
    """Source and processing of a ground motion, in the order of the fields; None: none. The run applies `scale`."""

    record: str = option(str, "recorded motion: file, prefix, or files with commas", "FILE", group="main")
    seed: int = option(int, f"synthetic motion of another seed (the default motion is seed {DEFAULT_SEED})", "N", 0,
                       2**31)
    component: str = option(str, "direction of each of the record's files, where they do not state it: ns, ew, ud or"
                            " azimuth, separated by commas", "DIRECTIONS")
    units: str = option(str, "unit of the record where it states none: gal, m/s2 or g", "UNIT")
    shortest: bool = option(bool, "cut components of different length at the shortest one instead of refusing them")
    azimuth: float = option(
        float, "direction of the record's north in the house's axes [degrees], clockwise from +y; "
        "with 90 the north component acts along +x (default 0)", "DEG", -360, 360)
    start: float = option(float, "remove the record before this time [s]", "S", 0, 1e5)
    end: float = option(float, "remove the record after this time [s]", "S", 0, 1e5)
    detrend: int = option(int, "baseline: subtract a polynomial of this order from the accelerations (0: the mean)",
                          "ORDER", 0, 8)
    highpass: float = option(float, "baseline: zero-phase high-pass at this frequency [Hz]", "HZ", 1e-3, 100)
    pga: float = option(float, "scale all components to this peak of the larger horizontal one [gal]", "GAL", 1e-3, 1e5)
    intensity: float = option(float, "scale all components to this JMA intensity (not rounded)", "I", 0, 8)
    scale: float = option(float, "factor on the ground motion (default 1)", "X", 0, 1e6)
    resample: bool = option(bool, "resample at the run's time step, band-limited, instead of linear interpolation"
                            " between the record's samples")
    then: str = option(
        str, "records that follow, as a main shock after a foreshock: record or record@factor, separated by ; "
        "all other options apply to each of them, too", "RECORDS")
    gap: float = option(float, f"quiet between the records of a sequence [s] (default {DEFAULT_GAP:g})", "S", 0, 1000)

    error: ClassVar[type[InputError]] = RecordError  # raised by `check`

    @property
    def factor(self):
        """`scale`, or its default. [-]"""
        return 1.0 if self.scale is None else self.scale

    def given(self):
        """Names of the requested options of the ground motion."""
        return [name for name in options(MotionRequest) if is_given(self, name)]

    def check(self, name=command_option):
        """Raise `error` for values out of range and contradictions. name: function that names an option in messages"""
        check_ranges(self, name, self.error)
        for one, other in (("record", "seed"), ("pga", "intensity"), ("pga", "scale"), ("intensity", "scale")):
            if is_given(self, one) and is_given(self, other):
                raise self.error(f"{name(one)} and {name(other)} exclude each other; give one of them")
        for only in ("component", "units", "shortest"):
            if is_given(self, only) and self.record is None and self.then is None:
                raise self.error(f"{name(only)} belongs to a record; give {name('record')}, too")
        if self.gap is not None and self.then is None:
            raise self.error(f"{name('gap')} belongs to a sequence; give {name('then')}, too")
        if self.then is not None:
            following(self.then, name("then"))
        if self.end is not None and self.end <= (self.start or 0.0):
            raise self.error(f"{name('end')} {self.end:g}: must be > {self.start or 0:g} s, where the motion starts")

    def motion(self, dt, measured=None):
        """GroundMotion before `scale`. dt [s]: for `resample`; measured: instead of a record. Raises RecordError."""
        if measured is not None and self.seed is not None:
            raise RecordError("seed: a GroundMotion is given; leave one of them out")
        if self.seed is not None:
            measured = synthetic_motion(self.seed)
        first = self._processed(self._read(DEFAULT_RECORD if self.record is None else self.record) if measured is None
                                else turned(measured, self.azimuth or 0.0), dt)
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
        for change, value in ((remove_polynomial, self.detrend), (highpass, self.highpass),
                              (partial(scaled_to_pga, component="level"), self.pga),
                              (scaled_to_intensity, self.intensity)):
            motion = motion if value is None else change(motion, value)
        self._require_possible(motion)
        warn_of_weak_motion(motion, self.factor)
        warn_of_constant_part(motion)
        return resample(motion, dt)[0] if self.resample else motion

    def _read(self, record):
        return read_unchecked(record, self.component, self.units, self.azimuth or 0.0, self.shortest)

    def _require_possible(self, motion):
        require_possible(np.abs(motion.acceleration).max() * self.factor, motion.name)


def add_motion_options(parser):
    """Give an ArgumentParser the options of MotionRequest."""
    add_options(parser.add_argument_group("ground motion"), options(MotionRequest).values())


def motion_request(arguments):
    """MotionRequest, checked, of a command line (argparse.Namespace). Raises RecordError, RunError."""
    request = MotionRequest(**read_arguments(MotionRequest, arguments))
    request.check()
    return request
