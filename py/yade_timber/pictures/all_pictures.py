# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from the files in its folder."""
from functools import partial

from ..recording import ensemble, frames
from ..recording.summary import Summary
from . import copies

END, CURVES, QUANTITIES, BANDS, PLAYER = "end_state", "history", "quantities", "ensemble", "player.html"
SHEETS = ("front", "side")
NAMES = [f"{END}.png",
         *(f"{stem}.{ending}" for stem in (*SHEETS, CURVES, QUANTITIES, BANDS) for ending in ("png", "pdf")), PLAYER]
"""Files that `write` makes."""


def write(folder, results=None, pdf=False):
    """Write the pictures of a run into a folder; returns their paths. results: folder of the frames; pdf: PDFs, too.

    Raises RunError when the frames cannot be read or nothing can be drawn, OSError when a picture cannot be written.
    """
    from . import figures

    path, endings = (results or folder) / frames.NAME, ("png", "pdf") if pdf else ("png",)
    recorded = frames.load(path)
    figures.drawable(recorded.title)  # a missing letter is reported here, once
    with copies.ahead(partial(_sheets, folder, recorded, path, endings)) as sheets:
        written = [path for paths in (*_pages(folder, recorded, path, endings), *sheets) for path in paths]
    return sorted(written, key=lambda path: NAMES.index(path.name))


def draw(folder, views, page):
    """Write pictures and player (views) and the report (page) of a run; returns paths. Raises RunError, OSError."""
    written = write(folder) if views else []
    if page:
        from . import report  # here: matplotlib takes 0.3 s

        written += report.write(folder)
    return written


def _sheets(folder, recorded, path, endings):
    """Draw by OpenGL and write the player, in a copy of the process if possible; yields paths. path: of the frames"""
    from . import figures, player, sheets, views

    for view in views.VIEWS:
        yield figures.save(sheets.sheet(recorded, view, sheets.PRINT), folder / view.name, endings)
    yield figures.save(sheets.both_views(recorded, -1, sheets.END_DPI), folder / END)
    yield [player.make([(path, recorded)], folder / PLAYER)]


def _pages(folder, recorded, path, endings):
    """Draw the curves, meanwhile in this process; yields lists of paths. path: of the frames"""
    from . import bands, curves, figures, quantities

    if recorded.history and recorded.history.samples:
        yield figures.save(curves.page(recorded, curves.DPI), folder / CURVES, endings)
        if isinstance(recorded.summary, Summary) and (path.parent / quantities.JOINTS).exists():
            page = quantities.page(quantities.read(path.parent), quantities.DPI)
            yield figures.save(page, folder / QUANTITIES, endings)
        if ensemble.has_runs(path.parent):
            page = bands.page(recorded, ensemble.histories(path.parent), bands.DPI)
            yield figures.save(page, folder / BANDS, endings)
