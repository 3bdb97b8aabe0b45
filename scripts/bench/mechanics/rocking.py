# SPDX-License-Identifier: GPL-2.0-or-later
"""A slender column that rocks or topples, a row of falling blocks, and a pendulum.

With edges of radius r the column rolls on arcs. With a = b/2 - r, c = h/2 - r and the tilt t, the centre is at
    across X = a cos t - c sin t    up Y = r + c cos t + a sin t        from the centre line of the arc,
    energy (I + m (X² + Y²)) t'² / 2 + m g Y.
"""
import math
import sys
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.special import ellipk

sys.path.append(str(Path(__file__).resolve().parents[2] / "validation"))

from mechanics.rows import EXACT, add, constant
from mechanics.scene import G, Body, Joint, Scene, box_inertia
from row_of_blocks import Row as BlockRow, touch_times

B, H, MASS = 0.105, 2.73, 10.0
"""Width and height [m], mass [kg] of the column."""
INERTIA = box_inertia(MASS, (B, B, H))[1]
START, STEEP = 0.5, 1.1
"""Tilts at the start, in parts of the critical one."""


def centre(tilt, radius):
    """(X, Y). [m]"""
    a, c = B / 2 - radius, H / 2 - radius
    return a * math.cos(tilt) - c * math.sin(tilt), radius + c * math.cos(tilt) + a * math.sin(tilt)


def critical(radius):
    """Tilt at which the column topples. [rad]"""
    return math.atan2(B / 2 - radius, H / 2 - radius)


def column(name, share, duration, radius):
    tilt = share * critical(radius)
    across, up = centre(tilt, radius)
    turn = (math.cos(tilt / 2), 0.0, math.sin(tilt / 2), 0.0)
    bodies = (Body("floor", (0, 0, -0.5), (10, 4, 1)),
              Body("column", (-across, 0, up), (B, B, H), mass=MASS, orientation=turn))
    return Scene(name, duration, bodies, friction=1.0, sample=0.002, radius=radius)


def rock(radius):
    return [column("rocking", START, 4.0, radius)]


def topple(radius):
    return [column("toppling", STEEP, 6.0, radius)]


def tilts(run):
    """Rotation about y (n,). [rad]"""
    q = run.orientation["column"]
    return 2 * np.arctan2(q[:, 2], q[:, 0])


def swing_time(low, high, rest, radius):
    """From the tilt `rest`, where the column is at rest, through low ... high, one of which is `rest`. [s]"""
    def integrand(u):
        tilt = rest - u * u if rest == high else rest + u * u
        x, y = centre(tilt, radius)
        return 2 * u * math.sqrt((INERTIA + MASS * (x * x + y * y)) / (2 * MASS * G * (centre(rest, radius)[1] - y)))

    return quad(integrand, 0, math.sqrt(high - low), epsabs=0, epsrel=1e-9)[0]


def impact_ratio(radius):
    """Angular velocity after an impact over that before, Housner (Bull. Seism. Soc. Am. 53 (1963) 403)."""
    a, up = B / 2 - radius, H / 2
    return (INERTIA + MASS * (up**2 - a**2)) / (INERTIA + MASS * (up**2 + a**2))


def height(tilt, radius):
    """Of the centre above that of the upright column. [m]"""
    return centre(abs(tilt), radius)[1] - H / 2


def time_to_upright(run):
    """[s]; from the last two samples before, as the tilt is nearly straight there."""
    tilt = tilts(run)
    below = np.flatnonzero(tilt <= 0)
    if not len(below):
        return math.inf
    k = below[0] - 1
    return float(run.times[k] + tilt[k] * (run.times[k] - run.times[k - 1]) / max(tilt[k - 1] - tilt[k], 1e-12))


def energy_after_impact(run, radius):
    """Energy of the first swing to the other side over that of the start."""
    start = START * critical(radius)
    upright = time_to_upright(run)
    if not math.isfinite(upright):
        return math.nan
    later = tilts(run)[(run.times > upright) & (run.times < upright + 2.2 * swing_time(0, start, start, radius))]
    other = -later.min() if len(later) else 0.0
    return height(other, radius) / height(start, radius)


@lru_cache
def late_tilt(radius):
    """Tilt of the last swing that ends within the run, by Housner's ratio from swing to swing. [rad]"""
    tilt, time = START * critical(radius), 0.0
    while True:
        wanted = height(tilt, radius) * impact_ratio(radius) ** 2
        low, high = 0.0, tilt
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if height(middle, radius) < wanted else (low, middle)
        time += swing_time(0, tilt, tilt, radius) + swing_time(0, low, low, radius)
        if time > 4.0:
            return tilt
        tilt = low


def late_ratio(run, radius):
    """Largest tilt in the last second over the closed form; infinite if the column never was upright."""
    if not math.isfinite(time_to_upright(run)):
        return math.inf
    return float(abs(tilts(run)[run.times > 3.0]).max() / late_tilt(radius))


def topple_time(run):
    """Until 1 rad. [s]"""
    beyond = np.flatnonzero(tilts(run) > 1.0)
    if not len(beyond):
        return math.inf
    k, tilt = beyond[0], tilts(run)
    return float(run.times[k] - (tilt[k] - 1) / (tilt[k] - tilt[k - 1]) * (run.times[k] - run.times[k - 1]))


def farther(scene):
    """A start 20 % farther from upright."""
    return column(scene.name, 1.2 * START, scene.duration, scene.radius)


def wider(scene):
    """A column 10 % wider, which keeps its start."""
    floor, block = scene.bodies
    return replace(scene, bodies=(floor, replace(block, extents=(1.1 * B, B, H))))


add(key="rocking_time", title="rocking: time to upright", unit="s", scenes=rock, measure=time_to_upright,
    expected=lambda radius: swing_time(0, START * critical(radius), START * critical(radius), radius), bound=EXACT,
    relative=True, source="quadrature of the rolling block", fault=farther)
add(key="rocking_energy", title="rocking: energy after impact", unit="-", scenes=rock,
    measure=lambda run: energy_after_impact(run, run.scene.radius), expected=lambda radius: impact_ratio(radius) ** 2,
    bound=EXACT, source="Housner 1963", fault=farther)
add(key="rocking_state", title="rocking: tilt in 4th second", unit="-", scenes=rock,
    measure=lambda run: late_ratio(run, run.scene.radius), expected=constant(1.0), bound=0.1,
    source="Housner 1963, impact by impact", fault=farther)
add(key="toppling", title="column at 1.1 critical: fall time", unit="s", scenes=topple, measure=topple_time,
    expected=lambda radius: swing_time(STEEP * critical(radius), 1.0, STEEP * critical(radius), radius), bound=EXACT,
    relative=True, source="quadrature of the rolling block", fault=wider)

# --- row of falling blocks --------------------------------------------------------------------------------------------
BLOCKS = BlockRow(0.48, 0.075, 0.2235, 12, 2.0)
"""Hinged at their front foot edges, without friction."""


def block_row(radius):
    width = 0.24
    base = Body("base", (1.2, 0, -0.05), (4.0, 0.6, 0.1))
    bodies, hinges = [base], []
    for k in range(BLOCKS.number):
        spin = (0.0, BLOCKS.first_velocity if k == 0 else 0.0, 0.0)
        velocity = (spin[1] * BLOCKS.height / 2, 0.0, spin[1] * BLOCKS.thickness / 2)
        bodies.append(Body(f"block{k}", (k * BLOCKS.pitch - BLOCKS.thickness / 2, 0, BLOCKS.height / 2),
                           (BLOCKS.thickness, width, BLOCKS.height), mass=9.0, spin=spin, velocity=velocity))
        foot = tuple((k * BLOCKS.pitch, y, 0.0) for y in (-width / 2, width / 2))
        hinges.append(Joint("hinge", "base", f"block{k}", foot, stiffness=1e6))
    return [Scene("block_row", 2.5, tuple(bodies), tuple(hinges), friction=0.0, sample=0.001)]


def wave_time(run):
    """From the touch of the fourth block on the fifth to that of the last but one on the last. [s]"""
    times = []
    for k in (3, BLOCKS.number - 2):
        q = run.orientation[f"block{k}"]
        beyond = np.flatnonzero(2 * np.arctan2(q[:, 2], q[:, 0]) >= BLOCKS.touch_angle)
        if not len(beyond):
            return math.inf
        times.append(run.times[beyond[0]])
    return float(times[1] - times[0])


@lru_cache
def theory_of_wave():
    times = touch_times(BLOCKS)
    return float(times[BLOCKS.number - 2] - times[3])


add(key="block_row", title="hinged blocks: wave time", unit="s", scenes=block_row, measure=wave_time,
    expected=lambda radius: theory_of_wave(), bound=0.05, relative=True,
    source="van Leeuwen, Am. J. Phys. 78 (2010) 721: rigid, inelastic", needs=frozenset({"hinge"}),
    fault=lambda scene: replace(scene, gravity=8.5))

# --- pendulum ---------------------------------------------------------------------------------------------------------
LENGTH, BOB = 2.0, (0.2, 0.2, 0.2)
REDUCED = LENGTH + BOB[0] ** 2 / 6 / LENGTH
"""Length of the simple pendulum with the same period. [m]"""


def pendulum(name, degrees, duration):
    angle = math.radians(degrees)
    place = (-LENGTH * math.sin(angle), 0.0, 3 - LENGTH * math.cos(angle))
    turn = (math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0)
    bodies = (Body("anchor", (0, 0, 3.5), (0.2, 0.2, 0.2)), Body("bob", place, BOB, mass=10.0, orientation=turn))
    return Scene(name, duration, bodies, (Joint("ball", "anchor", "bob", ((0.0, 0.0, 3.0),), stiffness=1e7),))


def wide_swing(radius):
    return [pendulum("pendulum_30", 30, 6.5)]


def small_swing(radius):
    return [pendulum("pendulum_5", 5, 28.0)]


def swing(run):
    """Angle of the bob about the anchor (n,), positive at the start. [rad]"""
    place = run.position["bob"]
    return np.arctan2(-place[:, 0], 3 - place[:, 2])


def period(run):
    """Twice the time between the first and the third passage through zero, over two. [s]"""
    angle = swing(run)
    k = np.flatnonzero(angle[:-1] * angle[1:] < 0)
    if len(k) < 3:
        return math.inf
    zeros = run.times[k] + (run.times[k + 1] - run.times[k]) * angle[k] / (angle[k] - angle[k + 1])
    return float(zeros[2] - zeros[0])


def exact_period():
    """[s]"""
    return 4 * math.sqrt(REDUCED / G) * ellipk(math.sin(math.radians(15)) ** 2)


def kept_amplitude(run):
    """Largest angle in the last period over that of the start."""
    return float(abs(swing(run)[run.times > run.times[-1] - 3.0]).max() / math.radians(5))


def lighter(scene):
    return replace(scene, gravity=0.95 * G)


def damped_start(scene):
    """A start at 95 % of the angle."""
    other = pendulum(scene.name, 4.75, scene.duration)
    return replace(scene, bodies=other.bodies)


add(key="pendulum_period", title="pendulum 30°: period", unit="s", scenes=wide_swing, measure=period,
    expected=lambda radius: exact_period(), bound=EXACT, relative=True, source="4 (l/g)^½ K(sin 15°)",
    needs=frozenset({"ball"}), fault=lighter)
add(key="pendulum_amplitude", title="pendulum 5°: amplitude", unit="-", scenes=small_swing, measure=kept_amplitude,
    expected=constant(1.0), bound=0.02, source="no damping", needs=frozenset({"ball"}), fault=damped_start)
