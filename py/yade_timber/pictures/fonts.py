# SPDX-License-Identifier: GPL-2.0-or-later
"""Fonts of all pictures: matplotlib's own, and one with Chinese and Japanese letters where it is installed. Needs no YADE."""
import sys
from functools import cache

import matplotlib
from matplotlib import font_manager
from matplotlib.ft2font import FT2Font

OWN = "DejaVu Sans"
EAST_ASIAN = ("IPAexGothic", "IPAPGothic", "IPAGothic", "TakaoPGothic", "TakaoGothic", "VL PGothic", "VL Gothic", "Noto Sans CJK JP", "WenQuanYi Zen Hei")
"""Families with Japanese letters, the preferred first: a PDF embeds TrueType outlines, which Noto's fonts do not have."""
PACKAGE = "fonts-ipafont-gothic"
SETTINGS = {"pdf.fonttype": 42, "ps.fonttype": 42}
"""TrueType fonts in PDF files: Type 3 fonts cannot be searched or edited, and journals refuse them."""
_missed = set()


@cache
def families():
    """Font families for matplotlib, in the order in which a letter is looked up."""
    installed = {font.name for font in font_manager.fontManager.ttflist}
    return [OWN, *[name for name in EAST_ASIAN if name in installed][:1]]


@cache
def letters(family):
    """Code points that a family has."""
    return frozenset(FT2Font(file(family)).get_charmap())


def file(family, bold=False):
    """Path of a font file."""
    return font_manager.findfont(font_manager.FontProperties(family=family, weight="bold" if bold else "normal"))


def has(letter):
    """Whether a picture can show a letter. The first one that no font has is reported on standard error."""
    if any(ord(letter) in letters(family) for family in families()):
        return True
    if not _missed and letter.isalpha():
        print(f"notice: no installed font has the letter '{letter}'; install {PACKAGE} for Japanese names", file=sys.stderr)
        _missed.add(letter)
    return False


def best_file(text, bold=False):
    """Path of the font file that has most letters of a text, for drawing without matplotlib."""
    family = max(families(), key=lambda name: sum(ord(letter) in letters(name) for letter in text if not letter.isspace()))
    return file(family, bold)


def apply(figure):
    """Let all texts of a figure find their letters in `families`."""
    for text in figure.findobj(matplotlib.text.Text):
        text.set_fontfamily(families())
