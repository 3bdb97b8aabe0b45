# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from the files in its folder."""
import warnings
from functools import partial

from ..base.notes import noted
from ..recording import ensemble, frames
from ..recording.summary import TownSummary
from . import MAP

END, CURVES, QUANTITIES, BANDS, PLAYER = "end_state", "history", "quantities", "ensemble", "player.html"
SHEETS = ("front", "side")
NAMES = [f"{END}.png",
         *(f"{stem}.{ending}" for stem in (*SHEETS, CURVES, QUANTITIES, BANDS) for ending in ("png", "pdf")), PLAYER]
"""Files that `write` makes."""


def write(folder, path=None, pdf=False):
    """Write the pictures of a run into a folder; returns their paths. path: of the frames; pdf: PDFs, too.

    Without OpenGL those that need none are written, with a note. Raises RunError when the frames cannot be read,
    OSError when a picture cannot be written.
    """
    from . import figures, player, sheets, town_page
    from .renderer import NoOpenGL

    path, endings = path or folder / frames.NAME, ("png", "pdf") if pdf else ("png",)
    recorded = frames.load(path)
    if isinstance(recorded.summary, TownSummary):
        return [*figures.save(town_page.figure(recorded), (folder / MAP).with_suffix("")),
                town_page.write(folder, recorded), player.make([(path, recorded)], folder / PLAYER)]
    pages = [(END, ("png",), partial(sheets.both_views, recorded, -1, sheets.END_DPI)),
             *((name, endings, page) for name, page in _pages(recorded, path.parent))]
    written, left_out = [], {}
    for name, kinds, page in pages:
        try:
            written += figures.save(page(), folder / name, kinds)
        except NoOpenGL as problem:
            left_out[name] = problem
    with noted():
        if left_out:
            warnings.warn(f"without {', '.join(left_out)}: {list(left_out.values())[-1]}")
    return [*written, player.make([(path, recorded)], folder / PLAYER)]


def draw(folder, views, page):
    """Write pictures and player (views) and the report (page) of a run; returns paths. Raises RunError, OSError."""
    written = write(folder) if views else []
    if page:
        from . import report  # here: matplotlib takes 0.3 s

        written += report.write(folder)
    return written


def _pages(recorded, folder):
    """(name, function that draws the figure) of each page. folder: of the run"""
    from . import bands, curves, quantities, sheets, views

    for view in views.VIEWS:
        yield view.name, partial(sheets.sheet, recorded, view, sheets.PRINT)
    if recorded.history and recorded.history.samples:
        yield CURVES, partial(curves.page, recorded, curves.DPI)
        if recorded.peaks is not None:
            yield QUANTITIES, partial(quantities.page, recorded, quantities.DPI)
        if ensemble.has_runs(folder):
            yield BANDS, partial(bands.page, recorded, ensemble.histories(folder), bands.DPI)
