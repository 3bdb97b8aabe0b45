# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 5: free fall, and torque-free rotation about the intermediate axis against Jacobi's solution.

The package's SymplecticIntegrator and YADE's NewtonIntegrator (damping = 0, exactAsphericalRot: Fincham 1992).
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from cases import DENSITY, G, O, scene, spin, steps
from rows import Registry, Row, series
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk, ellipkinc
from yade.minieigenHP import Vector3

case = Registry()
EDGES = np.array((0.4, 0.2, 0.1))
"""Along x, y, z; the moments of inertia about them are I1 < I2 < I3. [m]"""
MOMENTS = DENSITY * EDGES.prod() / 12 * ((EDGES**2).sum() - EDGES**2)
"""Moments of inertia about x, y, z. [kg m2]"""
START = np.array((0.05, 6.0, 0.1))
"""Angular velocity at t = 0, almost about the intermediate axis. [rad/s]"""
INTEGRATORS = {"SymplecticIntegrator": yw.SymplecticIntegrator,
               "NewtonIntegrator": lambda: yw.NewtonIntegrator(damping=0, exactAsphericalRot=True)}


class Jacobi:
    """Torque-free rotation (Landau and Lifshitz, Mechanics, section 37), L^2 > 2 T I2:

        w1 = A1 cn u,  w2 = A2 sn u,  w3 = A3 dn u,  u = rate t + u0,  parameter m = k^2.
    """

    def __init__(self, moments, start):
        i1, i2, i3 = moments
        self.twice_energy, self.momentum = (moments * start**2).sum(), np.sqrt(((moments * start) ** 2).sum())
        energy, square = self.twice_energy, self.momentum**2
        assert square > energy * i2, "L^2 <= 2 T I2"
        a1 = np.sqrt((energy * i3 - square) / (i1 * (i3 - i1)))
        a2 = np.sqrt((energy * i3 - square) / (i2 * (i3 - i2)))
        a3 = np.sqrt((square - energy * i1) / (i3 * (i3 - i1)))
        self.amplitudes = np.array((a1, a2, a3))
        self.rate = np.sqrt((i3 - i2) * (square - energy * i1) / (i1 * i2 * i3))
        self.parameter = (i2 - i1) * (energy * i3 - square) / ((i3 - i2) * (square - energy * i1))
        self.start = ellipkinc(np.arctan2(start[1] / a2, start[0] / a1), self.parameter)

    def omega(self, time):
        sn, cn, dn, _ = ellipj(self.rate * time + self.start, self.parameter)
        return self.amplitudes * np.array((cn, sn, dn))

    def flips(self, count):
        """Times of the zeros of w2. [s]"""
        half = 2 * ellipk(self.parameter)
        first = np.ceil(self.start / half)
        return (np.arange(first, first + count) * half - self.start) / self.rate


FLIPS = 3
JACOBI = Jacobi(MOMENTS, START)


def attitude(time):
    """Rotation matrix from the body frame of t = 0 to that of `time` [s], by scipy: R' = R [omega], Euler's equations
    for omega.
    """

    def rates(t, y):
        r, w = y[:9].reshape(3, 3), y[9:]
        return np.concatenate([np.cross(r, w).ravel(), np.cross(MOMENTS * w, w) / MOMENTS])

    run = solve_ivp(rates, (0, time), np.concatenate([np.eye(3).ravel(), START]), method="DOP853", rtol=1e-12,
                    atol=1e-13)
    return run.y[:9, -1].reshape(3, 3)


def tumbling(integrator, dt):
    """A body in torque-free rotation and its probe: omega2 [rad/s], twice the energy [J], |L| [kg m2/s]."""
    body = yt.box(EDGES, (0, 0, 0))
    O.reset()
    O.bodies.append(body)
    O.dt, O.engines = dt, [yw.ForceResetter(), INTEGRATORS[integrator]()]
    start, moments = body.state.ori, np.array(body.state.inertia)
    spin(body, START)

    def probe():
        local = np.array(body.state.ori.conjugate() * body.state.angMom)  # in the body's principal frame
        omega = start * Vector3(*(local / moments))
        return omega[1], (local**2 / moments).sum(), np.linalg.norm(local)

    return body, probe


def tumble(integrator, dt):
    """Three flips: dictionary of the time of the third flip [s], largest change of energy and momentum [-], angle
    between the final attitude and that of scipy [rad].
    """
    body, probe = tumbling(integrator, dt)
    start = body.state.ori
    count = int((JACOBI.flips(FLIPS)[-1] + 0.2) / dt)
    omega2, energy, momentum = steps(count, probe).T
    last = np.flatnonzero(omega2[1:] * omega2[:-1] < 0)[FLIPS - 1]
    rotation = np.array((body.state.ori * start.conjugate()).toRotationMatrix()).reshape(3, 3)
    return {
        "flip": (last + 1 + omega2[last] / (omega2[last] - omega2[last + 1])) * dt,
        "energy": np.abs(energy / JACOBI.twice_energy - 1).max(),
        "momentum": np.abs(momentum / JACOBI.momentum - 1).max(),
        "attitude": np.linalg.norm(rotation - attitude(count * dt)) / np.sqrt(2),
    }


def table(integrator, dts, quantities, momentum_bound=1e-13):
    """Series of rows; quantities: name -> (key of tumble(), expected, bound, least order); bound of the change of |L|:
    rounding in 1e4 steps.
    """
    runs = [tumble(integrator, dt) for dt in dts]
    note = "Jacobi's elliptic functions; scipy DOP853 for the attitude"
    rows = []
    for name, (key, expected, bound, order) in quantities.items():
        rows += series("5", f"{integrator}: {name}", expected, [run[key] for run in runs], dts, bound, order, note=note)
    change = max(run["momentum"] for run in runs)  # observed 1.3e-15 for any dt
    return rows + [Row("5", f"{integrator}: largest change of |L| [-]", 0.0, change, bound=momentum_bound,
                       note="rounding")]


@case
def symplectic_integrator_flips():
    """Second order; |L| is constant to rounding.

    Observed at 5e-4 s: flip 1.0e-6, energy 7e-8, attitude 2.3e-5 rad.
    """
    flip = JACOBI.flips(FLIPS)[-1]
    return table(
        "SymplecticIntegrator",
        (2e-3, 1e-3, 5e-4),
        {
            "time of the third flip [s]": ("flip", flip, 2e-6, 1.9),
            "largest change of energy [-]": ("energy", 0.0, 2e-7, 1.9),
            "attitude after three flips [rad]": ("attitude", 0.0, 5e-5, 1.9),
        },
    )


@case
def symplectic_integrator_does_not_drift():
    """One minute, 20 flips: the energy error remains of the order dt^2, without drift."""
    body, probe = tumbling("SymplecticIntegrator", 1e-3)
    energy = np.abs(steps(60000, probe, every=20)[:, 1] / JACOBI.twice_energy - 1)
    return [Row("5", "SymplecticIntegrator: largest change of energy in the last of 60 s [-]", 0.0, energy[-500:].max(),
                bound=5e-7, dt=1e-3, note="second order; no drift")]


@case
def newton_integrator_flips():
    """The rotation of YADE's integrator gains energy (order 1.3), so that flips come earlier by a third at 2.5e-4 s.
    This is the reason for the SymplecticIntegrator. For information only: |L| changes by rounding in YADE 2023.02a, by
    1.3e-8 in 2025.2.0.
    """
    flip = JACOBI.flips(FLIPS)[-1]
    quantities = {
        "time of the third flip [s]": ("flip", flip, np.inf, None), "largest change of energy [-]": (
            "energy", 0.0, np.inf, None)
    }
    return table("NewtonIntegrator", (1e-3, 5e-4, 2.5e-4), quantities, np.inf)


def fall(dt, speed, time=1.0):
    """Height after `time` [s] of free fall from height zero; speed: velocity half a step before the start, upward
    [m/s].
    """
    body = yt.box(EDGES, (0, 0, 0))
    scene([body], dt)
    body.state.vel = Vector3(0, 0, speed)
    steps(int(round(time / dt)))
    return body.state.pos[2]


@case
def free_fall():
    """Exact to rounding if the initial velocity is that of half a step before, g dt / 2 upward (leapfrog). A body at
    rest at t = 0 is late by dt / 2: order 1.
    """
    expected, dts = -G / 2, (4e-4, 2e-4, 1e-4)
    rows = series("5", "free fall for 1 s, at rest at -dt/2 [m]", expected, [fall(dt, 0.0) for dt in dts], dts, 2e-4,
                  0.9, note="leapfrog: velocity at a half step")
    return rows + [Row("5", "free fall for 1 s, at rest at 0 [m]", expected, fall(1e-4, G * 1e-4 / 2), bound=1e-12,
                       dt=1e-4, note="rounding")]
