# SPDX-License-Identifier: GPL-2.0-or-later
"""Start of a run script: `main` and `main_house` turn the command line into a run.

With YADE's `-x`, or without a terminal, the run is completed and its results are written. Otherwise it starts in the background, and the user has
the prompt. The other modules are imported inside `launch`, so that Ctrl-C during their import ends in a line, too.
"""
import signal
import sys
from contextlib import contextmanager


def main(house, earthquake=False, snow=False, argv=None):
    """Run a house (name of a shipped one, or path of a YAML file); returns the Run.

    earthquake, snow: loads of the script; argv: command line (default: sys.argv)
    """
    return launch(lambda cli, arguments: cli.read(house, earthquake, snow, arguments), argv)


def main_house(argv=None):
    """Run the house that the command line names; returns the Run."""
    return launch(lambda cli, arguments: cli.read_house(arguments), argv)


def launch(read, argv=None):
    """Run the (Scenario, Output) that `read(cli, argv)` returns; returns the Run.

    Bad input, a failed run and a signal end the process with a line on standard error: status 1, 1 and 128 + the signal's number.
    """
    try:
        with _deferred_interrupt():
            from ..base.errors import InputError
            from . import cli
            from .runner import Interrupted
    except KeyboardInterrupt:
        leave("stopped by SIGINT before the run", 128 + signal.SIGINT)
    output = None
    try:
        with _deferred_interrupt():
            scenario, output = read(cli, sys.argv if argv is None else argv)
        return _run(scenario, output)
    except InputError as problem:
        leave(f"error: {problem}", 1)
    except Interrupted as stop:
        remedy = "continue with --resume" if output.checkpoint_interval > 0 else "nothing was saved (--checkpoint 0)"
        leave(f"stopped by {signal.Signals(stop.number).name} at {stop.time:.2f} s; {remedy}", 128 + stop.number)
    except KeyboardInterrupt:  # before the first step, or while results and pictures are written
        remedy = f"; the same command makes the results, scripts/show/show_run.py the pictures in {output.folder}" if output else ""
        leave(f"stopped by SIGINT{remedy}", 128 + signal.SIGINT)


def _run(scenario, output):
    """Run to the end, or start a live run; returns the Run."""
    from contextlib import ExitStack

    import yade.runtime
    import yade.wrapper as yw

    from .. import host
    from ..base.errors import RunError
    from ..base.lock import locked
    from .cli import prepare_folder
    from .live import LiveRun
    from .runner import Run

    if yade.runtime.opts.exitAfter:
        host.close_servers()
    stays = not yade.runtime.opts.exitAfter and sys.stdin.isatty()
    if stays and yw.Omega().running:  # a live run: the new one takes its place
        yw.Omega().pause()
        yw.Omega().wait()
    prepare_folder(output.folder)
    with ExitStack() as folder_lock:
        if not folder_lock.enter_context(locked(output.folder)):
            raise RunError(f"{output.folder}: another process computes a run there; wait for it, or choose another folder with --out")
        with _deferred_interrupt():
            run = (LiveRun if stays else Run)(scenario, output)
        if not stays:
            run.complete()
            return run
        run.start(folder_lock.pop_all())
    print(f"{run}: O.pause(), O.run(), yt.energy(), yt.contacts(id1, id2), run.write(); results are written to {run.output.folder} at the end")
    return run


@contextmanager
def _deferred_interrupt():
    """Ctrl-C takes effect at the end of the block: KeyboardInterrupt in the middle of an import may crash compiled modules."""
    received = []
    before = signal.signal(signal.SIGINT, lambda *_: received.append(True))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if received:
        raise KeyboardInterrupt


def leave(line, status):
    """End the process: one line on standard error and an exit status. Ctrl-C has no effect any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    print(" ".join(line.split()), file=sys.stderr, flush=True)
    sys.exit(status)
