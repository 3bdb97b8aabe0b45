# SPDX-License-Identifier: GPL-2.0-or-later
"""Wave along a row of falling blocks: rigid, turning about their front foot edges, no friction, slip and restitution.

After J. M. J. van Leeuwen, The domino effect, American Journal of Physics 78 (2010) 721, derived again. Needs no YADE.

A block of height h and thickness d turns about its front foot edge by a; the edges lie at distances p, the pitch; the
gap is p - d. The front top edge of a block at (h sin a, h cos a) slides on the rear face of the next one, which has
turned by b. The rear face lies d behind the line through the next foot edge:
    h sin(a - b) = p cos b - d                                                  (1)
A block touches an upright one (b = 0) at sin c = (p - d) / h. The time derivative of (1) gives
    da/dt = w db/dt,   w = 1 - p sin b / (h cos(a - b))                         (2)
So the angle of the foremost block gives all angles behind it, and its angular velocity v all velocities, by products of
w. With the moment of inertia about the foot edge I = m (h2 + d2) / 3, the sum S of the squared products, and the
centre's height:
    energy = I S v2 / 2 + m g / 2 sum (h cos a + d sin a)                       (3)
is constant from one impact to the next. An impact at a = c, b = 0 transmits a horizontal impulse with equal levers
h cos c about both edges. Constraints without friction do no work, so the momentum of the foremost angle is constant:
    S v before = (S + 1) v after                                                (4)
because w = 1 there. The new block is then the foremost one. The time between two impacts is the integral of da / v
from 0 to c.
"""
from dataclasses import dataclass
from math import asin, cos, sin, sqrt

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)
"""Gauss points on -1 to 1."""


@dataclass(frozen=True)
class Row:
    """A row of equal blocks. Lengths in m; first_velocity: of the first block at the start, upright [rad/s]."""

    height: float
    thickness: float
    pitch: float
    number: int
    first_velocity: float
    gravity: float = 9.81

    @property
    def touch_angle(self):
        """c, at which a block touches the next one, upright. [rad]"""
        return asin((self.pitch - self.thickness) / self.height)

    @property
    def inertia(self):
        """About the foot edge, per mass. [m2]"""
        return (self.height**2 + self.thickness**2) / 3


def chain(row, foremost, number):
    """Angles [rad], and velocities over that of the foremost, of `number` blocks in contact.

    foremost: angle of the foremost [rad]
    """
    angles, ratios = [foremost], [1.0]
    for _ in range(number - 1):
        b = angles[-1]
        a = b + asin((row.pitch * cos(b) - row.thickness) / row.height)
        angles.append(a)
        ratios.append(ratios[-1] * (1 - row.pitch * sin(b) / (row.height * cos(a - b))))
    return np.array(angles), np.array(ratios)


def potential(row, angles):
    """Per mass. [J/kg]"""
    return row.gravity / 2 * float(np.sum(row.height * np.cos(angles) + row.thickness * np.sin(angles)))


def turning(row, energy, angle, number):
    """(velocity of the foremost block [rad/s], S) at its angle, with the energy per mass of `number` blocks [J/kg]."""
    angles, ratios = chain(row, angle, number)
    inertia = float(np.sum(ratios**2))
    kinetic = energy - potential(row, angles)
    if kinetic <= 0:
        raise ValueError(f"row of blocks: {number} blocks come to rest at {angle:.3f} rad; raise first_velocity")
    return sqrt(2 * kinetic / (row.inertia * inertia)), inertia


def touch_times(row):
    """Time at which each block reaches the touch angle, from the start. [s]"""
    velocity, inertia, time, times = row.first_velocity, 1.0, 0.0, []
    for number in range(1, row.number + 1):
        energy = row.inertia * turning_sum(row, number) * velocity**2 / 2 + potential(row, chain(row, 0.0, number)[0])
        angles = row.touch_angle * (NODES + 1) / 2
        velocities = np.array([turning(row, energy, angle, number)[0] for angle in angles])
        time += row.touch_angle / 2 * float(np.sum(WEIGHTS / velocities))
        times.append(time)
        velocity, inertia = turning(row, energy, row.touch_angle, number)
        velocity *= inertia / (inertia + 1)
    return np.array(times)


def turning_sum(row, number):
    """S of `number` blocks in contact whose foremost is upright. [-]"""
    return float(np.sum(chain(row, 0.0, number)[1] ** 2))


def wave_speed(pitch, times, blocks):
    """Mean speed over the last `blocks` blocks. [m/s]"""
    return pitch * blocks / (times[-1] - times[-1 - blocks])
