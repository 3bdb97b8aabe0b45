# SPDX-License-Identifier: GPL-2.0-or-later
"""From the scene in YADE to plain data for pictures."""
import numpy as np
import yade.wrapper as yw

from . import scene
from .views import Mark, Solid

O = yw.Omega()


def placed(body, position, orientation):
    """(n, 3) sharp corners of a body at a placement, world frame [m]."""
    return np.array([position + orientation * v for v in body.shape.vertices])


def solids(reference=False):
    """Solid of every body: in its present placement, or in that of the start."""
    made = []
    for body in O.bodies:
        s = body.state
        position, orientation = (s.refPos, s.refOri) if reference else (s.pos, s.ori)
        made.append(Solid(body.shape.kind, placed(body, position, orientation), body.shape.faces(), tuple(body.shape.color)))
    return made


def marks(model):
    """Mark of every joint that is broken or partly broken, where it sits on its first body."""
    made = []
    for spec, joint in zip(model.joints, scene.find_engine(yw.JointEngine).joints):
        state = O.bodies[joint.id1].state
        if any(joint.broken):
            place = np.mean([state.pos + state.ori * a for a in joint.anchors1], axis=0)
            made.append(Mark(place, "before" if spec.broken else "broken" if joint.isFinished else "partly"))
    return made
