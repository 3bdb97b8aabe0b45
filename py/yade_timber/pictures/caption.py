# SPDX-License-Identifier: GPL-2.0-or-later
"""Captions of films: house and loads, view, origin of the run; time, storey drift, broken joints, ground acceleration. Needs no YADE."""
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ..base import colors
from ..recording.summary import collapse_time
from ..recording.walls import count_apart
from ..text.english import broken_of, ratio
from . import fonts
from .figures import drawable
from .provenance import provenance
from .stage import frame_before, rgb

NORMAL = 720
"""Height of a picture for which the sizes below hold. [pixel]"""
TITLE, TEXT, SMALL = 26, 23, 14
"""Font sizes. [pixel]"""
SMALLEST = 9
"""Font size below which a text is cut instead. [pixel]"""
LABELLED = 0.75
"""Scale below which the curve has no label. [-]"""
PAD = 18
TRACE = 46
"""Height of the curve of the ground acceleration at the bottom. [pixel]"""
INK, SOFT, PAPER = (28, 36, 42), (70, 80, 88), (255, 254, 251)
VIEWS = {"front": "from the east", "side": "from the north", "space": "from the north-east"}


class Caption:
    """Texts on the pictures (width, height) [pixel] of a run (Frames). view: a key of VIEWS; speed: of the film [-]"""

    def __init__(self, run, size, view, speed):
        self.run, self.size = run, size
        self.scale = min(size[1] / NORMAL, size[0] / 620)
        self.fonts = {}
        self.speed = "" if speed == 1 else f", speed {speed:g}"
        self.drifts = run.history.largest_drift() if run.history and run.history.samples else None
        self.top = self._head(drawable(run.title), f"seen {VIEWS[view]}", drawable(provenance(run)))
        self.trace = self._trace() if run.motion else None
        self.text, self.bottom = None, None

    def on(self, image, time):
        """Draw the texts at a time [s] on an image of Pillow."""
        self.top.on(image, 0)
        text = self.state(time)
        if text != self.text:
            self.text, self.bottom = text, self._foot(text)
        base = self.size[1] - (self.trace.height if self.trace else 0)
        self.bottom.on(image, base - self.bottom.height)
        if self.trace:
            self.trace.on(image, base)
            column = int(np.clip((time - self.span[0]) / (self.span[1] - self.span[0]), 0, 1) * (self.size[0] - 2))
            image.paste(INK, (column, base, column + 2, self.size[1]))

    def state(self, time):
        """'12.35 s   storey drift 1/85   3 of 382 joints broken'"""
        run, shown = self.run, min(time, self.run.time[-1])
        parts = [f"{time:6.2f} s{self.speed}"]
        down = collapse_time(run.summary)
        if down is not None and time >= down:
            parts.append("collapsed")
        elif self.drifts is not None:
            row = max(0, np.searchsorted(run.history.time, shown, side="right") - 1)
            parts.append(f"storey drift {ratio(self.drifts[row])}")
        parts.append(broken_of(*count_apart(run.joints, run.joint_states(frame_before(run, shown)) == "broken")))
        return "     ".join(parts)

    def _font(self, size, text, bold=False):
        key = size, fonts.best_file(text, bold)
        if key not in self.fonts:
            self.fonts[key] = ImageFont.truetype(key[1], max(SMALLEST, round(size * self.scale)))
        return self.fonts[key]

    def _room(self):
        """Width of a line. [pixel]"""
        return self.size[0] - 2 * PAD * self.scale

    def _fitting(self, size, text, bold=False):
        """The font of the size, or a smaller one with which the text fits the width."""
        return self._font(min(size, size * self._room() / max(self._font(size, text, bold).getlength(text), 1)), text, bold)

    def _write(self, pen, top, text, size, ink, bold=False):
        """Write a line, made smaller and at last cut to fit the width. top: of the line [pixel]"""
        font = self._fitting(size, text, bold)
        while font.getlength(text) > self._room() and len(text) > 2:
            text = text[:-2] + "…"
        pen.text((PAD * self.scale, top), text, ink + (255,), font)

    def _wrapped(self, text, size):
        """Lines of a text that is too wide even in the smallest font, broken between words."""
        font, lines = self._fitting(size, text), [""]
        for word in text.split(" "):
            longer = f"{lines[-1]} {word}".strip()
            if lines[-1] and font.getlength(longer) > self._room():
                lines.append(word)
            else:
                lines[-1] = longer
        return lines

    def _head(self, title, view, origin):
        """Title, and origin of the run, at the top."""
        lines = self._wrapped(f"{view[0].upper()}{view[1:]}. {origin}", SMALL)
        step = 1.2 * max(SMALLEST, SMALL * self.scale)
        sheet, pen = self._sheet((TITLE + SMALL + 1.6 * PAD) * self.scale + (len(lines) - 1) * step)
        gap = 0.5 * PAD * self.scale
        self._write(pen, gap, title, TITLE, INK, bold=True)
        for number, line in enumerate(lines):
            self._write(pen, 1.5 * gap + TITLE * self.scale + number * step, line, SMALL, SOFT)
        return Overlay(sheet)

    def _foot(self, text):
        sheet, pen = self._sheet((TEXT + 0.9 * PAD) * self.scale)
        self._write(pen, 0.3 * PAD * self.scale, text, TEXT, INK)
        return Overlay(sheet)

    def _trace(self):
        """Ground acceleration over the time of the run."""
        motion, (width, _) = self.run.motion, self.size
        self.span = 0.0, float(self.run.time[-1])
        sheet, pen = self._sheet(TRACE * self.scale)
        height = sheet.size[1]
        most = abs(motion.acceleration).max() or 1.0
        for column, key in ((0, "ew"), (1, "ns")):
            values = np.interp(np.linspace(*self.span, 2 * width), motion.time, motion.acceleration[:, column], 0, 0)
            points = np.column_stack([np.arange(2 * width) / 2, height * (0.5 - 0.48 * values / most)])
            pen.line([tuple(point) for point in points], tuple(round(255 * part) for part in rgb(colors.DIRECTIONS[key])) + (255,), 1)
        if self.scale < LABELLED:
            return Overlay(sheet)
        label = f"ground acceleration, up to {most:.1f} m/s²: N-S blue, E-W orange"
        self._write(pen, 1, label, 0.85 * SMALL, SOFT)
        return Overlay(sheet)

    def _sheet(self, height):
        """Half transparent paper over the whole width."""
        sheet = Image.new("RGBA", (self.size[0], max(1, round(height))), PAPER + (190,))
        return sheet, ImageDraw.Draw(sheet)


class Overlay:
    """A half transparent image (RGBA) to draw over images of the same width."""

    def __init__(self, image):
        self.height = image.height
        self.ink, self.opacity = image.convert("RGB"), image.getchannel("A")

    def on(self, image, top):
        """Draw it over the rows of an image from `top` on."""
        image.paste(self.ink, (0, top), self.opacity)
