# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings and fonts of all pictures: matplotlib's own, whatever a user's matplotlibrc or session says, and a font with
Chinese and Japanese letters where it is installed."""
import sys
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import matplotlib
from matplotlib import font_manager
from matplotlib.ft2font import FT2Font
from matplotlib.style.core import STYLE_BLACKLIST

SETTINGS = {"pdf.fonttype": 42, "ps.fonttype": 42}
"""TrueType fonts in PDF files: Type 3 fonts cannot be searched or edited, and journals refuse them."""
OWN = "DejaVu Sans"
EAST_ASIAN = ("IPAexGothic", "IPAPGothic", "IPAGothic", "TakaoPGothic", "TakaoGothic", "VL PGothic", "VL Gothic",
              "Noto Sans CJK JP", "WenQuanYi Zen Hei")
"""Families with Japanese letters, the preferred first: a PDF embeds TrueType outlines, which Noto's lack."""
PACKAGE = "fonts-ipafont-gothic"
FILES = ("ipa", "takao", "vl-", "notosanscjk", "wqy")
"""How their files' names begin."""
_missed: set = set()
_used: set = set()


@contextmanager
def default_style():
    """matplotlib's defaults and SETTINGS within; the user's settings come back. Also a decorator: it stands on every
    function that makes, measures or saves a figure."""
    with matplotlib.rc_context():
        defaults = {key: value for key, value in matplotlib.rcParamsDefault.items() if key not in STYLE_BLACKLIST}
        dict.update(matplotlib.rcParams, defaults | SETTINGS)  # values that matplotlib has validated
        yield


@cache
def east_asian():
    """Installed family with Japanese letters, or None. Fonts installed since matplotlib listed them are found, too."""
    installed = {font.name for font in font_manager.fontManager.ttflist}
    if not installed.intersection(EAST_ASIAN):
        for path in font_manager.findSystemFonts():
            if Path(path).name.lower().startswith(FILES):
                font_manager.fontManager.addfont(path)
        installed = {font.name for font in font_manager.fontManager.ttflist}
    return next((name for name in EAST_ASIAN if name in installed), None)


@cache
def letters(family):
    """Code points that a family has."""
    return frozenset(FT2Font(file(family)).get_charmap())


@default_style()
def file(family, bold=False):
    return font_manager.findfont(font_manager.FontProperties(family=family, weight="bold" if bold else "normal"))


def has(letter):
    """Whether a picture can show a letter. The first one that no font has is reported on standard error."""
    if ord(letter) in letters(OWN):
        return True
    family = east_asian()
    if family and ord(letter) in letters(family):
        _used.add(family)
        return True
    if not _missed and letter.isalpha():
        print(f"notice: no installed font has the letter '{letter}'; install {PACKAGE} for Japanese names",
              file=sys.stderr)
        _missed.add(letter)
    return False


def best_file(text, bold=False):
    """Path of the font file for a text that is drawn without matplotlib."""
    own = all(letter.isspace() or ord(letter) in letters(OWN) for letter in text)
    return file(OWN if own else east_asian() or OWN, bold)


def apply(figure):
    """Let all texts of a figure find letters that matplotlib's own font lacks."""
    for text in figure.findobj(matplotlib.text.Text) if _used else ():
        text.set_fontfamily([OWN, *_used])
