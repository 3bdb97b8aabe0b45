# SPDX-License-Identifier: GPL-2.0-or-later
"""Perspective cameras around a house, with the player's angles (player/src/view.js). x east, y north, z up [m]."""
from dataclasses import dataclass

import numpy as np

FIELD = 32.0
"""Vertical angle of view. [degree]"""
SPARE = 1.16
"""Size of the picture over that of the house: captions need room above and below. [-]"""
DEBRIS_MARGIN = 1.5
"""Distance from the house up to which debris stays in the picture. [m]"""
SHADOW_MARGIN = 6.0
"""Distance from the house up to which debris casts a shadow. [m]"""
CAMERAS = {"front": (0.0, 5.0), "side": (90.0, 5.0), "space": (38.0, 20.0)}
"""Azimuth from east to north, and elevation. [degree]"""


@dataclass(frozen=True)
class Camera:
    """eye, target (3,) [m]; matrix (4, 4): world to clip space; scale: share of the
    picture's height of a metre at a distance of 1 m [-]"""

    eye: np.ndarray
    target: np.ndarray
    matrix: np.ndarray
    scale: float


def look(name, points, aspect):
    """Camera NAME at the smallest distance that shows all points (P, 3). aspect: width over height"""
    azimuth, elevation = np.radians(CAMERAS[name])
    toward = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    right = np.array([-toward[1], toward[0], 0]) / np.hypot(*toward[:2])
    up = np.cross(toward, right)
    tangent = np.tan(np.radians(FIELD) / 2)
    target = (points.min(0) + points.max(0)) / 2
    for _ in range(4):  # distance that shows all points from this target, then target in their middle
        offset = points - target
        halves = np.maximum(abs(offset @ right) / aspect, abs(offset @ up))
        away = (halves / (tangent / SPARE) + offset @ toward).max()
        for axis in (right, up):
            seen = (offset @ axis) / (away - offset @ toward)
            target = target + away * (seen.min() + seen.max()) / 2 * axis
    eye = target + away * toward
    near, far = max(0.2, 0.05 * away), away + 200.0 + 5 * np.ptp(points, axis=0).max()
    lens = np.zeros((4, 4))
    lens[0, 0], lens[1, 1] = 1 / (tangent * aspect), 1 / tangent
    lens[2, 2:], lens[3, 2] = ((far + near) / (near - far), 2 * far * near / (near - far)), -1
    return Camera(eye, target, lens @ _seen((right, up, toward), eye), 0.5 / tangent)


def _seen(axes, origin):
    """(4, 4) matrix from the world to three axes and an origin."""
    matrix = np.eye(4)
    matrix[:3, :3] = axes
    matrix[:3, 3] = -matrix[:3, :3] @ origin
    return matrix


def shown_points(start, end):
    """(P, 3) points that a camera shows: those of the start, and those of the end, clipped at DEBRIS_MARGIN."""
    margin = (DEBRIS_MARGIN, DEBRIS_MARGIN, 0)
    low, high = start.min(0) - margin, start.max(0) + margin
    return np.concatenate([start, np.clip(end[np.isfinite(end).all(1)], low, high)])


def sun(points):
    """((4, 4) matrix of the light's view, (3,) direction to it): from the south-east around points (P, 3)."""
    middle, size = (points.min(0) + points.max(0)) / 2, np.ptp(points, axis=0)
    light = np.array([13.0, -5.0, 17.0]) / np.linalg.norm([13.0, -5.0, 17.0])
    right = np.cross([0, 0, 1.0], light)
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(light, right), -light])
    half = max(size[:2].max() / 2 + SHADOW_MARGIN, size[2])
    return _seen(axes / half, middle), light
