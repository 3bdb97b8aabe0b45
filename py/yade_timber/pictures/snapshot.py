# SPDX-License-Identifier: GPL-2.0-or-later
"""From recorded frames to plain data for pictures."""
from ..base import colors
from ..base.joint_kinds import WALL_KINDS
from .panels import panels
from .views import Mark, Snapshot, Solid


def snapshot(frames, frame):
    """Snapshot of a frame."""
    return Snapshot(solids(frames, frame), marks(frames, frame), panels(frames, frame))


def solids(frames, frame=None):
    """Solid of every element in a frame, or (None) before the first step."""
    e = frames.elements
    parts = zip(e.kind, frames.all_corners(frame), e.faces)
    return [Solid(kind, corners, faces, colors.KINDS.get(kind, colors.OTHER)) for kind, corners, faces in parts]


def marks(frames, frame):
    """Mark of every broken or partly broken joint in a frame, without those of walls, which are panels."""
    positions, kinds = frames.joint_places(frame), frames.joints.kind
    return [Mark(positions[j], state) for j, state in enumerate(frames.joint_states(frame))
            if state != "whole" and kinds[j] not in WALL_KINDS]
