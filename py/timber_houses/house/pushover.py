# SPDX-License-Identifier: GPL-2.0-or-later
"""Pushover curve of each storey and direction: its shear over its drift at first loading, floors rigid, no torsion; and
the natural periods with the secant stiffness of the curves at a drift.

Walls have their envelopes at the level of the house; braces pull with the springs of both ends until the weaker one
breaks and bear nothing in compression. Column ends and P-delta are left out."""
from collections import defaultdict

import numpy as np

from ..base.gravity import weight_of
from ..base.joint_kinds import WALL_COLUMN
from .loads import bay_length
from .weight import level_masses

SHARES = 2.0  # halves of a wall: each spring stands for one. [-] (walls.py, SHARE)
DIRECTIONS = ("ew", "ns")


def pushover(model, group):
    """{(storey, direction): [[drift [-], shear [kN]]]}: piecewise linear, from zero to the drift at which no wall and
    brace is left, or the last point of those with a residual strength. Empty lists without any."""
    curves = defaultdict(list)
    for joint in model.joints:
        if joint.group == group and joint.kind == WALL_COLUMN and not joint.broken:
            low, high = model.element(joint.a), model.element(joint.b)
            axis = int(np.argmax(np.abs(high.solid.centroid - low.solid.centroid)[:2]))
            # the spring between its columns: stretch = length x drift, force = half of the shear x height / length
            length, height = bay_length(low, high), float(np.ptp(low.vertices[:, 2]))
            stretches, forces = np.transpose([(0.0, 0.0), *joint.envelope])
            curves[low.storey, DIRECTIONS[axis]].append((stretches / length, SHARES * forces * length / height))
    for brace in model.of_kind("brace", group=group):
        if (curve := _brace(model, brace)) is not None:
            along = np.ptp(brace.vertices, axis=0)
            curves[brace.storey, DIRECTIONS[int(along[1] > along[0])]].append(curve)
    return {(storey, direction): _sum(curves[storey, direction])
            for storey in model.storey_levels[group] for direction in DIRECTIONS}


def _brace(model, brace):
    """(drifts, shears [N]) of a brace in tension; None if an end is loose or never breaks."""
    ends = {"bottom": [], "top": []}
    for joint in model.joints:
        if joint.a == brace.name and not joint.broken:
            ends[joint.end].append(joint)
    if not all(ends.values()):
        return None
    stiffness, strength = zip(*((sum(j.whole(j.kn) for j in joints), sum(j.whole(j.strength) for j in joints))
                                for joints in ends.values()))
    rise, run = np.ptp(brace.vertices[:, 2]), np.ptp(brace.vertices[:, :2], axis=0).max()
    slope, force = run / np.hypot(rise, run), min(strength)
    if not np.isfinite(force):
        return None
    drift = force * sum(1 / k for k in stiffness) / (slope * rise)
    return np.array([0.0, drift, drift * (1 + 1e-6)]), np.array([0.0, force * slope, 0.0])


def _sum(curves):
    """Points of the sum of piecewise linear curves, rounded: drifts to 1e-6, shears to 1 N."""
    if not curves:
        return []
    drifts = np.unique(np.concatenate([drift for drift, _ in curves]).round(6))
    total = sum(np.interp(drifts, drift, shear) for drift, shear in curves)
    return [[round(float(drift), 6), round(float(shear) / 1000, 3)] for drift, shear in zip(drifts, total)]


def secant_periods(model, group, curves, drift):
    """{direction: period [s]} with all storeys at this drift, the lowest mode of one mass at each level, snow included.

    Stiffness of a storey: shear / (drift x height). Beside the walls and braces of `pushover`, columns of width b that
    rock under the weight W above bear W (b / height - drift): their resistance less P-delta. None where columns bear
    more than walls and braces in a storey: how storeys share the drift decides there."""
    storeys, masses = sorted(model.storey_levels[group]), level_masses(model, group)
    heights = np.array([np.subtract(*reversed(model.storey_levels[group][storey])) for storey in storeys])
    weights = 1000 * weight_of(np.cumsum(masses[::-1])[::-1])  # [N]
    periods = {}
    for axis, direction in enumerate(DIRECTIONS):
        curve = [np.transpose(curves[storey, direction] or [(0.0, 0.0)]) for storey in storeys]
        shears = [1000 * np.interp(drift, drifts, forces, right=0.0) for drifts, forces in curve]
        widths = [np.mean([np.ptp(column.vertices[:, axis]) for column in model.of_kind("column", group=group)
                           if column.storey == storey] or [0.0]) for storey in storeys]
        rocking = weights * (widths / heights - drift)
        stiffness = (shears + rocking) / (drift * heights)  # [N/m]
        periods[direction] = None
        if not all(shears > abs(rocking)):
            continue
        above = np.append(stiffness[1:], 0.0)  # springs from the ground up: K x = omega^2 M x, made symmetric
        matrix = np.diag(stiffness + above) - np.diag(above[:-1], 1) - np.diag(above[:-1], -1)
        omega2 = np.linalg.eigvalsh(matrix / np.sqrt(np.outer(masses, masses)))
        periods[direction] = round(float(2 * np.pi / np.sqrt(omega2[0])), 3)
    return periods
