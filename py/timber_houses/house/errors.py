# SPDX-License-Identifier: GPL-2.0-or-later
"""The exceptions of the house description."""
from ..base.errors import InputError


class HouseError(InputError):
    """A house that cannot be built; the message is one line: file:line: member: problem; admissible range; remedy."""


class StepError(HouseError):
    """A valid house whose joints are too stiff for the time step."""
