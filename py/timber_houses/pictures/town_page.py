# SPDX-License-Identifier: GPL-2.0-or-later
"""A town by verdicts: a map with the names of the lots as picture and page, which leads to the pages for the owners."""
import numpy as np
from matplotlib.patches import Patch, Polygon
from matplotlib.text import OffsetFrom

from ..base.atomic_write import write_text
from ..base.html import html
from ..text import english, japanese
from . import OWNER, PAGE, VERDICTS
from .figures import default_style, drawable, footer, heading, heading_height, new_figure
from .provenance import provenance

WIDTH, TALLEST, FOOT, DPI = 10.0, 10.0, 0.45, 130
"""Of the picture: width, largest height of the map, height below it [inch], resolution [1/inch]."""
BORDER, LABEL_ROOM = 2.0, 14.0
"""Around the houses [m]; room for a name [m]."""
PIXELS = 1000
"""Width of the map on the page."""


def write(folder, frames):
    """Write the page of a town (Frames); returns its path. Raises OSError."""
    write_text(folder / PAGE, page(frames))
    return folder / PAGE


@default_style()
def figure(frames):
    """Map of a town, north up."""
    summary = frames.summary
    left, right, bottom, top = box(summary.lots)
    height = min(TALLEST, WIDTH * (top - bottom) / (right - left))
    head = heading_height(WIDTH, english.sentence(summary))
    drawn = new_figure(WIDTH, head + height + FOOT, DPI)
    whole = head + height + FOOT
    ax = drawn.add_axes((0.02, FOOT / whole, 0.96, height / whole))
    for lot in summary.lots:
        for style in ({"edgecolor": "#333333", "lw": 1.6}, {"lw": 0}):  # borders, then what hides those between parts
            for corners in lot.outlines:
                ax.add_patch(Polygon(corners, facecolor=VERDICTS[lot.verdict], **style))
        ax.annotate(drawable(lot.name, 40), _label(lot), (0, -3), textcoords="offset points", ha="center", va="top",
                    fontsize=9)
    ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", xticks=[], yticks=[])
    counts = [Patch(facecolor=VERDICTS[state], label=f"{state}: {summary.verdicts.count(state)}")
              for state in VERDICTS if state in summary.verdicts]
    drawn.legend(handles=counts, loc="lower right", ncols=len(counts), frameon=False, fontsize=9,
                 bbox_to_anchor=(0.98, 0.14 / whole))
    _scale(ax, (left, right, bottom, top))
    heading(drawn, f"{frames.title}: houses by verdict", english.sentence(summary))
    footer(drawn, provenance(frames))
    return drawn


def _scale(ax, limits):
    """A bar of a tenth to a third of the width and an arrow to the north, above the houses."""
    left, right, _, top = limits
    length = 10.0 ** np.floor(np.log10((right - left) / 3))
    ax.plot((left + 1, left + 1 + length), (top - 1, top - 1), color="black", lw=2)
    text = ax.annotate(f"{length:g} m", (left + 1.5 + length, top - 1), ha="left", va="center", fontsize=8)
    beside = OffsetFrom(text, (1, 0.5), "points")
    ax.annotate("N", (14, 7), (14, -13), xycoords=beside, textcoords=beside, ha="center", va="center", fontsize=8,
                arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 2})


def box(lots):
    """(left, right, bottom, top) of the map [m]."""
    points = np.concatenate([_corners(lot) for lot in lots])
    low, high = points.min(0), points.max(0)
    lacking = np.maximum(LABEL_ROOM - (high - low), 0) / 2
    low, high = low - BORDER - lacking, high + BORDER + lacking
    room = 0.05 * (high - low)[1]  # for names below the southern houses, for the scale above the northern ones
    return low[0], high[0], low[1] - room, high[1] + room


def _corners(lot):
    """(n, 2) corners of the parts of a LotResult [m]."""
    return np.concatenate([np.array(part) for part in lot.outlines])


def _label(lot):
    """Place of its name: below the middle of the house [m]."""
    low, high = _corners(lot).min(0), _corners(lot).max(0)
    return (low[0] + high[0]) / 2, low[1]


def page(frames):
    """Text of the page, in both languages."""
    summary = frames.summary
    left, right, bottom, top = box(summary.lots)
    scale = PIXELS / (right - left)

    def place(x, y):
        return f"{scale * (x - left):.1f}", f"{scale * (top - y):.1f}"

    lots = [{"name": lot.name, "house": lot.house, "result": lot.result, "color": VERDICTS[lot.verdict],
             "verdict": {"en": lot.verdict, "ja": japanese.OUTCOMES[lot.verdict]},
             "parts": [" ".join(",".join(place(*corner)) for corner in part) for part in lot.outlines],
             "label": place(*_label(lot)),
             "pages": {language: f"lots/{lot.name}/{name}" for language, name in OWNER.items()}}
            for lot in summary.lots]
    return html("town.html", title=frames.title, sentences=[english.sentence(summary), japanese.result(summary)],
                lots=lots, width=PIXELS, height=f"{scale * (top - bottom):.0f}", origin=provenance(frames))
