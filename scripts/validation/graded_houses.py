#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Houses of 1.0, 1.25 and 1.5 times the required wall quantity under a strong motion, beside the lumped-mass model.

    scripts/validation/graded_houses.py --record PREFIX_OF_JMA_KOBE --start 6 --end 20 [--seeds N] [--to DIR]
    scripts/validation/graded_houses.py             # under the synthetic motion of kobe_like.py, which may be passed on

The tests to compare with: three houses on the shaking table of Tsukuba under JMA Kobe, 2004 to 2006. Wall quantity 1.0:
storey 1 collapses; 1.25: stands with loosened joints; 1.5: stands, 1/26 on the open south face. Their plans are not
public; the plan here is that of tiled_house (wall_grades.py).

Levels: those of walls of a rated multiplier (docs/house_files.md).
The runs take half a minute of computing each and can be stopped; the same command continues. Table and figure have the
name of the folder of the runs. Peaks compare best where no storey fails, at half of the motion:

    scripts/validation/graded_changes.py --record PREFIX --start 6 --end 18 --scale 0.5 --levels mean
        --changes 'finishes off + law slip' --out results/half_kobe
"""
import sys
from functools import partial
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot
from house_storeys import AXES, shear_storeys
from kobe_like import kobe_like
from shear_model import LIMIT, first_period, response
from wall_grades import RULES, STRUCTURE, house_file

from timber_houses.api.result import load_run
from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.errors import RunError
from timber_houses.base.table import csv_text
from timber_houses.house import LEVELS, build_house, load_house
from timber_houses.motion import processing, read_motion, write_csv
from timber_houses.run.options import RunOptions
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import (Parser, add_driver_options, count, non_negative, positive, record,
                                       results_folder, run_script, seed, selected)

DAMPED = 0.10
"""Damping ratio of a second response of the lumped-mass model: the influence of damping. [-]"""
TEST = {1.0: "storey 1 collapses", 1.25: "stands, joints loosened", 1.5: "stands, 1/26"}


def tasks(path, shaking, seeds, folder):
    """Runs of a house; seed 1 is undisturbed."""
    return [Task(folder / path.stem / f"{number:03d}",
                 RunOptions(house=str(path.resolve()), **shaking, until_collapse=True,
                            disturb=number if number > 1 else None, no_frames=True))
            for number in range(1, seeds + 1)]


def motion_of(given, folder):
    """(GroundMotion, options of a run for it)."""
    path = given.record
    if path is None:
        path = (folder / "kobe_like.csv").resolve()
        write_csv(kobe_like(given.seed), path)
    stated = {"record": str(path), "start": given.start, "end": given.end, "scale": given.scale}
    motion = processing.trim(read_motion(path), given.start or 0.0, given.end)
    return processing.scaled(motion, given.scale), stated


def add_motion_options(options):
    """Those of motion_of()."""
    options.add_argument("--record", type=record, metavar="PREFIX",
                         help="recorded motion (default: a motion of kobe_like.py)")
    options.add_argument("--seed", type=seed, default=0, metavar="N",
                         help="of the synthetic motion (default %(default)s)")
    options.add_argument("--start", type=non_negative, metavar="S",
                         help="start of the part of the motion that is run [s]")
    options.add_argument("--end", type=positive, metavar="S", help="end of that part [s]")
    options.add_argument("--scale", type=positive, default=1.0, metavar="X",
                         help="factor on the motion (default %(default)g)")


def before_failure(drifts):
    """Peak of each column (n, storeys) before the first column passes LIMIT, and whether one does."""
    beyond = (np.abs(drifts) > LIMIT).any(1)
    end = int(np.argmax(beyond)) if beyond.any() else len(beyond)
    return np.abs(drifts[:end]).max(0), bool(beyond.any())


def compare(grade, level, results, path, motion):
    """Rows of the table for a grade and level, one a direction: medians of the package's runs beside the model."""
    description = load_house(path)
    model = build_house(description)
    return [
        {"grade": grade, "level": level, "direction": direction, "test": TEST[grade], "runs": len(results),
         "collapsed": sum(result.collapsed for result in results),
         "broken_joints": float(np.median([result.broken for result in results])),
         **drifts_of_runs(results, direction),
         **drifts_of_model(partial(shear_storeys, model, description.data, STRUCTURE, direction),
                           getattr(motion, direction), motion.dt, description.data["law"]["joint_damping"])}
        for direction in AXES
    ]


def drifts_of_runs(results, direction):
    """Peaks before a storey fails in either direction, medians over the runs; failed runs; largest drift."""
    places = [(storey, d) for d in sorted(AXES, key=direction.__ne__) for storey in (1, 2)]
    histories = [np.column_stack([run.history.drift(*place) for place in places]) for run in results]
    peaks, failed = zip(*map(before_failure, histories))
    first, second = np.median(peaks, axis=0)[:2]
    largest = max(float(np.abs(drifts[:, :2]).max()) for drifts in histories)
    return {"storey1": float(first), "storey2": float(second), "failed": sum(failed), "largest": largest}


def drifts_of_model(storeys, acceleration, dt, damping):
    """The same of the lumped-mass model, its first period, and the peak of storey 1 with DAMPED. storeys(): anew"""
    (first, second), failed = before_failure(response(storeys(), acceleration, dt, damping)[1])
    damped = before_failure(response(storeys(), acceleration, dt, DAMPED)[1])[0]
    return {"storey1_model": float(first), "storey2_model": float(second), "failed_model": int(failed),
            "period_model_s": first_period(storeys()), "storey1_model_damped": float(damped[0])}


def draw(rows, path):
    """Peaks of storey 1 of the package over those of the lumped-mass model."""
    figure, axes = pyplot.subplots(figsize=(5.2, 4.6), layout="constrained")
    ends = np.array([0, 1.1 * max(max(row["storey1"], row["storey1_model"]) for row in rows)])
    axes.plot(ends, ends, color="0.5", lw=1)
    axes.fill_between(ends, 0.8 * ends, 1.2 * ends, color="0.9", label="20 %")
    for row in rows:
        color = "C0" if row["direction"] == "ew" else "C1"
        marker = "s" if row["level"] == "design" else "o"
        filling = "none" if row["failed"] or row["failed_model"] else color
        axes.plot(row["storey1_model"], row["storey1"], marker, ms=6 + 8 * (row["grade"] - 1), mec=color, mfc=filling)
    axes.set(xlabel="lumped-mass model", ylabel="package", xlim=ends, ylim=ends)
    axes.set_title("peak drift of storey 1 before a storey fails\n"
                   "square: design walls, circle: mean; blue: E-W, orange: N-S;\n"
                   "size: wall quantity; hollow: a storey fails, by definition at 1/10", fontsize=8)
    axes.legend(loc="upper left")
    with written_whole(path) as part:
        figure.savefig(part, dpi=130)


def parsed():
    options = Parser(__doc__)
    add_driver_options(options, Path("results/graded_houses"))
    add_motion_options(options)
    options.add_argument("--seeds", type=count, default=4, metavar="N",
                         help="runs of each house, 2 to N disturbed by 1e-9 m (default %(default)s)")
    options.add_argument("--rule", choices=RULES, default="law",
                         help="wall quantity: grade times the code's, or of the grades 2 and 3 of the performance"
                              " labelling (default %(default)s)")
    options.add_argument("--levels", default="design,mean", help="levels of the walls (default %(default)s)")
    options.add_argument("--to", type=results_folder, metavar="DIR",
                         help="folder of table and figure (default: the folder of the runs)")
    return options.parse_args()


def main():
    given = parsed()
    to = given.to or given.out
    for folder in (given.out, to):
        folder.mkdir(parents=True, exist_ok=True)
    motion, shaking = motion_of(given, given.out)
    levels = selected(given.levels, LEVELS, "--levels")
    files = {(grade, level): house_file(given.out, grade, level, given.rule) for level in levels
             for grade in RULES[given.rule]}
    runs = {key: tasks(path, shaking, given.seeds, given.out) for key, path in files.items()}
    run_missing([task for each in runs.values() for task in each], given.jobs)
    rows = []
    for key, each in runs.items():
        results = [load_run(task.folder) for task in each if task.summary is not None]
        if not results:
            raise RunError(f"{each[0].folder}: no run has ended well; its run.log says why")
        rows += compare(*key, results, files[key], motion)
    table = csv_text(list(rows[0]), [[f"{v:.4g}" if isinstance(v, float) else v for v in row.values()] for row in rows])
    name = given.out.name
    write_text(to / f"{name}.csv", table)
    draw(rows, to / f"{name}.png")
    print(table, f"written: {to}/{name}.csv, {name}.png", sep="\n")


if __name__ == "__main__":
    run_script(main)
