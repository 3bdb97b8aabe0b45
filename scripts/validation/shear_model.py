# SPDX-License-Identifier: GPL-2.0-or-later
"""Lumped-mass shear model of a house: one mass a level and direction, storeys as springs. Independent of the package.

    m_i a_i + c v + V_i(g_i) - V_i+1(g_i+1) = -m_i a_ground      g_i = (u_i - u_i-1) / h_i, drift of storey i [rad]
    V_i = shears of walls and column ends + rocking - W_i g_i    W_i weight above the storey (P-delta) [N]

* Walls: backbone B(g) of straight lines with slip. With the largest drift G so far and the unloading stiffness k, both
  parts have the elastic limit y = B(G) / k. A share phi is elastic-perfectly plastic; the rest has a slack of G - y
  on either side (docs/theory.md, section 4).
* Column ends: a column turns about an edge of either end; the fittings on the other edge, at a distance b, stretch by
  b g. Half of a fitting's stiffness k and strength F is at that edge. With n columns of height h: stiffness n k b2 / h
  per rad, strength n F b / h, softening and ultimate drift d / b.
* Rocking: the weight above acts on the edges, with W a / h against the drift, in full from ROCKING_DRIFT on; a is the
  distance of the edges.
* Damping: c = tau k with the tangent stiffness k of walls and column ends, never a negative one, or with the initial
  one. tau gives the first mode at small drift, with rocking and P-delta, the house's damping ratio.

Not in it: uplift and pulling out of columns, torsion, friction, vertical motion, members that come loose.
Integration: central differences.
"""
from dataclasses import dataclass
from math import copysign

import numpy as np
from scipy.linalg import eigh

from timber_houses.recording.verdict import TILT

STEP = 1e-3
"""[s]"""
ROCKING_DRIFT = 2e-3
"""Drift at which a column end of 0.12 m has lifted off its far edge: Hertz overlap of its points, 0.08 mm under its
share of the weight (paper, Eq. 37), twice over the distance of the edges, 0.096 m. [rad]"""
LIMIT = TILT.drift
"""Drift at which a storey fails and the calculation ends. [rad]"""


class SlipSpring:
    """A wall or joint between drift [rad] and shear [N]. points: backbone behind the origin [(rad, N)], at last 0 N."""

    def __init__(self, stiffness, friction_share, points):
        self.stiffness, self.friction_share = stiffness, friction_share
        self.drifts, self.forces = np.array([(0.0, 0.0), *points]).T
        self.largest = self.plastic = self.limit = 0.0
        self.tangent = stiffness  # of the last step, never negative [N/rad]

    def shear(self, drift):
        """After a further step to this drift. [N]"""
        rise = None  # of the elastic limit over that of the largest drift
        if abs(drift) > self.largest:
            grown, before = abs(drift) - self.largest, self.limit
            self.largest = abs(drift)
            self.limit = float(np.interp(self.largest, self.drifts, self.forces)) / self.stiffness
            rise = max(0.0, (self.limit - before) / grown)
        trial = drift - self.plastic
        elastic = min(max(trial, -self.limit), self.limit)
        self.plastic = drift - elastic
        slip = copysign(max(0.0, abs(drift) - (self.largest - self.limit)), drift)
        friction_rise = 1.0 if elastic == trial else rise or 0.0
        slip_rise = 0.0 if slip == 0 else 1.0 if rise is None else rise
        self.tangent = self.stiffness * (self.friction_share * friction_rise + (1 - self.friction_share) * slip_rise)
        return self.stiffness * (self.friction_share * elastic + (1 - self.friction_share) * slip)


@dataclass
class Storey:
    """mass: of its upper level [kg]; height [m]; weight: of all above [N]; edges: their distance a [m]; SlipSprings;
    p_delta: share of the weight that drives the drift [-]."""

    mass: float
    height: float
    weight: float
    edges: float
    springs: list
    p_delta: float = 1.0

    def shear(self, drift):
        """[N]"""
        rocking = self.weight * self.edges / self.height * max(-1.0, min(1.0, drift / ROCKING_DRIFT))
        return sum(spring.shear(drift) for spring in self.springs) + rocking - self.p_delta * self.weight * drift

    def stiffness(self):
        """Initial, of the springs. [N/m]"""
        return sum(spring.stiffness for spring in self.springs) / self.height

    def tangent(self):
        """Of the springs after the last step. [N/m]"""
        return sum(spring.tangent for spring in self.springs) / self.height

    def at_rest(self):
        """Stiffness at small drift, of springs, rocking and P-delta. [N/m]"""
        return self.stiffness() + self.weight * (self.edges / self.height / ROCKING_DRIFT - self.p_delta) / self.height


def slip_spring(stiffness, strength, friction_share, softening, ultimate):
    """Bilinear SlipSpring with loss of strength: [N/rad], [N], [-], drifts [rad]."""
    points = [(strength / stiffness, strength), (softening, strength), (ultimate, 0.0)]
    return SlipSpring(stiffness, friction_share, points)


def stiffness_matrix(storeys, of=Storey.stiffness):
    """Of the stiffnesses `of` the storeys. [N/m]"""
    k = np.array([of(storey) for storey in storeys])
    matrix = np.diag(k + np.append(k[1:], 0.0))
    return matrix - np.diag(k[1:], 1) - np.diag(k[1:], -1)


def first_period(storeys):
    """[s]"""
    omega2 = eigh(stiffness_matrix(storeys), np.diag([storey.mass for storey in storeys]), eigvals_only=True)
    return 2 * np.pi / np.sqrt(omega2[0])


def damping_time(storeys, ratio):
    """tau, with which the first mode at small drift has a damping ratio; 0 if it is unstable. [s]"""
    mass = np.diag([storey.mass for storey in storeys])
    omega2, shapes = eigh(stiffness_matrix(storeys, Storey.at_rest), mass)
    first = shapes[:, 0]
    return 2 * ratio * np.sqrt(max(0.0, omega2[0])) / (first @ stiffness_matrix(storeys) @ first)


def response(storeys, acceleration, dt, damping_ratio, damped=Storey.tangent):
    """(times [s], drifts (n, storeys) [rad]) to the end of the motion or to LIMIT.

    acceleration: of the ground [m/s2], one sample every dt [s]; damped: stiffness of the dashpots, Storey.stiffness for
    the initial one
    """
    mass, heights = np.array([s.mass for s in storeys]), np.array([s.height for s in storeys])
    tau, inertia = damping_time(storeys, damping_ratio), np.diag(mass) / STEP**2
    times = np.arange(0.0, dt * (len(acceleration) - 1), STEP)
    ground = np.interp(times, dt * np.arange(len(acceleration)), acceleration)
    last = now = np.zeros(len(storeys))
    drifts = np.zeros((len(times), len(storeys)))
    for step, a in enumerate(ground):
        drift = np.diff(now, prepend=0.0) / heights
        drifts[step] = drift
        if np.abs(drift).max() > LIMIT:
            return times[:step + 1], drifts[:step + 1]
        shear = np.array([storey.shear(g) for storey, g in zip(storeys, drift)])
        force = -mass * a - shear + np.append(shear[1:], 0.0)
        damping = tau * stiffness_matrix(storeys, damped) / (2 * STEP)
        last, now = now, np.linalg.solve(inertia + damping, force + 2 * inertia @ now + (damping - inertia) @ last)
    return times, drifts
