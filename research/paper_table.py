#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Do the paper's fourteen runs, then print and write the table of its claims with their numbers.

    research/paper_table.py [--out results] [--jobs 2] [--record PREFIX | --seed N] [--scale X] [--dt S] [--duration S]

A run is kept if its folder holds a summary.json made from the same options, files and package; otherwise it is done.
Writes claims.md, claims.csv, claims.json and runs.csv. Needs no YADE itself.
"""
from timber_research import SCRIPTS, report
from timber_research.claims import RUNS, judge, parse_run
from yade_timber.base.errors import RunError
from yade_timber.study.driver import Task, run_missing
from yade_timber.study.options import Parser, add_driver_options, add_run_options, run_of, run_options, run_script


def main():
    parser = Parser(__doc__)
    add_driver_options(parser, "results")
    add_run_options(parser)
    options = parser.parse_args()
    given = run_options(options)
    tasks = [Task(run, options.out / run, run_of(run, *parse_run(run), given)) for run in RUNS]
    summaries = {task.script: summary for task, summary in run_missing(tasks, SCRIPTS, options.jobs).items()
                 if summary is not None}
    results = judge(summaries)
    print(report.markdown(results, summaries))
    for path in report.write(options.out, results, summaries):
        print(f"written: {path}")
    if len(summaries) < len(RUNS):
        raise RunError("some runs failed; run.json in their folders contains the error")


if __name__ == "__main__":
    run_script(main)
