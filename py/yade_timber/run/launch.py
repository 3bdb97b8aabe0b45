# SPDX-License-Identifier: GPL-2.0-or-later
"""Start of a run: the command line of a script -> a Run.

With YADE's `-x`, or without a terminal, the run is completed and its results are written. Otherwise it starts in the
background, and the user has the prompt. The other modules are imported inside `launch`, so that Ctrl-C during their
import ends in a line, too.
"""
import signal
import sys

from ..base.encoding import print_anything
from ..base.interrupt import deferred_interrupt


def launch(read, ensemble, argv=None):
    """Run what `read(cli, argv)` returns: (Scenario or TownPlan, RunOptions); returns the Run or TownRun, or the result
    of `ensemble(scenario, options)` where one is asked for.

    Bad input, a failed run and a signal end the process with a line on standard error: status 1, 1 and 128 + the
    signal's number.
    """
    print_anything()
    try:
        with deferred_interrupt():
            from ..base.errors import InputError
            from . import cli, session
            from .runner import Interrupted
    except KeyboardInterrupt:
        leave("stopped by SIGINT before the run", 128 + signal.SIGINT)
    options = None
    try:
        with deferred_interrupt():
            scenario, options = read(cli, sys.argv if argv is None else argv)
        return _run(session, scenario, options) if options.ensemble is None else ensemble(scenario, options)
    except InputError as problem:
        leave(f"error: {problem}", 1)
    except Interrupted as stop:
        remedy = "continue with --resume" if options.checkpoint > 0 else "nothing was saved (--checkpoint 0)"
        leave(f"stopped by {signal.Signals(stop.number).name} at {stop.time:.2f} s; {remedy}", 128 + stop.number)
    except KeyboardInterrupt:  # before the first step, or while results and pictures are written
        remedy = (f"; the same command makes the results, scripts/show/show_run.py the pictures in {options.folder}"
                  if options else "")
        leave(f"stopped by SIGINT{remedy}", 128 + signal.SIGINT)


def _run(session, scenario, options):
    """Run to the end, or start a live run; returns the Run."""
    from ..host import has_prompt
    from .plan import TownPlan

    if isinstance(scenario, TownPlan):
        return session.complete_town(scenario, options)
    if not has_prompt():
        return session.complete(scenario, options)
    started = session.start(scenario, options)
    print(f"{started}: O.pause(), O.run(), yt.energy(), yt.contacts(id1, id2), run.write(); results are written to"
          f" {options.folder} at the end")
    return started


def leave(line, status):
    """End the process: one line on standard error and an exit status. Ctrl-C has no effect any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    print(" ".join(line.split()), file=sys.stderr, flush=True)
    sys.exit(status)
