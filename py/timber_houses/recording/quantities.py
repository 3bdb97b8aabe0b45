# SPDX-License-Identifier: GPL-2.0-or-later
"""Storey shears and floor accelerations of a run, from the momenta of parts of its main structure.

Part 2k is level k: floor, beams, roof and snow above storey k; level 0: sills that are not fixed. Part 2k - 1: columns,
braces and walls of storey k. The shear of storey k is the horizontal inertia force, minus mass times absolute
acceleration, of everything above the heads of its columns; the base shear is that of all parts. A positive shear goes
with a positive drift. Shears are means over a sample interval (0.01 s), accelerations what an accelerometer with the
band BAND shows: members that hit each other give peaks of a few ms, of any height."""
import numpy as np

from .history import DIRECTIONS, Series

NAME = "storeys.csv"
SUSTAINED = 0.1  # time over which a sustained shear is averaged. [s]
BAND = (0.0, 10.0)  # of accelerations [Hz]: up to the high-cut of JMA's intensity, where the amplitude is 1/sqrt(2)
BAND_TEXT = f"{BAND[0]:g} to {BAND[1]:g} Hz"
ORDER, STEP, PADDING = 3, 0.01, 1.0
"""Of the low-pass (Butterworth's amplitude, no phase), its time step, ends held for its transients. [s]"""
AXES = {"ew": 0, "ns": 1, "ud": 2}  # component of a vector (east, north, up)


class Storeys(Series):
    """The table storeys.csv.

    time [s]; base_shear_ns, base_shear_ew [N]; ground_acceleration_ns, _ew, _ud [m/s2]; for each storey k from 1:
    shear_nsk, shear_ewk [N] and the absolute acceleration of the level above it, acceleration_nsk, acceleration_ewk,
    acceleration_udk [m/s2]. Accelerations within BAND."""

    __slots__ = ()

    @property
    def count(self):
        return sum(name.startswith("shear_ns") for name in self.columns)

    def until(self, time):
        """The rows up to a time [s]."""
        return type(self)(self.columns, self.rows[self.time <= time])

    def peak(self, name):
        """Largest absolute value of a column; 0.0 without samples."""
        return float(np.nan_to_num(np.abs(self.column(name))).max(initial=0.0))

    def sustained(self, name):
        """Largest absolute mean of a column over SUSTAINED; 0.0 for a shorter run. Impacts of a few ms hardly count."""
        values, time = np.nan_to_num(self.column(name)), self.time
        total, end = np.concatenate([[0.0], np.cumsum(values)]), np.searchsorted(time, time + SUSTAINED)
        whole = np.flatnonzero(end < len(time))
        return float(np.abs((total[end[whole]] - total[whole]) / np.maximum(end[whole] - whole, 1)).max(initial=0.0))


def storeys(samples, masses, motion=None):
    """Storeys of a run. motion: frames.Motion or None; masses (P,) of parts [kg]. samples (F + 1, 1 + 3 P): time [s],
    momenta of the parts relative to the ground, east, north, up [kg m/s]"""
    samples, masses = np.asarray(samples, float), np.asarray(masses, float)
    time, steps = samples[:, 0], np.diff(samples[:, 0])
    steps = np.where(steps > 0, steps, np.nan)[:, None]
    ground = np.diff(ground_velocity(motion, time), axis=0) / steps
    rates = np.diff(samples[:, 1:].reshape(len(samples), len(masses), 3), axis=0) / steps[:, :, None]
    forces = rates + masses[:, None] * ground[:, None, :]  # (F, P, 3)
    middle = (time[1:] + time[:-1]) / 2
    columns, values = ["time [s]"], [middle]
    for k in range(len(masses) // 2 + 1):  # 0: of the base
        shear, acceleration = (f"shear_{{}}{k}", f"acceleration_{{}}{k}") if k else (
            "base_shear_{}", "ground_acceleration_{}")
        columns += [f"{shear.format(direction)} [N]" for direction in DIRECTIONS]
        values += [-forces[:, 2 * k:, AXES[direction]].sum(1) for direction in DIRECTIONS]
        level = (ground if k == 0 else forces[:, 2 * k] / masses[2 * k] if masses[2 * k] > 0
                 else np.zeros((len(forces), 3)))
        columns += [f"{acceleration.format(axis)} [m/s2]" for axis in ("ns", "ew", "ud")]
        values += [band_limited(middle, level[:, AXES[axis]]) for axis in ("ns", "ew", "ud")]
    return Storeys(tuple(columns), np.column_stack(values))


def band_limited(time, values):
    """(F,) values at times (F,) [s] without what lies beyond BAND; gaps (NaN) stay."""
    finite = np.isfinite(values)
    if finite.sum() < 2:
        return values
    grid = np.arange(time[0], time[-1] + STEP / 2, STEP)
    ends = round(PADDING / STEP)
    padded = np.pad(np.interp(grid, time[finite], values[finite]), ends, "edge")
    gain = 1 / np.sqrt(1 + (np.fft.rfftfreq(len(padded), STEP) / BAND[1]) ** (2 * ORDER))
    filtered = np.fft.irfft(gain * np.fft.rfft(padded), len(padded))[ends:-ends]
    return np.where(finite, np.interp(time, grid, filtered), values)


def ground_velocity(motion, time):
    """(F, 3) velocity of the ground at times (F,) [m/s]: exact integral of the linear acceleration, or zero."""
    if motion is None:
        return np.zeros((len(time), 3))
    a, dt = motion.acceleration, motion.dt
    velocity = np.concatenate([np.zeros((1, 3)), np.cumsum((a[1:] + a[:-1]) / 2, axis=0) * dt])
    place = np.clip((np.asarray(time) - motion.start) / dt, 0, len(a) - 1)
    k = np.minimum(place.astype(int), max(len(a) - 2, 0))
    rest = (place - k)[:, None]
    following = a[np.minimum(k + 1, len(a) - 1)]
    return velocity[k] + dt * rest * (a[k] + rest / 2 * (following - a[k]))
