# SPDX-License-Identifier: GPL-2.0-or-later
"""Sequences: several ground motions one after the other, as a foreshock and a main shock, with quiet between them."""
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

import numpy as np

from .measures import require_size
from .record import GroundMotion, RecordError, subdivided

DEFAULT_GAP = 5.0  # quiet between two motions of a sequence. [s]
DENOMINATOR = 100_000  # largest denominator of a time step as a fraction of a second


@dataclass(frozen=True)
class Part:
    """One motion of a sequence. start, duration [s]; scale: own factor [-]; pga_gal: {'ns', 'ew', 'ud'} after it; dt:
    own time step [s]."""

    source: str
    start: float
    duration: float
    scale: float
    pga_gal: dict
    dt: float


def joined(motions, scales, gap=DEFAULT_GAP):
    """One GroundMotion of several, times their factors, with `gap` seconds of quiet between; `parts` has their data.
    The step is the largest that divides all steps, which keeps the straight lines. RecordError where there is none."""
    step = common_step([motion.dt for motion in motions], " and ".join(motion.name for motion in motions))
    quiet = np.zeros((round(gap / step), 3))
    pieces, parts, start = [], [], 0.0
    for motion, scale in zip(motions, scales):
        samples = scale * subdivided(motion.acceleration, round(motion.dt / step))
        if pieces:
            pieces.append(quiet)
            start += len(quiet) * step
        pga = {axis: abs(scale) * value for axis, value in motion.pga_gal.items()}
        parts.append(Part(motion.source or motion.name, start, len(samples) * step, scale, pga, motion.dt))
        pieces.append(samples)
        start += len(samples) * step
    require_size(sum(map(len, pieces)), "the sequence")
    return GroundMotion(step, np.vstack(pieces), " then ".join(motion.name for motion in motions),
                        f"; then after {gap:g} s: ".join(part.source for part in parts), motions[0].begins,
                        tuple(parts))


def common_step(steps, where):
    """Largest time step [s] of which all steps are multiples."""
    if len(set(steps)) == 1:
        return steps[0]
    fractions = [Fraction(step).limit_denominator(DENOMINATOR) for step in steps]
    whole = [abs(float(fraction) - step) <= 1e-9 * step for fraction, step in zip(fractions, steps)]
    common = Fraction(gcd(*(f.numerator for f in fractions)), lcm(*(f.denominator for f in fractions)))
    if not all(whole) or min(steps) > 100 * common:
        raise RecordError(f"{where}: time steps of {', '.join(f'{step:g}' for step in steps)} s have no common step;"
                          " give --resample")
    return float(common)


def with_factor(entry):
    """'B@0.8' -> ('B', 0.8); 'B', 'me@host/B' -> (the same, 1.0). A factor that is no number is returned as -1."""
    record, sign, factor = entry.strip().rpartition("@")
    if not sign or "/" in factor:
        return entry.strip(), 1.0
    try:
        return record, float(factor)
    except ValueError:
        return record, -1.0


def following(text, name):
    """'B@0.8; C' -> [('B', 0.8), ('C', 1.0)]: records with their own factors. name: of the option"""
    records = []
    for entry in text.split(";"):
        record, value = with_factor(entry)
        if not record or not 0 < value <= 1e6:
            raise RecordError(f"{name} '{entry.strip()}': write a record, or record@factor with a factor in (0, 1e6];"
                              " records are separated by ;")
        records.append((record, value))
    return records


def with_then(arguments):
    """Arguments of a command line with '--record A then B then C' written as '--record A --then B;C'."""
    rest, records, words = [], [], iter(arguments)
    for word in words:
        if word == "then" and rest:
            records.append(next(words, ""))
        else:
            rest.append(word)
    return [*rest, "--then", ";".join(records)] if records else rest
