# SPDX-License-Identifier: GPL-2.0-or-later
"""What a joint is made from: places of its springs, stiffness, strength, law. Needs no YADE."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class WallCycles:
    """Law 'wall' of a spring: its cycles (docs/theory.md, section 4)."""

    friction_force: float  # [N] at zero stretch after yielding
    reload_target: float = 1.0  # stretch at which reloading meets the envelope, over the largest so far
    reload_share: float = 0.0  # of the slack, from which it reloads, unless reload_stiffness says otherwise
    pinched_stiffness: float = 0.0  # [N/m] within the slack
    reload_stiffness: float = 0.0  # [N/m] k0: stiffness of reloading k0 (reload_stretch / target)^reload_power
    reload_stretch: float = 0.0  # [m]
    reload_power: float = 0.0


@dataclass(eq=False, kw_only=True)
class JointValues:
    """Springs between two bodies, in the placement in which they are unstretched."""

    points: np.ndarray   # (n, 3) spring points [m], world frame
    normal: np.ndarray | None  # (3,) from the first body to the second; of a wall, along which its spring acts; None:
    # from centroid to centroid
    kind: str            # for pictures and tables: 'column_beam', ...
    kn: float            # [N/m] normal stiffness, of each spring or of the joint, see `per`
    ks: float            # [N/m] tangential stiffness, likewise; 0: the springs act along the normal only
    strength: float      # [N] P_max, with law 'slip' the yield force, likewise; inf: unbreakable
    per: str             # 'spring': values of each spring; 'joint': of the joint as a whole
    law: str = "brittle"  # or 'slip', 'wall'
    damping_ratio: float = 0.0  # of the critical damping of the joined masses
    damping_time: float = 0.0  # [s] of dashpots that damp the sway of the house, over the stiffness
    initial_damping: bool = False  # dashpots keep the initial stiffness of yielded springs
    friction_share: float | None = None     # law 'slip': share of the yield force that acts in both directions
    softening_stretch: float | None = None  # [m] law 'slip': stretch from which the strength falls
    ultimate_stretch: float | None = None   # [m] law 'slip': stretch at which no strength is left
    envelope: tuple = ()  # laws 'slip', 'wall': (stretch [m], force [N]) of the first loading
    cycles: WallCycles | None = None  # law 'wall'
    broken: bool = False  # damaged before the run starts
    label: str = ""

    @property
    def name(self):
        return self.label
