# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against run time for several time steps and solver options; predicted and measured stable time step.

    yade -j1 -n -x scripts/bench/benchmark_precision.py [--cases CASE ...] [--steps 1e-5 1e-4 ...] [--out FOLDER]

A case gives curves sampled each millisecond and peak values. The error is the largest difference from the reference
divided by the largest reference value. The reference is the default contact law, solved to a tolerance of 1e-6 with the
smallest time step of STEPS; that of ELASTIC variants has no bearing strength.
"""
import math
import sys
import time
from pathlib import Path

import numpy as np
import yade.wrapper as yw

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path[:0] = [str(ROOT / folder) for folder in ("scripts/bench", "tests", "tests/stress")]

import extreme_runs
import stable_steps
from bench_tools import write_table
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import MAX_DT
from timber_houses.house.errors import StepError
from timber_houses.motion import GroundMotion, default_motion
from timber_houses.scene import scenario
from timber_houses.study.options import Parser, positive, results_folder, run_script
from yade_timber.scene import engines

O = yw.Omega()

SAMPLE = 1e-3
"""Simulated time between samples [s]; a multiple of every time step."""
REFERENCE = {"sweeps": 500, "tolerance": 1e-6}
"""Solver options of the reference runs."""
UNBREAKABLE = 1e12
"""Strength of joints in cases without breaks [N]."""
STRONG = 17.6
"""Start of the strong part of the synthetic motion [s]."""
STOREYS = 2
"""Of the houses."""
STEPS = (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 2.5e-4, MAX_DT)
"""[s]"""
VARIANTS = {"default": {}, "tolerance 1e-2": {"tolerance": 1e-2}, "tolerance 1e-4": {"tolerance": 1e-4},
            "explicit dashpots": {"sweeps": 0}, "increment form": {"increment": True}}
ELASTIC = ("increment form",)
"""Variants without bearing strength."""
SHAKEN = 6.0
"""Duration of shaking for the energy balance [s]."""
HEADS = ("case", "variant", "dt [s]", "run time [s]", "quantity", "error [-]")


# --- cases ------------------------------------------------------------------------------------------------------------
def build_house(house, strength=None):
    """A house in the strong part of the synthetic motion."""

    def build(dt, options):
        motion = default_motion()
        cut = GroundMotion(motion.dt, motion.acceleration[round(STRONG / motion.dt) :], "strong part")
        scenario.build(scenario.Scenario("precision", house, cut, dt=dt, options={"skip_rest": 0, **options}))
        for joint in engines.find_engine(yw.JointEngine).joints if strength else []:
            joint.strength = strength

    return build


def drifts():
    """Storey drifts, as one row."""
    sampler = engines.find_engine(yw.Sampler)
    levels = [[O.bodies[b].state.displ() for b, group in zip(sampler.bodies, sampler.groups) if group == level]
              for level in range(STOREYS)]  # the first groups
    means = np.array([np.mean([[*d][:2] for d in level], axis=0) for level in levels])
    return np.diff(means, axis=0, prepend=0.0).ravel()


def joint_forces():
    """Force of each joint [N]."""
    return [sum(f.norm() for f in joint.forces) for joint in engines.find_engine(yw.JointEngine).joints]


CASES = {  # build, duration [s], whether joint forces are compared
    "standing house C": (build_house("C", UNBREAKABLE), 0.5, True),
    "collapsing house A": (build_house("A"), 2.0, False),
}


def error(found, reference):
    """Largest difference over the largest reference value (of a curve: largest displacement from its start); infinite
    if the run failed.
    """
    if found is None or not np.isfinite(found).all():
        return math.inf
    scale = abs(reference - reference[0]).max() if reference.ndim > 1 else abs(reference).max()
    return abs(found - reference).max() / scale


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--cases", nargs="+", choices=list(CASES), default=list(CASES), help="default: all")
    parser.add_argument("--steps", nargs="+", type=positive, default=STEPS, metavar="S",
                        help="time steps [s] (default 1e-5 ... 5e-4)")
    parser.add_argument("--no-limits", action="store_true", help="do not measure stable time steps and energy balance")
    parser.add_argument("--out", type=results_folder, default="results/performance",
                        help="folder of precision.csv, stable_dt.csv, balance.csv")
    return parser.parse_args()


# --- runs -------------------------------------------------------------------------------------------------------------
def run(case, dt, options, elastic=False):
    """({quantity: values}, CPU time of the steps [s]); None for values if the run failed or the time step is refused.
    elastic: without bearing strength.
    """
    build, duration, with_joints = CASES[case]
    try:
        build(dt, options)
    except StepError:  # too large a time step for the joints of the house
        return None, 0.0
    for body in O.bodies if elastic else []:
        if isinstance(body.material, yw.TimberMat):
            body.material.bearing = math.inf

    def sample():
        return {"drift": drifts(), **({"joint forces": joint_forces()} if with_joints else {})}

    rows, spent = [sample()], 0.0
    try:
        for _ in range(round(duration / SAMPLE)):
            since = time.process_time()
            for _ in range(round(SAMPLE / dt)):
                O.step()
            spent += time.process_time() - since
            rows.append(sample())
    except RuntimeError:  # the health check
        return None, spent
    found = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    if with_joints:
        found["joint forces"] = found["joint forces"].max(axis=0)  # the peak of each joint
    return found, spent


def study(case, options):
    """Rows of one case."""
    references = {elastic: run(case, STEPS[0], REFERENCE, elastic)[0] for elastic in (False, True)}
    rows = []
    for variant, changes in VARIANTS.items():
        reference = references[variant in ELASTIC]
        for dt in sorted(options.steps):
            found, spent = run(case, dt, changes, variant in ELASTIC)
            rows += [(case, variant, dt, spent, name, error(found and found[name], reference[name]))
                     for name in reference]
            print(
                f"{case}, {variant}, dt = {dt:g} s: {spent:.2f} s, "
                + ", ".join(f"{r[4]} {r[5]:.2g}" for r in rows[-len(reference) :]),
                flush=True,
            )
    return rows


def limit_rows():
    """Predicted and measured stable time steps, by bisection."""
    rows = []
    for build in (stable_steps.suspended_block, stable_steps.stack, stable_steps.house, stable_steps.stiff_house):
        predicted = stable_steps.settled(build)
        for contacts, damped in (("explicit springs, no dashpots", False), ("default", True)):
            rows.append(
                (build.__name__.replace("_", " "), contacts, predicted,
                 stable_steps.measured_limit(build, 0.3 * predicted, 16 * predicted, damped=damped))
            )
    return rows


def energy_rows():
    """(house, time step [s], energy gained in strong shaking under snow over the input [-]); NaN if the health check
    stops the run.
    """
    rows = []
    for house in ("B2", "C1", "C2"):
        for dt in (1e-4, 2.5e-4, 4e-4, MAX_DT):
            try:
                share = extreme_runs.shaken(house, extreme_runs.strong_part(SHAKEN), SHAKEN, snow_depth=1.0, dt=dt)[1]
            except RuntimeError:
                share = math.nan
            rows.append((house, dt, share))
            print(f"{house} under snow, dt = {dt:.3g} s: energy {share:.2g}", flush=True)
    return rows


def main():
    options = arguments()
    for dt in options.steps:
        if abs(SAMPLE / dt - round(SAMPLE / dt)) > 1e-6:
            raise RunError(f"--steps {dt:g}: must divide {SAMPLE:g} s, the time between samples")
    rows = [row for case in options.cases for row in study(case, options)]
    stable, balance = ([], []) if options.no_limits else (limit_rows(), energy_rows())
    write_table(options.out, "precision", HEADS, rows)
    write_table(options.out, "stable_dt", ("scene", "contacts", "predicted [s]", "measured [s]"), stable)
    write_table(options.out, "balance", ("house", "dt [s]", "energy gained [-]"), balance)
    print(f"written to {options.out}")


run_script(main)
