# SPDX-License-Identifier: GPL-2.0-or-later
"""Constant part of a motion: the zero error of a sensor, or gravity; it acts like a lean or like another weight.

The mean of a recorded motion is below 0.01 % of the peak as published, below 1 % in parts of a few seconds."""
import warnings

import numpy as np

from .record import GAL, STANDARD_GRAVITY, RecordWarning

LARGEST_SHARE = 0.02  # largest mean of a component that needs no warning, as a share of its peak. [-]
VISIBLE = 1e-3  # smaller means, as a share of the largest acceleration of all components, are noise. [-]
ROUNDING = 1e-9  # what is left of a constant part that was removed. [m/s2]
REMEDY = "--detrend 0 removes it"
AXES = (("N-S", 1, "a lean"), ("E-W", 0, "a lean"), ("up-down", 2, "a change of weight"))
"""Name, column of the accelerations, effect."""


def constant_note(motion, scale=1.0):
    """'constant part of 60 gal N-S (17 % of the peak) acts like a lean of 6.12 %; ...', or ''. scale: factor [-]"""
    pieces = [motion.acceleration]  # of a sequence those of each motion
    if motion.parts:
        ranges = ((round(part.start / motion.dt), round((part.start + part.duration) / motion.dt))
                  for part in motion.parts)
        pieces = [motion.acceleration[first:end] for first, end in ranges if end > first]
    texts = max((list(_texts(samples, scale)) for samples in pieces), key=len, default=[])
    return f"constant part of {', '.join(texts)}; {REMEDY}" if texts else ""


def warn_of_constant_part(motion):
    """Warn when a motion has one; returns the motion."""
    note = constant_note(motion)
    if note:
        warnings.warn(f"{motion.name}: {note}", RecordWarning, stacklevel=3)
    return motion


def _texts(samples, scale):
    means, peaks = scale * samples.mean(axis=0), np.abs(scale * samples).max(axis=0)
    for name, k, effect in AXES:
        if abs(means[k]) > max(LARGEST_SHARE * peaks[k], VISIBLE * peaks.max(), ROUNDING):
            share, strength = abs(means[k]) / peaks[k], abs(means[k]) / STANDARD_GRAVITY
            gal = means[k] / GAL
            yield (f"{gal:{'.0f' if abs(gal) >= 100 else '.3g'}} gal {name} ({100 * share:.0f} % of the peak) acts like"
                   f" {effect} of {100 * strength:.3g} %")
