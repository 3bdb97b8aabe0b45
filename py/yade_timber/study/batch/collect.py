# SPDX-License-Identifier: GPL-2.0-or-later
"""The results of a table's runs in one CSV file, a row a run, made from what each run left in its own folder."""

import csv
import io
import json

from ...base.atomic_write import write_text

END, SUMMARY, RUNS = "run.json", "summary.json", "runs.csv"
STATES = ("done", "failed", "unfinished")
RESULTS = {
    "collapsed": "collapsed",
    "collapse_time_s": "collapse_time_s",
    "tilt_time_s": "tilt_time_s",
    "tilt_direction": "tilt_direction",
    **{f"peak_drift_{s}_{w}": f"peak_drift.storey{s}.{w}" for s in (1, 2) for w in ("ns", "ew")},
    **{f"residual_drift_{s}_{w}": f"residual_drift.storey{s}.{w}" for s in (1, 2) for w in ("ns", "ew")},
    "joints": "joints.total",
    "broken": "broken.total",
    "broken_column_beam": "broken.column_beam",
    "broken_brace_beam": "broken.brace_beam",
    "columns_fallen": "columns.fallen",
    "snow_mass_kg": "snow_mass_kg",
    **{f"pga_{axis}_gal": f"record.pga_gal.{axis}" for axis in ("ns", "ew", "ud")},
    "energy_residual": "energy.residual_fraction",
    "time_step_s": "dt",
    "simulated_s": "duration_s",
    "wall_s": "wall_s",
    "version": "versions.package",
}
"""{column of runs.csv: where it is in summary.json}."""


def collect(rows, folder):
    """[{'run', 'line', 'status', 'error', every column of the table, 'peak_drift', every one of RESULTS}] in the order of the table; None: nothing to say."""
    columns = list(dict.fromkeys(column for row in rows for column in row.cells))
    return [_collected(row, folder / row.name, columns) for row in rows]


def _collected(row, folder, columns):
    end = _json(folder / END) or {"status": "unfinished", "error": None}
    found = _json(folder / SUMMARY) if end["status"] == "done" else None
    return {
        "run": row.name,
        "line": row.line,
        "description": row.description or None,
        "status": end["status"],
        "error": end["error"],
        **{column: row.cells.get(column) for column in columns},
        "peak_drift": _largest(_at(found, "peak_drift")),
        **{column: _at(found, path) for column, path in RESULTS.items()},
    }


def _json(path):
    try:
        return json.loads(path.read_text())
    except FileNotFoundError:
        return None


def _largest(drifts):
    """Largest of {storey: {direction: drift}}, None where there is none."""
    return max((drift for ways in (drifts or {}).values() for drift in ways.values() if drift is not None), default=None)


def _at(found, path):
    """Value at 'a.b.c' of nested tables, None where there is none."""
    for key in path.split("."):
        found = found.get(key) if isinstance(found, dict) else None
    return found


def write_runs(rows, folder):
    """Write runs.csv for the runs as they are now; returns what `collect` does."""
    found = collect(rows, folder)
    text = io.StringIO()
    writer = csv.DictWriter(text, list(found[0]) if found else ["run"], lineterminator="\n")
    writer.writeheader()
    writer.writerows(found)
    write_text(folder / RUNS, text.getvalue())
    return found
