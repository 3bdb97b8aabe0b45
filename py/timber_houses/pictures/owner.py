# SPDX-License-Identifier: GPL-2.0-or-later
"""Page for the owner of a house in English or Japanese: verdict, its meaning, pictures, events."""
import io

from ..base.atomic_write import write_text
from ..base.html import embedded, html
from ..text import english, japanese
from . import OWNER, VERDICTS
from .renderer import NoOpenGL
from .stage import stages

LANGUAGES = {"en": english, "ja": japanese}
SIZE = (640, 420)
"""Of a picture. [pixel]"""


def write(folder, frames, languages=tuple(LANGUAGES)):
    """Write the pages of an ended run (Frames) into its folder; returns their paths. Raises OSError."""
    shown, written = pictures(frames), []
    for language in languages:
        written.append(folder / OWNER[language])
        write_text(written[-1], page(frames, shown, language))
    return written


def page(frames, shown, language):
    """Text of a page. shown: {'start', 'end'}: addresses of pictures, empty without OpenGL"""
    summary, words = frames.summary, LANGUAGES[language]
    return html("owner.html", language=language, words=words.OWNER, pictures=shown, color=VERDICTS[summary.verdict],
                title=japanese.title(summary) if language == "ja" else frames.title,
                verdict=words.OUTCOMES[summary.verdict], meaning=words.MEANING[summary.verdict],
                result=japanese.result(summary) if language == "ja" else english.sentence(summary),
                events=[(f"{event.time_s:.1f}", words.event(event)) for event in summary.events])


def pictures(frames):
    """{'start', 'end'}: the house at the start and at the end, as addresses of images."""
    try:
        stage, = stages([frames], SIZE, "space")
        return {name: _address(stage.picture(frames.time[frame])) for name, frame in (("start", 0), ("end", -1))}
    except NoOpenGL:
        return {}


def _address(image):
    data = io.BytesIO()
    image.save(data, "jpeg", quality=85)
    return embedded(data.getvalue(), "jpeg")
