# SPDX-License-Identifier: GPL-2.0-or-later
"""One row of a table: row -> Scenario, run in this YADE process, its end recorded in `run.json`, good or bad.

`run.json` is the last file written. Where it is, the run is over: its row has results, or an error. A run without it goes
on from its checkpoint the next time. A lock keeps two processes from one run (yade-batch, killed, leaves its jobs alive).
"""

import json
import os
import signal
import sys
import warnings
from pathlib import Path

import yaml

from ...run import checkpoint
from ...run import runner
from ...run.cli import QUIET_DURATION, Output, prepare_folder
from ...run.launch import leave
from ...base.errors import RunError
from ...base.atomic_write import write_text
from ...house import HouseError, changed_house, load_house
from ...base.lock import locked
from ...motion import MotionRequest, RecordError
from ...base.time_step import DEFAULT_DT, MAX_DT, MIN_DT
from ...scene.scenario import Scenario
from .collect import END
from .table import MOTION, NO_EARTHQUAKE, BatchError, read_table


def scenario(row, folder):
    """The Scenario of a row; a changed house is written to `folder`. Raises BatchError, HouseError, RecordError."""
    motion, scale = _motion(row)
    duration = row.value("duration", motion.duration if motion else QUIET_DURATION)
    house, dt = _house(row, folder), row.value("dt", DEFAULT_DT)
    snow = row.value("snow", load_house(house).data["snow"]["depth"])
    for column, value, low, high in (("snow", snow, 0, 20), ("duration", duration, 0, 1e5), ("dt", dt, MIN_DT, MAX_DT)):
        if not low <= value <= high:
            raise BatchError(f"{row.where(column)}: {value:g}: must be between {low:g} and {high:g}")
    return Scenario(row.name, house, motion, snow, scale=scale, dt=dt, duration=duration)


def _motion(row):
    """(GroundMotion or None, factor on it)."""
    asked = {column: row.value(column) for column in MOTION if column != "record"}
    request = MotionRequest(record=row.record, **asked)
    if row.cells.get("record") == NO_EARTHQUAKE:
        if request.given():
            raise BatchError(f"{row.where(request.given()[0])}: this run has no earthquake (record: {NO_EARTHQUAKE})")
        return None, 1.0
    request.check(f"{row.table.name}:{row.line}, column {{}}:")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        motion = request.motion(row.value("dt", DEFAULT_DT))
    return motion, 1.0 if request.scale is None else request.scale


def _house(row, folder):
    """What Scenario takes for the row's house: itself, or the file of its changed description in `folder`."""
    strength = row.value("strength", 1.0)
    changes = {column: row.cells[column].split(";") for column in ("set", "braces") if column in row.cells}
    if not changes and strength == 1.0:
        return row.house
    data = changed_house(row.house, changes.get("set", ()), changes.get("braces", ()), strength, row.where)
    path = folder / "house.yaml"
    write_text(path, f"# {row.cells['house']}, changed as {row.table.name}:{row.line} says\n{yaml.safe_dump(data, sort_keys=False)}")
    return str(path)


# --- running ----------------------------------------------------------------------------------------------------------


def main(argv):
    """Run the row that yade-batch names in YADE_BATCH, or `TABLE:LINE` (`TABLE:NAME`); results go to FOLDER/<name>. Ends the process.

    argv: [script, TABLE:LINE, FOLDER]; yade-batch's jobs have only the script, and FOLDER in YADE_TIMBER_BATCH.
    Status 0: done, now or before. 1: failed, and recorded. 75: another process is at it. 128 + n: stopped by a signal.
    """
    place, root = (argv[1], argv[2]) if len(argv) == 3 else (os.environ.get("YADE_BATCH", ""), os.environ.get("YADE_TIMBER_BATCH"))
    try:
        row = row_at(place)
        folder = Path(root or Path("results") / row.table.stem) / row.name
        prepare_folder(folder)
        with locked(folder) as free:
            status = finish(row, folder) if free else 75
    except RunError as problem:
        leave(f"error: {problem}", 1)
    if status == 75:
        print(f"{row.name}: another process is computing it", file=sys.stderr)
    sys.exit(status)


def row_at(place):
    """Row of 'TABLE:LINE' or 'TABLE:NAME'. Raises BatchError."""
    table, _, key = place.rpartition(":")
    if not table:
        raise BatchError(f"'{place}': give TABLE:LINE and a folder, or start this script by yade-batch")
    row = next((row for row in read_table(table) if key in (row.name, str(row.line))), None)
    if row is None:
        raise BatchError(f"{table}: no run in line {key}, and none of that name")
    return row


def finish(row, folder):
    """Bring the run of a row to its end, unless it is there already; returns the exit status."""
    if (folder / END).exists():
        return int(json.loads((folder / END).read_text())["status"] != "done")
    try:
        runner.Run(scenario(row, folder), Output(folder, resume=True, or_anew=True, views=False, frames=False, quiet=True)).complete()
    except runner.Interrupted as stop:
        print(f"{row.name}: stopped by {signal.Signals(stop.args[0]).name}, goes on when the batch is run again", file=sys.stderr)
        return 128 + stop.args[0]
    except (RunError, RecordError, HouseError) as problem:
        said = " ".join(str(problem).split())
        place = f"{row.table.name}:{row.line}"
        return _record(row, folder, said if said.startswith(place) else f"{place}: {said}")
    except Exception as problem:  # a bug, full disk, no memory: this run's loss, not the batch's
        return _record(row, folder, f"{type(problem).__name__}: {problem}")
    return _record(row, folder)


def _record(row, folder, error=None):
    """Write run.json; the checkpoint has served. Returns the exit status."""
    status = "failed" if error else "done"
    write_text(folder / END, json.dumps({"status": status, "error": error, "line": row.line, "cells": row.cells}, indent=1) + "\n")
    (folder / checkpoint.NAME).unlink(missing_ok=True)
    if error:
        print(f"{row.name}: {error}", file=sys.stderr)
    return int(status == "failed")
