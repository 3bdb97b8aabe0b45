# SPDX-License-Identifier: GPL-2.0-or-later
"""One view of a house on matplotlib axes: front (from the east) or side (from the north), hidden surfaces removed."""
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from contourpy import FillType, contour_generator
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.path import Path

from ..base import colors
from .figures import Pixels
from .raster import Window, covered, shade


@dataclass
class Solid:
    """A convex body. vertices (n, 3) world [m]; faces: vertex indices, counter-clockwise from outside; color RGB."""

    kind: str
    vertices: np.ndarray
    faces: list
    color: tuple


@dataclass(frozen=True)
class View:
    """A direction of projection. right, toward (the viewer), up (3,): unit vectors."""

    name: str
    title: str
    right: tuple
    toward: tuple
    left_end: str
    right_end: str
    up: tuple = (0, 0, 1)


@dataclass
class Snapshot:
    """A house at one time. walls: Solids of kinds as in WALL_NAMES; places (M, 3) [m] and states of marks"""

    solids: list
    walls: list
    places: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    states: Sequence[str] = ()

    @property
    def explained(self):
        """What the legend explains: states of marks, kinds of walls."""
        return {*self.states} | {wall.kind for wall in self.walls}


FRONT = View("front", "Front, seen from the east", (0, 1, 0), (1, 0, 0), "south", "north")
SIDE = View("side", "Side, seen from the north", (-1, 0, 0), (0, 1, 0), "east", "west")
VIEWS = (FRONT, SIDE)
BORDER = 0.8
"""Around everything drawn. [m]"""
DEPTH_BELOW = 0.5
"""Depth of soil shown. [m]"""
GRID = 0.5
"""Boxes begin and end at multiples of it: with an even number of pixels per metre they have whole pixels. [m]"""
FAR = 8.0
"""Wreckage farther from the house's original outline is cut off. [m]"""
STRAYS = 0.02
"""Share of the members, at least one, that may leave the frame on each side. [-]"""
OUTLINE_PIXELS = 60
"""For the dashed outline. [1/m]"""
HIDDEN_BEHIND = 0.25
"""A mark this far behind the visible face is hidden: half the width of a member, rounded up. [m]"""
MARK_SIZE = 7.5
"""Mark of a broken joint in a large picture. [pt]"""
INK = "#444444"
MARKERS = {  # share of MARK_SIZE and style; shapes differ, too, for print in grey
    "broken": (1.0, dict(marker="X", markerfacecolor=colors.ORANGE, markeredgecolor="white")),
    "partly": (0.9, dict(marker="^", markerfacecolor=colors.AMBER, markeredgecolor="black")),
    "before": (0.75, dict(marker="o", markerfacecolor="white", markeredgecolor="black")),
}
MARK_NAMES = {"broken": "joint broken (pale: hidden)", "partly": "joint partly broken",
              "before": "joint broken before the start"}
WALL_NAMES = {"wall whole": "wall", "wall partly": "wall partly broken", "wall broken": "wall broken"}
LEGEND_COLUMNS = 6
LEGEND_PLACE = 0.14
"""Height of its lower end. [inch]"""
LEGEND_KINDS = {"snow": "snow", "roof": "roof", "brace": "brace", "column": "column", "beam": "beam", "floor": "floor",
                "rafter": "rafter", "foundation": "foundation"}


def box_of(view, starts, later):
    """(left, right, bottom, top) around the solids at the start and lists of solids at later times, without STRAYS. [m]
    """

    def reach(axis):
        end = max(largest(starts, axis))
        without_strays = [end]
        for values in (sorted(largest(solids, axis)) for solids in later):
            strays = min(len(values) - 1, max(1, int(STRAYS * len(values))))
            without_strays.append(values[len(values) - 1 - strays])
        return min(max(without_strays), end + FAR) + BORDER

    right = np.array(view.right)
    left, right, top = -reach(-right), reach(right), reach(np.array([0.0, 0.0, 1.0]))
    return np.floor(left / GRID) * GRID, np.ceil(right / GRID) * GRID, -DEPTH_BELOW, np.ceil(top / GRID) * GRID


def largest(solids, axis):
    """Largest coordinate of each solid but the ground along an axis. [m]"""
    return [(s.vertices @ axis).max() for s in solids if s.kind != "ground"]


def draw_view(panel, snapshot, front, mark_size=MARK_SIZE):
    """Shaded picture of a Snapshot in a Panel with ground line and damaged joints. front: from `front_of` [m]"""
    picture, depth = shade([*snapshot.solids, *snapshot.walls], panel.window, front)
    panel.add_artist(Pixels(picture, panel.area))
    panel.plot(panel.window.box[:2], (0, 0), color="black", linewidth=0.16 * mark_size)
    draw_marks(panel, depth, snapshot, mark_size)


def silhouette(start, view):
    """Outlines of the house without snow: list of (n, 2) closed lines [m]. start: solids before the first step"""
    box = box_of(view, start, [])
    window = Window(view, box, OUTLINE_PIXELS)
    mask = np.pad(covered([s for s in start if s.kind not in ("ground", "snow")], window), 1)[::-1].astype(float)
    contours = contour_generator(z=mask, fill_type=FillType.OuterOffset).filled(0.5, np.inf)
    outers = [points[: ends[1]] for points, ends in zip(*contours)]
    outers = [line for line in outers
              if not any(Path(other).contains_point(line[0]) for other in outers if other is not line)]
    return [(line - 0.5) / OUTLINE_PIXELS + (box[0], box[2]) for line in outers]


def draw_marks(panel, depth, snapshot, size):
    """Marks of damaged joints, pale where a face hides them. depth: from `shade` [m]; size [pt]"""
    across = snapshot.places @ panel.window.view.right
    groups = {}
    for state, place, x in zip(snapshot.states, snapshot.places, across):
        groups.setdefault((state, is_hidden(panel.window, depth, place)), []).append((x, place[2]))
    for (state, hidden), places in groups.items():
        panel.plot(*np.transpose(places), linestyle="none", alpha=0.4 if hidden else 1.0, zorder=5 if hidden else 6,
                   **marker(state, size))


def is_hidden(window, depth, position):
    """Whether the visible face of a pixel lies in front of a joint at a position (3,) [m]. depth: from `shade` [m]"""
    view, (left, _, _, top), density = window.view, window.box, window.density
    row, column = int((top - position[2]) * density), int((np.dot(position, view.right) - left) * density)
    inside = 0 <= row < depth.shape[0] and 0 <= column < depth.shape[1]
    return bool(inside and depth[row, column] > np.dot(position, view.toward) + HIDDEN_BEHIND)


def marker(state, size):
    """Keyword arguments of a mark for matplotlib. size [pt]"""
    share, style = MARKERS[state]
    return dict(markersize=share * size, markeredgewidth=0.1 * size, **style)


def draw_ends(panel, size):
    """Compass directions below the ends of the ground. size: of the text [pt]"""
    view = panel.window.view
    for end, name, side in ((0, view.left_end, "left"), (1, view.right_end, "right")):
        panel.note(name, (end, 0), (0, -4), fontsize=size, va="top", ha=side)


def scale_bar(panel, size):
    """A bar of 1, 10 or 100 m in the upper right corner, at most a sixth of the width. size: of its text [pt]"""
    left, right, _, top = panel.window.box
    length = 10.0 ** max(0, math.floor(math.log10((right - left) / 6)))
    right, up = right - 0.25, top - 0.35
    panel.plot([right - length, right], [up, up], color="black", linewidth=0.3 * size, solid_capstyle="butt")
    panel.note(f"{length:g} m", (right, up), (0, -0.4 * size), panel.plane, fontsize=size, ha="right", va="top")


def kind_entries(solids):
    """Legend entries of the kinds of elements that occur."""
    colours = {s.kind: s.color for s in reversed(solids)}
    names = LEGEND_KINDS | ({"beam": "beam, sill"} if "sill" in colours else {})
    return [Patch(facecolor=colours[kind], edgecolor=INK, linewidth=0.6, label=name) for kind, name in names.items()
            if kind in colours]


def wall_solids(plates, states):
    """Solids of Plates in the world that show states of the sheets."""
    return [Solid(f"wall {states[plate.sheet]}", plate.vertices, plate.faces, colors.SHEETS[states[plate.sheet]])
            for plate in plates]


def wall_entries(kinds):
    """Legend entries of the kinds of walls that occur."""
    return [Patch(facecolor=colors.SHEETS[kind.removeprefix("wall ")], edgecolor=INK, linewidth=0.6, label=name)
            for kind, name in WALL_NAMES.items() if kind in kinds]


def legend(figure, solids, states, size):
    """Legend of colours and marks, at the bottom. states: of the marks; size: of the text, reduced to fit [pt]"""
    entries = kind_entries(solids)
    entries.append(Line2D([], [], color=INK, linewidth=0.9, linestyle="dashed", label="house at the start"))
    entries += wall_entries(states)
    names = MARK_NAMES | ({"broken": "joint or wall broken (pale: hidden)"} if "wall broken" in states else {})
    entries += [Line2D([], [], linestyle="none", label=name, **marker(state, 0.8 * size))
                for state, name in names.items() if state in states]
    rows = -(-len(entries) // LEGEND_COLUMNS)
    place = (0.5, LEGEND_PLACE / figure.get_size_inches()[1])
    style = dict(handles=entries, loc="lower center", bbox_to_anchor=place, ncols=-(-len(entries) // rows),
                 frameon=False, handletextpad=0.5, columnspacing=1.6)
    drawn = figure.legend(**style, fontsize=size)
    fit = 0.98 * figure.bbox.width / drawn.get_window_extent().width
    if fit < 1:
        drawn.remove()
        figure.legend(**style, fontsize=fit * size)
