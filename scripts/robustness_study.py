#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Which claims keep holding: other seeds of the synthetic motion, its size, a recorded motion, half and double the time step.

    scripts/robustness_study.py [--out results/robustness] [--jobs 2] [--record PREFIX] [--only seed-1,scale-0.8]

Fourteen runs for each case (the six without an earthquake's three only where they would differ). What has been done is not done again.
Writes robustness.md; a folder of each case holds its own tables. Needs no YADE itself.
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "py"))

from yade_timber import campaign, claims_table  # noqa: E402
from yade_timber.claims import RUNS, judge  # noqa: E402
from yade_timber.files import write_text  # noqa: E402
from yade_timber.motion import synthetic_motion, write_csv  # noqa: E402

SEEDS = (0, 2, 3, 4, 5)
SCALES = (0.5, 0.75, 1.25, 1.5)
STEPS = (5e-5, 2e-4)  # [s]; the default lies between
QUIET = ("modelA_snow", "modelB_snow", "modelC_snow")


def cases(record, folder):
    """{name: (words, options of the run scripts)}."""
    found = {"shipped": ("the shipped motion and time step", ())}
    for seed in SEEDS:
        path = folder / "motions" / f"seed-{seed}.csv"
        found[f"seed-{seed}"] = (f"synthetic motion of seed {seed}", ("--record", path))
    for scale in SCALES:
        found[f"scale-{scale:g}"] = (f"the shipped motion times {scale:g}", ("--scale", scale))
    for dt in STEPS:
        found[f"dt-{dt:g}"] = (f"time step {dt:g} s", ("--dt", dt))
    if record:
        found["record"] = (f"recorded motion {Path(record).name}", ("--record", record))
    return found


def make_motions(names, folder):
    """Write the synthetic motions that the cases need and that are not there."""
    (folder / "motions").mkdir(parents=True, exist_ok=True)
    for seed in SEEDS:
        path = folder / "motions" / f"seed-{seed}.csv"
        if f"seed-{seed}" in names and not path.is_file():
            write_csv(synthetic_motion(seed), path, [f"Synthetic ground motion of yade-timber, seed {seed}"])


def tasks_of(name, options, folder):
    """Tasks of a case. Runs without an earthquake know nothing of motions: those of the shipped case serve all."""
    quiet_folder, quiet_options = (folder / name, options) if "--dt" in options else (folder / "shipped", ())
    return [campaign.Task(run, quiet_folder / run, quiet_options) if run in QUIET else campaign.Task(run, folder / name / run, options) for run in RUNS]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--out", type=Path, default=Path("results/robustness"), help="folder of the study (default results/robustness)")
    parser.add_argument("--jobs", type=int, help="runs at a time (default: all cores)")
    parser.add_argument("--record", metavar="FILE_OR_PREFIX", help="a recorded motion as one more case")
    parser.add_argument("--only", help="cases, comma-separated")
    options = parser.parse_args()
    known = cases(options.record, options.out)
    names = options.only.split(",") if options.only else list(known)
    unknown = [name for name in names if name not in known]
    if unknown:
        sys.exit(f"error: --only: unknown: {', '.join(unknown)}; known: {', '.join(known)}")
    make_motions(names, options.out)
    tasks = {name: tasks_of(name, known[name][1], options.out) for name in names}
    done = campaign.run_missing(list(dict.fromkeys(task for some in tasks.values() for task in some)), options.jobs)
    summaries = {name: {task.script: done[task] for task in some if done[task] is not None} for name, some in tasks.items()}
    text = claims_table.compare({name: known[name][0] for name in names}, {name: judge(found) for name, found in summaries.items()})
    print(text)
    write_text(options.out / "robustness.md", text)
    for name, found in summaries.items():
        claims_table.write(options.out / name, judge(found), found)


if __name__ == "__main__":
    main()
