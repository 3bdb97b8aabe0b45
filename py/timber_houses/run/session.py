# SPDX-License-Identifier: GPL-2.0-or-later
"""A run in this session: computed to its end, or live in the background; one process for each folder."""
from contextlib import ExitStack, contextmanager

import yade.runtime
import yade.wrapper as yw
from yade_timber import guard

from ..base.errors import RunError
from ..base.files import remove_parts
from ..base.interrupt import deferred_interrupt
from ..base.lock import locked, prepare_folder
from .live import LiveRun
from .plan import TownPlan
from .runner import Run
from .town import TownRun

O = yw.Omega()


def complete(scenario, options):
    """Run a Scenario or a TownPlan to its end and write its results; returns the Run or TownRun. Raises InputError,
    runner.Interrupted."""
    with reserved(options):
        run = _built(TownRun if isinstance(scenario, TownPlan) else Run, scenario, options)
        run.complete()
    return run


def start(scenario, options):
    """Start a scenario in the background; returns the LiveRun. Raises InputError."""
    with ExitStack() as stack:
        stack.enter_context(reserved(options))
        run = _built(LiveRun, scenario, options)
        run.start(stack.pop_all())
    return run


def _built(kind, scenario, options):
    """A Run, LiveRun or TownRun with its scenes in YADE. A live run ends: the new one takes its place."""
    if O.running and not yade.runtime.opts.exitAfter:
        O.pause()
        O.wait()
    guard()
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
