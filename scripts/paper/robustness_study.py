#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Robustness of the claims: other seeds and amplitudes of the synthetic motion, a recorded motion, other time steps.

    scripts/paper/robustness_study.py [--out results/robustness] [--jobs 2] [--record PREFIX] [--only seed-1,scale-0.75]

Fourteen runs per case; the three without an earthquake only with other time steps. The motions of all seeds have the same published
strength: their medians are judged as one more case. Runs that are done are kept.
Writes robustness.md, and the tables of each case to a folder of its own. Needs no YADE itself.
"""
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs use

from yade_timber.study.claims import RUNS, parse_run  # noqa: E402
from yade_timber.study.comparison import run_cases  # noqa: E402
from yade_timber.study.driver import Task  # noqa: E402
from yade_timber.study.options import Parser, add_driver_options, record, run_script, selected  # noqa: E402

SEEDS = (0, 1, 2, 4, 5)
SCALES = (0.5, 0.75, 1.25, 1.5)
STEPS = (1e-4, 4e-4)
"""Below and above the default time step. [s]"""


def all_cases(record):
    """{name: (description, options of the run scripts)}."""
    cases = {"shipped": ("the shipped motion and time step", ())}
    cases |= {f"seed-{seed}": (f"synthetic motion of seed {seed}", ("--seed", seed)) for seed in SEEDS}
    cases |= {f"scale-{scale:g}": (f"the shipped motion times {scale:g}", ("--scale", scale)) for scale in SCALES}
    cases |= {f"dt-{dt:g}": (f"time step {dt:g} s", ("--dt", dt)) for dt in STEPS}
    return cases | ({"record": (f"recorded motion {Path(record).name}", ("--record", record))} if record else {})


def tasks_of(case, options, folder):
    """Tasks of a case. Runs without an earthquake are those of the shipped case, except with other time steps."""
    own = [parse_run(run)[1] or "--dt" in options for run in RUNS]
    return [Task(run, folder / (case if differs else "shipped") / run, options if differs else ()) for run, differs in zip(RUNS, own)]


def main():
    parser = Parser(__doc__)
    add_driver_options(parser, "results/robustness")
    parser.add_argument("--record", type=record, metavar="FILE_OR_PREFIX", help="a recorded motion as one more case")
    parser.add_argument("--only", help="cases, comma-separated (default: all)")
    options = parser.parse_args()
    known = all_cases(options.record)
    cases = {case: (known[case][0], tasks_of(case, known[case][1], options.out)) for case in selected(options.only, known, "--only")}
    same_strength = [case for case in cases if case == "shipped" or case.startswith("seed-")]
    return run_cases(cases, SCRIPTS, options, "robustness.md", same_strength if len(same_strength) > 2 else ())


if __name__ == "__main__":
    run_script(main)
