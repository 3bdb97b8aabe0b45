# SPDX-License-Identifier: GPL-2.0-or-later
"""Warnings as lines for users."""
import sys
import warnings
from contextlib import contextmanager

from .errors import one_line


@contextmanager
def noted():
    """Print each warning as a line 'note: ...' on standard error."""
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        yield
    for note in notes:
        print(f"note: {one_line(str(note.message))}", file=sys.stderr)
