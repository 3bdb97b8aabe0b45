# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of an ensemble, in processes of their own."""
from ...base.errors import RunError
from ...base.lock import is_locked
from ...pictures import all_pictures
from ...recording.ensemble import run_folder
from ..driver import LOG, Task, run_missing
from . import results

FEWEST = 2
"""Finished runs below which there are no results."""


def tasks(script, house, folder, options, number, frames=True):
    """Tasks of the runs 1 to `number`, the first one undisturbed. script: name without .py; house: its house; options: that decide the results"""
    seeds = [(), *(("--disturb", str(seed)) for seed in range(2, number + 1))]
    return [Task(script, run_folder(folder, k), (*options, *seed), frames, house) for k, seed in enumerate(seeds, 1)]


def complete(script, house, output):
    """Run what is missing of an ensemble, and write its results.

    script: path of the run script; house: name or file of its house; output: run.cli.Output.
    Raises RunError, also when some runs have failed, and KeyboardInterrupt after a signal, when the started runs have saved their checkpoints.
    """
    if not script.is_file():
        raise RunError(f"--ensemble: {script}: no such script, which the runs start")
    report = (lambda _line: None) if output.quiet else lambda line: print(line, flush=True)
    planned = tasks(script.stem, house, output.folder, output.options, output.ensemble, output.frames)
    found = run_missing(planned, script.resolve().parent, output.jobs, report)
    done = {k: found[task] for k, task in enumerate(planned, 1) if found[task] is not None}
    errors = {k: task.error or _reason(task) for k, task in enumerate(planned, 1) if k not in done}
    if len(done) >= FEWEST:
        report(_write(output, planned, done, errors))
    if errors:
        number, error = next(iter(errors.items()))
        raise RunError(f"{len(errors)} of {len(planned)} runs have no results; run {number}: {error}")


def _reason(task):
    """Why a run has neither results nor an error."""
    if is_locked(task.folder):
        return "another process computes this run; repeat the command when it has ended"
    return f"it was stopped ({task.folder / LOG}); the same command continues it"


def _write(output, planned, done, errors):
    """Write results and pictures; returns the text for the terminal. Raises RunError."""
    from ...pictures import report as report_page  # here: matplotlib takes 0.3 s

    try:
        content = results.content(done, errors)
        written = results.write(output.folder, content, done, planned)
        if output.views:
            written += all_pictures.write(output.folder)
        if output.report:
            written += report_page.write(output.folder)
    except OSError as problem:
        raise RunError(f"{output.folder}: the results cannot be written ({problem.strerror}); repeat the command") from None
    shown = done[content["shown"]]
    return "\n".join([*results.lines(content, shown), "written: " + ", ".join(map(str, written))])
