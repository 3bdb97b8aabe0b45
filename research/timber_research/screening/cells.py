# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells of the screening: house files and the rows of its batch table.

A cell is a run of the design: one level of each factor, for all houses. Its runs are the paper's: those with an
earthquake under each motion, those with snow alone once. Cells are numbered in the order of the design, whose first
half can be analysed alone.
"""
from dataclasses import dataclass
from pathlib import Path

import yaml
from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import MotionRequest, onset
from timber_houses.study.batch.table import NO_EARTHQUAKE

from .. import design
from ..claims import RUNS, parse_run
from ..factors import FACTORS, house_entries

TABLE, HOUSES = "table.csv", "houses"
SNOW_DEPTH = 1.0
"""Snow on the roofs. [m] (paper, section 3.4)"""
LEAD, LENGTH = 4.0, 14.0
"""Part of a recorded motion that is run: from LEAD before the onset of strong shaking, LENGTH in all. [s]"""
SIGNS = design.levels(len(FACTORS))
"""(32, factors) levels of the cells: -1 the first, +1 the second."""


@dataclass(frozen=True)
class Motion:
    """A ground motion: name in tables, and its columns in the batch table."""

    name: str
    columns: tuple


def synthetic(seed, start, end):
    """Part of a synthetic motion. start, end [s]"""
    return Motion(f"seed{seed}", (("seed", seed), ("start", start), ("end", end)))


def recorded(record):
    """The strong part of a recorded motion: LENGTH from LEAD before its onset, or from its beginning. Raises
    RecordError.
    """
    start = max(0.0, round(onset(MotionRequest(record=record).motion(DEFAULT_DT)) - LEAD, 2))
    return Motion(Path(record).name, (("record", Path(record).absolute()), ("start", start), ("end", start + LENGTH)))


@dataclass(frozen=True)
class Planned:
    """A run of the screening. motion: name, None without an earthquake; row: {column: value} of the batch table."""

    cell: int
    run: str
    motion: str
    row: dict


def plan(motions, dt):
    """Runs of the screening, cell by cell. dt [s]: time step."""
    return [planned for cell in range(design.RUNS) for planned in _runs_of(cell, motions, dt)]


def _runs_of(cell, motions, dt):
    shaken = [run for run in RUNS if parse_run(run)[1]]
    quiet = [run for run in RUNS if not parse_run(run)[1]]
    found = [(run, motion.name, dict(motion.columns)) for motion in motions for run in shaken]
    found += [(run, None, {"record": NO_EARTHQUAKE}) for run in quiet]
    return [Planned(cell, run, motion, _row(cell, run, motion, {**columns, "dt": dt}))
            for run, motion, columns in found]


def _row(cell, run, motion, columns):
    house, _, snow = parse_run(run)
    name = "_".join(filter(None, (cell_name(cell), run.removeprefix("model"), motion)))
    values = {"description": name, "house": house_file(cell, house), "snow": SNOW_DEPTH if snow else 0,
              "until_collapse": "yes"}
    return {**dict.fromkeys(("record", "seed", "start", "end")), **values, **columns}


def cell_name(cell):
    return f"c{cell:02d}"


def house_file(cell, house):
    """Path of a cell's house file below the folder of the screening."""
    return f"{HOUSES}/{cell_name(cell)}/{house}.yaml"


def write_inputs(planned, folder):
    """Write house files and batch table of the planned runs to a folder; returns the path of the table. Raises OSError.
    """
    for cell, house in dict.fromkeys((entry.cell, parse_run(entry.run)[0]) for entry in planned):
        _write_new(folder / house_file(cell, house),
                   yaml.safe_dump(house_entries(house, FACTORS, SIGNS[cell]), sort_keys=False))
    rows = [entry.row for entry in planned]
    write_text(folder / TABLE, csv_text(list(rows[0]), [row.values() for row in rows]))
    return folder / TABLE


def _write_new(path, text):
    """Write a file unless it has this content already."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or path.read_text() != text:
        write_text(path, text)
