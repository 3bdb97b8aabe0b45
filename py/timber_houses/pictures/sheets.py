# SPDX-License-Identifier: GPL-2.0-or-later
"""Sheets of pictures of a run, made from its recorded frames: key times in one view, and the end in two views."""
from dataclasses import dataclass
from functools import cache, partial

from ..base import colors
from ..text.english import sentence
from . import key_times
from .figures import (A4, MARGIN, POINT_LETTERS, TITLE_PAD, Panel, default_style, drawable, fitting_size, footer,
                      heading, heading_height, new_figure)
from .panels import mark_anchors, marks, placed_plates, plates, states
from .provenance import provenance
from .raster import Window, even_density, front_of
from .views import (INK, MARK_SIZE, VIEWS, Snapshot, Solid, box_of, draw_ends, draw_view, legend, scale_bar,
                    silhouette, wall_solids)


@dataclass(frozen=True)
class Format:
    """Of a sheet: largest width and height [inch], resolution of shaded parts [1/inch], number of panels."""

    width: float
    height: float
    dpi: int
    panels: int


PRINT = Format(A4[1], A4[0], 300, 6)
"""A4, landscape."""
SCREEN = Format(9.5, 6.2, 150, 4)
"""A small picture for a web page."""
END_DPI = 130
"""For the picture of the end, made for screens."""
GAP, FOOT, CAPTION = 0.12, 0.76, 0.36
"""Gap between panels, height of the legend, height of a panel's caption. [inch]"""
PANEL_MARK = 5
"""Size of the marks of joints in a panel. [pt]"""
CAPTION_SIZE, TWO_LINES_SIZE, SMALLEST_CAPTION = 9.0, 7.5, 5.5
"""Font sizes of captions: the usual one, the largest with two lines, the smallest. [pt]"""
NARROWEST = 0.6
"""Smallest width of a sheet as a part of its format's: titles need it. [-]"""
END_WIDTH, END_AXES = 12.5, FOOT + 0.25
"""Width of both panels of the picture of the end, and height below them. [inch]"""


@dataclass(frozen=True)
class Layout:
    """Panels in rows on a sheet. panel: (width, height); head: of the heading [inch]; density: pixels per metre"""

    count: int
    columns: int
    density: float
    panel: tuple
    width: float
    head: float

    @property
    def height(self):
        return self.head + -(-self.count // self.columns) * (CAPTION + self.panel[1] + GAP) + FOOT

    def corners(self):
        """(x, y) of the lower left corner of each panel [inch]; rows from the top."""
        width, height = self.panel
        left = (self.width - self.columns * (width + GAP) + GAP) / 2
        for k in range(self.count):
            row, column = divmod(k, self.columns)
            yield left + column * (width + GAP), self.height - self.head - (row + 1) * (CAPTION + height) - row * GAP


def layout(form, count, box, result):
    """The Layout that draws `count` panels of a box [m] largest, with few places empty. result: subtitle"""
    width, height = box[1] - box[0], box[3] - box[2]
    choices = []
    for columns in range(1, count + 1):
        rows = -(-count // columns)
        across = (form.width - 2 * MARGIN - (columns - 1) * GAP) / columns / width
        up = ((form.height - heading_height(form.width, result) - FOOT) / rows - CAPTION - GAP) / height
        choices.append((min(across, up), columns - rows * columns, columns))
    scale, _, columns = max(choices)
    density = even_density(scale * form.dpi)
    panel = width * density / form.dpi, height * density / form.dpi
    sheet_width = max(columns * (panel[0] + GAP) - GAP + 2 * MARGIN, NARROWEST * form.width)
    return Layout(count, columns, density, panel, sheet_width, heading_height(sheet_width, result))


class Stills:
    """Sheets of a run (Frames); what several of them show is made once."""

    def __init__(self, frames):
        self.frames, self.start = frames, solids(frames)
        self.plates, self.anchors = plates(frames), mark_anchors(frames)
        self.times = cache(partial(key_times.choose, frames))
        self.outlines = cache(partial(silhouette, self.start))
        self.shot = cache(self._shot)

    def _shot(self, frame):
        """Snapshot of a frame."""
        position, orientation = self.frames.position[frame], self.frames.orientation[frame]
        shown = states(self.frames, frame)
        return Snapshot(solids(self.frames, frame),
                        wall_solids(placed_plates(self.plates, shown, position, orientation), shown),
                        *marks(self.frames, self.anchors, frame, position, orientation))

    @default_style()
    def sheet(self, view, form):
        """Figure with the key times of a run in one view."""
        times = self.times(form.panels)
        shots = [self.shot(time.frame) for time in times]
        box = box_of(view, self.start, [shot.solids for shot in shots])
        plan = layout(form, len(shots), box, result(self.frames))
        figure = new_figure(plan.width, plan.height, form.dpi)
        for time, shot, corner in zip(times, shots, plan.corners()):
            panel = Panel(figure, corner, Window(view, box, plan.density))
            self._draw(panel, shot, 7, PANEL_MARK, outlined=time.frame)
            fitted_title(panel, f"{self.frames.time[time.frame]:.2f} s", time.reason)
        self._finish(figure, view.title, shots, 8)
        return figure

    @default_style()
    def both_views(self, frame, dpi):
        """Figure with a frame in both views."""
        shot = self.shot(frame)
        boxes = [box_of(view, self.start, [shot.solids]) for view in VIEWS]
        top = max(box[3] for box in boxes)
        boxes = [(*box[:3], top) for box in boxes]
        density = even_density(END_WIDTH * dpi / sum(box[1] - box[0] for box in boxes))
        width = sum(box[1] - box[0] for box in boxes) * density / dpi + 2 * MARGIN + GAP
        high = (top - boxes[0][2]) * density / dpi
        figure = new_figure(width, heading_height(width, result(self.frames)) + CAPTION + high + END_AXES, dpi)
        left = MARGIN
        for view, box in zip(VIEWS, boxes):
            panel = Panel(figure, (left, END_AXES), Window(view, box, density))
            self._draw(panel, shot, 10)
            panel.note(view.title, (0.5, 1), (0, TITLE_PAD), fontsize=12, ha="center")
            left += panel.width + GAP
        self._finish(figure, f"After {self.frames.time[frame]:.1f} s", [shot], 10)
        return figure

    def _draw(self, panel, shot, size, mark_size=MARK_SIZE, outlined=True):
        """A shot with the outline of the house at the start. size: of the texts [pt]"""
        view = panel.window.view
        draw_view(panel, shot, front_of(self.start, view), mark_size)
        for line in self.outlines(view) if outlined else ():
            panel.plot(*line.T, color=INK, linewidth=0.1 * mark_size, linestyle="dashed")
        draw_ends(panel, size)
        scale_bar(panel, size)

    def _finish(self, figure, title, shots, size):
        """Heading, legend and origin. size: of the legend [pt]"""
        heading(figure, f"{self.frames.title}. {title}", result(self.frames))
        legend(figure, self.start, set().union(*(shot.explained for shot in shots)), size)
        footer(figure, provenance(self.frames))


def fitted_title(panel, time, reason):
    """Title of a panel in one line or, where that would be small, in two; at last cut to fit."""
    lines, largest, width = [f"{time}: {reason}"], CAPTION_SIZE, panel.width
    if fitting_size(lines[0], width, CAPTION_SIZE) < TWO_LINES_SIZE:
        lines, largest = [f"{time}:", reason], TWO_LINES_SIZE
    lines = [drawable(line, int(POINT_LETTERS * width / SMALLEST_CAPTION)) for line in lines]
    size = min(fitting_size(line, width, largest) for line in lines)
    panel.note("\n".join(lines), (0, 1), (0, 3), fontsize=size, linespacing=1.0)


def result(frames):
    """Result of a run that has ended, in one sentence; else an empty text."""
    return sentence(frames.summary) if frames.summary else ""


def solids(frames, frame=None):
    """Solid of every element in a frame, or (None) before the first step."""
    e = frames.elements
    return [Solid(kind, corners, faces, colors.of(kind))
            for kind, corners, faces in zip(e.kind, frames.all_corners(frame), e.faces)]
