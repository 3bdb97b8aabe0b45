# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures without pyplot: page, text from data, heading, PNG and PDF files."""
import io
import re
from textwrap import fill
from unicodedata import east_asian_width

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from matplotlib.transforms import Bbox, BboxTransformFrom, BboxTransformTo, ScaledTranslation, TransformedBbox
from PIL import Image

from ..base.atomic_write import written_whole
from ..text.english import LONGEST_TEXT, cut_line
from . import fonts
from .fonts import default_style

A4 = (8.27, 11.69)
"""Short and long side. [inch]"""
MARGIN = 0.35
"""Left and right of the headings. [inch]"""
TITLE_HEIGHT, LINE_HEIGHT = 0.58, 0.17
"""Height of the title, and of each line of the subtitle. [inch]"""
TITLE_SIZE, SMALLEST_TITLE, SUBTITLE_SIZE = 14, 9, 10
"""Font sizes. [pt]"""
TITLE_LETTERS, SUBTITLE_LETTERS = 8.2, 13.5
"""Letters per inch at TITLE_SIZE (bold) and SUBTITLE_SIZE."""
FOOTER_SIZE, FOOTER_LETTERS, FOOTER_PLACE = 6.5, 20.0, 0.09
"""Of the line at the bottom: font size [pt], letters per inch, height of its baseline [inch]."""
POINT_LETTERS = 140.0
"""Letters per inch of usual text, times its font size. [pt/inch]"""
TITLE_PAD = 6
"""Between a diagram and its title. [pt]"""
REPLACEMENT = "\ufffd"
PNG_LEVEL = 1
"""Of zlib: 0.7 times the time of its default, files 4 to 18 % larger."""
METADATA = {"CreationDate": None}
"""Of PDF files: nothing that differs between two runs of the same program."""


@default_style()
def new_figure(width, height, dpi):
    """Empty white figure of a width and height [inch], rounded to whole pixels of a resolution [1/inch]."""
    figure = Figure(figsize=(round(width * dpi) / dpi, round(height * dpi) / dpi), dpi=dpi, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


class Panel:
    """A Window on a figure, its lower left corner at (x, y) [inch], rounded to whole pixels. Axes of matplotlib make
    ticks, which take longer than the picture.
    """

    def __init__(self, figure, corner, window):
        self.figure, self.window = figure, window
        left, right, bottom, top = window.box
        self.width, height = (pixels / figure.dpi for pixels in window.size)
        whole = np.tile(figure.get_size_inches(), 2)
        x, y = (round(length * figure.dpi) / figure.dpi for length in corner)
        self.area = TransformedBbox(Bbox.from_bounds(*((x, y, self.width, height) / whole)), figure.transFigure)
        self.parts = BboxTransformTo(self.area)
        """From parts of width and height to the figure."""
        self.plane = BboxTransformFrom(Bbox.from_extents(left, bottom, right, top)) + self.parts
        """From metres to the figure."""
        figure.add_artist(Rectangle((0, 0), 1, 1, transform=self.parts, fill=False, lw=0.8, zorder=2.5))

    def add_artist(self, artist):
        """Add what is drawn within the panel, in metres unless it has a transform."""
        if not artist.is_transform_set():
            artist.set_transform(self.plane)
        if artist.get_clip_on():
            artist.set_clip_box(self.area)
        self.figure.add_artist(artist)

    def plot(self, x, y, **style):
        self.add_artist(Line2D(x, y, **style))

    def note(self, text, place, offset, plane=None, **style):
        """A text beside a place. plane: of the place, by default `parts`; offset: [pt]"""
        shift = ScaledTranslation(*(length / 72 for length in offset), self.figure.dpi_scale_trans)
        self.figure.add_artist(Text(*place, text, transform=(plane or self.parts) + shift, **style))


class Pixels(Artist):
    """A picture (rows, columns, 4) uint8 in the lower left corner of an area, drawn by pixels: `imshow` resamples."""

    zorder = 0

    def __init__(self, picture, area):
        super().__init__()
        self.area = area
        self.rows = picture[::-1].copy()
        self.rows[..., 3] = 255

    def draw(self, renderer):
        renderer.draw_image(renderer.new_gc(), round(self.area.x0, 6), round(self.area.y0, 6), self.rows)


def known_letters(text, most=LONGEST_TEXT):
    """A text from data on one line, of letters that the fonts have, at most `most`."""
    return "".join(letter if fonts.has(letter) else REPLACEMENT for letter in cut_line(text, most))


def drawable(text, most=LONGEST_TEXT):
    """The same for matplotlib, without mathtext.

    Every name, title or message that comes from a file passes through one of these before it is drawn.
    """
    return known_letters(text, most).replace("$", r"\$")


def heading(figure, title, subtitle=""):
    """Title, made smaller and at last cut to fit the width, and a wrapped subtitle at the top of a figure."""
    width, height = figure.get_size_inches()
    room = TITLE_LETTERS * (width - 2 * MARGIN)  # letters at TITLE_SIZE
    title = drawable(title, int(room * TITLE_SIZE / SMALLEST_TITLE))
    size = TITLE_SIZE * min(1, room / max(wide(title), 1))
    figure.text(MARGIN / width, 1 - 0.30 / height, title, fontsize=size, fontweight="bold", va="center")
    figure.text(MARGIN / width, 1 - 0.46 / height, _wrapped(subtitle, width), fontsize=SUBTITLE_SIZE, va="top")


def footer(figure, text):
    """One small line at the bottom of a figure, made smaller to fit the width."""
    width, height = figure.get_size_inches()
    text = drawable(text)
    size = min(FOOTER_SIZE, FOOTER_SIZE * FOOTER_LETTERS * (width - 2 * MARGIN) / max(wide(text), 1))
    figure.text(MARGIN / width, FOOTER_PLACE / height, text, fontsize=size, color="#555555")


def wide(text):
    """Width of a text in Latin letters: a Japanese one takes two."""
    return sum(2 if east_asian_width(letter) in "WF" else 1 for letter in text)


def fitting_size(text, width, largest):
    """Font size [pt], at most `largest`, with which a text fits a width [inch]."""
    return min(largest, POINT_LETTERS * width / max(wide(text), 1))


def heading_height(width, subtitle=""):
    """Height of a heading at the top of a figure of this width. [inch]"""
    return TITLE_HEIGHT + LINE_HEIGHT * (1 + _wrapped(subtitle, width).count("\n"))


def _wrapped(subtitle, width):
    """Subtitle in lines for a figure of this width [inch]; each line of the text begins a new one."""
    # a number and its unit stay together
    units_kept = (re.sub(r"(?<=\d) (?=[a-z]\b)", "\u00a0", drawable(line)) for line in subtitle.splitlines())
    return "\n".join(fill(line, int(SUBTITLE_LETTERS * (width - 2 * MARGIN))) for line in units_kept)


@default_style()
def save(figure, stem, endings=("png",)):
    """Write a figure as files STEM.ENDING, PNG with its own resolution; returns their paths. Raises OSError."""
    paths = [stem.with_name(f"{stem.name}.{ending}") for ending in endings]
    for path in paths:
        with written_whole(path) as part:
            if path.suffix == ".png":
                part.write_bytes(png(image_of(figure), figure.dpi))
            else:
                fonts.apply(figure)
                figure.savefig(part, dpi=figure.dpi, metadata=METADATA)
    return paths


@default_style()
def image_of(figure):
    """PIL.Image of a figure with its own resolution, RGB."""
    fonts.apply(figure)
    figure.canvas.draw()
    return Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")


def png(picture, dpi):
    """PNG file of a PIL.Image. dpi: resolution [1/inch]"""
    content = io.BytesIO()
    picture.save(content, "PNG", compress_level=PNG_LEVEL, dpi=(dpi, dpi))
    return content.getvalue()


def stem_and_endings(path):
    """Arguments of `save` for a picture: PDF if the path ends so, else PNG. Any other dot belongs to the name."""
    ending = path.suffix.lower()
    return (path.with_suffix(""), (ending[1:],)) if ending in (".png", ".pdf") else (path, ("png",))
