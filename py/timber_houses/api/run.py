# SPDX-License-Identifier: GPL-2.0-or-later
"""`run`: scripts/house.py as a function, with its options as keywords."""
import signal
from pathlib import Path

from yade_timber import host

from ..base.errors import RunError
from ..base.options import read_keywords
from ..run.options import OptionSource, RunOptions
from .house import House
from .motion import source_of
from .result import RunResult

RESULTS = Path("results")
SOURCE = OptionSource(name=str, earthquake="give motion='shipped', a record, or seed",
                      pictures=lambda folder: f"th.load_run({str(folder)!r}).player()")
INSTEAD = {"quake": "give motion='shipped'", "record": "give motion='FILE_OR_PREFIX'", "export": "call export_scene",
           **dict.fromkeys(("ensemble", "jobs"), "scripts/house.py has it")}
"""Options of the command line that are no keywords, and what takes their place."""
_used = set()  # folders of the runs of this session


def run(house, motion=None, snow=None, duration=None, out=None, **options):
    """Run a house to the end, in this YADE session. The scene that is loaded in YADE is replaced.

    Parameters
    ----------
    house : House, str or Path
        A house, the name of a shipped house, or a house file.
    motion : None, str, Path or GroundMotion
        Ground motion: none, ``"shipped"``, a record's file or the common prefix of its three files, or a motion from
        `motion`.
    snow : float, optional
        Depth of snow on the roofs [m]; by default the house file's.
    duration : float, optional
        Simulated time [s]; by default that of the motion, or 30 s without one.
    out : str or Path, optional
        Folder of the results; by default ``results/NAME``, for further runs of a house in a session ``results/NAME_2``
        and so on.
    **options
        Further options of the run scripts, with ``_`` for ``-``. Of the run: ``dt`` [s], ``until_collapse``,
        ``joint_damping`` [-], ``walls``, ``resume``, ``no_frames``, ``every_step``, ``quiet``. Of the motion: ``seed``,
        ``scale`` [-], ``azimuth`` [degrees], ``start``, ``end`` [s], ``pga`` [gal], ``intensity``, ``detrend``,
        ``highpass`` [Hz], ``resample``, ``component``, ``units``.

    Returns
    -------
    RunResult
        ``run.drift``, ``run.broken``, ``run.collapsed``, ``run.history``, ``run.player()``. No picture is made before
        it is asked for.

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
    >>> run = th.run(th.house("C2"), motion="shipped", scale=1.2, snow=1.0)
    >>> run.drift, run.broken, run.player()
    """
    if not host.running():
        raise RunError("th.run needs YADE: start this script with `yade -n -x script.py`, or call it in a YADE session")
    house = house if isinstance(house, House) else House(house)
    keywords = read_keywords(RunOptions, "run",
                             {"no_views": True, **options, "snow": snow, "duration": duration, "out": out}, INSTEAD)
    record, ground_motion = (None, None) if motion is None else source_of(motion)
    shaking = {"record": record, "ground_motion": ground_motion,
               "quake": motion is not None and record is ground_motion is None}
    return _complete(RunOptions(house=house.given, source=SOURCE,
                                **{"out": _default_folder(house), **keywords, **shaking}))


def _complete(options):
    from ..run import session
    from ..run.plan import planned
    from ..run.runner import Interrupted

    options.check()
    scenario = planned(options)
    _used.add(options.folder.resolve())
    handlers = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        session.complete(scenario, options)
    except Interrupted as stop:
        if stop.number == signal.SIGTERM:
            raise SystemExit(128 + stop.number) from None
        raise KeyboardInterrupt(f"stopped at {stop.time:.2f} s; th.run(..., out='{options.folder}', resume=True)"
                                " continues") from None
    finally:  # an interrupted run keeps its handlers
        for number, handler in handlers.items():
            signal.signal(number, handler)
    return RunResult(options.folder)


def _default_folder(house):
    """results/NAME, or the first of results/NAME_2, NAME_3, ... that no run of this session has used."""
    name, number = Path(house.given).stem, 1
    while (folder := RESULTS / (name if number == 1 else f"{name}_{number}")).resolve() in _used:
        number += 1
    return folder
