# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames from CAD programs: BTLx files -> tables of a house file. Data flows reader -> cuts -> fit -> tables."""
from .reader import MAX_FILE_SIZE, read_project
from .tables import house_table

__all__ = ["MAX_FILE_SIZE", "btlx_table"]


def btlx_table(content, file):
    """Table of a house file from the bytes of a BTLx file; warns of what is left out. file: its name. Raises
    HouseError."""
    return house_table(read_project(content, file), file)
