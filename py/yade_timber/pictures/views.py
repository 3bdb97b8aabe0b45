# SPDX-License-Identifier: GPL-2.0-or-later
"""One view of a house on matplotlib axes: front (from the east) or side (from the north), hidden surfaces removed. Needs no YADE."""
from dataclasses import dataclass

import numpy as np

from .raster import outline, shade


@dataclass
class Solid:
    """A convex body. vertices (n, 3) world [m]; faces: vertex indices, counter-clockwise from outside; color RGB in 0..1."""

    kind: str
    vertices: np.ndarray
    faces: list
    color: tuple


@dataclass
class Mark:
    """A damaged joint. place (3,) world [m]; state 'broken', 'partly' or 'before' (damaged before the run)."""

    place: np.ndarray
    state: str


@dataclass(frozen=True)
class View:
    """A direction to look in. right, toward, up (3,): unit vectors to the right of the picture, towards the viewer, and up in it."""

    name: str
    title: str
    right: tuple
    toward: tuple
    left_end: str
    right_end: str
    up: tuple = (0, 0, 1)


FRONT = View("front", "Front, seen from the east", (0, 1, 0), (1, 0, 0), "south", "north")
SIDE = View("side", "Side, seen from the north", (-1, 0, 0), (0, 1, 0), "east", "west")
VIEWS = (FRONT, SIDE)

MARGIN = 0.8
"""Around the house, before and now. [m]"""
DEPTH_BELOW = 0.5
"""How much of the soil is shown. [m]"""
GRID = 0.5
"""Windows begin and end at multiples of it, so that a picture of a multiple of 2 pixels per metre has whole pixels. [m]"""
FAR = 8.0
"""How far from the place of the house wreckage is still shown. [m]"""
OUTLINE_PIXELS = 60
"""Per metre, for the dashed outline. [1/m]"""
MARK_SIZE = 7.5
"""Of a broken joint's mark in a large picture. [pt]"""

INK = "#444444"
MARKERS = {  # shapes differ, too, for print in grey; sizes by MARK_SIZE
    "broken": (1.0, dict(marker="X", markerfacecolor="#D55E00", markeredgecolor="white")),
    "partly": (0.9, dict(marker="^", markerfacecolor="#E69F00", markeredgecolor="black")),
    "before": (0.75, dict(marker="o", markerfacecolor="white", markeredgecolor="black")),
}
MARK_NAMES = {"broken": "joint broken (pale: hidden)", "partly": "joint partly broken", "before": "joint broken before the start"}
LEGEND_KINDS = {"snow": "snow", "roof": "roof", "brace": "brace", "column": "column", "beam": "beam, sill", "floor": "floor", "foundation": "foundation"}


def window(view, starts, others):
    """(left, right, bottom, top) of the picture plane that holds lists of solids: at the start, and any number of later ones. [m]"""
    place = np.vstack([s.vertices for s in starts if s.kind != "ground"])
    now = np.vstack([place, *(s.vertices for solids in others for s in solids if s.kind != "ground")])
    across, home = now @ view.right, place @ view.right
    left = max(across.min(), home.min() - FAR) - MARGIN
    right = min(across.max(), home.max() + FAR) + MARGIN
    top = now[:, 2].max() + MARGIN
    return np.floor(left / GRID) * GRID, np.ceil(right / GRID) * GRID, -DEPTH_BELOW, np.ceil(top / GRID) * GRID


def draw_view(ax, view, box, density, solids, start, marks, mark_size=MARK_SIZE):
    """One view with its ground line, outline of the start and damaged joints.

    box      (left, right, bottom, top) [m]; density: pixels per metre
    solids, start  lists of Solid: now, and at the start (drawn as a dashed outline; None: not drawn)
    """
    picture, depth = shade(solids, view, box, density)
    ax.imshow(np.rint(255 * picture).astype(np.uint8), extent=box, interpolation="antialiased", aspect="equal")
    if start is not None:
        was = outline([s for s in start if s.kind != "ground"], view, box, OUTLINE_PIXELS)
        ax.contour(was.astype(float), [0.5], extent=box, origin="upper", colors=INK, linewidths=0.1 * mark_size, linestyles="dashed")
    ax.axhline(0, color="black", linewidth=0.16 * mark_size)
    draw_marks(ax, view, box, depth, density, marks, mark_size)
    ax.set(xlim=box[:2], ylim=box[2:], xticks=[], yticks=[])


def draw_marks(ax, view, box, depth, density, marks, size):
    """Marks of damaged joints; those behind something else are pale."""
    for mark in marks:
        across, up = np.dot(mark.place, view.right), mark.place[2]
        row, column = int((box[3] - up) * density), int((across - box[0]) * density)
        inside = 0 <= row < depth.shape[0] and 0 <= column < depth.shape[1]
        hidden = inside and depth[row, column] > np.dot(mark.place, view.toward) + 0.25  # half a member's width, generously
        ax.plot(across, up, linestyle="none", alpha=0.4 if hidden else 1.0, zorder=5 if hidden else 6, **marker(mark.state, size))


def marker(state, size):
    """Keyword arguments of a mark for matplotlib. size [pt]"""
    share, style = MARKERS[state]
    return dict(markersize=share * size, markeredgewidth=0.1 * size, **style)


def draw_ends(ax, view, size):
    """Names of the compass below the ends of the axes."""
    for end, name, side in ((0, view.left_end, "left"), (1, view.right_end, "right")):
        ax.annotate(name, (end, 0), (0, -4), "axes fraction", "offset points", fontsize=size, va="top", ha=side)


def scale_bar(ax, box, size, length=1.0):
    """A bar of `length` [m] in the upper right corner, its text of a size [pt]."""
    right, up = box[1] - 0.25, box[3] - 0.35
    ax.plot([right - length, right], [up, up], color="black", linewidth=0.3 * size, solid_capstyle="butt")
    ax.annotate(f"{length:g} m", (right - length / 2, up), (0, -0.4 * size), textcoords="offset points", fontsize=size, ha="center", va="top")


def legend(figure, solids, states, size, start=True, columns=6):
    """What colours and marks mean: only what occurs. states: of the marks in the picture; size of the text [pt]."""
    from matplotlib.lines import Line2D  # not above: see pictures.write
    from matplotlib.patches import Patch

    colors = {s.kind: s.color for s in reversed(solids)}
    entries = [Patch(facecolor=colors[kind], edgecolor=INK, linewidth=0.6, label=name) for kind, name in LEGEND_KINDS.items() if kind in colors]
    if start:
        entries.append(Line2D([], [], color=INK, linewidth=0.9, linestyle="dashed", label="outline at the start"))
    entries += [Line2D([], [], linestyle="none", label=name, **marker(state, 0.8 * size)) for state, name in MARK_NAMES.items() if state in states]
    figure.legend(handles=entries, loc="lower center", ncols=min(len(entries), columns), frameon=False, fontsize=size, handletextpad=0.5, columnspacing=1.6)
