# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of matplotlib for our pictures: its own defaults, whatever a user's matplotlibrc or session says."""
from contextlib import contextmanager

import matplotlib
from matplotlib.style.core import STYLE_BLACKLIST

SETTINGS = {"pdf.fonttype": 42, "ps.fonttype": 42}
"""TrueType fonts in PDF files: Type 3 fonts cannot be searched or edited, and journals refuse them."""


@contextmanager
def default_style():
    """matplotlib's defaults and SETTINGS within; the user's settings come back. Also a decorator: it stands on every
    function that makes, measures or saves a figure."""
    with matplotlib.rc_context():
        defaults = {key: value for key, value in matplotlib.rcParamsDefault.items() if key not in STYLE_BLACKLIST}
        dict.update(matplotlib.rcParams, defaults | SETTINGS)  # values that matplotlib has validated
        yield
