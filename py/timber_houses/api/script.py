# SPDX-License-Identifier: GPL-2.0-or-later
"""The run scripts: `main`, `main_house` and `main_town` turn the command line into a run in this process, or into an
ensemble of processes; `main_requested` does a run of such processes.

With YADE's `-x`, or without a terminal, the run is completed and its results are written. Otherwise it starts in the
background, and the user has the prompt. Most modules are imported inside `_launch`, so that Ctrl-C during their import
ends in a line, too."""
import gc
import signal
import sys

import timber_houses as th  # noqa: F401  (this and yt for the scripts)
import yade_timber as yt  # noqa: F401

from ..base.encoding import print_anything
from ..base.interrupt import deferred_interrupt

PAPER_RUNS = {
    "modelA_quake": ("A", True, False), "modelB_quake": ("B", True, False), "modelC_quake": ("C", True, False),
    "modelA_snow": ("A", False, True), "modelB_snow": ("B", False, True), "modelC_snow": ("C", False, True),
    "modelB1_quake": ("B1", True, False), "modelB2_quake": ("B2", True, False),
    "modelC1_quake": ("C1", True, False), "modelC2_quake": ("C2", True, False),
    "modelB1_snow": ("B1", True, True), "modelB2_snow": ("B2", True, True),
    "modelC1_snow": ("C1", True, True), "modelC2_snow": ("C2", True, True)}
"""Run of the paper (sections 4.1 to 4.4) -> house, whether there is an earthquake, whether 1 m of snow."""


def main(run, argv=None):
    """Run one of PAPER_RUNS; returns the Run. argv: command line (default: sys.argv)"""
    return _launch(lambda cli, arguments: cli.read(*PAPER_RUNS[run], arguments), argv)


def main_house(argv=None):
    """Run the house that the command line names; returns the Run."""
    return _launch(lambda cli, arguments: cli.read_house(arguments), argv)


def main_town(argv=None):
    """Run the town that the command line names; returns the TownRun."""
    return _launch(lambda cli, arguments: cli.read_town(arguments), argv)


def main_requested(folder):
    """Complete the run that a study requests in a folder; a fault of it is noted there."""
    from ..run.options import read_request
    from ..study import driver

    _launch(lambda *_: read_request(folder).check(), None, lambda fault: driver.note_fault(folder, fault))


def _launch(read, argv, note=lambda fault: None):
    """Run what `read(cli, argv)`, RunOptions, asks for; returns the Run or TownRun, of an ensemble the RunResult of the
    run that it shows. note: called with an InputError that ends it

    Bad input, a failed run and a signal end the process with a line on standard error: status 1, 1 and 128 + the
    signal's number."""
    print_anything()
    try:
        with deferred_interrupt():
            from ..base.errors import InputError
            from ..run import cli, ports, session
            from ..run.plan import planned
            from ..run.runner import Interrupted
    except KeyboardInterrupt:
        _leave("stopped by SIGINT before the run", 128 + signal.SIGINT)
    argv, options = sys.argv if argv is None else argv, None
    try:
        with deferred_interrupt():
            if not ports.has_prompt():
                ports.close_servers()
            gc.freeze()  # modules live on: not searching them for cycles saves 0.15 s of a start
            options = read(cli, argv)
            scenario = planned(options)
        return _run(session, ports.has_prompt(), scenario, options)
    except InputError as problem:
        note(problem)
        _leave(f"error: {problem}", 1)
    except Interrupted as stop:
        remedy = "continue with --resume" if options.checkpoint > 0 else "nothing was saved (--checkpoint 0)"
        _leave(f"stopped by {signal.Signals(stop.number).name} at {stop.time:.2f} s; {remedy}", 128 + stop.number)
    except KeyboardInterrupt:  # before the first step, or while results and pictures are written
        remedy = (f"; the same command makes the results, scripts/show/show_run.py the pictures in {options.folder}"
                  if options else "")
        _leave(f"stopped by SIGINT{remedy}", 128 + signal.SIGINT)


def _run(session, prompt, scenario, options):
    """Run to the end, or start a live run. Raises InputError, Interrupted."""
    try:
        if options.ensemble is not None:
            return _ensemble(session, scenario, options)
        if options.report:
            from ..study import probe

            scenario.other_walls = probe.with_other_walls(options, scenario.description.data)
    except KeyboardInterrupt:
        _leave("stopped; the same command continues", 128 + signal.SIGINT)
    if options.town or not prompt:
        return session.complete(scenario, options)
    started = session.start(scenario, options)
    print(f"{started}: O.pause(), O.run(), yt.energy(), yt.contacts(id1, id2), run.write(); results are written to"
          f" {options.folder} at the end")
    return started


def _ensemble(session, scenario, options):
    """Run an ensemble; returns the RunResult of the run that it shows. Raises InputError."""
    from ..run import runner
    from ..study import ensemble
    from .result import RunResult

    scenario.build_model()  # a fault of the house is reported once
    with session.reserved(options):
        runner.clear(options, *runner.RECORDED, *runner.STATE)
        ensemble.complete(options)
    return RunResult(options.folder)


def _leave(line, status):
    """End the process: one line on standard error and an exit status. Ctrl-C has no effect any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    print(" ".join(line.split()), file=sys.stderr, flush=True)
    sys.exit(status)
