# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes without dashpots, for checks against undamped solutions."""
import yade.wrapper as yw
from yade_timber.scene import engines as scene

O = yw.Omega()


def undamp():
    """Switch the dashpots of all contacts off, present and future."""
    for functor in scene.find_engine(yw.ContactLoop).loop.physDispatcher.functors:
        functor.dampingRatio = 0
    for interaction in O.interactions:
        if interaction.phys is not None:
            interaction.phys.dampingRatio = 0
