# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes without dashpots, for checks against undamped solutions."""
import yade.wrapper as yw
from yade_timber.scene.engines import find_engine

O = yw.Omega()


def undamp():
    """Set the damping ratio of all present and future contacts to zero."""
    for functor in find_engine(yw.ContactLoop).loop.physDispatcher.functors:
        functor.dampingRatio = 0
    for interaction in O.interactions:
        if interaction.phys is not None:
            interaction.phys.dampingRatio = 0
