# SPDX-License-Identifier: GPL-2.0-or-later
"""Sheathed walls in the front and side views: whole, partly broken, broken."""
from dataclasses import dataclass

import numpy as np
from matplotlib.patches import Polygon

from ..base import colors
from ..base.joint_kinds import WALL_COLUMN
from ..recording.walls import state, wall_sheets

FACING = {(1, 0, 0): "east", (0, 1, 0): "north"}
"""Outer walls that face the viewer: direction towards the viewer -> side."""
FILL = "#d8c39a"
"""Of a whole wall."""
STYLES = {"whole": dict(facecolor=FILL, edgecolor=FILL, alpha=0.45, linewidth=0.0),
          "partly": dict(facecolor=FILL, edgecolor=colors.AMBER, alpha=0.7, linewidth=1.0, hatch="//"),
          "broken": dict(facecolor="none", edgecolor=colors.ORANGE, alpha=0.9, linewidth=0.8, hatch="x")}
OPENINGS = {"window": (0.2, 0.8, 0.33, 0.78), "door": (0.2, 0.8, 0.0, 0.75)}
"""Left, right, lower and upper edge of an opening as parts of its bay."""
OPEN = dict(facecolor="#e8f1f8", edgecolor="#777777", linewidth=0.5)
NAMES = {"whole": "wall", "partly": "wall partly broken", "broken": "wall broken"}


@dataclass
class Panel:
    """The wall of a bay. corners (4, 3) world [m]; storey: from 1; sides: as 'north'; state: a key of STYLES."""

    corners: np.ndarray
    storey: int
    sides: tuple
    state: str
    opening: str = ""

    def opening_corners(self):
        """(4, 3) corners of its opening. [m]"""
        left, right, low, high = OPENINGS[self.opening]
        foot, other_foot, other_head, head = self.corners
        at = [(left, low), (right, low), (right, high), (left, high)]
        return np.array([(1 - u) * (1 - v) * foot + u * (1 - v) * other_foot + u * v * other_head + (1 - u) * v * head
                         for u, v in at])


@dataclass
class Sheet:
    """One sheet. ends: ((3,) foot, (3,) head) of both columns' axes [m]; name: of its joint; broken: of its joints."""

    bay: tuple
    ends: list
    sides: tuple
    name: str
    storey: int
    broken: list


def panels(frames, frame):
    """Panels of all walls in a frame; their corners are the ends of the axes of the bays' columns."""
    joints, broken = frames.joints, frames.joint_states(frame) != "whole"
    sheets = []
    for halves in wall_sheets(joints):
        k = next(k for k in halves if joints.kind[k] == WALL_COLUMN)
        bay = joints.a[k], joints.b[k]
        ends = [axis_ends(frames.corners_at_start(column), frames.corners(frame, column)) for column in bay]
        storey = int(frames.elements.storey[joints.a[k]])
        sheets.append(Sheet(bay, ends, tuple(joints.side[k].split("+")), joints.name[k], storey, list(broken[halves])))
    return of_sheets(sheets)


def panels_as_built(model):
    """Panels of all walls of a HouseModel."""
    sheets = []
    for joint in model.joints:
        if joint.kind == WALL_COLUMN:
            ends = [axis_ends(vertices, vertices)
                    for vertices in (model.element(name).vertices for name in (joint.a, joint.b))]
            sheets.append(Sheet((joint.a, joint.b), ends, tuple(joint.side), joint.name, model.element(joint.a).storey,
                                [joint.broken]))
    return of_sheets(sheets)


def of_sheets(sheets):
    """One Panel for each bay, of all its sheets."""
    bays = {}
    for sheet in sheets:
        bays.setdefault(sheet.bay, []).append(sheet)
    walls = []
    for layers in bays.values():
        (foot, head), (other_foot, other_head) = layers[0].ends
        broken = [half for sheet in layers for half in sheet.broken]
        opening = next((name for name in OPENINGS if f".{name}." in layers[0].name), "")
        corners = np.array([foot, other_foot, other_head, head])
        walls.append(Panel(corners, layers[0].storey, layers[0].sides, state(broken), opening))
    return walls


def axis_ends(start, corners):
    """((3,) foot, (3,) head) of a column's axis. start, corners: (n, 3) before the first step and now [m]."""
    height = start[:, 2]
    return corners[height < height.mean()].mean(0), corners[height > height.mean()].mean(0)


def draw_panels(ax, view, shown):
    """Panels of the outer wall that faces the viewer. view: View; shown: list of Panel."""
    for panel in shown:
        if FACING.get(tuple(view.toward)) in panel.sides:
            ax.add_patch(_polygon(view, panel.corners, **STYLES[panel.state]))
            if panel.opening and panel.state != "broken":
                ax.add_patch(_polygon(view, panel.opening_corners(), **OPEN))


def _polygon(view, corners, **style):
    return Polygon(np.column_stack([corners @ view.right, corners @ view.up]), closed=True, zorder=4, **style)
