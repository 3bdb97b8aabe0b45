# SPDX-License-Identifier: GPL-2.0-or-later
"""The high-pass filter of baseline correction, velocities and displacements."""
import math

import numpy as np
import scipy  # submodules (27 MB) load on first use; a plain run needs none

from .record import RecordError

MAX_RESULT = 5_000_000  # samples of one component, transients included, in a processed motion: 45 s at 1e-5 s
PADDING = 1.5  # zeros for the transients of a high-pass, before and after the motion, each times its corner. [-]


def zero_phase_highpass(acceleration, dt, corner, order):
    """High-pass of (n, k) samples along the first axis, padded for the transients."""
    padded, pad = highpass_with_ends(acceleration, dt, corner, order)
    return padded[pad:-pad]


def require_size(samples, member):
    """Refuse a result of more than MAX_RESULT samples."""
    if samples > MAX_RESULT:
        raise RecordError(f"{member}: {samples:.3g} samples; at most {MAX_RESULT:g}; take a larger time step or a"
                          " shorter motion")


def highpass_with_ends(acceleration, dt, corner, order):
    """The same with the transients before and after: (n + 2 pad, k) samples, and pad."""
    if not 0.0 < corner < 0.5 / dt:
        raise RecordError(f"high-pass corner {corner:g} Hz; it must lie between 0 and {0.5 / dt:g} Hz")
    pad = math.ceil(PADDING / (corner * dt))
    require_size(len(acceleration) + 2 * pad, f"high-pass at {corner:g} Hz")
    padded = np.pad(acceleration, ((pad, pad), (0, 0)))
    sos = scipy.signal.butter(order, corner, "highpass", fs=1.0 / dt, output="sos")
    return scipy.signal.sosfiltfilt(sos, padded, axis=0, padtype=None), pad
