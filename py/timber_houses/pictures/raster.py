# SPDX-License-Identifier: GPL-2.0-or-later
"""Orthographic pictures of convex bodies with hidden surfaces removed; bodies may overlap."""
from dataclasses import dataclass
from typing import Any

import numpy as np

from .renderer import Bodies, canvas, program, put

LIGHT = np.array([0.35, 0.75, 0.80])
"""Direction to the light in the axes right, towards the viewer, up of the picture; any length."""
DARKEST = 0.74
"""Brightness of a face turned away from the light. [-]"""
HAZE, HAZE_DEPTH = 0.4, 12.0
"""Largest share of sky over a face, reached HAZE_DEPTH [m] behind the front of the house, so that far walls recede."""
EDGE_COLOR, EDGE_WIDTH = 0.22, 1.2
"""Grey and width [pixel] of the lines along edges."""
SKY = np.array([0.76, 0.85, 0.93], np.float32)


@dataclass(frozen=True)
class Window:
    """Part of a picture plane. view: a View; box (left, right, bottom, top) [m]; density: pixels per metre."""

    view: Any
    box: tuple
    density: float

    @property
    def size(self):
        """Width and height. [pixel]"""
        left, right, bottom, top = self.box
        return round((right - left) * self.density), round((top - bottom) * self.density)

    def matrix(self, near, far):
        """(4, 4) from the world to OpenGL's clip space. near, far: ends of what is drawn towards the viewer [m]"""
        left, right, bottom, top = self.box
        rows = [(self.view.right, left, right), (self.view.up, bottom, top), (self.view.toward, near, far)]
        matrix = np.eye(4)
        for k, (axis, low, high) in enumerate(rows):
            matrix[k] = *(2 * np.array(axis, float) / (high - low)), -(low + high) / (high - low)
        return matrix


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
    Returns the picture (rows, columns, 4), uint8, first row at the top, and for each pixel the coordinate towards the
    viewer of the visible face [m], of the background a lower one than of any body.
    """
    sky = np.broadcast_to(np.float32(sky), 3)
    drawn, near, far = _drawn(solids, window, front, sky)
    return drawn.pixels(), near + (far - near) * drawn.depths()


def covered(solids, window):
    """(rows, columns) whether a body covers a pixel."""
    drawn, *_ = _drawn(solids, window, 0.0, np.zeros(3))
    return drawn.depths() < 1


def _drawn(solids, window, front, sky):
    """(Canvas with the picture, nearest and farthest coordinate towards the viewer [m])."""
    view = window.view
    bodies = Bodies([(k, s.vertices, s.faces, s.color) for k, s in enumerate(solids)], "PLAIN")
    toward = bodies.vertices @ view.toward
    near, far = (toward.max() + 0.1, toward.min() - 0.1) if len(toward) else (1.0, 0.0)
    bodies.put(bodies.vertices)
    light = LIGHT @ np.array([view.right, view.toward, view.up], float) / np.linalg.norm(LIGHT)
    shared = dict(camera=window.matrix(near, far), toward=(*view.toward, front), haze=sky, haziness=(HAZE, HAZE_DEPTH))
    put(program("PLAIN"), **shared, light=light, ambient=(DARKEST, DARKEST), direct=1 - DARKEST)
    put(program("EDGE"), **shared, eye=(*view.toward, 0), ink=(EDGE_COLOR,) * 3 + (1,), size=window.size,
        width=EDGE_WIDTH)
    drawn = canvas(*window.size)
    drawn.begin(sky)
    bodies.render_faces()
    bodies.render_edges()
    bodies.release()
    return drawn, near, far
