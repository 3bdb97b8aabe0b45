# SPDX-License-Identifier: GPL-2.0-or-later
"""Orthographic pictures of convex bodies with a depth buffer: exact for bodies in any placement, even overlapping ones."""
import numpy as np
from scipy.ndimage import binary_fill_holes

SUPERSAMPLING = 2
LIGHT = np.array([0.35, 0.75, 0.80])
"""Direction to the light, in the picture's axes right, towards the viewer, up; need not be a unit vector."""
DARKEST = 0.74
"""Brightness of a face that is turned away from the light. [-]"""
HAZE, HAZE_DEPTH = 0.4, 12.0
"""Share of sky over what lies HAZE_DEPTH [m] behind the front of the house: far walls recede. [-]"""
EDGE_COLOR = 0.22
SKY = np.array([0.76, 0.85, 0.93])


def shade(solids, view, box, density):
    """Picture and depth of bodies.

    solids   list with .vertices, .faces, .color, .kind; view: .right and .toward, unit vectors; box (left, right, bottom, top) [m]
    density  pixels per metre
    Returns RGB picture (rows, columns, 3) in 0..1, first row at the top, and the coordinate towards the viewer of what is seen in
    each pixel [m], minus infinity where nothing is.
    """
    face, depth, faces = _scan(solids, view, box, density * SUPERSAMPLING)
    shown = [solids[k].vertices @ view.toward for k in range(len(solids)) if solids[k].kind != "ground"]
    nearest = max(v.max() for v in shown) if shown else 0.0
    colors = np.array([SKY] + [_tint(solids[body], normal) for body, normal in faces])
    picture = colors[face + 1]
    behind = np.clip((nearest - depth) / HAZE_DEPTH, 0, 1)
    behind[face < 0] = 0
    picture = picture + (HAZE * behind)[..., None] * (SKY - picture)
    lines = _edges(face)
    picture[lines] = (EDGE_COLOR + (0.85 - EDGE_COLOR) * HAZE * behind[lines])[:, None]
    return _smaller(picture), depth[::SUPERSAMPLING, ::SUPERSAMPLING]


def outline(solids, view, box, density):
    """(rows, columns) whether a pixel lies within the outer outline of the bodies; arguments as in `shade`."""
    return binary_fill_holes(_scan(solids, view, box, density)[0] >= 0)


def _tint(solid, normal):
    """RGB of a face by its normal (right, toward, up)."""
    light = max(0.0, float(normal @ LIGHT) / np.linalg.norm(LIGHT))
    return np.array(solid.color) * (DARKEST + (1 - DARKEST) * light)


def _scan(solids, view, box, density):
    """Depth buffer: (face number or -1, depth, list of (body, normal) of the faces)."""
    left, right, bottom, top = box
    shape = round((top - bottom) * density), round((right - left) * density)
    owner, depth = np.full(shape, -1), np.full(shape, -np.inf)
    axes = np.array([view.right, view.toward, (0, 0, 1)], float)
    faces = []
    for body, solid in enumerate(solids):
        corners = solid.vertices @ axes.T
        pixels = np.column_stack([(corners[:, 0] - left) * density, (top - corners[:, 2]) * density, corners[:, 1]])
        for face in solid.faces:
            normal = _normal(corners[face])
            if normal[1] > 1e-6:
                _fill(pixels[face], len(faces), owner, depth)
                faces.append((body, normal))
    return owner, depth, faces


def _normal(corners):
    """Unit normal of a convex polygon (n, 3) by Newell's sum. In the axes (right, toward, up), which are left-handed, the sign turns."""
    normal = -np.cross(corners, np.roll(corners, -1, 0)).sum(0)
    return normal / np.linalg.norm(normal)


def _fill(polygon, number, owner, depth):
    """Enter a convex polygon (n, 3: column, row, depth) into the buffers where it is nearest. Pixel centres count."""
    low = np.maximum(np.floor(polygon[:, :2].min(0)).astype(int), 0)
    high = np.minimum(np.ceil(polygon[:, :2].max(0)).astype(int), owner.shape[::-1])
    if (low >= high).any():
        return
    x, y = np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1])[:, None] + 0.5
    first, second = polygon, np.roll(polygon, -1, 0)
    area = np.sum(first[:, 0] * second[:, 1] - second[:, 0] * first[:, 1])
    inside = np.ones((len(y), len(x)), bool)
    for a, b in zip(first, second):
        inside &= ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) * np.sign(area) >= 0
    slope, *_ = np.linalg.lstsq(np.column_stack([polygon[:, :2], np.ones(len(polygon))]), polygon[:, 2], rcond=None)
    here = slope[0] * x + slope[1] * y + slope[2]
    window = np.s_[low[1] : high[1], low[0] : high[0]]
    nearer = inside & (here > depth[window])
    owner[window][nearer] = number
    depth[window][nearer] = here[nearer]


def _edges(face):
    """Pixels at which the visible face changes to that of the right or lower neighbour."""
    lines = np.zeros(face.shape, bool)
    lines[:, :-1] |= face[:, :-1] != face[:, 1:]
    lines[:-1] |= face[:-1] != face[1:]
    return lines


def _smaller(picture):
    """Mean over blocks of SUPERSAMPLING x SUPERSAMPLING pixels; a rest at the border goes."""
    n = SUPERSAMPLING
    rows, columns = picture.shape[0] // n * n, picture.shape[1] // n * n
    return picture[:rows, :columns].reshape(rows // n, n, columns // n, n, 3).mean((1, 3))
