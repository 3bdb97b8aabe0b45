# SPDX-License-Identifier: GPL-2.0-or-later
"""High-pass; peaks, JMA instrumental intensity, response spectra, Arias intensity, in the customary gal, cm/s, cm."""
import math
from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
import scipy  # submodules (27 MB) load on first use; a plain run needs none

from .record import GAL, STANDARD_GRAVITY, RecordError, interpolated, subdivided

CM = 0.01  # one centimetre in metres
MAX_RESULT = 5_000_000  # samples of one component, transients included, in a processed motion: 45 s at 1e-5 s
PADDING = 1.5  # zeros for the transients of a high-pass, before and after the motion, each times its corner. [-]
VELOCITY_CORNER = 0.05
"""Default high-pass of velocities and displacements. [Hz] Below it records have baseline errors, not motion."""
INTENSITY_DURATION = 0.3  # the filtered vector acceleration must stay at or above a0 for this long in total. [s] (JMA)
INTENSITY_STEP = 1 / 800
"""Largest step between two values of the filtered acceleration, whose highest frequency of note is 10 Hz. [s]"""
MOST_SAMPLES = 2_000_000
"""Samples of one component that are integrated, transients included: 100 s at 1e-4 s. Resampled motions may have more.
"""
STEPS_PER_PERIOD = 20
"""Smallest number of steps per oscillator period; sampling then underestimates a peak by at most 1.2 %."""


# --- high-pass ----------------------------------------------------------------------------------


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


# --- peaks --------------------------------------------------------------------------------------


def peak(values, component="any"):
    """Largest absolute value of (n, 3) columns ew, ns, ud. component: 'ew', 'ns', 'ud'; 'h', 'v3': of the horizontal or
    whole vector; 'level': larger horizontal one; 'any'"""
    if component in ("level", "any"):
        return float(np.abs(values[:, : 2 if component == "level" else 3]).max())
    columns = {"ew": [0], "ns": [1], "ud": [2], "h": [0, 1], "v3": [0, 1, 2]}
    if component not in columns:
        raise RecordError(f"component '{component}'; admissible: ew, ns, ud, h, v3, level, any")
    return float(np.linalg.norm(values[:, columns[component]], axis=1).max())


def pga(motion, component="any"):
    """Peak ground acceleration [gal]; component as in `peak`."""
    return peak(motion.acceleration, component) / GAL


def pgv(motion, component="h", corner=VELOCITY_CORNER):
    """Peak ground velocity [cm/s]; component as in `peak`, corner as in `velocity`."""
    return peak(velocity(motion, corner), component) / CM


def pgd(motion, component="h", corner=VELOCITY_CORNER):
    """Peak ground displacement [cm]; component as in `peak`, corner as in `velocity`."""
    return peak(displacement(motion, corner), component) / CM


def velocity(motion, corner=VELOCITY_CORNER):
    """Ground velocity from rest: trapezoidal integral of the acceleration. (n, 3) [m/s] corner: of a zero-phase
    Butterworth high-pass of order 2 before integrating [Hz]; None: none"""
    return _integral(motion, corner, 1)


def displacement(motion, corner=VELOCITY_CORNER):
    """Ground displacement from rest: trapezoidal integral of `velocity`. (n, 3) [m]"""
    return _integral(motion, corner, 2)


def _integral(motion, corner, times):
    """Acceleration integrated once or twice, from rest before the transients of the high-pass, against a drift. Of more
    than MOST_SAMPLES every second, third ... one is integrated, with straight lines between the results."""
    transients = 0.0 if corner is None else 2 * PADDING / corner / motion.dt
    stride = math.ceil((len(motion) + transients) / MOST_SAMPLES)
    kept, dt, pad = np.arange(0, len(motion), stride), stride * motion.dt, 0
    values = motion.acceleration[kept]
    if corner is not None:
        values, pad = highpass_with_ends(values, dt, corner, 2)
    for _ in range(times):
        values = scipy.integrate.cumulative_trapezoid(values, dx=dt, axis=0, initial=0.0)
    values = values[pad : len(values) - pad]
    return values if stride == 1 else interpolated(np.arange(len(motion)), kept, values)


# --- JMA instrumental intensity -----------------------------------------------------------------


@dataclass(frozen=True)
class JmaIntensity:
    """JMA instrumental intensity. raw: I = 2 log10(a0) + 0.94, not rounded, -inf for a motion of zeros; official:
    rounded to two decimals, then cut to one; a0: filtered vector acceleration reached for 0.3 s in total [gal]."""

    raw: float
    official: float
    a0: float


def jma_filter(frequency):
    """Gain of JMA's filter (Notification 4 of 1996): period effect x high cut x low cut. frequency [Hz] >= 0."""
    f = np.asarray(frequency, dtype=float)
    safe = np.where(f > 0.0, f, 1.0)
    x = safe / 10.0
    powers = (1.0, 0.694, 0.241, 0.0557, 0.009664, 0.00134, 0.000155)
    period_effect = 1.0 / np.sqrt(safe)
    high_cut = 1.0 / np.sqrt(sum(c * x ** (2 * k) for k, c in enumerate(powers)))
    low_cut = np.sqrt(-np.expm1(-((safe / 0.5) ** 3)))
    return np.where(f > 0.0, period_effect * high_cut * low_cut, 0.0)


def jma_filtered(motion, parts=1):
    """Acceleration after JMA's filter, applied by Fourier transform of the whole record, at `parts` times per sample of
    the motion. (n parts, 3) [m/s2]"""
    n = len(motion)
    gain = jma_filter(np.fft.rfftfreq(n, motion.dt))
    spectrum = np.fft.rfft(motion.acceleration, axis=0) * gain[:, None]
    return parts * np.fft.irfft(spectrum, n * parts, axis=0)


def lasting_level(values, duration):
    """Largest level at or above which periodic values stay for a duration in total, straight lines between them. values
    (n,); duration: in steps between two values, at most n"""
    ends = np.stack([values, np.roll(values, -1)])
    low, high = ends.min(axis=0), ends.max(axis=0)
    sloping = high > low

    def time_above(level, reached=np.greater_equal):
        shares = (high[sloping] - level) / (high - low)[sloping]
        return np.clip(shares, 0.0, 1.0).sum() + np.count_nonzero(reached(low[~sloping], level))

    levels = np.unique(values)
    reached = bisect_right(levels, -duration * (1 - 1e-9), key=lambda level: -time_above(level)) - 1
    level, above = levels[reached], time_above(levels[reached], np.greater)
    if reached + 1 == len(levels) or above <= duration:
        return float(level)
    upper = levels[reached + 1]
    return float(level + (upper - level) * (above - duration) / (above - time_above(upper)))


def stated_intensity(motion):
    """Official JMA intensity, None for a motion of zeros or of less than 0.3 s."""
    if motion.duration < INTENSITY_DURATION or not motion.acceleration.any():
        return None
    return jma_intensity(motion).official


def jma_intensity(motion):
    """JMA instrumental intensity of three components -> JmaIntensity. The record must last 0.3 s or more."""
    if len(motion) * motion.dt < INTENSITY_DURATION * (1 - 1e-9):
        raise RecordError(f"{motion.name}: lasts {motion.duration:g} s; JMA intensity needs 0.3 s or more")
    parts = math.ceil(motion.dt / INTENSITY_STEP)
    vector = np.linalg.norm(jma_filtered(motion, parts), axis=1)
    a0 = lasting_level(vector, INTENSITY_DURATION * parts / motion.dt) / GAL
    if a0 <= 0.0:
        return JmaIntensity(-np.inf, -np.inf, 0.0)
    raw = float(2.0 * np.log10(a0) + 0.94)
    return JmaIntensity(raw, float(np.floor(np.round(raw, 2) * 10.0 + 1e-9) / 10.0), a0)


# --- response spectra ---------------------------------------------------------------------------


@dataclass(frozen=True)
class Spectrum:
    """Response spectrum of linear oscillators, arrays (m,). periods [s]; sa: largest absolute acceleration of the mass
    [gal]; psv: pseudo-velocity, 2 pi / T times sd [cm/s]; sd: largest displacement relative to the ground [cm]."""

    periods: np.ndarray
    sa: np.ndarray
    psv: np.ndarray
    sd: np.ndarray


def response_spectrum(acceleration, dt, periods, damping=0.05):
    """Response spectrum of a ground acceleration.

    Exact for ground acceleration that is linear between its samples (Nigam and Jennings 1969), half a period of free
    vibration after its end included.

    Parameters
    ----------
    acceleration : (n,) or (n, k) array_like
        [m/s2]; with several columns the result is the length of the vector of the columns' responses (the resultant).
    dt : float
        [s]
    periods : (m,) array_like
        > 0 [s]
    damping : float
        Share of critical damping, 0 <= damping < 1. [-]

    Returns
    -------
    Spectrum
    """
    periods = np.atleast_1d(np.asarray(periods, dtype=float))
    if not (np.isfinite(periods).all() and (periods > 0.0).all() and 0.0 <= damping < 1.0):
        raise RecordError("response spectrum: periods must be > 0 and the damping in [0, 1)")
    columns = np.asarray(acceleration, dtype=float).reshape(len(acceleration), -1)
    peaks = np.array([_oscillator_peaks(columns, dt, period, damping) for period in periods])
    return Spectrum(periods, peaks[:, 1] / GAL, peaks[:, 0] * 2.0 * np.pi / periods / CM, peaks[:, 0] / CM)


def oscillator(acceleration, dt, period, damping=0.05):
    """Response of one oscillator at rest at the first sample: (displacement [m], absolute acceleration [m/s2]).

    acceleration (n, k) of the ground [m/s2], taken as linear between samples; results have its shape. With s = -damping
    w + i w sqrt(1 - damping^2), the displacement is Im(y) / Im(s), where y' = s y - acceleration; each step of y is
    integrated in closed form."""
    omega = 2.0 * np.pi / period
    s = complex(-damping * omega, omega * np.sqrt(1.0 - damping**2))
    growth, z = np.exp(s * dt), s * dt
    # (exp(z) - 1 - z) / z^2; by its series where cancellation would cost more than 1e-12 of it
    late = dt * (1.0 / 2.0 + z / 6.0 + z**2 / 24.0 + z**3 / 120.0 + z**4 / 720.0 + z**5 / 5040.0 if abs(z) < 1e-2
                 else (growth - 1.0 - z) / z**2)
    early = (growth - 1.0) / s - late
    forcing = np.zeros(acceleration.shape, dtype=complex)
    forcing[1:] = -(early * acceleration[:-1] + late * acceleration[1:])
    y = scipy.signal.lfilter([1.0], [1.0, -growth], forcing, axis=0)
    displacement_, velocity_ = y.imag / s.imag, (s * y).imag / s.imag
    return displacement_, -(2.0 * damping * omega * velocity_ + omega**2 * displacement_)


def _oscillator_peaks(columns, dt, period, damping):
    """Largest length of (displacement [m], absolute acceleration [m/s2]) of (n, k) ground acceleration."""
    parts = int(np.ceil(STEPS_PER_PERIOD * dt / period))
    tail = int(np.ceil(0.5 * period / dt))
    ground = subdivided(np.pad(columns, ((0, tail), (0, 0))), parts)
    responses = oscillator(ground, dt / parts, period, damping)
    return [float(np.linalg.norm(response, axis=1).max()) for response in responses]


# --- energy and duration ------------------------------------------------------------------------


def arias(motion):
    """Arias intensity pi / (2 g) x integral of the squared acceleration: {'ew', 'ns', 'ud', 'total': sum}. [m/s]"""
    each = np.pi / (2.0 * STANDARD_GRAVITY) * _energy(motion)[-1]
    return {"ew": float(each[0]), "ns": float(each[1]), "ud": float(each[2]), "total": float(each.sum())}


def significant_duration(motion, start=0.05, end=0.95):
    """Time in which the Arias intensity of all components grows from `start` to `end` of its final value. [s]"""
    first, last = onset(motion, start), onset(motion, end)
    return 0.0 if first is None else last - first


def onset(motion, share=0.05):
    """Onset of strong shaking: the Arias intensity reaches `share` of its final value. [s]; None without shaking. With
    0.95: its end."""
    growth = _energy(motion).sum(axis=1)
    return float(np.searchsorted(growth, share * growth[-1]) * motion.dt) if growth[-1] > 0.0 else None


def _energy(motion):
    """Running integral of the squared acceleration. (n, 3) [m2/s3]"""
    return scipy.integrate.cumulative_trapezoid(motion.acceleration**2, dx=motion.dt, axis=0, initial=0.0)
