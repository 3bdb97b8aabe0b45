# SPDX-License-Identifier: GPL-2.0-or-later
"""Sheets of pictures of a run, made from its recorded frames: six moments in one view, and the end in two views. Needs no YADE."""
import re
from dataclasses import dataclass
from textwrap import fill

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import key_times as moments
from . import snapshot
from ..base.atomic_write import written_whole
from .views import VIEWS, draw_ends, draw_view, legend, scale_bar, window
from ..recording.sentences import sentence


@dataclass(frozen=True)
class Format:
    """Of a sheet: paper [inch], resolution of the shaded parts [1/inch] (in a PDF lines and words are vectors), number of panels."""

    width: float
    height: float
    dpi: int
    panels: int


PRINT = Format(11.69, 8.27, 300, 6)
"""A4, landscape."""
SCREEN = Format(9.5, 6.2, 150, 4)
"""A small picture for a web page."""
END_DPI = 130
"""Of the picture of the end, which is for screens."""
EDGE, GAP, HEAD, FOOT, CAPTION = 0.35, 0.12, 0.75, 0.62, 0.36
"""Margin of the paper, gap between panels, title, legend, line of words above each panel. [inch]"""
LETTERS = 13.5
"""Of 10 pt that fit into an inch."""


@dataclass
class Panel:
    """A moment as drawn: its solids, marks and words."""

    solids: list
    marks: list
    words: str


def write_sheet(stem, frames, view):
    """Write `stem`.png and `stem`.pdf: six moments in one view. Returns the paths. Raises OSError."""
    return save(sheet(frames, view, PRINT), stem, ("png", "pdf"), PRINT.dpi)


def sheet(frames, view, form):
    """Figure with moments of a run in one view."""
    chosen = moments.choose(frames, form.panels)
    panels = [Panel(snapshot.solids(frames, m.frame), snapshot.marks(frames, m.frame), words(frames, m)) for m in chosen]
    start = snapshot.solids(frames)
    figure = Figure(figsize=(form.width, form.height), facecolor="white")
    FigureCanvasAgg(figure)
    box = window(view, start, [p.solids for p in panels])
    columns, density = layout(form, len(panels), box)
    for k, (panel, place) in enumerate(zip(panels, places(form, len(panels), columns, density, box))):
        ax = figure.add_axes(place)
        draw_view(ax, view, box, density, panel.solids, start if k else None, panel.marks, mark_size=5)
        ax.set_title(panel.words, fontsize=9, loc="left", pad=3)
        draw_ends(ax, view, 7)
        scale_bar(ax, box, 7)
    heading(figure, frames, view.title)
    legend(figure, start, {m.state for p in panels for m in p.marks}, 8, columns=int(0.6 * form.width))
    return figure


def words(frames, moment):
    """Line above a panel."""
    time = f"{frames.time[moment.frame]:.2f} s"
    return f"{time}  {moment.reason}" if moment.reason else time


def layout(form, count, box):
    """(columns, pixels per metre, a multiple of 2) that draws panels of `box` largest on the paper, with as few places empty as that allows."""
    width, height = box[1] - box[0], box[3] - box[2]
    found = []
    for columns in (1, 2, 3):
        rows = -(-count // columns)
        across = (form.width - 2 * EDGE - (columns - 1) * GAP) / columns / width
        up = ((form.height - HEAD - FOOT) / rows - CAPTION - GAP) / height
        found.append((min(across, up), -(rows * columns - count), columns))
    scale, _, columns = max(found)
    return columns, max(2, int(scale * form.dpi) // 2 * 2)


def places(form, count, columns, density, box):
    """[left, bottom, width, height] of each panel in parts of the figure; rows from the top, centred between title and legend."""
    width, height = (box[1] - box[0]) * density / form.dpi, (box[3] - box[2]) * density / form.dpi
    rows, pitch = -(-count // columns), height + CAPTION + GAP
    left = (form.width - columns * width - (columns - 1) * GAP) / 2
    top = form.height - HEAD - (form.height - HEAD - FOOT - rows * pitch) / 2
    for k in range(count):
        row, column = divmod(k, columns)
        x, y = (round(length * form.dpi) / form.dpi for length in (left + column * (width + GAP), top - row * pitch - CAPTION - height))  # whole pixels
        yield x / form.width, y / form.height, width / form.width, height / form.height


def heading(figure, frames, what):
    """Title and result at the top of a sheet."""
    width, height = figure.get_size_inches()
    figure.text(EDGE / width, 1 - 0.30 / height, f"{frames.title}. {what}", parse_math=False, fontsize=14, fontweight="bold", va="center")
    if frames.summary:
        result = re.sub(r"(?<=\d) (?=[st]\b)", "\u00a0", sentence(frames.summary))  # units stay with their numbers
        result = fill(result, int(LETTERS * (width - 2 * EDGE)))
        figure.text(EDGE / width, 1 - 0.46 / height, result, parse_math=False, fontsize=10, va="top")


def write_end(stem, frames):
    """Write `stem`.png: both views of the last frame. Returns the path in a list. Raises OSError."""
    return save(both_views(frames, -1, END_DPI), stem, ("png",), END_DPI)


def both_views(frames, frame, dpi):
    """Figure with the two views of a frame."""
    solids, start, marks = snapshot.solids(frames, frame), snapshot.solids(frames), snapshot.marks(frames, frame)
    boxes = [window(view, start, [solids]) for view in VIEWS]
    top = max(box[3] for box in boxes)
    boxes = [(*box[:3], top) for box in boxes]
    density = int(12.5 * dpi / sum(box[1] - box[0] for box in boxes)) // 2 * 2
    sizes = [((box[1] - box[0]) * density / dpi, (top - box[2]) * density / dpi) for box in boxes]  # [inch]
    paper = sum(width for width, _ in sizes) + 2 * EDGE + GAP, sizes[0][1] + HEAD + CAPTION + FOOT + 0.25
    figure = Figure(figsize=paper, facecolor="white")
    FigureCanvasAgg(figure)
    left = EDGE
    for view, box, (width, height) in zip(VIEWS, boxes, sizes):
        ax = figure.add_axes([left / paper[0], (FOOT + 0.25) / paper[1], width / paper[0], height / paper[1]])
        draw_view(ax, view, box, density, solids, start, marks)
        ax.set_title(view.title, fontsize=12)
        draw_ends(ax, view, 10)
        scale_bar(ax, box, 10)
        left += width + GAP
    heading(figure, frames, f"After {frames.time[frame]:.1f} s")
    legend(figure, solids, {m.state for m in marks}, 10)
    return figure


def stem_of(path):
    """A picture's path without its ending; a dot in a name is none."""
    return path.with_suffix("") if path.suffix.lower() in (".png", ".pdf") else path


def save(figure, stem, endings, dpi):
    """Write a figure as files STEM.ENDING; returns their paths."""
    paths = [stem.with_name(f"{stem.name}.{ending}") for ending in endings]
    for path in paths:
        with written_whole(path) as part:
            figure.savefig(part, dpi=dpi, metadata={"Software": None} if path.suffix == ".png" else {"CreationDate": None})
    return paths
