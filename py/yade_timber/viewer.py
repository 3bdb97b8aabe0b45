# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's own viewer on the scene that is loaded: elements in the colours of their kinds, joints by load."""
import yade.runtime
import yade.wrapper as yw

BACKGROUND = (0.80, 0.87, 0.93)
CENTRE, EYE = (3.6, 4.1, 3.5), (17.0, 16.0, 9.0)
"""What the camera looks at, and from where: from the north-east, above. [m]"""


def show():
    """Open a view when YADE has a display; returns it, or None without one."""
    if not yade.runtime.hasDisplay:
        return None
    from yade import qt
    from yade.minieigenHP import Vector3

    renderer = qt.Renderer()
    renderer.bgColor = Vector3(*BACKGROUND)
    renderer.extraDrawers = [yw.GlTimberJoints()]
    view = qt.View()
    view.eyePosition, view.upVector, view.lookAt = Vector3(*EYE), Vector3.UnitZ, Vector3(*CENTRE)
    return view
