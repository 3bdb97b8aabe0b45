# SPDX-License-Identifier: GPL-2.0-or-later
"""Orthographic pictures of convex bodies with a depth buffer; bodies may overlap."""
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_fill_holes

SUPERSAMPLING = 2
LIGHT = np.array([0.35, 0.75, 0.80])
"""Direction to the light in the axes right, towards the viewer, up of the picture; any length."""
DARKEST = 0.74
"""Brightness of a face turned away from the light. [-]"""
HAZE, HAZE_DEPTH = 0.4, 12.0
"""Largest share of sky over a face, reached HAZE_DEPTH [m] behind the front of the house, so that far walls recede."""
EDGE_COLOR = 0.22
EDGE_ON = 1e-6
"""Faces with a smaller component of the normal towards the viewer are not drawn. [-]"""
SKY = np.array([0.76, 0.85, 0.93], np.float32)


@dataclass(frozen=True)
class Window:
    """Part of a picture plane. view: .right, .toward and .up, unit vectors; box (left, right, bottom, top) [m]; density: pixels per metre."""

    view: object
    box: tuple
    density: float


def even_density(density):
    """Pixels per metre reduced to a multiple of 2; unchanged below 2, for scenes of kilometres."""
    return int(density) // 2 * 2 or density


def front_of(solids, view):
    """Coordinate towards the viewer of the nearest corner of the house, snow and ground left out. [m]"""
    return max(((s.vertices @ view.toward).max() for s in solids if s.kind not in ("ground", "snow")), default=0.0)


def shade(solids, window, front, sky=SKY):
    """Picture and depth of bodies in a Window.

    solids  list with .vertices, .faces, .color, .kind
    front   where haze begins, as from `front_of` [m]
    sky     RGB of the background, or one number for a grey
    Returns the RGB picture (rows, columns, 3) in 0..1, first row at the top, and for each pixel the coordinate towards the viewer of
    the visible face [m], minus infinity for the background.
    """
    face, depth, faces = _scan(solids, window, window.density * SUPERSAMPLING)
    sky = np.broadcast_to(np.float32(sky), 3)
    colors = np.array([sky] + [_tint(solids[body], normal) for body, normal in faces] + [np.full(3, EDGE_COLOR)], np.float32)
    color = np.where(_edges(face), len(faces) + 1, face + 1)
    haze = _haze(face, depth, front)
    rows, columns = (n // SUPERSAMPLING * SUPERSAMPLING for n in face.shape)  # an incomplete pixel at the border is dropped
    corners = [np.s_[i:rows:SUPERSAMPLING, k:columns:SUPERSAMPLING] for i in range(SUPERSAMPLING) for k in range(SUPERSAMPLING)]
    picture = sum(_blended(colors.take(color[part], axis=0), sky, haze[part]) for part in corners)
    return picture / np.float32(len(corners)), depth[::SUPERSAMPLING, ::SUPERSAMPLING]


def outline(solids, window):
    """(rows, columns) whether a pixel lies within the outer outline of the bodies."""
    return binary_fill_holes(_scan(solids, window, window.density)[0] >= 0)


def _tint(solid, normal):
    """RGB of a face by its normal (right, toward, up)."""
    light = max(0.0, float(normal @ LIGHT) / np.linalg.norm(LIGHT))
    return np.array(solid.color) * (DARKEST + (1 - DARKEST) * light)


def _haze(face, depth, front):
    """(rows, columns) share of sky over the visible face. [-]"""
    haze = np.clip((np.float32(front) - depth) * np.float32(HAZE / HAZE_DEPTH), 0, HAZE)
    haze[face < 0] = 0
    return haze


def _blended(picture, sky, share):
    """RGB picture with a share of sky over it."""
    picture += share[..., None] * (sky - picture)
    return picture


def _scan(solids, window, density):
    """Depth buffer: (face number or -1, depth, list of (body, normal) of the faces). density: pixels per metre"""
    view, (left, right, bottom, top) = window.view, window.box
    shape = round((top - bottom) * density), round((right - left) * density)
    owner, depth = np.full(shape, -1, np.int32), np.full(shape, -np.inf, np.float32)
    axes = np.array([view.right, view.toward, view.up], float)
    faces = []
    for body, solid in enumerate(solids):
        corners = (solid.vertices @ axes.T - (left, 0, top)) * (density, 1, -density)  # column, depth, row
        for face in solid.faces:
            normal = _normal(corners[face])
            if normal[1] > EDGE_ON * np.abs(normal).sum():
                _fill(corners[face], normal, len(faces), owner, depth)
                outward = normal * (density, 1, -density)
                faces.append((body, outward / np.linalg.norm(outward)))
    return owner, depth, faces


def _normal(corners):
    """Normal of a convex polygon (n, 3: column, depth, row) by Newell's sum; its depth component is > 0 for a face turned to the viewer."""
    a, b = corners, np.concatenate([corners[1:], corners[:1]])
    return np.array([a[:, j] @ b[:, k] - a[:, k] @ b[:, j] for j, k in ((1, 2), (2, 0), (0, 1))])


def _fill(polygon, normal, number, owner, depth):
    """Write a convex polygon (n, 3: column, depth, row) to the buffers at the pixels whose centres it covers and where it is nearest."""
    across, up = polygon[:, 0], polygon[:, 2]
    low = np.maximum([int(np.floor(up.min())), int(np.floor(across.min()))], 0)
    high = np.minimum([int(np.ceil(up.max())), int(np.ceil(across.max()))], owner.shape)
    if (low >= high).any():
        return
    x, y = np.arange(low[1], high[1]) + 0.5, np.arange(low[0], high[0])[:, None] + 0.5
    inside = np.ones((len(y), len(x)), bool)
    for a, b in zip(polygon, np.concatenate([polygon[1:], polygon[:1]])):
        inside &= (b[0] - a[0]) * (y - a[2]) <= (b[2] - a[2]) * (x - a[0])
    distance = polygon[0, 1] - (normal[0] * (x - across[0]) + normal[2] * (y - up[0])) / normal[1]
    part = np.s_[low[0] : high[0], low[1] : high[1]]
    nearer = inside & (distance > depth[part])
    owner[part][nearer] = number
    depth[part][nearer] = distance[nearer]


def _edges(face):
    """Pixels on either side of a change of the visible face."""
    lines = np.zeros(face.shape, bool)
    across, down = face[:, :-1] != face[:, 1:], face[:-1] != face[1:]
    lines[:, :-1] |= across
    lines[:, 1:] |= across
    lines[:-1] |= down
    lines[1:] |= down
    return lines
