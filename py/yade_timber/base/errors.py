# SPDX-License-Identifier: GPL-2.0-or-later
"""Exceptions of runs."""


class RunError(ValueError):
    """A run that cannot be done as requested; the message is one line: place, fault, admissible range."""
