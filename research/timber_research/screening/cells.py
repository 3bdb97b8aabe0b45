# SPDX-License-Identifier: GPL-2.0-or-later
"""Cells of the screening: house files and rows of its batch.

A cell is a run of the design: one level of each factor, for all houses. Its runs are the paper's: those with an
earthquake under each motion, those with snow alone once. Cells are numbered in the order of the design, whose first
half can be analysed alone.
"""
from dataclasses import dataclass
from pathlib import Path

import yaml
from timber_houses.base.atomic_write import write_text
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import MotionRequest, onset
from timber_houses.run.options import RunOptions
from timber_houses.study.batch import Row

from .. import design
from ..claims import RUNS, parse_run
from ..factors import FACTORS, house_entries

HOUSES = "houses"
SNOW_DEPTH = 1.0
"""Snow on the roofs. [m] (paper, section 3.4)"""
LEAD, LENGTH = 4.0, 14.0
"""Part of a recorded motion that is run: from LEAD before the onset of strong shaking, LENGTH in all. [s]"""
SIGNS = design.levels(len(FACTORS))
"""(32, factors) levels of the cells: -1 the first, +1 the second."""


@dataclass(frozen=True)
class Motion:
    """A ground motion: name in tables, and its options of a run."""

    name: str
    options: dict


def synthetic(seed, start, end):
    """Part of a synthetic motion. start, end [s]"""
    return Motion(f"seed{seed}", {"seed": seed, "start": start, "end": end})


def recorded(record):
    """The strong part of a recorded motion: LENGTH from LEAD before its onset, or from its beginning. Raises
    RecordError.
    """
    start = max(0.0, round(onset(MotionRequest(record=record).motion(DEFAULT_DT)) - LEAD, 2))
    return Motion(Path(record).name, {"record": str(Path(record).absolute()), "start": start, "end": start + LENGTH})


@dataclass(frozen=True)
class Planned:
    """A run of the screening. motion: name, None without an earthquake; options: {option: value} but the house."""

    cell: int
    run: str
    motion: str
    options: dict

    def row(self, folder):
        """Row of the batch. folder: of the screening"""
        name = "_".join(filter(None, (cell_name(self.cell), self.run.removeprefix("model"), self.motion)))
        house = Path(folder).absolute() / house_file(self.cell, parse_run(self.run)[0])
        return Row(RunOptions(house=str(house), **self.options), description=name, place=name)


def plan(motions, dt):
    """Runs of the screening, cell by cell. dt [s]: time step."""
    return [planned for cell in range(design.RUNS) for planned in _runs_of(cell, motions, dt)]


def _runs_of(cell, motions, dt):
    shaken = [run for run in RUNS if parse_run(run)[1]]
    quiet = [run for run in RUNS if not parse_run(run)[1]]
    found = [(run, motion.name, {"quake": True, **motion.options}) for motion in motions for run in shaken]
    found += [(run, None, {}) for run in quiet]
    return [Planned(cell, run, motion, {"snow": SNOW_DEPTH if parse_run(run)[2] else 0.0, "until_collapse": True,
                                        "dt": dt, **options}) for run, motion, options in found]


def cell_name(cell):
    return f"c{cell:02d}"


def house_file(cell, house):
    """Path of a cell's house file below the folder of the screening."""
    return f"{HOUSES}/{cell_name(cell)}/{house}.yaml"


def write_houses(planned, folder):
    """Write the house files of the planned runs to the folder of the screening. Raises OSError."""
    for cell, house in dict.fromkeys((entry.cell, parse_run(entry.run)[0]) for entry in planned):
        _write_new(folder / house_file(cell, house),
                   yaml.safe_dump(house_entries(house, FACTORS, SIGNS[cell]), sort_keys=False))


def _write_new(path, text):
    """Write a file unless it has this content already."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or path.read_text() != text:
        write_text(path, text)
