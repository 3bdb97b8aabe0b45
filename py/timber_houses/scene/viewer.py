# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's own viewer on the scene that is loaded: elements in the colours of their kinds, joints by load."""
import numpy as np
import yade.runtime
import yade.wrapper as yw

BACKGROUND = (0.80, 0.87, 0.93)
DIRECTION = (0.72, 0.64, 0.30)  # direction from the house to the camera: north-east, above. [-]
DISTANCE = 1.15  # distance of the camera over the diagonal of the house. [-]
O = yw.Omega()


def show():
    """Open a view when YADE has a display; returns it, or None without one."""
    if not yade.runtime.hasDisplay:
        return None
    from yade import qt
    from yade.minieigenHP import Vector3

    renderer = qt.Renderer()
    renderer.bgColor = Vector3(*BACKGROUND)
    renderer.extraDrawers = [yw.GlExtra_TimberJoints(cross=0.1)]
    view = qt.View()
    centres = np.array([body.state.pos for body in O.bodies if body.shape.kind != "ground"])
    low, high = centres.min(0), centres.max(0)
    centre = (low + high) / 2
    eye = centre + DISTANCE * np.linalg.norm(high - low) * np.array(DIRECTION)
    view.eyePosition = Vector3(*eye)  # first: YADE computes the view direction from the position
    view.upVector, view.lookAt = Vector3.UnitZ, Vector3(*centre)
    return view
