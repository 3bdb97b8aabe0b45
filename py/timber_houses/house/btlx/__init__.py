# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames from CAD programs: BTLx files -> tables of a house file. Data flows reader -> cuts -> fit -> tables."""
from copy import deepcopy
from functools import lru_cache

from .reader import MAX_FILE_SIZE, read_project
from .tables import house_table

__all__ = ["MAX_FILE_SIZE", "btlx_table"]


def btlx_table(content, file):
    """Table of a house file from the bytes of a BTLx file; the first time it warns of what is left out. file: its name.
    Raises HouseError."""
    return deepcopy(_table(content, file))


@lru_cache(maxsize=2)
def _table(content, file):
    return house_table(read_project(content, file), file)
