# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from the files in its folder."""
import gc
import warnings
from contextlib import contextmanager
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


@contextmanager
def _uncollected():
    """Context without Python's collector of cycles: it takes a tenth of the time of the figures, which live on."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@_uncollected()
def write(folder, path=None, pdf=False, views=True, page=False):
    """Write pictures and player (views) and the report (page) of a run into a folder; returns their paths.

    path: of the frames; pdf: PDFs, too. Without OpenGL those that need none are written, with a note. Raises RunError
    when the frames cannot be read, OSError when a picture cannot be written.
    """
    if not (views or page):
        return []
    from . import figures, player, sheets  # here: matplotlib takes 0.3 s
    from .renderer import NoOpenGL

    path, endings = path or folder / frames.NAME, ("png", "pdf") if pdf else ("png",)
    recorded = frames.load(path)
    if isinstance(recorded.summary, TownSummary):
        from . import town_page

        return [*figures.save(town_page.figure(recorded), (folder / MAP).with_suffix("")),
                town_page.write(folder, recorded), player.make([(path, recorded)], folder / PLAYER)]
    written, left_out, stills = [], {}, sheets.Stills(recorded)
    for name, draw in _pages(stills, path.parent) if views else ():
        try:
            written += figures.save(draw(), folder / name, endings if name != END else ("png",))
        except NoOpenGL as problem:
            left_out[name] = problem
    with noted():
        if left_out:
            warnings.warn(f"without {', '.join(left_out)}: {list(left_out.values())[-1]}")
    if views:
        written.append(player.make([(path, recorded)], folder / PLAYER))
    if page:
        from . import report

        written += report.write(folder, stills)
    return written


def _pages(stills, folder):
    """(name, function that draws the figure) of each page. folder: of the run"""
    from . import curves, quantities, sheets, views

    recorded = stills.frames
    yield END, partial(stills.both_views, -1, sheets.END_DPI)
    for view in views.VIEWS:
        yield view.name, partial(stills.sheet, view, sheets.PRINT)
    if recorded.history and recorded.history.samples:
        yield CURVES, partial(curves.page, recorded, curves.DPI)
        if recorded.peaks is not None:
            yield QUANTITIES, partial(quantities.page, recorded, quantities.DPI)
        if ensemble.has_runs(folder):
            yield BANDS, partial(curves.bands, recorded, ensemble.histories(folder), curves.DPI)
