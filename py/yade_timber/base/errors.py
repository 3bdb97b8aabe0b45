# SPDX-License-Identifier: GPL-2.0-or-later
"""The exception of runs."""


class RunError(ValueError):
    """A run that cannot be done as asked; the message is one line: what, where, the admissible range."""
