# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a batch in one CSV file, one row per run."""

from ...base.atomic_write import write_text
from ...base.json_types import encode, leaves
from ...base.table import csv_text
from ...text.english import event
from .table import COLUMNS
from .tasks import task_of

RUNS = "runs.csv"
RESULTS = {
    "verdict": "verdict",
    "sentence": "sentence",
    "collapsed": "collapsed",
    "collapse_time_s": "collapse_time_s",
    "tilt_time_s": "tilt_time_s",
    "tilt_direction": "tilt_direction",
    **{f"{drift}_{storey}_{direction}": f"{drift}.storey{storey}.{direction}"
       for drift in ("peak_drift", "residual_drift") for storey in (1, 2) for direction in ("ns", "ew")},
    "joints": "joints.total",
    "broken": "broken.total",
    "broken_column_beam": "broken.column_beam",
    "broken_brace_beam": "broken.brace_beam",
    "wall_sheets": "joints.wall_sheets",
    "broken_wall_sheets": "broken.wall_sheets",
    "columns_fallen": "columns.fallen",
    "snow_mass_kg": "snow_mass_kg",
    **{f"pga_{axis}_gal": f"record.pga_gal.{axis}" for axis in ("ns", "ew", "ud")},
    "energy_residual": "energy.residual_fraction",
    "time_step_s": "dt",
    "simulated_s": "duration_s",
    "wall_s": "wall_s",
    "version": "versions.package",
}
"""{column of runs.csv: its path in summary.json}."""


def write_runs(rows, folder):
    """Write runs.csv with the present state of all runs; returns its rows, with None for empty cells."""
    columns = [column for column in COLUMNS if any(column in row.cells for row in rows)]
    results = [_result(row, task_of(row, folder), columns) for row in rows]
    header = list(results[0]) if results else ["run"]
    write_text(folder / RUNS, csv_text(header, [result.values() for result in results]))
    return results


def _result(row, task, columns):
    summary = task.summary
    table = dict(leaves(encode(summary) or {}))
    error = None if summary else task.error
    return {
        "run": row.name, "line": row.line, "description": row.description or None,
        "status": "failed" if error else "done" if summary else "unfinished",
        "error": error and f"{row.place}: {error}",
        **{column: row.cells.get(column) for column in columns}, "peak_drift": summary and summary.largest_drift()[0],
        **{column: table.get(path) for column, path in RESULTS.items()},
        "events": "; ".join(f"{one.time_s:.2f} s {event(one)}" for one in (summary.events if summary else ())) or None
    }
