#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What decides whether the graded houses stand: single changes of the model, one table.

    scripts/validation/graded_changes.py --record PREFIX_OF_JMA_KOBE --start 6 --end 20 [--runs N]
        [--changes 'default,siding,siding + damping 2 %,...'] [--grades 1,1.25,1.5] [--levels design,mean]
        [--only-done] [--runs-alone] [--to DIR]

Houses, tests and motion: graded_houses.py. Each row of the table is a change, or several joined by " + ", a grade and a
level of the walls. Its runs have the motion times 1, 0.99, 1.01, 0.98, ...: disturbances of 1e-9 m change neither
outcomes nor drifts. The same command continues runs that were stopped; further changes, grades and runs add to them.
finishes: sum of the largest shears of finishes in storey 1 over the code's wall quantity, the smaller of both
directions. Drifts of storey 1 are medians over the runs, of the centre and of the column that drifts most; 1 for a run
that collapses. model: the same of the lumped-mass model (shear_model.py), 1 where the storey passes 1/10. It alone has
the changes of MODEL_CHANGES: a house file has neither P-delta nor the radius of members.
"""
import sys
from collections.abc import Callable
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

import house_storeys
from graded_houses import TEST, add_motion_options, before_failure, motion_of
from house_storeys import AXES, shear_storeys, wall_joints
from shear_model import Storey, response
from wall_grades import HOUSE, REQUIRED, STRUCTURE, graded_house, listed

from timber_houses.api.result import load_run
from timber_houses.base.atomic_write import write_text
from timber_houses.base.errors import RunError
from timber_houses.base.table import csv_text
from timber_houses.house import LEVELS, build_house, changed_house, load_house
from timber_houses.house.layout import SAWS_STATES
from timber_houses.house.parser import house_text
from timber_houses.house.walls import SHARE
from timber_houses.run.options import RunOptions
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import Parser, add_driver_options, count, results_folder, run_script, selected

UNIT = 1960.0
"""Allowable shear of a wall of multiplier 1. [N/m]"""
CLOSED = {"law": "slip", "kn": 1e8, "ks": 1e8, "strength": 2e7, "friction_share": 0.0, "softening_stretch": 0.4,
          "ultimate_stretch": 0.5}
"""Fitting that neither opens nor yields below 20 MN; at the corners of a column it clamps it, too. [N, m]"""
NONE = CLOSED | {"kn": 1e6, "ks": 1e6, "strength": 100.0}
"""Fitting without strength: friction alone holds the ends. [N, m]"""
SIDED, LINED = 0.31, 0.14
"""Weight of outer walls with siding of 0.17, and without: gypsum board 0.09 (l_house.yaml), plywood of 9 mm 0.05.
[kN/m2]"""
STEP = 0.01
"""Of the factors on the motion. [-]"""
SHARP = 0.02
"""Radius of a column's edges over its width, in place of house_storeys.ROUNDING. [-]"""


def unchanged(_):
    pass


@dataclass(frozen=True)
class Change:
    """Of a graded house: functions that change its content, that of the house with the plan, and the storeys of the
    lumped-mass model; finish_ratio() to which finishes are scaled."""

    content: Callable = unchanged
    plan: Callable = unchanged
    storey: Callable = unchanged
    finishes: float | None = None


def scale_finishes(data, factor):
    """Shears of all finishes times a factor."""
    for table in data["wall_types"].values():
        if table.get("finish") and "envelope" in table:
            table["envelope"] = [[drift, factor * shear] for drift, shear in table["envelope"]]


def law(**values):
    """Options of the laws."""
    return Change(lambda data: data["law"].update(values))


def without_finishes(data):
    data["finishes"] = False


def heavy_siding(data):
    """In place of mortar, with its weight."""
    for table in (table for name, table in data["wall_types"].items() if name.startswith("stucco")):
        table["envelope"] = data["wall_types"]["siding1ew"]["envelope"]


def siding(data):
    heavy_siding(data)
    data["loads"]["wall"] = SIDED


def gypsum_alone(data):
    """Finishes inside, none outside."""
    data["loads"]["wall"] = LINED
    lines = data["structures"][STRUCTURE]["walls"]
    for line in lines:
        line["type"] = [name for name in listed(line["type"]) if not name.startswith("stucco")]
    data["structures"][STRUCTURE]["walls"] = [line for line in lines if line["type"]]


def slip_walls(data):
    """The law slip, with slack up to the largest drift of either side, for all walls."""
    for table in data["wall_types"].values():
        table |= {"friction_share": 0.2}
        for key in (*SAWS_STATES, "residual_share"):
            table.pop(key, None)


def symmetric_walls(data):
    """All plywood in the outer walls, which have the same windows on opposite sides."""
    table = data["structures"][STRUCTURE]
    walls = [line for line in table["walls"] if listed(line["type"]) != ["plywood"]]
    outer = [line for line in walls if "stucco" in listed(line["type"]) and not line.get("opening")]
    windows = [line for line in walls if line.get("opening") == "window" and "storeys" not in line]
    inner = [line for line in walls if "stucco" not in listed(line["type"])]
    south, west = ([line for line in windows if line["along"] == axis] for axis in "xy")
    pairs = [{**line, "at": [0, 7]} for line in south] + [{**line, "at": [0, 8]} for line in west if line["at"] == 0]
    table["walls"] = outer + pairs + inner


def axis_fittings(values):
    """Column ends with one fitting at the column's axis, without rotational stiffness."""
    def change(data):
        data["joint_types"]["hold_down"].update(values)
        data["joints"]["column_ends"].update(type="hold_down", number=1)
    return Change(change)


def no_p_delta(storey):
    storey.p_delta = 0.0


def sharp_columns(storey):
    storey.edges *= (1 - 2 * SHARP) / (1 - 2 * house_storeys.ROUNDING)


CHANGES = {
    "default": Change(),
    "siding": Change(siding),
    "heavy siding": Change(heavy_siding),
    "gypsum alone": Change(gypsum_alone),
    "finishes off": Change(without_finishes),
    **{f"finishes {ratio:g}": Change(finishes=ratio) for ratio in (1.0, 2.1, 2.8)},
    "damping 0": law(joint_damping=0.0),
    "damping 2 %": law(joint_damping=0.02),
    "damping 5 %": law(joint_damping=0.05),
    "initial stiffness": law(damping_stiffness="initial"),
    "law slip": Change(slip_walls),
    "symmetric walls": Change(plan=symmetric_walls),
    "column ends closed": Change(lambda data: data["joint_types"].update(corner_fitting=CLOSED)),
    "hold-downs": axis_fittings({}),
    "hold-downs closed": axis_fittings(CLOSED),
    "hold-downs none": axis_fittings(NONE),
    "no P-delta": Change(storey=no_p_delta),
    "sharp columns": Change(storey=sharp_columns),
}
"""{name: Change}: finishes, damping, its stiffness, cycles, torsion, uplift, P-delta, rounding of columns."""
MODEL_CHANGES = ("no P-delta", "sharp columns")
FINISHES = ("siding", "finishes off")
SHIPPED = tuple(f"{finishes} + damping {damping:g} %" for finishes in FINISHES for damping in (2, 5))
"""Rows of the report: finishes on and off, damping 2 and 5 %."""


@dataclass(frozen=True)
class Case:
    """A row of the table; names: keys of CHANGES."""

    names: tuple
    grade: float
    level: str

    @property
    def change(self):
        return " + ".join(self.names)

    @property
    def has_runs(self):
        """Whether house files have all its changes."""
        return not set(self.names) & set(MODEL_CHANGES)

    def changes(self):
        return [CHANGES[name] for name in self.names]

    def house_file(self, folder, rule):
        """Write a house file. Returns its path."""
        name = _name(f"{self.change} {self.grade:g} {self.level}")
        data = graded_house(self.grade, self.level, rule, self._plan(folder))
        data["name"] = name
        for change in self.changes():
            change.content(data)
        path = self._written(folder, data)
        for wanted in (change.finishes for change in self.changes() if change.finishes):
            scale_finishes(data, wanted / finish_ratio(path))
            self._written(folder, data)
        return path

    def _plan(self, folder):
        """House with the plan: HOUSE, or a file."""
        if all(change.plan is unchanged for change in self.changes()):
            return HOUSE
        data = changed_house(HOUSE)
        for change in self.changes():
            change.plan(data)
        data["name"] = _name(f"plan {self.change}")
        return self._written(folder, data)

    def _written(self, folder, data):
        path = folder / f"{data['name']}.yaml"
        write_text(path, f"# Graded house with changes: {self.change}\n{house_text(data)}")
        return path

    def storeys(self, path, direction):
        """Of the lumped-mass model."""
        description = load_house(path)
        storeys = shear_storeys(build_house(description), description.data, STRUCTURE, direction)
        for change in self.changes():
            for storey in storeys:
                change.storey(storey)
        return storeys


def _name(text):
    return "".join(c if c.isalnum() else "_" for c in text)


def finish_ratio(path):
    """Largest shears of the finishes of storey 1 over the code's wall quantity, the smaller of both directions. [-]"""
    description = load_house(path)
    model, types = build_house(description), description.data["wall_types"]
    required = UNIT * REQUIRED[0] * model.plans[STRUCTURE][1].area
    return min(sum(j.strength for j in wall_joints(model, 1, axis) if types[j.sheet.type]["finish"]) / SHARE / required
               for axis in AXES)


def tasks(path, shaking, number, folder):
    """Runs of a house. shaking: options of the motion"""
    return [Task(folder / path.stem / f"{k + 1:03d}",
                 RunOptions(house=str(path.resolve()), until_collapse=True, no_frames=True,
                            **shaking | {"scale": factor(k) * shaking["scale"]})) for k in range(number)]


def factor(k):
    """On the motion, of run k from 0 on: 1, 0.99, 1.01, 0.98, ... [-]"""
    return round(1 + (-1)**k * STEP * ((k + 1) // 2), 9)


def row(case, path, window, results):
    """Of the table; results: of runs that ended well."""
    data, summaries = load_house(path).data, [result.summary for result in results]
    return {"change": case.change, "grade": case.grade, "walls": case.level, "finishes": finish_ratio(path),
            "damping": data["law"]["joint_damping"], "start_s": window[0], "end_s": window[1], "test": TEST[case.grade],
            "runs": len(summaries), "collapsed": sum(s.collapsed for s in summaries),
            "tilted": sum(s.tilt_time_s is not None for s in summaries),
            **{f"{name}_{axis}": median_drift(summaries, name, axis) for axis in AXES for name in ("centre", "column")}}


def median_drift(summaries, name, axis):
    """Of storey 1; 1 for a run that collapses, empty without runs. name: centre or column"""
    values = []
    for summary in summaries:
        drifts = summary.peak_drift if name == "centre" else summary.column_drift.largest
        values.append(1.0 if summary.collapsed else drifts["storey1"][axis])
    return float(np.median(values)) if values else ""


def model_drift(case, path, axis, motion):
    """Of storey 1 in the lumped-mass model; 1 if a storey fails."""
    law_options = load_house(path).data["law"]
    damped = Storey.stiffness if law_options["damping_stiffness"] == "initial" else Storey.tangent
    storeys, ground = case.storeys(path, axis), getattr(motion, axis)
    peaks, failed = before_failure(response(storeys, ground, motion.dt, law_options["joint_damping"], damped)[1])
    return 1.0 if failed else float(peaks[0])


def rows_of(given, runs, files, motion):
    """Of the table. runs: {case: tasks}; files: {case: house file}"""
    rows = []
    for case, each in runs.items():
        results = [load_run(task.folder) for task in each if task.summary is not None]
        if each and not results and not given.only_done:
            print(f"{each[0].folder}: no run has ended well; its run.log says why")
        if results or not given.runs_alone:
            rows.append(row(case, files[case], (given.start, given.end), results))
            if not given.runs_alone:
                rows[-1] |= {f"model_{axis}": model_drift(case, files[case], axis, motion) for axis in AXES}
    return rows


def cases_of(given):
    """Cases of the options. Raises RunError for an unknown name."""
    changes = [tuple(text.strip().split(" + ")) for text in given.changes.split(",")]
    for names in changes:
        selected(",".join(names), CHANGES, "--changes")
    try:
        grades = [float(text) for text in given.grades.split(",")]
    except ValueError:
        grades = []
    if not grades or set(grades) - set(TEST):
        raise RunError(f"--grades: got {given.grades}; known: {', '.join(f'{grade:g}' for grade in TEST)}")
    return [Case(names, grade, level) for names in changes for grade in grades
            for level in selected(given.levels, LEVELS, "--levels")]


def parsed():
    options = Parser(__doc__)
    add_driver_options(options, Path("results/graded_changes"))
    add_motion_options(options)
    options.add_argument("--runs", type=count, default=1, metavar="N", help="of each row (default %(default)s)")
    options.add_argument("--rule", choices=("law", "label"), default="law", help="wall quantity (graded_houses.py)")
    options.add_argument("--changes", default=",".join(SHIPPED),
                         help=f"default: {', '.join(SHIPPED)}; known: {', '.join(CHANGES)}".replace("%", "%%"))
    options.add_argument("--grades", default="1,1.25,1.5", help="default %(default)s")
    options.add_argument("--levels", default="design,mean", help="of the walls (default %(default)s)")
    options.add_argument("--only-done", action="store_true", help="table of the runs that are done")
    options.add_argument("--runs-alone", action="store_true",
                         help="table without the lumped-mass model and without rows that have no run")
    options.add_argument("--to", type=results_folder, metavar="DIR", help="folder of the table")
    return options.parse_args()


def main():
    given = parsed()
    to = given.to or given.out
    for folder in (given.out, to):
        folder.mkdir(parents=True, exist_ok=True)
    motion, shaking = motion_of(given, given.out)
    files = {case: case.house_file(given.out, given.rule) for case in cases_of(given)}
    runs = {case: tasks(path, shaking, given.runs, given.out) if case.has_runs else [] for case, path in files.items()}
    if not given.only_done:
        run_missing([task for each in zip_longest(*runs.values()) for task in each if task], given.jobs)
    rows = rows_of(given, runs, files, motion)
    if not rows:
        raise RunError(f"{given.out}: no run of these rows is done")
    table = csv_text(list(rows[0]), [[f"{v:.4g}" if isinstance(v, float) else v for v in r.values()] for r in rows])
    write_text(to / f"{given.out.name}.csv", table)
    print(table, f"written: {to}/{given.out.name}.csv", sep="\n")


if __name__ == "__main__":
    run_script(main)
