#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Do the paper's fourteen runs, then print and write the table of its claims with their numbers.

    research/paper_table.py [--out results] [--jobs 2] [--record PREFIX | --seed N] [--scale X] [--dt S] [--duration S]

A run is kept if its folder holds a summary.json made from the same options, files and package; otherwise it is done.
Writes claims.md, claims.csv, claims.json and runs.csv. Needs no YADE itself.
"""
import argparse

from timber_research import report
from timber_research.claims import RUNS, judge, parse_run
from timber_houses.base.errors import RunError
from timber_houses.base.options import add_options, options, read_arguments
from timber_houses.motion import MotionRequest
from timber_houses.run.options import RunOptions, scripted
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import Parser, add_driver_options, record, run_script

SHARED = ("record", "seed", "scale", "start", "end", "dt", "duration")
"""Options that are passed to the fourteen runs."""


def main():
    parser = Parser(__doc__)
    add_driver_options(parser, "results")
    add_options(parser, [options(RunOptions)[name] for name in SHARED])
    arguments = parser.parse_args()
    shared = run_options(arguments)
    tasks = [Task(arguments.out / run, run_of(run, *parse_run(run), shared)) for run in RUNS]
    summaries = {task.options.name: summary for task, summary in run_missing(tasks, arguments.jobs).items()
                 if summary is not None}
    results = judge(summaries)
    print(report.markdown(results, summaries))
    for path in report.write(arguments.out, results, summaries):
        print(f"written: {path}")
    if len(summaries) < len(RUNS):
        raise RunError("some runs failed; run.json in their folders contains the error")


def run_options(arguments):
    """{option: value}, checked, of parsed arguments. Raises RunError, RecordError."""
    values = read_arguments(RunOptions, argparse.Namespace(**{name: getattr(arguments, name) for name in SHARED}))
    RunOptions(**values, quake=True).check()
    if "record" in values:
        record(values["record"])
    return values


def run_of(script, house, earthquake, snow, values):
    """RunOptions of a run script with values of `run_options`; those of the motion only with an earthquake."""
    motion = () if earthquake else options(MotionRequest)
    return scripted(script, house, earthquake, snow,
                    **{name: value for name, value in values.items() if name not in motion})


if __name__ == "__main__":
    run_script(main)
