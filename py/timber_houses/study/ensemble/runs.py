# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of an ensemble, in processes of their own, and their results: ensemble.json, ensemble.csv, lines for the
terminal, results of the run that is shown."""
import json
import shutil
from dataclasses import replace

from ...base.atomic_write import write_text, written_whole
from ...base.errors import RunError, os_errors
from ...base.lock import is_locked
from ...base.table import csv_text
from ...house.disturbance import LARGEST
from ...pictures import all_pictures
from ...recording import frames
from ...recording.ensemble import NAME, TABLE, run_folder
from ...recording.summary_parts import Ensemble
from ...recording.verdict import TILT
from ...text.english import counted, ratio, sentence, span
from ..driver import LOG, Task, run_missing
from ..probe import estimate
from . import statistics

FEWEST = 2  # finished runs below which there are no results
ROWS = (
    ("peak drift", "largest_peak_drift", ratio),
    *((f"  storey {k} {name}", f"peak_drift.storey{k}.{key}", ratio) for k in (1, 2, 3)
      for key, name in (("ns", "N-S"), ("ew", "E-W"))),
    ("residual drift", "largest_residual_drift", ratio),
    ("broken joints", "broken.total", "{:.4g}".format),
    ("  column-beam", "broken.column_beam", "{:.4g}".format),
    ("  brace-beam", "broken.brace_beam", "{:.4g}".format),
    ("broken wall sheets", "broken.wall_sheets", "{:.4g}".format),
    ("broken springs", "broken.springs", "{:.4g}".format),
    (f"tilt ({TILT.ratio}) [s]", "tilt_time_s", "{:.1f}".format),
    ("collapse [s]", "collapse_time_s", "{:.1f}".format),
    ("energy input [kJ]", "energy.input", lambda joule: f"{joule / 1e3:.4g}"),
    ("energy residual [-]", "energy.residual_fraction", "{:.1g}".format),
)
"""Lines for the terminal: label, path of a number, its text."""
COLUMNS = "{:<20}{:>13}   {:<30}{}"


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
        found = content(done, errors)
        written = [*write(options.folder, found, done, planned),
                   *all_pictures.write(options.folder, views=options.views, page=options.report)]
    return "\n".join([*lines(found, done[found["shown"]]), "written: " + ", ".join(map(str, written))])


def content(done, errors):
    """Content of ensemble.json. done: {number: summary} of finished runs; errors: {number: message} of others."""
    summaries, count = list(done.values()), len(done)
    frequency = statistics.outcomes(summaries)
    return {"runs": count + len(errors), "finished": list(done), "errors": errors, "disturbance_m": LARGEST,
            "shown": statistics.representative(done),
            "outcomes": {state: statistics.share(number, count) for state, number in frequency.items()},
            "numbers": statistics.spreads(summaries), "words": statistics.counts(summaries)}


def write(folder, content, done, planned):
    """Write ensemble.json, ensemble.csv, results of the shown run, summary last. content: `content`; planned: Tasks"""
    write_text(folder / NAME, json.dumps(content, indent=1, allow_nan=False) + "\n")
    write_text(folder / TABLE, table_text(content, done, planned))
    shown = content["shown"]
    return [folder / NAME, folder / TABLE,
            *show(folder, planned[shown - 1].folder, replace(done[shown], ensemble=draw(content, done)))]


def table_text(content, done, planned):
    """Text of ensemble.csv: a row a run, with all numbers of the summary and the texts that differ."""
    texts = [place for place, values in content["words"].items() if len(values) > 1 and place != "verdict"]
    header = ("run", "folder", "verdict", "error", *content["numbers"], *texts)
    rows = []
    for number, task in enumerate(planned, 1):
        summary = done.get(number)
        entries = ({**statistics.words(summary), **statistics.numbers(summary)} if summary
                 else {"error": content["errors"][number]})
        entries = {place: value for place, value in entries.items() if value != statistics.NONE}
        place = task.folder.relative_to(task.folder.parents[1])
        rows.append((number, place, *(entries.get(column, "") for column in header[2:])))
    return csv_text(header, rows)


def draw(content, done):
    """The entry `ensemble` in the summary of the run that is shown: its number, outcomes and ranges of all."""
    standing = [summary.largest_drift()[0] for summary in done.values() if not summary.collapsed]
    failed = {"failed": len(content["errors"])} if content["errors"] else {}
    outcomes = {**{state: share["runs"] for state, share in content["outcomes"].items()}, **failed}
    return Ensemble(run=content["shown"], runs=content["runs"], outcomes=outcomes,
                    peak_drift_standing=[min(standing), max(standing)] if standing else None)


def show(folder, run, summary):
    """Copy a run's results into the ensemble's folder, with another summary; returns the paths. Raises OSError."""
    written = []
    for table in sorted(run.glob("*.csv")):
        with written_whole(folder / table.name) as part:
            shutil.copyfile(table, part)
        written.append(folder / table.name)
    summary = replace(summary, sentence=sentence(summary))
    if (run / frames.NAME).is_file():
        recorded = frames.load(run / frames.NAME)
        recorded.summary = summary
        frames.save(folder / frames.NAME, recorded)
        written.append(folder / frames.NAME)
    return [*written, summary.write(folder)]


def lines(content, shown):
    """Outcomes, medians and ranges, and the run that is shown. shown: its summary"""
    count = len(content["finished"])
    heads = [f"{count} runs of house {shown.model}, vertices disturbed by at most {content['disturbance_m']:g} m",
             *(f"{state}: {counted(share['runs'], 'run')}, {100 * share['share']:.0f} % (95 % confidence:"
               f" {100 * share['low']:.0f} to {100 * share['high']:.0f} %)"
               for state, share in content["outcomes"].items())]
    heads += [f"failed: {counted(len(content['errors']), 'run')}"] if content["errors"] else []
    rows = [_row(label, content["numbers"][place], text, count) for label, place, text in ROWS
            if place in content["numbers"]]
    number = content["shown"]
    reason = (f"shown: run {number}, nearest to the median of the"
              f" {'collapse time' if shown.collapsed else 'peak drift'} of the {shown.verdict} ones")
    return [*heads, COLUMNS.format("", "median", "lowest to highest", "").rstrip(), *rows, reason]


def _row(label, spread, text, count):
    part = f"in {counted(spread['runs'], 'run')}" if spread["runs"] < count else ""
    return COLUMNS.format(label, text(spread["median"]), span(text(spread["lowest"]), text(spread["highest"])),
                          part).rstrip()
