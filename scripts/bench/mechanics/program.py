# SPDX-License-Identifier: GPL-2.0-or-later
"""What a program states of itself, and the CSV file of its column. Needs no YADE."""
import csv
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from mechanics.rows import table

HEADS = ("program", "version", "settings", "radius [m]", "dt [s]", "row", "value", "note", "CPU time [s]")


class NotPossible(Exception):
    """The program or its adapter has no result for the scene; the text says why."""


LONGEST = 40
"""Of a run. [s of processor time]"""


def too_late():
    return NotPossible(f"no end in {LONGEST} s of processor time")


@dataclass(frozen=True)
class Program:
    """run(scene, dt): Trajectory; raises NotPossible. steps: time steps of the column [s]. radius: rounding of
    edges [m]. lacks: (ability that rows may need, what is missing).
    """

    name: str
    version: str
    settings: str
    run: Callable
    steps: tuple
    radius: float = 0.0
    lacks: tuple = ()


def measured(program, row, dt, runs):
    """(value or "", note) of a row; runs: {scene's name: trajectory or the reason for having none}, which grows."""
    missing = [reason for ability, reason in program.lacks if ability in row.needs]
    if missing:
        return "", f"not possible: {missing[0]}"
    for scene in row.scenes(program.radius):
        if scene.name not in runs:
            try:
                runs[scene.name] = program.run(scene, dt)
            except NotPossible as reason:
                runs[scene.name] = f"not possible: {reason}"
            except Exception as reason:  # one scene that a program refuses must not end its column
                runs[scene.name] = f"failed: {' '.join(str(reason).split())[:160]}"
    found = [runs[scene.name] for scene in row.scenes(program.radius)]
    reasons = [run for run in found if isinstance(run, str)]
    if reasons:
        return "", reasons[0]
    if not all(run.finite for run in found):
        return "", "failed: positions are not finite"
    return row.measure(*found), ""


def column(program, steps=None, keys=None):
    """Rows of the CSV file of a program, one for each row and step."""
    for dt in steps or program.steps:
        runs = {}
        for row in table():
            if keys and row.key not in keys:
                continue
            since = time.process_time()
            value, note = measured(program, row, dt, runs)
            spent = time.process_time() - since
            print(f"{program.name} {dt:.3g} s {row.key}: {value if value != '' else note} ({spent:.1f} s)", flush=True)
            yield (program.name, program.version, program.settings, program.radius, f"{dt:.9g}", row.key,
                   "" if value == "" else f"{value:.9g}", note, f"{spent:.1f}")


def write_column(path, rows):
    """Write rows of a column; rows of the same program, step and key that the file already has are replaced."""
    path, rows = Path(path), [tuple(map(str, row)) for row in rows]
    old = []
    if path.exists():
        with open(path, newline="", encoding="utf-8") as file:
            old = [tuple(row) for row in csv.reader(file)][1:]
    new = {(row[0], row[4], row[5]) for row in rows}
    order = {row.key: k for k, row in enumerate(table())}
    kept = [row for row in old if (row[0], row[4], row[5]) not in new and row[5] in order] + rows
    kept.sort(key=lambda row: (row[0], -float(row[4]), order[row[5]]))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADS)
        writer.writerows(kept)
