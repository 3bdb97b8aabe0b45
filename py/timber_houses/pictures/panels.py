# SPDX-License-Identifier: GPL-2.0-or-later
"""Sheathed walls in the front and side views: whole, partly broken, broken."""
from dataclasses import dataclass, field

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
    """The wall of a bay.

    corners  (4, 3) world, the ends of the axes of the bay's columns [m]
    storey   from 1
    sides    as 'north'
    name     of the joint of a sheet
    broken   of the joints of all its sheets
    """

    corners: np.ndarray
    storey: int
    sides: tuple
    name: str
    broken: list = field(default_factory=list)

    @property
    def state(self):
        """A key of STYLES."""
        return state(self.broken)

    @property
    def opening(self):
        """A key of OPENINGS, or ''."""
        return next((name for name in OPENINGS if f".{name}." in self.name), "")

    def opening_corners(self):
        """(4, 3) corners of its opening. [m]"""
        left, right, low, high = OPENINGS[self.opening]
        foot, other_foot, other_head, head = self.corners
        at = [(left, low), (right, low), (right, high), (left, high)]
        return np.array([(1 - u) * (1 - v) * foot + u * (1 - v) * other_foot + u * v * other_head + (1 - u) * v * head
                         for u, v in at])


def panels(frames, frame):
    joints, broken, bays = frames.joints, frames.joint_states(frame) != "whole", {}
    for halves in wall_sheets(joints):
        k = next(k for k in halves if joints.kind[k] == WALL_COLUMN)
        bay = joints.a[k], joints.b[k]
        corners = bay_corners((frames.corners_at_start(column), frames.corners(frame, column)) for column in bay)
        panel = Panel(corners, int(frames.elements.storey[bay[0]]), tuple(joints.side[k].split("+")), joints.name[k])
        bays.setdefault(bay, panel).broken += list(broken[halves])
    return list(bays.values())


def panels_as_built(model):
    """Panels of all walls of a HouseModel."""
    bays = {}
    for joint in model.joints:
        if joint.kind == WALL_COLUMN:
            columns = model.element(joint.a), model.element(joint.b)
            corners = bay_corners((column.vertices, column.vertices) for column in columns)
            panel = Panel(corners, columns[0].storey, tuple(joint.side), joint.name)
            bays.setdefault((joint.a, joint.b), panel).broken.append(joint.broken)
    return list(bays.values())


def bay_corners(columns):
    """(4, 3) ends of the axes of a bay's columns. columns: of each, corners (n, 3) before the first step and now [m]"""
    (foot, head), (other_foot, other_head) = ((now[z < z.mean()].mean(0), now[z > z.mean()].mean(0))
                                              for z, now in ((start[:, 2], now) for start, now in columns))
    return np.array([foot, other_foot, other_head, head])


def draw_panels(ax, view, shown):
    """Panels of the outer wall that faces the viewer. view: View; shown: list of Panel."""
    for panel in shown:
        if FACING.get(tuple(view.toward)) in panel.sides:
            ax.add_patch(_polygon(view, panel.corners, **STYLES[panel.state]))
            if panel.opening and panel.state != "broken":
                ax.add_patch(_polygon(view, panel.opening_corners(), **OPEN))


def _polygon(view, corners, **style):
    return Polygon(np.column_stack([corners @ view.right, corners @ view.up]), closed=True, zorder=4, **style)
