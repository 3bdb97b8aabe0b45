# SPDX-License-Identifier: GPL-2.0-or-later
"""Drifts of a run: the residual drift, the amplitude of the motion that is left, the start of a lean."""
import numpy as np

from .history import DIRECTIONS

SHORT_WINDOW = 1.0
"""Last part of a run without a whole period of oscillation, over which the residual drift is averaged. [s]"""
SLOW_WINDOW = 5.0  # last part of such a run that gives the amplitude, about the period of a swinging wreck. [s]
WINDOWS = (2.0, 4.0, 8.0, 16.0)  # last parts of a run in which two periods' ends are searched, the shortest first. [s]
AVERAGED = 2.0  # the last whole periods that make up this time, at least one, are averaged: slow swings decay. [s]
HYSTERESIS = 0.25  # a zero crossing counts after an excursion to the other side by this share of half the range. [-]
RECENT = 1.2  # the last whole period must end at most this many periods before the end of the run. [-]
MOVING_AMPLITUDE = 1e-3  # a house whose drift oscillates by more at the end is still moving. [-]


def residual(history):
    """([residual drift], [amplitude at the end]), each ns1, ew1, ns2, ew2, ... [-]; empty lists without samples.

    Residual drift: absolute mean over the last whole periods of oscillation, so that it does not depend on the phase at
    the end; without a whole period the mean of the last SHORT_WINDOW. Amplitude: half the range of the drift in the
    same periods, or in the last SLOW_WINDOW."""
    if not history.samples:
        return [], []
    residuals, amplitudes, time = [], [], history.time
    for _, _, values in history.drifts():
        periods = last_periods(time, values)
        averaged = slice(start_of(time, SHORT_WINDOW), None) if periods is None else periods
        moving = slice(start_of(time, SLOW_WINDOW), None) if periods is None else periods
        residuals.append(float(abs(values[averaged].mean())))
        amplitudes.append(float(np.ptp(values[moving]) / 2))
    return residuals, amplitudes


def last_periods(time, values):
    """Slice of the samples of the last whole periods, None when there is no whole period."""
    for window in WINDOWS:
        first = start_of(time, window)
        crossings = first + upward_crossings(values[first:])
        if len(crossings) > 1 and time[-1] - time[crossings[-1]] < RECENT * np.diff(time[crossings]).max():
            enough = np.flatnonzero(time[crossings[-1]] - time[crossings[:-1]] >= AVERAGED)
            return slice(crossings[enough[-1] if len(enough) else 0], crossings[-1])
        if first == 0:
            break
    return None


def start_of(time, window):
    """Index of the first sample less than `window` [s] before the last one."""
    return int(np.searchsorted(time, time[-1] - window, side="right"))


def upward_crossings(values):
    """(n,) samples that pass the mean upwards, after an excursion below it by HYSTERESIS of half the range."""
    centred = values - values.mean()
    beyond = np.flatnonzero(np.abs(centred) > HYSTERESIS * np.ptp(values) / 2)
    below = centred[beyond] < 0
    returns = beyond[1:][below[:-1] & ~below[1:]]  # first samples above, after excursions below
    negative = np.flatnonzero(centred < 0)
    return negative[np.searchsorted(negative, returns) - 1] + 1


def still_moving(amplitudes):
    """Whether any amplitude at the end [-] exceeds MOVING_AMPLITUDE."""
    return any(amplitude > MOVING_AMPLITUDE for amplitude in amplitudes)


def has_settled(residuals, amplitudes):
    """Whether the drift at the end is a residual one: the largest amplitude is below it, or below MOVING_AMPLITUDE."""
    return not still_moving(amplitudes) or max(amplitudes) < max(residuals)


def by_storey(values):
    """{'storey1': {'ns', 'ew'}, ...} from [ns1, ew1, ns2, ...]; at least two storeys, None without a value."""
    values = [float(value) if np.isfinite(value) else None for value in values]
    pairs = list(zip(values[::2], values[1::2])) + [(None, None)] * (2 - len(values) // 2)
    return {f"storey{k}": dict(zip(DIRECTIONS, pair)) for k, pair in enumerate(pairs, 1)}


def lean_start(history, tilt_time, direction):
    """Start of the lean that tilted a storey at `tilt_time` [s]: last sample of another sign, or 0; else None. [s]"""
    if tilt_time is None:
        return None
    last = int(np.searchsorted(history.time, tilt_time, side="right"))
    drift = max((history.drift(storey, direction)[:last] for storey in history.storeys),
                key=lambda values: abs(values[-1]))
    opposite = np.flatnonzero(drift * drift[-1] <= 0)
    return float(history.time[opposite[-1]]) if len(opposite) else 0.0
