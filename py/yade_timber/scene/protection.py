# SPDX-License-Identifier: GPL-2.0-or-later
"""Protection of a scene while YADE computes it in the background, and of YADE's classes against values that end it."""
from functools import cache

from . import attributes, background, containers


@cache
def guard():
    """Protect this session: YADE's classes wait for the end of a step, and refuse what its engines cannot compute.

    Needed where a scene is changed or queried while it runs in the background (``O.run(n)``), as at the prompt. It
    replaces methods and attributes of YADE's own classes for the rest of the session. A second call has no effect.

    Notes
    -----
    Bodies, interactions and engines are changed, and scenes replaced or saved, between two steps. None in a list of
    engines, functors or bodies, and a number of a state that is not finite, are refused. An erased body takes its
    joints with it at once. ``State.angVel`` sets the angular momentum, too.
    """
    containers.guard()
    background.guard()
    attributes.guard()
