# SPDX-License-Identifier: GPL-2.0-or-later
"""Terms of the energy balance, as `yade_timber.energy` names them: the sum of sign times energy is constant."""
from dataclasses import dataclass

from . import colors


@dataclass(frozen=True)
class Term:
    """name; sign in the balance; label (with a line break) and color: of a dissipated term in pictures."""

    name: str
    sign: int = 1
    label: str = ""
    color: tuple = None


ELASTIC = (Term("elastic_contacts"), Term("elastic_joints"))
DISSIPATED = (Term("dashpot_normal", 1, "contact dashpots,\nnormal", colors.SKY_BLUE),
              Term("dashpot_shear", 1, "contact dashpots,\ntangential", colors.BLUE),
              Term("friction", 1, "friction", colors.AMBER), Term("broken_springs", 1, "broken joints", colors.ORANGE),
              Term("lost_contacts", 1, "contacts lost\nunder load", colors.PURPLE),
              Term("joint_dashpot", 1, "joint dashpots", colors.GREEN),
              Term("joint_yield", 1, "yielding joints", colors.GREY))
IMPOSED = "imposed_velocity"
SIGNS = {term.name: term.sign
         for term in (Term("ground_motion", -1), Term(IMPOSED, -1), Term("gravity"), Term("kinetic"), *ELASTIC,
                      *DISSIPATED)}
"""{name: sign}"""
