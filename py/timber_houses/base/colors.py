# SPDX-License-Identifier: GPL-2.0-or-later
"""Colours shared by all pictures, distinct for colour-blind readers (Okabe and Ito 2008) and in grey print."""
KINDS = {  # of elements; RGB in 0..1
    "ground": (0.55, 0.55, 0.50),
    "foundation": (0.60, 0.60, 0.60),
    "sill": (0.60, 0.45, 0.30),
    "column": (0.90, 0.75, 0.50),
    "beam": (0.75, 0.55, 0.35),
    "rafter": (0.62, 0.42, 0.22),
    "floor": (0.80, 0.70, 0.55),
    "brace": (0.00, 0.45, 0.70),
    "roof": (0.35, 0.35, 0.40),
    "snow": (0.95, 0.97, 1.00),
}
SHEETS = {"whole": (0.86, 0.88, 0.80), "partly": (0.95, 0.76, 0.36), "broken": (0.90, 0.52, 0.30)}
"""Of wall sheets, by state."""
OTHER = (0.7, 0.7, 0.7)
"""For kinds of elements without a colour of their own."""
BLUE, ORANGE, GREEN, SKY_BLUE, AMBER, PURPLE, YELLOW, GREY, INDIGO, WINE = (
    "#0072B2", "#D55E00", "#009E73", "#56B4E9", "#E69F00", "#CC79A7", "#F0E442", "#999999", "#332288",
    "#882255")
DIRECTIONS = {"ns": BLUE, "ew": ORANGE, "ud": GREY}
"""N-S, E-W, up-down."""


def of(kind):
    """RGB of a kind of elements."""
    return KINDS.get(kind, OTHER)
