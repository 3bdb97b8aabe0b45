#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Robustness of the claims: in how many of several ground motions each holds.

    research/robustness_study.py [--out results/robustness] [--jobs 2] [--seeds 0,1,2,4,5] [--record PREFIX]

Eleven runs for each motion: the shipped one (seed 3), other seeds of the synthetic generator, recorded ones. The
motions of all seeds have the same published strength. The three runs with snow alone are done once. Runs that are done
are kept. Writes robustness.md, and the tables of each motion to a folder of its own. Needs no YADE itself.
"""
from pathlib import Path

from timber_research import comparison
from timber_research.claims import RUNS, parse_run
from timber_houses.base.errors import RunError
from timber_houses.run.options import scripted
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import Parser, add_driver_options, list_of, record, run_script, seed

SHIPPED = "shipped"


def all_cases(seeds, records):
    """{motion: (description, options of a run)}."""
    cases = {SHIPPED: ("the shipped motion", {})}
    cases |= {f"seed-{number}": (f"synthetic motion of seed {number}", {"seed": number}) for number in seeds}
    return cases | {Path(name).name: ("recorded motion", {"record": name}) for name in records}


def tasks_of(case, options, folder):
    """{run: task} of a motion. Only the shipped case has the runs without an earthquake."""
    return {run: Task(folder / case / run, scripted(run, *parse_run(run), **options)) for run in RUNS
            if case == SHIPPED or parse_run(run)[1]}


def main():
    parser = Parser(__doc__)
    add_driver_options(parser, "results/robustness")
    parser.add_argument("--seeds", type=list_of(seed), default=[0, 1, 2, 4, 5], metavar="N,N",
                        help="other synthetic motions (default 0,1,2,4,5)")
    parser.add_argument("--record", type=record, action="append", default=[], metavar="FILE_OR_PREFIX",
                        help="a recorded motion besides; may be repeated")
    options = parser.parse_args()
    cases = all_cases(options.seeds, options.record)
    tasks = {case: tasks_of(case, given, options.out) for case, (_, given) in cases.items()}
    done = run_missing([task for some in tasks.values() for task in some.values()], options.jobs)
    summaries = {case: {run: done[task] for run, task in some.items() if done[task] is not None}
                 for case, some in tasks.items()}
    print(comparison.write({case: about for case, (about, _) in cases.items()}, summaries, options.out))
    if None in done.values():
        raise RunError("some runs failed; run.json in their folders contains the error")


if __name__ == "__main__":
    run_script(main)
