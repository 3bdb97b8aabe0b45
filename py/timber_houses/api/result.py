# SPDX-License-Identifier: GPL-2.0-or-later
"""The results of a finished run as an object. Needs no YADE."""
from functools import cached_property
from pathlib import Path

from ..base.errors import os_errors
from ..base.files import make_folder
from ..base.table import read_rows
from ..recording import ensemble, frames
from ..recording.history import BREAKS, History
from ..recording.history import NAME as HISTORY
from ..recording.summary import Summary
from ..text.english import sentence


class RunResult:
    """Results of a run, from the files in its folder.

    Parameters
    ----------
    folder : str or Path
        Folder of the results, with ``summary.json``.

    Raises
    ------
    RunError
        One line, when the folder holds no finished run.

    Examples
    --------
    >>> run = th.load_run("results/modelC2_snow")
    >>> run.drift, run.broken, run.collapsed
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.summary = Summary.read(self.folder)
        self.sentence = sentence(self.summary)

    def __repr__(self):
        return f"<Run {self.folder}: {self.sentence}>"

    @property
    def drift(self):
        """Largest storey drift of any storey and direction during the run. [-]"""
        return self.summary.largest_drift()[0]

    @property
    def residual_drift(self):
        """Largest storey drift that remains at the end, mean of the last oscillations. [-]"""
        return self.summary.largest_drift("residual_drift")[0]

    @property
    def drifts(self):
        """Peak drift of each storey and direction: ``run.drifts["storey1"]["ns"]``. [-]"""
        return self.summary.peak_drift

    @property
    def broken(self):
        """Number of joints that broke during the run, without those of walls."""
        return self.summary.broken.total

    @property
    def collapsed(self):
        """Whether a floor of the main structure has come down by half a storey."""
        return self.summary.collapsed

    @property
    def collapse_time(self):
        """Time of the collapse [s], or None."""
        return self.summary.collapse_time_s

    @property
    def energy(self):
        """Energy balance at the end: ``energy.input``, ``kinetic``, ``elastic``, ``dissipated``, ``residual``. [J]"""
        return self.summary.energy

    @property
    def events(self):
        """Events in the order of time: each with ``time_s`` [s], ``kind``, ``facts``."""
        return self.summary.events

    @cached_property
    def history(self):
        """Time histories: ``history.time`` [s], ``history.drift(1, "ns")`` [-], ``history.energy("kinetic")`` [J]."""
        return History.read(self.folder / HISTORY)

    @cached_property
    def breaks(self):
        """Each spring that broke, in order: dictionaries of texts with the columns of ``breaks.csv`` as keys."""
        return read_rows(self.folder / BREAKS)

    @cached_property
    def frames(self):
        """Recorded frames (`Frames`), 20 times per simulated second: positions, orientations, loads, breaks."""
        return frames.load(self.folder / frames.NAME)

    @cached_property
    def ensemble(self):
        """Medians, ranges and shares of an ensemble (content of ``ensemble.json``); None for a run on its own."""
        return ensemble.read(self.folder) if (self.folder / ensemble.NAME).exists() else None

    def player(self, other=None, path=None):
        """Make the page that plays the run in 3D in any browser.

        Parameters
        ----------
        other : RunResult, optional
            A second run, shown beside this one in step.
        path : str or Path, optional
            Page to write; by default ``player.html``, or ``compare_with_NAME.html``, in the folder of this run.

        Returns
        -------
        Path
        """
        from ..pictures import player
        from ..pictures.all_pictures import PLAYER

        runs = [run for run in (self, other) if run is not None]
        name = PLAYER if other is None else f"compare_with_{other.folder.resolve().name}.html"
        page = Path(path) if path is not None else self.folder / name
        with os_errors(lambda fault: f"{page}: cannot be written: {fault}"):
            return player.make([(run.folder / frames.NAME, run.frames) for run in runs], page)

    def pictures(self, folder=None):
        """Make all pictures of the run and the player.

        Parameters
        ----------
        folder : str or Path, optional
            Folder to write to; by default the folder of the run.

        Returns
        -------
        list of Path
        """
        from ..pictures import all_pictures

        folder = self.folder if folder is None else Path(folder)
        with os_errors(lambda fault: f"{folder}: the pictures cannot be written: {fault}"):
            make_folder(folder)
            return all_pictures.write(folder, self.folder / frames.NAME)


def load_run(folder):
    """Results of a finished run. Needs no YADE.

    Parameters
    ----------
    folder : str or Path
        Folder of the results of a script, a batch or `run`.

    Returns
    -------
    RunResult

    Raises
    ------
    RunError
        One line, when the folder holds no finished run.
    """
    return RunResult(folder)
