# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a house: front (from the east) and side (from the north), hidden surfaces removed pixel by pixel. Needs no YADE."""
from dataclasses import dataclass

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .files import written_whole
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


@dataclass
class Caption:
    """Words of a picture: what was done to the house, when the picture is taken, what became of the house."""

    title: str
    time: str
    result: str


@dataclass(frozen=True)
class View:
    """A direction to look in. right (3,), toward (3,): unit vectors to the right of the picture and towards the viewer."""

    name: str
    right: tuple
    toward: tuple
    left_end: str
    right_end: str


FRONT = View("Front, seen from the east", (0, 1, 0), (1, 0, 0), "south", "north")
SIDE = View("Side, seen from the north", (-1, 0, 0), (0, 1, 0), "east", "west")

PIXELS_PER_METRE = 90
MARGIN = 0.8
"""Around the house, before and now. [m]"""
DEPTH_BELOW = 0.4
"""How much of the soil is shown. [m]"""
FAR = 8.0
"""How far from the place of the house wreckage is still shown. [m]"""

MARKERS = {  # colours of Okabe and Ito (2008); shapes differ, too, for print in grey
    "broken": dict(marker="X", markersize=8.5, markerfacecolor="#D55E00", markeredgecolor="white", markeredgewidth=0.9),
    "partly": dict(marker="^", markersize=7.5, markerfacecolor="#E69F00", markeredgecolor="black", markeredgewidth=0.7),
    "before": dict(marker="o", markersize=6.5, markerfacecolor="white", markeredgecolor="black", markeredgewidth=1.3),
}
MARK_NAMES = {"broken": "joint broken (pale: hidden)", "partly": "joint partly broken", "before": "joint broken before the start (pale: hidden)"}
LEGEND_KINDS = {"snow": "snow", "roof": "roof", "brace": "brace", "column": "column", "beam": "beam, sill", "floor": "floor", "foundation": "foundation"}


def end_state(path, solids, reference, marks, caption):
    """Write a PNG of the two views.

    solids, reference  lists of Solid: now, and at the start (drawn as a dashed outline)
    marks              list of Mark, now
    Raises OSError when the file cannot be written.
    """
    boxes = [window(view, solids, reference) for view in (FRONT, SIDE)]
    widths = [box[1] - box[0] for box in boxes]
    height = max(box[3] - box[2] for box in boxes)
    scale = 12.5 / (sum(widths) + 1.0)  # [inch/m]
    figure = Figure(figsize=(13.5, height * scale + 2.3), facecolor="white")
    axes = figure.subplots(1, 2, width_ratios=widths)
    for view, box, ax in zip((FRONT, SIDE), boxes, axes):
        draw_view(ax, view, (*box[:3], box[2] + height), solids, reference, marks)
    head = 1 - 0.30 / figure.get_figheight()
    figure.text(0.025, head, f"{caption.title}, {caption.time}", fontsize=16, fontweight="bold", va="center")
    figure.text(0.025, head - 0.30 / figure.get_figheight(), caption.result, fontsize=11, va="center")
    legend(figure, solids, marks)
    figure.subplots_adjust(left=0.025, right=0.975, bottom=0.85 / figure.get_figheight(), top=1 - 1.1 / figure.get_figheight(), wspace=0.05)
    FigureCanvasAgg(figure)
    with written_whole(path) as part:
        figure.savefig(part, dpi=130, metadata={"Software": None})


def window(view, solids, reference):
    """(left, right, bottom, top) of the picture plane that holds the house, then and now. [m]"""
    now, start = (np.vstack([s.vertices for s in bodies if s.kind != "ground"]) for bodies in (solids, reference))
    across, place = now @ view.right, start @ view.right
    left = max(min(across.min(), place.min()), place.min() - FAR) - MARGIN
    right = min(max(across.max(), place.max()), place.max() + FAR) + MARGIN
    return left, right, -DEPTH_BELOW, max(now[:, 2].max(), start[:, 2].max()) + MARGIN


def draw_view(ax, view, box, solids, reference, marks):
    """One view with its ground line, scale bar, outline of the start and damaged joints."""
    picture, depth = shade(solids, view, box, PIXELS_PER_METRE)
    ax.imshow(picture, extent=box, interpolation="antialiased", aspect="equal")
    was = outline([s for s in reference if s.kind != "ground"], view, box, PIXELS_PER_METRE)
    ax.contour(was.astype(float), [0.5], extent=box, origin="upper", colors="#444444", linewidths=1.0, linestyles="dashed")
    ax.axhline(0, color="black", linewidth=1.4)
    draw_marks(ax, view, box, depth, marks)
    scale_bar(ax, box)
    ax.set_title(view.name, fontsize=12)
    for end, name, side in ((0, view.left_end, "left"), (1, view.right_end, "right")):
        ax.annotate(name, (end, 0), (0, -5), "axes fraction", "offset points", fontsize=10, va="top", ha=side)
    ax.set(xlim=box[:2], ylim=box[2:], xticks=[], yticks=[])


def draw_marks(ax, view, box, depth, marks):
    """Marks of damaged joints; those behind something else are pale."""
    for mark in marks:
        across, up = np.dot(mark.place, view.right), mark.place[2]
        row, column = int((box[3] - up) * PIXELS_PER_METRE), int((across - box[0]) * PIXELS_PER_METRE)
        inside = 0 <= row < depth.shape[0] and 0 <= column < depth.shape[1]
        hidden = inside and depth[row, column] > np.dot(mark.place, view.toward) + 0.25  # half a member's width, generously
        ax.plot(across, up, linestyle="none", alpha=0.4 if hidden else 1.0, zorder=5 if hidden else 6, **MARKERS[mark.state])


def scale_bar(ax, box, length=1.0):
    """A bar of `length` [m] in the upper right corner."""
    right, up = box[1] - 0.25, box[3] - 0.35
    ax.plot([right - length, right], [up, up], color="black", linewidth=3, solid_capstyle="butt")
    ax.annotate(f"{length:g} m", (right - length / 2, up), (0, -4), textcoords="offset points", fontsize=10, ha="center", va="top")


def legend(figure, solids, marks):
    """What colours and marks mean: only what occurs."""
    colors = {s.kind: s.color for s in reversed(solids)}
    entries = [Patch(facecolor=colors[kind], edgecolor="#444444", linewidth=0.6, label=name) for kind, name in LEGEND_KINDS.items() if kind in colors]
    entries.append(Line2D([], [], color="#444444", linewidth=0.9, linestyle="dashed", label="outline at the start"))
    found = {m.state for m in marks}
    entries += [Line2D([], [], linestyle="none", label=name, **MARKERS[state]) for state, name in MARK_NAMES.items() if state in found]
    figure.legend(handles=entries, loc="lower center", ncols=min(len(entries), 6), frameon=False, fontsize=10, handletextpad=0.5, columnspacing=1.6)
