# SPDX-License-Identifier: GPL-2.0-or-later
"""Processing of ground motions; every function returns a new GroundMotion."""
import math
from dataclasses import replace
from datetime import timedelta
from fractions import Fraction

import numpy as np
import scipy  # submodules (27 MB) load on first use; a plain run needs none

from .measures import jma_intensity, pga, require_size, zero_phase_highpass
from .record import GAL, GroundMotion, RecordError, interpolated, peaks_gal

PAD_SECONDS = 5.0  # zeros added at the end before a band-limited resampling, which treats the record as periodic. [s]
LARGEST_RATIO = 100_000  # largest numerator or denominator of old step / new step for band-limited resampling


def turned(motion, angle):
    """The motion in axes in which its north has the azimuth `angle` [degrees, clockwise]: with 90 along +x."""
    if not np.isfinite(angle):
        raise RecordError(f"{motion.name}: angle {angle}; it must be a finite number of degrees")
    if angle == 0.0:
        return motion
    sine, cosine = round_off(np.sin(np.radians(angle))), round_off(np.cos(np.radians(angle)))
    ew, ns, ud = motion.acceleration.T
    return _changed(motion, np.column_stack([cosine * ew + sine * ns, cosine * ns - sine * ew, ud]),
                    f"turned by {angle:g} degrees")


def in_axes(motion, axes):
    """The motion in other axes. axes: (3, 3), their directions as columns"""
    if np.array_equal(axes, np.eye(3)):
        return motion
    turned = np.einsum("ij,jk->ik", motion.acceleration, axes)  # without BLAS: the same bits on every processor
    return replace(_changed(motion, turned, ""), source=motion.source)


def round_off(x):
    """Sine or cosine without rounding noise at multiples of a right angle."""
    return float(np.round(x, 15))


def remove_polynomial(motion, order=0):
    """Subtract from each component its least-squares polynomial in time (0: the mean, 1: also the trend)."""
    if order < 0:
        raise RecordError(f"{motion.name}: polynomial order {order}; it must be >= 0")
    t = np.linspace(-1.0, 1.0, len(motion))
    basis = np.polynomial.legendre.legvander(t, order)
    weights, *_ = np.linalg.lstsq(basis, motion.acceleration, rcond=None)
    return _changed(motion, motion.acceleration - basis @ weights, f"polynomial of order {order} removed")


def highpass(motion, corner, order=4):
    """Zero-phase Butterworth high-pass. corner [Hz] (-6 dB there, forwards and backwards), order of one pass."""
    filtered = zero_phase_highpass(motion.acceleration, motion.dt, corner, order)
    return _changed(motion, filtered, f"high-pass {corner:g} Hz, order {order}, zero phase")


def trim(motion, start=0.0, end=None):
    """Keep the samples with start <= t <= end [s]; the first kept sample becomes t = 0."""
    end = motion.duration if end is None else end
    keep = (motion.time >= start - 1e-9) & (motion.time <= end + 1e-9)
    if np.count_nonzero(keep) < 2:
        raise RecordError(f"{motion.name}: nothing between {start:g} and {end:g} s; it lasts {motion.duration:g} s")
    cut = _changed(motion, motion.acceleration[keep], f"cut to {start:g}-{end:g} s", start=float(motion.time[keep][0]))
    return replace(cut, begins=motion.begins + timedelta(seconds=motion.time[keep][0])) if motion.begins else cut


def scaled(motion, factor):
    """All components times one factor (finite; it may be negative)."""
    if not np.isfinite(factor):
        raise RecordError(f"{motion.name}: scale factor {factor}; it must be finite")
    changed = _changed(motion, motion.acceleration * factor, f"scaled by {factor:.6g}", factor=factor)
    return replace(changed, source=motion.source) if factor == 1.0 else changed


def scaled_to_pga(motion, gal, component="h"):
    """One factor for all components so that pga(motion, component) is `gal`; component as in measures.pga."""
    present = pga(motion, component)
    if not (gal > 0.0 and present > 0.0):
        raise RecordError(f"{motion.name}: cannot scale {component} from {present:g} to {gal:g} gal; both must be > 0")
    return scaled(motion, gal / present)


def scaled_to_intensity(motion, intensity):
    """One factor for all components so that the raw JMA intensity is `intensity` (exact: the filter is linear)."""
    present = jma_intensity(motion).raw
    if not (np.isfinite(intensity) and np.isfinite(present)):
        raise RecordError(f"{motion.name}: cannot scale intensity {present:g} to {intensity:g}; both must be finite")
    return scaled(motion, 10.0 ** ((intensity - present) / 2.0))


def resample(motion, dt, method="bandlimited"):
    """Samples at another time step.

    Parameters
    ----------
    motion : GroundMotion
    dt : float
        New time step. [s]
    method : {"bandlimited", "linear"}
        ``bandlimited``: Fourier interpolation of the record, padded with zeros; for a larger step it also removes
        frequencies above the new Nyquist frequency; dt / old dt must be a ratio of whole numbers. ``linear``: straight
        lines between the samples, as in the ground-motion engine.

    Returns
    -------
    motion : GroundMotion
    error : float
        Largest difference from the band-limited interpolation of the original at the new times, in parts of the
        record's PGA (0 for an upsampling by ``bandlimited``).
    """
    if method not in ("bandlimited", "linear"):
        raise RecordError(f"resampling method '{method}'; admissible: bandlimited, linear")
    if not (np.isfinite(dt) and dt > 0.0):
        raise RecordError(f"{motion.name}: time step {dt} s; it must be > 0")
    exact, kept = _fourier(motion, dt)
    chosen = kept if method == "bandlimited" else interpolated(
        np.arange(len(kept)) * dt, motion.time, motion.acceleration)
    peak = np.abs(motion.acceleration).max()
    error = float(np.abs(chosen - exact).max() / peak) if peak > 0.0 else 0.0
    return _changed(motion, chosen, f"resampled to {dt:g} s ({method})", dt=dt), error


def _fourier(motion, dt):
    """(band-limited interpolation at the new times, the same without frequencies above the new Nyquist frequency)."""
    ratio = Fraction(dt / motion.dt).limit_denominator(LARGEST_RATIO)
    if ratio <= 0 or abs(float(ratio) - dt / motion.dt) > 1e-9 * dt / motion.dt or ratio.numerator > LARGEST_RATIO:
        raise RecordError(f"{motion.name}: {dt:g} s is not a whole-number ratio of {motion.dt:g} s; choose another"
                          " step")
    periods = math.ceil((len(motion) + PAD_SECONDS / motion.dt) / ratio.numerator)
    total = periods * ratio.numerator
    require_size(max(total, periods * ratio.denominator) if ratio <= 1 else total * ratio.denominator,
                 f"{motion.name}: resampling to {dt:g} s")
    padded = np.pad(motion.acceleration, ((0, total - len(motion)), (0, 0)))
    last = math.floor((len(motion) - 1) * motion.dt / dt + 1e-9)
    kept = scipy.signal.resample(padded, periods * ratio.denominator, axis=0)
    if ratio <= 1:
        return kept[: last + 1], kept[: last + 1]
    dense = scipy.signal.resample(padded, total * ratio.denominator, axis=0)
    return dense[:: ratio.numerator][: last + 1], kept[: last + 1]


def interpolation_error(motion, dt=0.0):
    """Largest error of straight lines between the samples, taken half way between them [fraction of the PGA]; 0 for a
    run with a time step dt [s] that is not smaller than the samples'. Of a sequence: between its motions' own samples.
    """
    peak = np.abs(motion.acceleration).max()
    pieces = [motion]
    if motion.parts:  # each with its own time step
        ends = [[round(time / motion.dt) for time in (part.start, part.start + part.duration)] for part in motion.parts]
        pieces = [GroundMotion(part.dt, motion.acceleration[first : end : round(part.dt / motion.dt)], motion.name)
                  for part, (first, end) in zip(motion.parts, ends)]
    return max((resample(piece, 0.5 * piece.dt, "linear")[1] * float(np.abs(piece.acceleration).max() / peak)
                for piece in pieces if piece.dt > dt and peak > 0), default=0.0)


def shaking_window(motion, threshold=0.5):
    """(first, last) time with more than `threshold` [gal] in any component [s]. Raises RecordError without one."""
    above = np.flatnonzero(np.abs(motion.acceleration).max(axis=1) > threshold * GAL)
    if not above.size:
        raise RecordError(f"{motion.name}: nothing above {threshold:g} gal; its peak is {pga(motion, 'any'):g} gal")
    return float(above[0] * motion.dt), float(above[-1] * motion.dt)


def _changed(motion, acceleration, change, dt=None, factor=1.0, start=0.0):
    """The motion with other samples. change: for its source; dt [s]; factor [-]; start: of the kept part [s]"""
    step, parts = motion.dt if dt is None else dt, []
    for part in motion.parts:  # of a sequence, without those that are cut off
        first, end = max(part.start - start, 0.0), min(part.start + part.duration - start, len(acceleration) * step)
        samples = acceleration[max(0, round(first / step)) : max(0, round(end / step))]
        if len(samples):
            parts.append(replace(part, start=first, duration=end - first, scale=factor * part.scale,
                                 pga_gal=peaks_gal(samples), dt=part.dt if dt is None else dt))
    return replace(motion, dt=step, acceleration=acceleration, source=f"{motion.source}; {change}".lstrip("; "),
                   parts=tuple(parts))
