# SPDX-License-Identifier: GPL-2.0-or-later
"""A run in this session: computed to its end, or live in the background; one process for each folder."""
import os
from contextlib import ExitStack, contextmanager

import yade.runtime
import yade.wrapper as yw

from ..base.atomic_write import remove_parts
from ..base.errors import RunError
from ..base.interrupt import deferred_interrupt
from ..base.lock import locked, prepare_folder
from ..plugin import compiled
from .live import LiveRun
from .runner import Run
from .town import TownRun


def complete(scenario, options):
    """Run a scenario to its end and write its results; returns the Run. Raises InputError, runner.Interrupted."""
    with ExitStack() as stack:
        run = _built(Run, scenario, options, stack)
        run.complete()
    return run


def complete_town(plan, options):
    """Run a town to its end, on all processors or YADE's -j; returns the TownRun. Raises InputError, Interrupted."""
    if yade.runtime.opts.threads is None and yade.runtime.opts.cores is None:
        compiled.set_thread_count(len(os.sched_getaffinity(0)))
    with ExitStack() as stack:
        run = _built(lambda *_: TownRun(plan.town, plan.lots, options), plan, options, stack)
        run.complete()
    return run


def start(scenario, options):
    """Start a scenario in the background; returns the LiveRun. Raises InputError."""
    with ExitStack() as stack:
        run = _built(LiveRun, scenario, options, stack)
        run.start(stack.pop_all())
    return run


def _built(kind, scenario, options, stack):
    """A Run, LiveRun or TownRun with its scenes in YADE. stack: ExitStack that gets the lock of the folder."""
    if yw.Omega().running and not yade.runtime.opts.exitAfter:  # a live run: the new one takes its place
        yw.Omega().pause()
        yw.Omega().wait()
    stack.enter_context(reserved(options))
    with deferred_interrupt():
        return kind(scenario, options)


@contextmanager
def reserved(options):
    """Make the folder of the results, which this process alone has until the end of the block. Raises RunError."""
    folder = options.folder
    prepare_folder(folder, options.named("out"))
    with locked(folder) as free:
        if not free:
            raise RunError(f"{folder}: another process computes a run there; wait for it, or choose another folder with"
                           f" {options.named('out')}")
        remove_parts(folder)
        yield
