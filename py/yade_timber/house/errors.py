# SPDX-License-Identifier: GPL-2.0-or-later
"""The exceptions of the house description."""


class HouseError(ValueError):
    """A house that cannot be built; the message is one line: where (file:line), what, and what to do."""


class StepError(HouseError):
    """A sound house whose joints are too stiff for the time step."""
