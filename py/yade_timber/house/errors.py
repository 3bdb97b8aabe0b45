# SPDX-License-Identifier: GPL-2.0-or-later
"""The one exception of the house description."""


class HouseError(ValueError):
    """A house that cannot be built; the message is one line: where (file:line), what, and what to do."""
