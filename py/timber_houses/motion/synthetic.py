# SPDX-License-Identifier: GPL-2.0-or-later
"""A seeded synthetic motion like the one recorded at Ojiya (K-NET NIG019) on 2004-10-23, which may not be
redistributed.

It matches the published measures of that record (TARGETS), not its wave form. Steps for one seed:

1. Noise: white noise under an envelope (15 s of quiet, P waves, S waves from 18 s, decay), coloured by a
   soil filter (Kanai-Tajimi) with a low cut and a high cut.
2. Pulses: Mavroeidis-Papageorgiou velocity pulses of about 0.65 s (the site's period), which carry the response
   spectrum's peak, and one of about 2 s, which carries displacement.
3. Rest: two smooth functions far below 1 gal remove the final velocity and displacement.
4. Peaks: Ricker wavelets of 5 Hz bring the component and vector peak accelerations to their targets.
5. Loop: pulse size, number of cycles, noise level and the share of NS are corrected, and 2-4 repeated, until vector
   PGV, JMA intensity and response spectrum fit as well.

A motion that does not converge is discarded and replaced by the next random stream of the same seed."""
from dataclasses import dataclass

import numpy as np
import scipy  # submodules (27 MB) load on first use; a plain run needs none

from .measures import (CM, INTENSITY_DURATION, VELOCITY_CORNER, jma_filtered, peak, pga, response_spectrum,
                       zero_phase_highpass)
from .record import GAL, GroundMotion, RecordError

GENERATOR_VERSION = 1  # raised whenever the output for a given seed changes
DEFAULT_SEED = 3
"""Of the shipped motion, under which an unbraced house falls E-W (in the paper N-S); others: research/claims."""
DT = 0.01  # time step. [s]
DURATION = 40.0  # length. [s]
P_ARRIVAL, S_ARRIVAL = 15.0, 17.9  # first shaking and beginning of the strong shaking. [s]
TARGETS = {"pga_ns": 1147.0, "pga_ew": 1308.0, "pga_ud": 820.0, "pga_h": 1501.0, "pgv_h": 133.0, "jma": 6.73,
           "psv_ew": 500.0}
"""Published values: peaks of components and of the horizontal vector [gal], [cm/s], JMA intensity, and the value that
the 5 % pseudo-velocity [cm/s] exceeds at PSV_PERIODS (checked for EW alone, hence for the resultant too)."""
PSV_PERIODS = np.linspace(0.60, 0.70, 11)  # periods at which the pseudo-velocity is above its target. [s]
PSV_GOAL = 1.08  # smallest pseudo-velocity over PSV_PERIODS that the loop aims at, in parts of the target
LOOPS, ATTEMPTS = 25, 100  # corrections of one motion, and motions tried for one seed


@dataclass(frozen=True)
class _Parameters:
    """Parameters of the loop: pulse velocity [m/s], cycles in the pulse, noise level [m/s2], NS part of the pulse."""

    pulse: float = 1.15
    cycles: float = 3.6
    noise: float = 2.4
    share: float = 0.4


def synthetic_motion(seed=DEFAULT_SEED):
    """GroundMotion of a seed (whole, >= 0), 40 s of 100 Hz; equal bits with the same numpy. Raises RecordError."""
    if not isinstance(seed, (int, np.integer)) or seed < 0:
        raise RecordError(f"seed {seed}: it must be a whole number >= 0")
    for attempt in range(ATTEMPTS):
        motion = _converge(np.random.Generator(np.random.PCG64([int(seed), attempt])), int(seed))
        if motion is not None:
            return motion
    raise RecordError(f"seed {seed}: no motion met the targets in {ATTEMPTS} attempts; take another seed")


def achieved(motion):
    """What the motion has of TARGETS, under the same names; psv_ew is the smallest over PSV_PERIODS."""
    # of generator version 1: `measures.pgv` differs by 0.1 %, `measures.jma_intensity` by less than 0.003
    acceleration = zero_phase_highpass(motion.acceleration, DT, VELOCITY_CORNER, 2)
    velocity = scipy.integrate.cumulative_trapezoid(acceleration, dx=DT, axis=0, initial=0.0)
    lasting = np.sort(np.linalg.norm(jma_filtered(motion), axis=1))[-round(INTENSITY_DURATION / DT)]
    return {"pga_ns": pga(motion, "ns"), "pga_ew": pga(motion, "ew"), "pga_ud": pga(motion, "ud"),
            "pga_h": pga(motion, "h"), "pgv_h": peak(velocity, "h") / CM,
            "jma": float(2.0 * np.log10(lasting / GAL) + 0.94),
            "psv_ew": float(response_spectrum(motion.ew, motion.dt, PSV_PERIODS).psv.min())}


# --- the loop -----------------------------------------------------------------------------------


def _converge(random, seed):
    """One motion brought to the targets, or None."""
    noise, pulses = _noise(random), _pulses(random)
    parameters = _Parameters()
    for _ in range(LOOPS):
        motion = _assemble(noise, pulses, parameters, seed)
        got = achieved(motion)
        peaks = all(abs(got[k] / TARGETS[k] - 1.0) < 0.015 for k in ("pga_ns", "pga_ew", "pga_ud", "pga_h", "pgv_h"))
        if peaks and abs(got["jma"] - TARGETS["jma"]) < 0.02 and got["psv_ew"] > 1.03 * TARGETS["psv_ew"]:
            return motion
        parameters = _corrected(parameters, got)
    return None


def _corrected(parameters, got):
    """Damped multiplicative corrections; each parameter mainly moves one measure."""
    size = (TARGETS["pgv_h"] / got["pgv_h"]) ** 0.6
    spectrum = PSV_GOAL * TARGETS["psv_ew"] / got["psv_ew"] * got["pgv_h"] / TARGETS["pgv_h"]
    strength = 10.0 ** (0.5 * (TARGETS["jma"] - got["jma"]))
    return _Parameters(pulse=parameters.pulse * size,
                       cycles=float(np.clip(parameters.cycles * spectrum**0.5, 2.0, 5.5)),
                       noise=float(np.clip(parameters.noise * strength**0.8, 1.8, 6.0)),
                       share=float(np.clip(parameters.share * strength**0.5, 0.2, 0.9)))


def _assemble(noise, pulses, parameters, seed):
    """Noise and pulses with their peaks brought to the targets, at rest at the end."""
    acceleration = parameters.noise * noise
    acceleration[:, :2] += pulses(parameters)
    acceleration[:, 2] *= TARGETS["pga_ud"] * GAL / np.abs(acceleration[:, 2]).max()
    acceleration = _at_rest(acceleration)
    _fit_horizontal_peaks(acceleration[:, 0], acceleration[:, 1])
    return GroundMotion(DT, acceleration, f"ojiya-like-{seed}", f"synthetic, seed {seed}, version {GENERATOR_VERSION}")


# --- noise --------------------------------------------------------------------------------------


def _times():
    return np.arange(round(DURATION / DT)) * DT


def _noise(random):
    """Coloured noise (n, 3) under the envelope, unit rms in the strong part, exactly zero before the P waves."""
    t = _times()
    white = random.standard_normal((len(t), 3))
    envelope = np.column_stack([_envelope(t, p_level) for p_level in (0.10, 0.10, 0.22)])
    colours = ((2.6, 0.5, 0.9), (3.0, 0.5, 0.9), (6.0, 0.6, 1.6))
    coloured = np.column_stack([_coloured(white[:, k] * envelope[:, k], *colours[k]) for k in range(3)])
    ending = np.sin(0.5 * np.pi * np.clip((DURATION - DT - t) / 2.0, 0.0, 1.0)) ** 2  # to zero in the last two seconds
    strong = (t > S_ARRIVAL + 0.5) & (t < S_ARRIVAL + 5.0)
    return coloured / np.sqrt((coloured[strong] ** 2).mean(axis=0)) * ending[:, None]


def _envelope(t, p_level):
    """Strength of the noise over time, 1 in the strong part; p_level before the S waves."""
    p = p_level * np.clip((t - P_ARRIVAL) / 1.2, 0.0, 1.0) ** 2
    rise = np.clip((t - S_ARRIVAL) / 0.7, 0.0, 1.0) ** 2
    decay = np.exp(-np.clip(t - S_ARRIVAL - 4.5, 0.0, None) / 3.2)
    return np.where(t > P_ARRIVAL, np.maximum(p, rise), 0.0) * np.maximum(decay, 0.004)


def _coloured(white, soil_frequency, soil_damping, low_cut):
    """Causal soil filter (Kanai-Tajimi), low cut and a high cut at 18 Hz. Frequencies in [Hz]."""
    w, z = 2.0 * np.pi * soil_frequency, soil_damping
    soil = scipy.signal.bilinear([2.0 * z * w, w * w], [1.0, 2.0 * z * w, w * w], fs=1.0 / DT)
    out = scipy.signal.lfilter(*soil, white)
    for kind, corner in (("highpass", low_cut), ("lowpass", 18.0)):
        out = scipy.signal.sosfilt(scipy.signal.butter(2, corner, kind, fs=1.0 / DT, output="sos"), out)
    return out


# --- pulses -------------------------------------------------------------------------------------


def _pulses(random):
    """Random pulses: function of _Parameters that gives their EW and NS accelerations. (n, 2) [m/s2]"""
    times = random.uniform(19.2, 19.8) + np.array([0.0, random.uniform(2.4, 3.2), random.uniform(3.6, 5.0)])
    periods = np.array([0.65, random.uniform(0.55, 0.78), random.uniform(1.7, 2.3)])
    phases, signs = random.uniform(0.0, 2.0 * np.pi, 3), random.choice([-1.0, 1.0], 3)

    def accelerations(parameters):
        main, second, slow = map(_pulse, times, periods, phases, (parameters.cycles, 2.2, 2.2))
        ew = main + 0.35 * second + 0.30 * slow
        delayed = _pulse(times[0] + 0.16, periods[0], phases[0], parameters.cycles)
        ns = signs[0] * parameters.share * delayed + signs[1] * 0.65 * second + signs[2] * 0.35 * slow
        return parameters.pulse * np.column_stack([ew, ns])

    return accelerations


def _pulse(centre, period, phase, cycles):
    """Acceleration of a velocity pulse of unit amplitude (Mavroeidis and Papageorgiou 2003, Eq 3). (n,) [1/s] v = 1/2
    (1 + cos(w t / cycles)) cos(w t + phase) for |w t| < pi cycles, w = 2 pi / period, t from `centre`."""
    t, w = _times() - centre, 2.0 * np.pi / period
    slow = w * t / cycles
    carrier, bell = w * t + phase, 0.5 * (1.0 + np.cos(slow))
    rate = -0.5 * w / cycles * np.sin(slow) * np.cos(carrier) - bell * w * np.sin(carrier)
    return np.where(np.abs(slow) < np.pi, rate, 0.0)


def _at_rest(acceleration):
    """Remove the final velocity and displacement by two smooth corrections of 24 s, some 0.05 gal. (n, 3) [m/s2]"""
    t = _times()
    phase = np.clip((t - P_ARRIVAL - 0.5) / (DURATION - P_ARRIVAL - 1.0), 0.0, 1.0)
    corrections = np.column_stack([np.sin(np.pi * phase) ** 2, np.sin(np.pi * phase) ** 2 * np.cos(np.pi * phase)])
    # Cramer's rule and einsum: the last bits of BLAS and LAPACK depend on the processor
    (a, b), (c, d) = _final_state(corrections)
    speed, displacement = _final_state(acceleration)
    weights = np.array([d * speed - b * displacement, a * displacement - c * speed]) / (a * d - b * c)
    return acceleration - np.einsum("ij,jk->ik", corrections, weights)


def _final_state(acceleration):
    """Velocity and displacement at the end, integrated as `measures.velocity` does. (2, k) [m/s], [m]"""
    speed = scipy.signal.lfilter([0.5 * DT, 0.5 * DT], [1.0, -1.0], acceleration, axis=0)
    return np.array([speed[-1], DT * (speed[:-1].sum(axis=0) + 0.5 * speed[-1])])


# --- peaks --------------------------------------------------------------------------------------


def _fit_horizontal_peaks(ew, ns):
    """Bring the peaks of EW, NS and of their vector, which lies at EW's, to the targets by Ricker wavelets in place."""
    top_ew, top_ns, top = (TARGETS[k] * GAL for k in ("pga_ew", "pga_ns", "pga_h"))
    beside_ew = np.sqrt(top**2 - top_ew**2)
    beside_ns = 0.9 * np.sqrt(top**2 - top_ns**2)
    for _ in range(8):
        _limit(ew, ns, top_ew, top_ns, top)
        at_ew = _cheapest(np.abs(top_ew - np.abs(ew)) + np.abs(beside_ew - np.abs(ns)), [])
        _raise(ew, at_ew, top_ew)
        _raise(ns, at_ew, beside_ew)
        at_ns = _cheapest(np.abs(top_ns - np.abs(ns)) + np.clip(np.abs(ew) - beside_ns, 0.0, None), [at_ew])
        _raise(ns, at_ns, top_ns)
        _raise(ew, at_ns, min(beside_ns, abs(ew[at_ns])))
    _limit(ew, ns, top_ew, top_ns, top)


def _limit(ew, ns, top_ew, top_ns, top):
    """Lower whatever passes the peaks by more than 0.2 %, worst first, in place."""
    for _ in range(60):
        excess = np.maximum.reduce([np.abs(ew) / top_ew, np.abs(ns) / top_ns, np.hypot(ew, ns) / top])
        worst = int(excess.argmax())
        if excess[worst] <= 1.002:
            return
        _raise(ew, worst, min(top_ew, abs(ew[worst]) / excess[worst]))
        _raise(ns, worst, min(top_ns, abs(ns[worst]) / excess[worst]))


def _cheapest(cost, elsewhere):
    """Index in the strong part where the cost is least, 0.4 s or more away from the indices `elsewhere`."""
    t = _times()
    allowed = (t > S_ARRIVAL + 0.6) & (t < S_ARRIVAL + 6.0)
    for index in elsewhere:
        allowed &= np.abs(t - t[index]) > 0.4
    return int(np.where(allowed, cost, np.inf).argmin())


def _raise(component, index, size):
    """Make |component[index]| equal to `size` [m/s2] by a 5 Hz Ricker wavelet without velocity, in place."""
    argument = (np.pi * 5.0 * (np.arange(len(component)) - index) * DT) ** 2
    wavelet = (1.0 - 2.0 * argument) * np.exp(-argument)
    sign = 1.0 if component[index] >= 0.0 else -1.0
    component += (sign * size - component[index]) * np.where(argument < 40.0, wavelet, 0.0)
