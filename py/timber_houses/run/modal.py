# SPDX-License-Identifier: GPL-2.0-or-later
"""Natural modes of the house that is loaded in YADE, as in the summary."""
import numpy as np
import yade.wrapper as yw

from ..recording.history import DIRECTIONS
from ..recording.quantities import AXES
from ..recording.summary_parts import Mode, ModesAt
from ..scene.modes import natural_modes

ROUNDING = 1e-6
"""Displacement of the levels over the largest one of a mode in which they do not move [-]: rounding gives 1e-15,
modes of a house 0.6 and more."""
O = yw.Omega()


def modes_now(levels):
    """ModesAt of the scene as it is now; an unstable mode has no period. levels: of the main structure."""
    mass = sum(b.state.mass for b in O.bodies if b is not None and not b.state.blockedDOFs)
    modes = []
    for mode in natural_modes():
        share = {axis: round(float(mode.mass[AXES[axis]] / mass), 4) for axis in DIRECTIONS}
        moved = np.array([level.displacement(mode.shape[:, :3]) for level in levels])
        largest = max(moved[:, :2].flat, key=abs, default=1.0)
        if abs(largest) < ROUNDING * abs(mode.shape[:, :3]).max():  # of another structure
            continue
        shape = {f"storey{k}": {axis: round(float(row[AXES[axis]] / largest), 4) for axis in DIRECTIONS}
                 for k, row in enumerate(moved, 1)}
        period = round(mode.period, 4) if mode.omega2 > 0 else None
        modes.append(Mode(period_s=period, direction=max(share, key=share.get), mass_share=share, shape=shape))
    return ModesAt(time_s=round(O.time, 6), modes=modes)
