#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What each reading of the paper's open choices does to its claims: the fourteen runs for every reading in READINGS.

    scripts/paper/sensitivity_study.py [--out results/sensitivity] [--jobs 2] [--only joint-whole,flush-off] [--runs modelA_snow,...] [--dt S]
        [--record PREFIX | --seed N] [--scale X] [--start S] [--end S] [--duration S]

Readings differ from the shipped houses in one thing each; runs of houses that a reading does not change are those of the
shipped case. What has been done is not done again. Writes sensitivity.md, and the tables of each reading in its folder.
Needs no YADE itself.
"""
import argparse
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs are made of

from yade_timber.study import campaign  # noqa: E402
from yade_timber.study import claims_table  # noqa: E402
from yade_timber.study.claims import RUNS, loads  # noqa: E402
from yade_timber.study.variants import READINGS, changes, house_options  # noqa: E402


def tasks_of(name, folder, runs, options):
    """Tasks of a reading, each with a house file of its own; houses that it does not change are those of the shipped case."""
    return [task_of(name if changes(READINGS[name], loads(run)[0]) else "shipped", run, folder, options) for run in runs]


def task_of(name, run, folder, options):
    words = (*house_options(READINGS[name], run, folder / name / "houses"), *campaign.handed_on(options, earthquake=loads(run)[1]))
    return campaign.Task("house", folder / name / run, words)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    campaign.add_arguments(parser, "results/sensitivity")
    parser.add_argument("--only", help=f"readings, comma-separated, of: {', '.join(READINGS)}")
    parser.add_argument("--runs", help="runs, comma-separated (default: all fourteen)")
    options = parser.parse_args()
    readings = campaign.chosen(options.only, READINGS, "--only")
    runs = campaign.chosen(options.runs, RUNS, "--runs")
    tasks = {name: tasks_of(name, options.out, runs, options) for name in readings}
    return claims_table.study({name: READINGS[name].words for name in readings}, tasks, SCRIPTS, options.jobs, options.out, "sensitivity.md")


if __name__ == "__main__":
    sys.exit(main())
