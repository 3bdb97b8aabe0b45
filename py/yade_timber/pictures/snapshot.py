# SPDX-License-Identifier: GPL-2.0-or-later
"""From recorded frames to plain data for pictures. Needs no YADE."""
from ..base import colors as palette
from .views import Mark, Solid


def solids(frames, frame=None):
    """Solid of every element: in a frame, or as it stood before the first step."""
    e = frames.elements
    place = frames.corners_at_start if frame is None else lambda k: frames.corners(frame, k)
    return [Solid(kind, place(k), e.faces[k], palette.KINDS.get(kind, palette.OTHER)) for k, kind in enumerate(e.kind)]


def marks(frames, frame):
    """Mark of every joint that is broken or partly broken in a frame."""
    places = frames.joint_places(frame)
    return [Mark(places[j], state) for j, state in enumerate(frames.joint_states(frame)) if state != "whole"]
