# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a batch or a study: options and changes of the house, from which the name follows; their check, tasks of the
driver, and results in one CSV file."""
import re
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path

from ...base.atomic_write import write_text
from ...base.errors import RunError, located
from ...base.files import make_folder
from ...base.json_types import encode, leaves
from ...base.notes import noted
from ...base.options import is_given, option, options
from ...base.table import csv_text
from ...house import build_house, changed_house, load_house
from ...house.parser import house_text
from ...run.identity import content, made_from, of_values
from ...run.options import RunOptions
from ...text.english import event
from ..driver import Task, run_missing

NO_EARTHQUAKE = "none"  # value of the column `record` for a run without an earthquake
HOUSE = "house.yaml"  # house file of a row that changes its house, in the run's folder
DECISIVE = {name: each for name, each in options(RunOptions).items() if each.metadata["decides"] and name != "quake"}


class BatchError(RunError):
    """A row or table that cannot be run; the message is one line: place, column, admissible values."""


@dataclass(frozen=True)
class HouseChanges:
    """Columns that change the house of a row; in a table ; separates the entries of a list."""

    set: tuple = option(str, "changes of the house: key=value;key=value, keys as in house files, list items counted"
                        " from 1", default=())
    braces: tuple = option(str, "names of braces and walls to add to the house, separated by ;", default=())
    strength: float = option(float, "factor on the strength of all joints (default 1)", default=1.0)


HOUSE_CHANGES = options(HouseChanges)
COLUMNS = {"house": DECISIVE["house"], **HOUSE_CHANGES, **DECISIVE}
"""{column: option}, without the column `description`. A run has an earthquake unless its record is NO_EARTHQUAKE."""
RUNS = "runs.csv"
RESULTS = {
    **{name: name for name in ("verdict", "sentence", "collapsed", "collapse_time_s", "tilt_time_s", "tilt_direction")},
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


@dataclass(frozen=True)
class Row:
    """One run. options: RunOptions with the house before its changes; place: of messages, 'runs.txt:5'; line: of a
    table."""

    options: RunOptions
    changes: HouseChanges = HouseChanges()
    description: str = ""
    place: str = "row"
    line: int | None = None

    def where(self, column):
        """'runs.txt:5, column scale'."""
        return f"{self.place}, column {column}"

    @property
    def name(self):
        """Name of the run and its folder: it follows from its options and the content of its house and record."""
        origin = content(made_from(self.options))
        if origin["content of files"] is None:  # faulty ones, reported by the check
            origin["content of files"] = [self.options.house, self.options.record, self.options.then]
        label = self.description or Path(self.options.house).stem
        return f"{re.sub(r'[^A-Za-z0-9._+=-]+', '_', label)[:60]}-{of_values([origin, asdict(self.changes)])[:8]}"

    @property
    def cells(self):
        """{column: value} of a table with this row, without defaults."""
        given = {name: getattr(part, name) for part, names in ((self.options, DECISIVE), (self.changes, HOUSE_CHANGES))
                 for name in names if is_given(part, name)}
        calm = {} if self.options.shaken else {"record": NO_EARTHQUAKE}
        return {name: ";".join(value) if isinstance(value, tuple) else value for name, value in (given | calm).items()}

    def task(self, folder):
        """Task of the row, in the folder of its name. Paths are absolute: they are part of a run's identity."""
        folder = Path(folder).absolute() / self.name
        house = self.options.house if self.changes == HouseChanges() else str(folder / HOUSE)
        return Task(folder, replace(self.options, house=house, no_frames=True))


def run_rows(rows, folder, jobs=None, retry=False):
    """Run the rows that are not done, all checked first; returns {task: summary or None}. retry: failed ones, too"""
    tasks = [row.task(folder) for row in rows]
    missing = [row for row, task in zip(rows, tasks) if task.is_missing(retry)]
    check_rows(missing, folder)
    return run_missing(tasks, jobs, retry=retry)


def check_rows(rows, folder):
    """Refuse rows that cannot be run; files of changed houses are written. Raises BatchError, OSError."""
    for row in rows:
        with located(row.place, BatchError):
            options = row.options.check()
            if options.record is not None or options.then is not None:
                _read_record(options)
    _check_houses(rows, folder)


def _check_houses(rows, folder):
    """Build each different house once, in memory. Raises BatchError, OSError."""
    built = set()
    for row in rows:
        with located(row.place, BatchError):
            if row.changes != HouseChanges():
                house, changes, path = row.options.house, row.changes, Path(folder) / row.name / HOUSE
                data = changed_house(house, changes.set, changes.braces, changes.strength, row.where)
                make_folder(path.parent)
                write_text(path, f"# House {Path(house).stem} with changes\n{house_text(data)}")
            variant = row.options.house, row.changes, row.options.snow, row.options.walls
            if variant not in built:
                options = row.task(folder).options
                build_house(load_house(options.house), options.snow, wall_level=options.walls)
        built.add(variant)


@lru_cache(maxsize=256)
@noted()
def _read_record(options):
    """Read and process a recorded ground motion; its warnings become notes, once. Raises RecordError."""
    options.motion(options.dt)


def write_runs(rows, folder):
    """Write runs.csv with the present state of all runs; returns its rows, with None for empty cells."""
    columns = [column for column in COLUMNS if any(column in row.cells for row in rows)]
    results = [_result(row, row.task(folder), columns) for row in rows]
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
