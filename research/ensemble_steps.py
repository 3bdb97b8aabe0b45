#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ensembles at two time steps: do medians, ranges and shares of outcomes agree within their sampling error?

    research/ensemble_steps.py [-j 2] [--runs 16] [--dt 1e-4] [--cases modelC2_snow,modelA_quake] [--collect]

Runs each case 16 times at a small time step and 16 times at the default one, under the strong part of the shipped
motion, to its end or to a collapse. Writes ensemble_steps.md and ensemble_steps.csv. It can be stopped; the same
command continues.
"""
from itertools import chain

from timber_research import SCRIPTS, two_ensembles
from timber_research.claims import parse_run
from timber_research.report import markdown_table
from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.house.disturbance import LARGEST
from timber_houses.run.options import scripted
from timber_houses.study.driver import run_missing
from timber_houses.study.ensemble import tasks
from timber_houses.study.options import (Parser, add_driver_options, count, non_negative, positive, results_folder,
                                       run_script, selected)

CASES = ("modelC2_snow", "modelA_quake", "modelB1_quake")
SMALL_STEP = 1e-4
"""[s]"""
NAMES = ("small", "default")
"""Of the two time steps, and of their folders."""


def arguments():
    parser = Parser(__doc__)
    add_driver_options(parser, "results/ensemble_steps")
    parser.add_argument("--runs", type=count, default=16, metavar="N",
                        help="runs of each case at each time step (default %(default)s)")
    parser.add_argument("--dt", type=positive, default=SMALL_STEP, metavar="S",
                        help="the small time step [s] (default %(default)g)")
    parser.add_argument("--cases", metavar="RUN,RUN", help=f"run scripts (default {','.join(CASES)})")
    parser.add_argument("--start", type=non_negative, default=15.0, metavar="S",
                        help="start of the part of the motion that is run [s] (default %(default)g)")
    parser.add_argument("--end", type=positive, default=29.0, metavar="S",
                        help="end of that part [s] (default %(default)g)")
    parser.add_argument("--to", type=results_folder, metavar="DIR",
                        help="folder of the tables (default: the folder of the runs)")
    parser.add_argument("--collect", action="store_true", help="run nothing; compare the runs there are")
    return parser.parse_args()


def plan(options):
    """{(case, name of the time step): tasks}"""
    same = {"ensemble": options.runs, "start": options.start, "end": options.end, "until_collapse": True,
            "no_frames": True}
    steps = dict(zip(NAMES, ({"dt": options.dt}, {})))
    cases = (selected(options.cases, sorted(path.stem for path in SCRIPTS.glob("model*.py")), "--cases")
             if options.cases else CASES)
    return {(case, name): tasks(scripted(case, *parse_run(case), out=options.out / case / name, **step, **same))
            for case in cases for name, step in steps.items()}


def collect(planned):
    """(comparisons, {name: time steps [s]}, number of finished runs)."""
    done = {key: [found for task in group if (found := task.summary)] for key, group in planned.items()}
    cases = dict.fromkeys(case for case, _ in done)
    found = [entry for case in cases for entry in two_ensembles.compare(case, *(done[case, name] for name in NAMES))]
    steps = {name: sorted({run.dt for (_, other), runs in done.items() for run in runs if other == name})
             for name in NAMES}
    return found, steps, sum(map(len, done.values()))


def page(found, steps, done, options):
    """Text of ensemble_steps.md."""
    first, second = ("/".join(f"{dt:g} s" for dt in steps[name]) or f"{name} step" for name in NAMES)
    table = [[text.replace("first", first).replace("second", second) if row == 0 else text for text in line]
             for row, line in enumerate([two_ensembles.HEADER, *two_ensembles.rows(found)])]
    tested = [p for p in two_ensembles.corrected(found) if p is not None]
    differ = sum(p < two_ensembles.SIGNIFICANCE for p in tested)
    return "\n".join([
        "# Ensembles at two time steps",
        "",
        f"{done} runs, up to {options.runs} of each house at each time step, whose vertices differ by at most "
        f"{LARGEST:g} m. "
        f"Motion: the shipped one from {options.start:g} to {options.end:g} s; a collapse ends a run.",
        f"{differ} of {len(tested)} tests show a difference (p < {two_ensembles.SIGNIFICANCE:g} after Holm's "
        f"correction).",
        "",
        "Medians, with the range and the number of runs, are compared by the Mann-Whitney U test, ranges by the "
        "Brown-Forsythe test on logarithms, "
        "shares of verdicts by Fisher's exact test. All are two-sided. The interval of a ratio of medians is a "
        "bootstrap (percentiles). "
        "Drifts are those of runs that stand. Equal values in all runs, and fewer than "
        f"{two_ensembles.FEWEST} values, have no test. Ratios within the interval cannot be excluded. "
        "Where chance decides little, a test shows even a small error of the time step; the ratio of medians is its "
        "size.",
        "",
        *markdown_table(table[0], table[1:]),
    ]) + "\n"


def main():
    options = arguments()
    planned = plan(options)
    try:
        if not options.collect:
            run_missing(chain(*zip(*planned.values())), options.jobs)
    finally:
        found, steps, done = collect(planned)
        text, folder = page(found, steps, done, options), options.to or options.out
        write_text(folder / "ensemble_steps.md", text)
        write_text(folder / "ensemble_steps.csv", csv_text(two_ensembles.HEADER, two_ensembles.rows(found)))
        print(f"{text}\nwritten: {folder / 'ensemble_steps.md'}, {folder / 'ensemble_steps.csv'}")
    return int(done < options.runs * len(planned))


if __name__ == "__main__":
    run_script(main)
