# SPDX-License-Identifier: GPL-2.0-or-later
"""Terms of the energy balance, as `yade_timber.energy` names them: all but SUPPLIED, minus these, are constant."""
from dataclasses import dataclass

from . import colors


@dataclass(frozen=True)
class Term:
    """A dissipated term. label (with a line break) and color: in pictures"""

    name: str
    label: str
    color: str


ELASTIC = ("elastic_contacts", "elastic_joints")
DISSIPATED = (Term("dashpot_normal", "contact dashpots,\nnormal", colors.SKY_BLUE),
              Term("dashpot_shear", "contact dashpots,\ntangential", colors.BLUE),
              Term("friction", "friction", colors.AMBER), Term("crushing", "crushed timber", colors.WINE),
              Term("broken_springs", "broken joints", colors.ORANGE),
              Term("lost_contacts", "contacts lost\nunder load", colors.PURPLE),
              Term("joint_dashpot", "joint dashpots", colors.INDIGO),
              Term("joint_yield", "yielding joints", colors.GREY))
IMPOSED = "imposed_velocity"
SUPPLIED = ("ground_motion", IMPOSED)
