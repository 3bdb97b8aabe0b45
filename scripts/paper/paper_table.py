#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's fourteen runs and its claims: does what is missing, then prints and writes the table of claims with their numbers.

    scripts/paper/paper_table.py [--out results] [--jobs 2] [--record PREFIX | --seed N] [--scale X] [--dt S] [--duration S]

A run is there when its folder holds a summary.json made from the same options, files and state of this package; otherwise it is done, or done again. Writes claims.md, claims.csv and claims.json.
Needs no YADE itself.
"""
import argparse
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs are made of

from yade_timber.study import campaign  # noqa: E402
from yade_timber.study import claims_table  # noqa: E402
from yade_timber.study.claims import RUNS, judge, loads  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    campaign.add_arguments(parser, "results")
    options = parser.parse_args()
    tasks = [campaign.Task(run, options.out / run, campaign.handed_on(options, earthquake=loads(run)[1])) for run in RUNS]
    done = campaign.run_missing(tasks, SCRIPTS, options.jobs)
    summaries = {task.script: summary for task, summary in done.items() if summary is not None}
    results = judge(summaries)
    print(claims_table.markdown(results, summaries))
    for path in claims_table.write(options.out, results, summaries):
        print(f"written: {path}")
    sys.exit(0 if len(summaries) == len(RUNS) else "error: some runs failed; their last words are in failed.txt in their folders")


if __name__ == "__main__":
    main()
