#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Which claims keep holding: other seeds of the synthetic motion, its size, a recorded motion, half and double the time step.

    scripts/paper/robustness_study.py [--out results/robustness] [--jobs 2] [--record PREFIX] [--only seed-1,scale-0.75]

Fourteen runs for each case; the three without an earthquake only where they differ. Seeds, all of one published strength, are also
judged together, by the medians of their numbers. What has been done is not done again.
Writes robustness.md; a folder of each case holds its own tables. Needs no YADE itself.
"""
import argparse
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.append(str(SCRIPTS.parent / "py"))  # after the installed package, which the runs are made of

from yade_timber.study import campaign  # noqa: E402
from yade_timber.study import claims_table  # noqa: E402
from yade_timber.study.claims import RUNS, loads  # noqa: E402

SEEDS = (0, 1, 2, 4, 5)
SCALES = (0.5, 0.75, 1.25, 1.5)
STEPS = (1e-4, 4e-4)  # [s]; the default lies between


def cases(record):
    """{name: (words, options of the run scripts)}."""
    found = {"shipped": ("the shipped motion and time step", ())}
    found |= {f"seed-{seed}": (f"synthetic motion of seed {seed}", ("--seed", seed)) for seed in SEEDS}
    found |= {f"scale-{scale:g}": (f"the shipped motion times {scale:g}", ("--scale", scale)) for scale in SCALES}
    found |= {f"dt-{dt:g}": (f"time step {dt:g} s", ("--dt", dt)) for dt in STEPS}
    return found | ({"record": (f"recorded motion {Path(record).name}", ("--record", record))} if record else {})


def tasks_of(name, options, folder):
    """Tasks of a case. Runs without an earthquake know nothing of motions: those of the shipped case serve all but other time steps."""
    return [_task(run, options, folder / name) if loads(run)[1] or "--dt" in options else _task(run, (), folder / "shipped") for run in RUNS]


def _task(run, options, folder):
    return campaign.Task(run, folder / run, options)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--out", type=Path, default=Path("results/robustness"), help="folder of the study (default results/robustness)")
    parser.add_argument("--jobs", type=int, help="runs at a time (default: all cores)")
    parser.add_argument("--record", metavar="FILE_OR_PREFIX", help="a recorded motion as one more case")
    parser.add_argument("--only", help="cases, comma-separated")
    options = parser.parse_args()
    known = cases(options.record)
    names = campaign.chosen(options.only, known, "--only")
    tasks = {name: tasks_of(name, known[name][1], options.out) for name in names}
    same_strength = [name for name in names if name == "shipped" or name.startswith("seed-")]
    return claims_table.study({name: known[name][0] for name in names}, tasks, SCRIPTS, options.jobs, options.out, "robustness.md", same_strength if len(same_strength) > 2 else ())


if __name__ == "__main__":
    sys.exit(main())
