# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows as tasks of the driver, all checked before the first run."""
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from ...base.atomic_write import write_text
from ...base.errors import located
from ...base.files import make_folder
from ...base.notes import noted
from ...house import build_house, changed_house, load_house
from ...house.parser import house_text
from ..driver import Task, run_missing
from .row import BatchError, HouseChanges

HOUSE = "house.yaml"  # house file of a row that changes its house, in the run's folder


def run_rows(rows, folder, jobs=None, retry=False):
    """Run the rows that are not done, all checked first; returns {task: summary or None}. retry: failed ones, too"""
    tasks = [task_of(row, folder) for row in rows]
    missing = [row for row, task in zip(rows, tasks) if task.is_missing(retry)]
    check_rows(missing, folder)
    return run_missing(tasks, jobs, retry=retry)


def task_of(row, folder):
    """Task of a row, in the folder of that name. Paths are absolute: they are part of a run's identity."""
    folder = Path(folder).absolute() / row.name
    house = row.options.house if row.changes == HouseChanges() else str(folder / HOUSE)
    return Task(folder, replace(row.options, house=house, no_frames=True))


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
                options = task_of(row, folder).options
                build_house(load_house(options.house), options.snow, wall_level=options.walls)
        built.add(variant)


@lru_cache(maxsize=256)
@noted()
def _read_record(options):
    """Read and process a recorded ground motion; its warnings become notes, once. Raises RecordError."""
    options.motion(options.dt)
