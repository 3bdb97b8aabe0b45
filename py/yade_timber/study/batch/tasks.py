# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of a table as tasks of the driver: each row is a run of scripts/house.py. All rows are checked before the first run."""

from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

from ...base.atomic_write import write_text
from ...base.notes import noted
from ...house import HouseError, build_house, changed_house, load_house
from ...house.parser import house_text
from ...motion import MotionRequest, RecordError
from ...base.time_step import DEFAULT_DT, MAX_DT, MAX_DURATION, MIN_DT
from ..driver import Task, run_missing
from .table import MOTION, NO_EARTHQUAKE, RECORDS, BatchError

HOUSE = "house.yaml"
"""House file of a row that changes its house, in the run's folder."""
LIMITS = {"dt": (MIN_DT, MAX_DT), "duration": (0, MAX_DURATION), "snow": (0, 20), "joint_damping": (0, 1)}
"""{column: admissible range}, units as in the table."""


def run_rows(rows, folder, scripts, jobs=None, retry=False):
    """Run the rows that are not done, after checking each of them; returns {task: summary or None}.

    retry: failed rows run again. Raises BatchError, RunError, KeyboardInterrupt, OSError.
    """
    tasks = [task_of(row, folder) for row in rows]
    missing = [row for row, task in zip(rows, tasks) if task.is_missing(retry)]
    check_rows(missing, folder)
    return run_missing(tasks, scripts, jobs, retry=retry)


def task_of(row, folder):
    """Task of a row, in the folder of that name. Paths are absolute: they are part of a run's identity."""
    folder = Path(folder).absolute() / row.name
    return Task("house", folder, options(row, folder), frames=False)


def options(row, folder):
    """Options of scripts/house.py for a row."""
    words = [str(folder / HOUSE) if any(changes(row)) else row.house]
    if row.cells.get("record") != NO_EARTHQUAKE:
        words.append("--quake")
    for column in ("snow", "joint_damping", "dt", "duration", "until_collapse", *MOTION):
        value, option = getattr(row, column) if column in RECORDS else row.value(column), f"--{column.replace('_', '-')}"
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            words += [option, str(value)]
    return tuple(words)


# --- houses -----------------------------------------------------------------------------------------------------------


def changes(row):
    """(set, braces, strength) of a row as texts, None for what it does not change."""
    return tuple(row.cells.get(column) for column in ("set", "braces", "strength"))


def write_house(row, folder):
    """Write the house file of a row that changes its house. Raises HouseError, OSError."""
    settings, braces = (tuple(filter(None, (text or "").split(";"))) for text in changes(row)[:2])
    data = changed_house(row.house, settings, braces, row.value("strength", 1.0), row.where)
    path = Path(folder) / row.name / HOUSE
    path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, f"# House {row.cells['house']} with the changes of {row.table.name}\n{house_text(data)}")


# --- checks -----------------------------------------------------------------------------------------------------------


def check_rows(rows, folder):
    """Refuse rows that cannot be run; house files of changed houses are written to their folders. Raises BatchError, OSError."""
    for row in rows:
        _check_numbers_and_motion(row)
    _check_houses(rows, folder)


def _check_numbers_and_motion(row):
    """Refuse numbers and ground motions that cannot be run. Raises BatchError."""
    for column, (low, high) in LIMITS.items():
        value = row.value(column, low)
        if not low <= value <= high:
            raise BatchError(f"{row.where(column)}: {value:g}: must be between {low:g} and {high:g}")
    request = MotionRequest(**{column: getattr(row, column) for column in RECORDS}, **{column: row.value(column) for column in MOTION if column not in RECORDS})
    if row.cells.get("record") == NO_EARTHQUAKE:
        for column in request.given():
            raise BatchError(f"{row.where(column)}: this run has no earthquake (record: {NO_EARTHQUAKE})")
    with _located(row):
        request.check(f"{row.table.name}:{row.line}, column {{}}:")
        if row.record is not None or row.then is not None:
            _read_record(request, row.value("dt", DEFAULT_DT))


def _check_houses(rows, folder):
    """Build each different house once, in memory. Raises BatchError, OSError."""
    built = set()
    for row in rows:
        with _located(row):
            if any(changes(row)):
                write_house(row, folder)
            variant = row.house, changes(row), row.value("snow")
            if variant not in built:
                build_house(load_house(task_of(row, folder).options[0]), row.value("snow"))
        built.add(variant)


@contextmanager
def _located(row):
    """Turns errors of houses and records into a BatchError of one line that begins with the row's place in the table."""
    try:
        yield
    except (HouseError, RecordError) as problem:
        text, place = " ".join(str(problem).split()), f"{row.table.name}:{row.line}"
        raise BatchError(text if text.startswith(place) else f"{place}: {text}") from None


@lru_cache(maxsize=256)
def _read_record(request, dt):
    """Read and process a recorded ground motion; its warnings become notes, once. Raises RecordError."""
    with noted():
        request.motion(dt)
