# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts of films: house and state on each picture; time, ground acceleration and origin in a strip below."""
import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image, ImageDraw, ImageFont

from ..base import colors
from ..recording.damage import DamageSurvey, State
from ..text.english import DRIFT_LINES, broken_of, ratio
from . import fonts
from .figures import known_letters
from .key_times import first_shown
from .stage import frame_before

NORMAL = 720
"""Height of a picture for which the sizes below hold. [pixel]"""
TITLE, TEXT, SMALL = 26, 22, 13
"""Font sizes. [pixel]"""
SMALLEST = 9
"""Font size below which a text is cut instead. [pixel]"""
PAD = 14
TRACE, CLOCK = 46, 130
"""Height of the curve of the ground acceleration, width of the time. [pixel]"""
INK, SOFT, PAPER = (28, 36, 42), (70, 80, 88), (255, 254, 251)


class Pen:
    """Writes lines on sheets of paper (RGBA) as wide as pictures of a size (width, height). [pixel]"""

    def __init__(self, size):
        self.width, self.scale = size[0], min(size[1] / NORMAL, size[0] / 560)

    def sheet(self, height, opacity=255):
        return Image.new("RGBA", (self.width, max(1, round(height * self.scale))), PAPER + (opacity,))

    def write(self, sheet, top, text, size, ink=INK, bold=False):
        """Write a line, made smaller to fit, and cut at SMALLEST. top: of the line [scaled pixel]"""
        wide = self._font(size, text, bold).getlength(text)
        font = self._font(size * min(1.0, self._room / max(wide, 1)), text, bold)
        while font.getlength(text) > self._room and len(text) > 2:
            text = text[:-2] + "…"
        ImageDraw.Draw(sheet).text((PAD * self.scale, top * self.scale), text, ink + (255,), font)

    def fitting(self, parts, size):
        """As many of the parts as a line has room for, the first one in any case."""
        while len(parts) > 1 and self._font(size, parts[0], False).getlength("; ".join(parts)) > self._room:
            parts = parts[:-1]
        return "; ".join(parts)

    @property
    def _room(self):
        return self.width - 2 * PAD * self.scale

    def _font(self, size, text, bold):
        return ImageFont.truetype(fonts.best_file(text, bold), max(SMALLEST, round(size * self.scale)))


class Caption:
    """A line above with the title of a run (Frames), one below with its state. size: (width, height) [pixel]"""

    def __init__(self, run, size):
        self.run = run
        self.pen = Pen(size)
        self.survey = DamageSurvey(run.elements, run.joints, [])
        self.drifts = run.history.largest_drift() if run.history and run.history.samples else None
        self.title, self.text, self.foot = self._line(known_letters(run.title), TITLE, bold=True), None, None

    def on(self, image, time):
        """Draw the texts at a time [s] on an image of Pillow."""
        text = self.state(time)
        if text != self.text:
            self.text, self.foot = text, self._line(text, TEXT)
        for line, top in ((self.title, 0), (self.foot, image.height - self.foot.height)):
            image.paste(line, (0, top), line)

    def state(self, time):
        """'storey drift 1/85', or '42 of 90 columns fallen, 49 of 206 joints broken' once a column has fallen."""
        run, shown = self.run, min(time, self.run.time[-1])
        frame = frame_before(run, shown)
        state = State(*(np.asarray(values[frame]) for values in (run.position, run.orientation, run.broken)))
        fallen = self.survey.fallen_columns(state)
        broken = run.joint_states(frame) == "broken"
        parts = [broken_of(*run.joints.count_apart(broken))] if broken.any() else []
        if fallen.any():
            return ", ".join([f"{fallen.sum()} of {len(fallen)} columns fallen", *parts])
        if self.drifts is not None:
            drift = self.drifts[run.history.row_at(shown)]
            most = DRIFT_LINES[-1][0]
            parts.insert(0, f"storey drift {ratio(drift)}" if drift <= most else f"leaning by more than {ratio(most)}")
        return ", ".join(parts)

    def _line(self, text, size, bold=False):
        sheet = self.pen.sheet(1.5 * size, 190)
        self.pen.write(sheet, 0.15 * size, text, size, bold=bold)
        return sheet


class Strip:
    """Time, ground acceleration and origin (provenance.parts) of a run (Frames) below pictures of (width, height)."""

    def __init__(self, run, origin, size):
        self.run, self.pen = run, Pen(size)
        self.span = first_shown(run), float(run.time[-1])
        self.left = round(CLOCK * self.pen.scale)
        top, small = TRACE if run.motion else 1.5 * TEXT, max(SMALL, SMALLEST / self.pen.scale)
        self.still = self.pen.sheet(top + 1.5 * small)
        self.width, self.height = self.still.size
        if run.motion:
            self._draw_trace()
        colours = ["N-S blue, E-W orange"] * bool(run.motion)
        text = self.pen.fitting([known_letters(origin[0]), *colours, *map(known_letters, origin[1:])], small)
        self.pen.write(self.still, top, text, small, SOFT)
        self.still = self.still.convert("RGB")

    def at(self, time):
        """Image (of Pillow) at a time [s]."""
        image = self.still.copy()
        self.pen.write(image, 0.5 * (TRACE - TEXT) * bool(self.run.motion), f"{time:6.2f} s", TEXT)
        if self.run.motion:
            share = np.clip((time - self.span[0]) / (self.span[1] - self.span[0]), 0, 1)
            column = self.left + int(share * (self.width - self.left - 2))
            image.paste(INK, (column, 0, column + 2, round(TRACE * self.pen.scale)))
        return image

    def _draw_trace(self):
        motion, pen = self.run.motion, ImageDraw.Draw(self.still)
        height, count = TRACE * self.pen.scale, 2 * (self.width - self.left)
        most = abs(motion.acceleration).max() or 1.0
        for column, key in ((0, "ew"), (1, "ns")):
            values = np.interp(np.linspace(*self.span, count), motion.time, motion.acceleration[:, column], 0, 0)
            points = np.column_stack([self.left + np.arange(count) / 2, height * (0.5 - 0.48 * values / most)])
            pen.line([tuple(point) for point in points],
                     tuple(round(255 * part) for part in to_rgb(colors.DIRECTIONS[key])) + (255,), 1)
