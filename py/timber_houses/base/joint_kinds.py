# SPDX-License-Identifier: GPL-2.0-or-later
"""Kinds of joints that the package itself distinguishes; house files name the others."""
WALL_KINDS = WALL_BEAM, WALL_COLUMN = ("wall_beam", "wall_column")
"""Of the two joints of a wall sheet: between beams, between columns."""
