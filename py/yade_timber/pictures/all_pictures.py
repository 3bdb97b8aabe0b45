# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from its recorded frames alone. Needs no YADE."""
from ..recording import frames
from . import player
from .views import VIEWS

END, CURVES = "end_state", "history"
NAMES = [f"{END}.png"] + [f"{stem}.{ending}" for stem in (*(view.name for view in VIEWS), CURVES) for ending in ("png", "pdf")] + [player.NAME]
"""Files that `write` makes."""


def write(folder, results=None):
    """Write the pictures of a run into a folder; returns their paths. results: folder with the run's frames, by default the same.

    Raises RunError when the frames cannot be read, OSError when a picture cannot be written.
    """
    from . import curves as plots  # not above: a run without pictures needs no matplotlib, which takes 22 MB and 0.3 s
    from . import sheets  # not above: a run without pictures needs no matplotlib, which takes 22 MB and 0.3 s

    recorded = frames.load((results or folder) / frames.NAME)
    written = sheets.write_end(folder / END, recorded)
    for view in VIEWS:
        written += sheets.write_sheet(folder / view.name, recorded, view)
    if recorded.history and len(recorded.history[1]):
        written += plots.write(folder / CURVES, recorded)
    return written + [player.make((results or folder) / frames.NAME, folder / player.NAME)]
