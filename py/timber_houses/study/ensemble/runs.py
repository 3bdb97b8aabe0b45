# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of an ensemble, in processes of their own."""
from dataclasses import replace

from ...base.errors import RunError, os_errors
from ...base.lock import is_locked
from ...pictures import all_pictures
from ...recording.ensemble import run_folder
from ..driver import LOG, Task, run_missing
from ..probe import estimate
from . import results

FEWEST = 2  # finished runs below which there are no results


def tasks(options):
    """Tasks of an ensemble's runs, the first one undisturbed. options: RunOptions"""
    return [Task(run_folder(options.folder, k), replace(options, disturb=k if k > 1 else None))
            for k in range(1, options.ensemble + 1)]


def complete(options):
    """Run what is missing of an ensemble and write its results. Raises RunError, also when some runs have failed,
    KeyboardInterrupt after a signal, when checkpoints are saved."""
    planned = tasks(options)
    missing = [task for task in planned if task.is_missing(True)]
    if missing:
        options.say(estimate(missing[0], len(missing), options.jobs))
    summaries = run_missing(planned, options.jobs, options.say)
    done = {k: summaries[task] for k, task in enumerate(planned, 1) if summaries[task] is not None}
    errors = {k: task.error or _reason(task) for k, task in enumerate(planned, 1) if k not in done}
    if len(done) >= FEWEST:
        options.say(_write(options, planned, done, errors))
    if errors:
        number, error = next(iter(errors.items()))
        raise RunError(f"{len(errors)} of {len(planned)} runs have no results; run {number}: {error}")


def _reason(task):
    """Why a run has neither results nor an error."""
    if is_locked(task.folder):
        return "another process computes this run; repeat the command when it has ended"
    return f"it was stopped ({task.folder / LOG}); the same command continues it"


def _write(options, planned, done, errors):
    """Write results and pictures; returns the text for the terminal. Raises RunError."""
    with os_errors(lambda fault: f"{options.folder}: the results cannot be written ({fault}); repeat the command"):
        content = results.content(done, errors)
        written = [*results.write(options.folder, content, done, planned),
                   *all_pictures.write(options.folder, views=options.views, page=options.report)]
    shown = done[content["shown"]]
    return "\n".join([*results.lines(content, shown), "written: " + ", ".join(map(str, written))])
