# SPDX-License-Identifier: GPL-2.0-or-later
"""`run`: scripts/house.py as a function, with the options of its command line as keywords."""
import signal
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path

from .. import host
from ..base.errors import RunError
from ..motion import GroundMotion, MotionRequest
from .house import House
from .motion import SHIPPED, refuse_motion, require_known
from .result import RunResult

RESULTS = Path("results")
_used = set()
"""Folders of the runs of this session."""


def run(house, motion=None, snow=None, duration=None, out=None, **options):
    """Run a house to the end, in this YADE session. The scene that is loaded in YADE is replaced.

    Parameters
    ----------
    house : House, str or Path
        A house, the name of a shipped house, or a house file.
    motion : None, str, Path or GroundMotion
        Ground motion: none, ``"shipped"``, a record's file or the common prefix of its three files, or a motion from `motion`.
    snow : float, optional
        Depth of snow on the roofs [m]; by default the house file's.
    duration : float, optional
        Simulated time [s]; by default that of the motion, or 30 s without one.
    out : str or Path, optional
        Folder of the results; by default ``results/NAME``, for further runs of a house in a session ``results/NAME_2`` and so on.
    **options
        Further options of the run scripts, with ``_`` for ``-``. Of the run: ``dt`` [s], ``until_collapse``, ``joint_damping`` [-], ``walls``,
        ``resume``, ``no_frames``, ``every_step``, ``quiet``. Of the motion: ``seed``, ``scale`` [-], ``azimuth`` [degrees], ``start``, ``end`` [s],
        ``pga`` [gal], ``intensity``, ``detrend``, ``highpass`` [Hz], ``resample``, ``component``, ``units``.

    Returns
    -------
    RunResult
        ``run.drift``, ``run.broken``, ``run.collapsed``, ``run.history``, ``run.player()``. No picture is made before it is asked for.

    Raises
    ------
    RunError, HouseError, RecordError
        One line, for input that cannot be used, and for a run that fails.
    TypeError
        For an unknown option.
    KeyboardInterrupt
        After Ctrl-C; the same call with ``resume=True`` and the same ``out`` continues.

    Examples
    --------
    >>> run = yt.run(yt.house("C2"), motion="shipped", scale=1.2, snow=1.0)
    >>> run.drift, run.broken, run.player()
    """
    if not host.running():
        raise RunError("yt.run needs YADE: start this script with `yade -n -x script.py`, or call it in a YADE session")
    house = house if isinstance(house, House) else House(house)
    out = _default_folder(house) if out is None else out
    given, words = _motion_words(motion, options)
    words += _words({"snow": snow, "duration": duration, "out": out, "no_views": True, **options})
    return _complete(["run", house.given, *words], given)


def _complete(argv, motion):
    """Run a command line of scripts/house.py; returns the RunResult. motion: GroundMotion or None."""
    from ..run import cli, session
    from ..run.runner import Interrupted

    scenario, output = cli.read_house(argv, motion)
    _used.add(output.folder.resolve())
    try:
        with _restored_handlers():
            session.complete(scenario, output)
    except Interrupted as stop:
        if stop.number == signal.SIGTERM:
            raise SystemExit(128 + stop.number) from None
        raise KeyboardInterrupt(f"stopped at {stop.time:.2f} s; yt.run(..., out='{output.folder}', resume=True) continues") from None
    return RunResult(output.folder)


@contextmanager
def _restored_handlers():
    """The session's own signal handlers again at the end: a run that is stopped keeps its handlers for the end of a script."""
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _default_folder(house):
    """results/NAME, or the first of results/NAME_2, NAME_3, ... that no run of this session has used."""
    name, number = Path(house.given).stem, 1
    while (folder := RESULTS / (name if number == 1 else f"{name}_{number}")).resolve() in _used:
        number += 1
    return folder


def _motion_words(motion, options):
    """(GroundMotion or None, options of the command line)."""
    if motion is None:
        processing = [f.name for f in fields(MotionRequest) if f.name in options]
        if processing and "seed" not in processing:
            raise RunError(f"yt.run: {processing[0]}: this run has no earthquake; give motion='{SHIPPED}', a record, or seed")
        return None, []
    if isinstance(motion, (str, Path)):
        return None, ["--quake"] if str(motion) == SHIPPED else [f"--record={motion}"]
    if isinstance(motion, GroundMotion):
        return motion, []
    refuse_motion(motion)


def _words(options):
    """Options of the command line from keywords: dt=1e-4 -> --dt=0.0001, quiet=True -> --quiet."""
    from ..run import cli

    known = [name for name in vars(cli.house_parser().parse_args(["house"])) if name not in ("file", "quake", "record", "export", "ensemble", "jobs")]
    words = []
    for name, value in options.items():
        require_known("run", name, known)
        if value is not None and value is not False:
            words.append(f"--{name.replace('_', '-')}" + ("" if value is True else f"={value}"))
    return words
