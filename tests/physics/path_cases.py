# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 2, friction: the tangential spring on prescribed paths.

The bodies are so heavy that contact forces do not change their prescribed velocities (the elastic law does not depend
on mass).
Without dashpots and gravity the forces follow from the path alone.
"""
import dataclasses

import numpy as np
import yade_timber as yt
from cases import O, hertz_constant, integrate_first, scene, shear_stiffness
from rows import Registry, Row, series
from yade.minieigenHP import Vector3

case = Registry()
HEAVY = 1e18
"""[kg/m3]"""
MU, POINTS, OVERLAP = 0.5, 4, 1e-4
SIZES = ((0.5, 0.4, 0.44), (0.2, 0.24, 0.28))
"""Extents of base and block; all edges differ, so that the principal axes are parallel to them. [m]"""
CONSTANT = hertz_constant(np.prod(SIZES[0]), np.prod(SIZES[1]))
FORCE = POINTS * CONSTANT * OVERLAP**1.5
"""Normal force at OVERLAP, all points. [N]"""
STIFFNESS = POINTS * shear_stiffness(CONSTANT, OVERLAP)
"""Tangential stiffness at OVERLAP, all points. [N/m]"""


def pair(dt=1e-4, friction=MU):
    """Base and a block on it with OVERLAP."""
    heavy = yt.timber(density=HEAVY, friction=friction)
    base, block = np.array(SIZES)
    low = yt.box(base, (0, 0, -base[2] / 2), None, heavy)
    high = yt.box(block, (0, 0, block[2] / 2 - OVERLAP), None, heavy)
    scene((low, high), dt, gravity=(0, 0, 0), damping_ratio=0, health_check=0)
    O.step()  # a pair counts as placed before its bodies have been integrated
    integrate_first()
    O.step()
    return low, high


def shear_force():
    """Tangential force on the block, all points. [N]"""
    return sum((c["shear_force"] for c in yt.contacts(0, 1)), Vector3.Zero)


def move(block, displacement, count):
    """Move the block by `displacement` (3,) [m] in equal steps; returns the work done on the tangential springs. [J]"""
    work, before, step = 0.0, shear_force(), Vector3(*displacement) / count
    for _ in range(count):
        block.state.vel = step / O.dt
        O.step()
        after = shear_force()
        work -= (before + after).dot(step) / 2
        before = after
    return work


def by_count(quantity, expected, work, counts, bound, least_order, note):
    """Rows for paths in several numbers of steps. These scenes have no time scale: the order is that in the length of a
    step.
    """
    rows = series("2", quantity, expected, [work(count) for count in counts], [1 / count for count in counts], bound,
                  least_order, note=note)
    return [dataclasses.replace(row, quantity=f"{row.quantity[:-4]}, {count} steps [J]", dt=None) for row,
            count in zip(rows, counts)]


def deeper(overlap):
    """Displacement of the block from OVERLAP to this overlap. [m]"""
    return (0, 0, OVERLAP - overlap)


@case
def elastic_cycle():
    """A cycle below the friction limit does no work. Rounding of coordinates against a path of 1e-7 m; observed 3e-15.
    """
    block = pair()[1]
    reach = 0.5 * MU * FORCE / STIFFNESS
    work = sum(move(block, (d, 0, 0), 50) for d in (reach, -2 * reach, reach))
    return [Row("2", "elastic tangential cycle: work / stored energy [-]", 0.0, work / (STIFFNESS * reach**2 / 2),
                bound=1e-9, note="rounding")]


@case
def slip_cycle():
    """Hysteresis of spring and slider: work 4 mu N (S - mu N / K_s) per cycle, after the first quarter.

    The corners of the loop are inside a step, where the trapezoidal rule errs by up to K_s ds^2 / 2: order 2. Observed:
    1.6e-6 with 1600 steps.
    """
    limit = MU * FORCE / STIFFNESS
    reach = 3 * limit

    def work(count):
        block = pair()[1]
        move(block, (reach, 0, 0), count // 4)
        return move(block, (-2 * reach, 0, 0), count // 2) + move(block, (2 * reach, 0, 0), count // 2)

    return by_count("slip cycle: work [J]", 4 * MU * FORCE * (reach - limit), work, (400, 800, 1600), 5e-6, 1.8,
                    "corner of the loop inside a step")


@case
def slip_circle():
    """Block on a circle of radius R: the sliders move on a circle of radius sqrt(R^2 - l^2), l = mu N / K_s, and
    dissipate mu N 2 pi sqrt(R^2 - l^2) per revolution.

    Radial return at the end of each step is of first order in the angle of a step. Observed: 9e-4 with 2000 steps.
    """
    limit = MU * FORCE / STIFFNESS
    reach = 2 * limit

    def work(count):
        block, angle = pair()[1], np.linspace(0, 2 * np.pi, count + 1)
        path = reach * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        move(block, path[0], 100)
        return [sum(move(block, step, 1) for step in np.diff(path, axis=0)) for _ in range(2)][1]

    return by_count("slip on a circle, one revolution: work [J]", 2 * np.pi * MU * FORCE * np.sqrt(reach**2 - limit**2),
                    work, (500, 1000, 2000), 2e-3, 0.9, "radial return")


@case
def squeeze_and_shear_cycle():
    """Shear by s at n1, compress to n2, shear back, release, and the reverse order: both need the work (K_s2 - K_s1)
    s^2 / 2.

    A spring with constant length instead of constant force while n grows, or constant force while n shrinks, would
    create energy in one of the two orders. The trapezoidal rule is exact on straight parts; rounding remains.
    """
    squeezed, shift = 1.5 * OVERLAP, 0.3 * MU * FORCE / STIFFNESS
    expected = POINTS * (shear_stiffness(CONSTANT, squeezed) - shear_stiffness(CONSTANT, OVERLAP)) * shift**2 / 2
    down, up = np.array(deeper(squeezed)), -np.array(deeper(squeezed))
    orders = {
        "shear first": [(shift, 0, 0), down, (-shift, 0, 0), up],
        "squeeze first": [down, (shift, 0, 0), up, (-shift, 0, 0)]
    }
    rows = []
    for name, parts in orders.items():
        block = pair()[1]
        rows.append(
            Row(
                "2",
                f"cycle of shear and squeeze, {name}: work [J]",
                expected,
                sum(move(block, part, 50) for part in parts),
                bound=1e-6,
                note="rounding",
            )
        )
    return rows


@case
def closed_paths_create_no_energy():
    """40 random closed polygons in (x, y, n), below and above the friction limit, from an unloaded tangential spring:
    the smallest work is not negative.
    """
    random, limit = np.random.default_rng(1), MU * FORCE / STIFFNESS
    least = np.inf
    for _ in range(40):
        block = pair()[1]
        corners = random.uniform(-1, 1, (6, 3)) * (2 * limit, 2 * limit, 0.4 * OVERLAP)
        legs = np.diff(np.vstack([np.zeros(3), corners, np.zeros(3)]), axis=0)
        parts = [leg * mask for leg in legs for mask in ((1, 1, 0), (0, 0, 1))]
        least = min(least, sum(move(block, part, 20) for part in parts))
    scale = STIFFNESS * limit**2 / 2
    return [Row("2", "random closed paths: energy created / stored at the limit [-]", 0.0, max(0.0, -least / scale),
                bound=1e-9, note="rounding; dissipation is not counted")]
