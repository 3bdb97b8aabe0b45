#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What decides whether the graded houses stand: single changes of the model, one table.

    scripts/validation/graded_changes.py --record PREFIX_OF_JMA_KOBE --start 6 --end 20 [--seeds N]
        [--changes 'default,finishes off,...'] [--grades 1,1.25,1.5] [--levels design,mean] [--no-runs] [--to DIR]

Houses, tests and motion: graded_houses.py. Each row of the table is a change, a grade and a level of the walls. The
same command continues runs that were stopped; further changes, grades and seeds add to them. finishes: sum of the
largest shears of finishes in storey 1 over the code's wall quantity, the smaller of both directions. Drifts of storey 1
are medians over the runs, of the centre and of the column that drifts most; 1 for a run that collapses.
"""
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs use

from graded_houses import TEST, motion_of
from house_storeys import AXES, wall_joints
from wall_grades import REQUIRED, STRUCTURE, graded_house

from timber_houses.api.result import load_run
from yade_timber.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.house import LEVELS, build_house, load_house
from timber_houses.house.parser import house_text
from timber_houses.house.walls import SHARE
from timber_houses.house.weight import floor_area
from timber_houses.run.options import RunOptions
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import (Parser, add_driver_options, count, non_negative, positive, record,
                                       results_folder, run_script, seed, selected)

UNIT = 1960.0
"""Allowable shear of a wall of multiplier 1. [N/m]"""
UNCOUNTED = ("mortar", "gypsum")
"""Sheets of the house that many houses have without a count."""
CLOSED = {"law": "brittle", "kn": 1e8, "ks": 1e8, "strength": math.inf, "softening_stretch": None,
          "ultimate_stretch": None, "friction_share": None}
"""Fitting that neither opens nor yields; it clamps the column, too."""


@dataclass(frozen=True)
class Change:
    """Of a graded house: function that changes its content; finish_ratio() with plywood as the only counted sheet."""

    of_content: Callable
    finishes: float | None = None


def scale_finishes(data, factor):
    """Shears of all finishes times a factor."""
    for table in data["wall_types"].values():
        if table.get("finish"):
            table["envelope"] = [[drift, factor * shear] for drift, shear in table["envelope"]]


def law(**values):
    """Options of the laws."""
    return Change(lambda data: data["law"].update(values))


def without_finishes(data):
    data["finishes"] = False


def slip_walls(data):
    """The law slip, with slack up to the largest drift of either side, for all walls."""
    for table in data["wall_types"].values():
        table |= {"friction_share": 0.2}
        for key in ("friction_force", "reload_share", "reload_target", "residual_share"):
            table.pop(key, None)


def bare(**values):
    """Without finishes, and with options of the laws."""
    def change(data):
        without_finishes(data)
        data["law"].update(values)
    return Change(change)


CHANGES = {
    "default": law(),
    "finishes off": bare(),
    "plywood alone": Change(without_finishes, 0.0),
    **{f"plywood and finishes {ratio:g}": Change(lambda data: None, ratio) for ratio in (1.0, 2.1, 2.8)},
    "damping 0": law(joint_damping=0.0),
    "damping 2 %": law(joint_damping=0.02),
    "damping 5 %": law(joint_damping=0.05),
    "damping of initial stiffness": law(damping_stiffness="initial"),
    "damping 5 % of initial stiffness": law(joint_damping=0.05, damping_stiffness="initial"),
    "finishes off and damping 2 %": bare(joint_damping=0.02),
    "finishes off and damping 5 %": bare(joint_damping=0.05),
    "law slip": Change(slip_walls),
    "column ends closed": Change(lambda data: data["joint_types"].update(corner_fitting=CLOSED)),
}
"""{name: Change}"""
SHIPPED = ("default", "finishes off", "damping 2 %", "damping 5 %", "finishes off and damping 2 %",
           "finishes off and damping 5 %")
"""Finishes off and on, damping as shipped, 2 and 5 %."""


def house_file(folder, change, grade, level, rule):
    """Write a house file. Returns its path."""
    wanted = CHANGES[change].finishes
    data = graded_house(grade, level, rule, () if wanted is None else UNCOUNTED)
    CHANGES[change].of_content(data)
    data["name"] = "".join(c if c.isalnum() else "_" for c in f"{change} {grade:g} {level}")
    path = _written(folder, change, data)
    if wanted:
        scale_finishes(data, wanted / finish_ratio(path))
        _written(folder, change, data)
    return path


def _written(folder, change, data):
    path = folder / f"{data['name']}.yaml"
    write_text(path, f"# Graded house with one change: {change}\n{house_text(data)}")
    return path


def finish_ratio(path):
    """Largest shears of the finishes of storey 1 over the code's wall quantity, the smaller of both directions. [-]"""
    description = load_house(path)
    model, types = build_house(description), description.data["wall_types"]
    required = UNIT * REQUIRED[0] * floor_area(model, STRUCTURE, 1)
    return min(sum(j.strength for j in wall_joints(model, 1, axis) if types[j.type]["finish"]) / SHARE / required
               for axis in AXES)


def tasks(path, shaking, seeds, folder):
    """Runs of a house; seed 1 is undisturbed."""
    return [Task("house", folder / path.stem / f"{number:03d}",
                 RunOptions(house=str(path.resolve()), **shaking, until_collapse=True,
                            disturb=number if number > 1 else None, no_frames=True))
            for number in range(1, seeds + 1)]


def row(change, grade, level, path, results):
    """Of the table; results: of runs that ended well."""
    data, summaries = load_house(path).data, [result.summary for result in results]
    return {"change": change, "grade": grade, "walls": level, "finishes": finish_ratio(path),
            "damping": data["law"]["joint_damping"], "test": TEST[grade], "runs": len(summaries),
            "collapsed": sum(s.collapsed for s in summaries),
            "tilted": sum(s.tilt_time_s is not None for s in summaries),
            **{f"{name}_{axis}": median_drift(summaries, name, axis) for axis in AXES for name in ("centre", "column")}}


def median_drift(summaries, name, axis):
    """Of storey 1; 1 for a run that collapses. name: centre or column"""
    values = []
    for summary in summaries:
        drifts = summary.peak_drift if name == "centre" else summary.column_drift.largest
        values.append(1.0 if summary.collapsed else drifts["storey1"][axis])
    return float(np.median(values))


def parsed():
    options = Parser(__doc__)
    add_driver_options(options, Path("results/graded_changes"))
    options.add_argument("--record", type=record, metavar="PREFIX",
                         help="recorded motion (default: a motion of kobe_like.py)")
    options.add_argument("--seed", type=seed, default=0, metavar="N", help="of the synthetic motion")
    options.add_argument("--start", type=non_negative, metavar="S", help="start of the part that is run [s]")
    options.add_argument("--end", type=positive, metavar="S", help="end of that part [s]")
    options.add_argument("--scale", type=positive, default=1.0, metavar="X", help="factor on the motion")
    options.add_argument("--seeds", type=count, default=1, metavar="N", help="runs of each house (default %(default)s)")
    options.add_argument("--rule", choices=("law", "label"), default="law", help="wall quantity (graded_houses.py)")
    options.add_argument("--changes", default=",".join(CHANGES),
                         help=f"default: all; shipped: {', '.join(SHIPPED)}".replace("%", "%%"))
    options.add_argument("--grades", default="1,1.25,1.5", help="default %(default)s")
    options.add_argument("--levels", default="design,mean", help="of the walls (default %(default)s)")
    options.add_argument("--no-runs", action="store_true", help="table of the runs that are done")
    options.add_argument("--to", type=results_folder, metavar="DIR", help="folder of the table")
    return options.parse_args()


def main():
    given = parsed()
    to = given.to or given.out
    for folder in (given.out, to):
        folder.mkdir(parents=True, exist_ok=True)
    _, shaking = motion_of(given, given.out)
    changes = SHIPPED if given.changes == "shipped" else selected(given.changes, CHANGES, "--changes")
    houses = {(change, grade, level): house_file(given.out, change, grade, level, given.rule)
              for change in changes for grade in map(float, given.grades.split(","))
              for level in selected(given.levels, LEVELS, "--levels")}
    runs = {key: tasks(path, shaking, given.seeds, given.out) for key, path in houses.items()}
    if not given.no_runs:
        run_missing([task for each in runs.values() for task in each], SCRIPTS, given.jobs)
    rows = []
    for key, each in runs.items():
        results = [load_run(task.folder) for task in each if task.summary is not None]
        if results:
            rows.append(row(*key, houses[key], results))
        elif not given.no_runs:
            print(f"{each[0].folder}: no run has ended well; its run.log says why")
    table = csv_text(list(rows[0]), [[f"{v:.4g}" if isinstance(v, float) else v for v in r.values()] for r in rows])
    write_text(to / f"{given.out.name}.csv", table)
    print(table, f"written: {to}/{given.out.name}.csv", sep="\n")


if __name__ == "__main__":
    run_script(main)
