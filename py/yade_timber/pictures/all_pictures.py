# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from its recorded frames alone. Needs no YADE."""
from ..recording import frames

END, CURVES, QUANTITIES, PLAYER = "end_state", "history", "quantities", "player.html"
SHEETS = ("front", "side")
NAMES = [f"{END}.png", *(f"{stem}.{ending}" for stem in (*SHEETS, CURVES, QUANTITIES) for ending in ("png", "pdf")), PLAYER]
"""Files that `write` makes."""


def write(folder, results=None):
    """Write the pictures of a run into a folder; returns their paths. results: folder with the run's frames, by default the same.

    Raises RunError when the frames cannot be read, OSError when a picture cannot be written.
    """
    from . import curves, player, quantities, sheets, views  # here: matplotlib takes 22 MB and 0.3 s, and a run without pictures needs none

    path = (results or folder) / frames.NAME
    recorded = frames.load(path)
    written = sheets.write_end(folder / END, recorded)
    for view in views.VIEWS:
        written += sheets.write_sheet(folder / view.name, recorded, view)
    if recorded.history and recorded.history.samples:
        written += curves.write(folder / CURVES, recorded)
        if "quantities" in recorded.summary and (path.parent / quantities.JOINTS).exists():
            written += quantities.write(folder / QUANTITIES, quantities.read(path.parent))
    return written + [player.make([(path, recorded)], folder / PLAYER)]
