# SPDX-License-Identifier: GPL-2.0-or-later
"""Labels and colours of dissipated energies."""
from dataclasses import dataclass

from yade_timber.energy_terms import DISSIPATED

from ..base import colors


@dataclass(frozen=True)
class Term:
    """A dissipated term, and its label (with a line break)."""

    name: str
    label: str
    color: str


_LOOKS = (("contact dashpots,\nnormal", colors.SKY_BLUE), ("contact dashpots,\ntangential", colors.BLUE),
          ("friction", colors.AMBER), ("crushed timber", colors.WINE), ("broken joints", colors.ORANGE),
          ("contacts lost\nunder load", colors.PURPLE), ("joint dashpots", colors.INDIGO),
          ("yielding joints", colors.GREY))
TERMS = tuple(Term(name, *look) for name, look in zip(DISSIPATED, _LOOKS, strict=True))
