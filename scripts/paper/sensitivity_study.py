#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Sensitivity of the claims to the paper's open choices: the fourteen runs for each variant of the houses.

    scripts/paper/sensitivity_study.py [--out results/sensitivity] [--jobs 2] [--only joint-whole,flush-off] [--runs modelA_snow,...]
        [--record PREFIX | --seed N] [--scale X] [--start S] [--end S] [--dt S] [--duration S]

A variant differs from the shipped houses in one choice; houses that it does not change share the runs of the shipped case. Runs that
are done are kept. Writes sensitivity.md, and the tables of each variant to a folder of its own. Needs no YADE itself.
"""
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs use

from yade_timber.study.claims import RUNS, parse_run  # noqa: E402
from yade_timber.study.comparison import run_cases  # noqa: E402
from yade_timber.study.driver import Task  # noqa: E402
from yade_timber.study.options import Parser, add_driver_options, add_run_options, run_options, run_script, selected  # noqa: E402
from yade_timber.study.variants import VARIANTS, house_options  # noqa: E402


def task_of(name, run, options):
    """Task of a published run of a variant, with a house file of its own; of the shipped case if the variant does not change its house."""
    house, earthquake, _ = parse_run(run)
    name = name if VARIANTS[name].changes(house) else "shipped"
    folder = options.out.absolute() / name
    return Task("house", folder / run, (*house_options(VARIANTS[name], run, folder / "houses"), *run_options(options, earthquake)))


def main():
    parser = Parser(__doc__)
    add_driver_options(parser, "results/sensitivity")
    add_run_options(parser)
    parser.add_argument("--only", help=f"variants, comma-separated, of: {', '.join(VARIANTS)}")
    parser.add_argument("--runs", help="runs, comma-separated (default: all fourteen)")
    options = parser.parse_args()
    runs = selected(options.runs, RUNS, "--runs")
    cases = {name: (VARIANTS[name].description, [task_of(name, run, options) for run in runs]) for name in selected(options.only, VARIANTS, "--only")}
    return run_cases(cases, SCRIPTS, options, "sensitivity.md")


if __name__ == "__main__":
    run_script(main)
