# SPDX-License-Identifier: GPL-2.0-or-later
"""All pictures of a run and its player, from its recorded frames alone. Needs no YADE."""
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import partial

from ..recording import ensemble, frames
from . import copies

END, CURVES, QUANTITIES, BANDS, PLAYER = "end_state", "history", "quantities", "ensemble", "player.html"
SHEETS = ("front", "side")
NAMES = [f"{END}.png", *(f"{stem}.{ending}" for stem in (*SHEETS, CURVES, QUANTITIES, BANDS) for ending in ("png", "pdf")), PLAYER]
"""Files that `write` makes."""
PROCESSES = 2
"""Largest number that draw at the same time."""


def write(folder, results=None):
    """Write the pictures of a run into a folder; returns their paths. results: folder with the run's frames, by default the same.

    Raises RunError when the frames cannot be read or nothing can be drawn, OSError when a picture cannot be written.
    """
    from matplotlib.backends import backend_pdf  # noqa: F401  (before this process is copied)

    from . import bands, curves, figures, player, quantities, sheets, views  # here: matplotlib takes 22 MB and 0.3 s, and a run without pictures needs none

    path = (results or folder) / frames.NAME
    recorded = frames.load(path)
    figures.drawable(recorded.title)  # a missing letter is reported here, once
    tasks = [partial(sheets.write_sheet, folder / view.name, recorded, view) for view in views.VIEWS]
    if recorded.history and recorded.history.samples:
        tasks.append(partial(curves.write, folder / CURVES, recorded))
        if "quantities" in recorded.summary and (path.parent / quantities.JOINTS).exists():
            tasks.append(lambda: quantities.write(folder / QUANTITIES, quantities.read(path.parent)))
        if ensemble.has_runs(path.parent):
            tasks.append(partial(bands.write, folder / BANDS, recorded, path.parent))
    tasks += [partial(sheets.write_end, folder / END, recorded), lambda: [player.make([(path, recorded)], folder / PLAYER)]]
    return sorted((path for paths in _results(tasks) for path in paths), key=lambda path: NAMES.index(path.name))


def _results(tasks):
    """Results of functions, called in copies of this process where that is possible."""
    if not copies.possible():
        return [task() for task in tasks]
    _Tasks.all = tasks
    try:
        with ProcessPoolExecutor(PROCESSES, copies.fork, copies.begin) as pool:
            return list(pool.map(_Tasks.result, range(len(tasks))))
    except BrokenProcessPool:  # a copy was killed, as by lack of memory
        return [task() for task in tasks]


class _Tasks:
    """The functions, which cannot be sent to a copied process, but are in its memory."""

    all = ()

    @classmethod
    def result(cls, number):
        return cls.all[number]()
