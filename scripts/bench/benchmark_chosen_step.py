# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against run time: fixed time steps, steps chosen by an estimate of the error, explicit springs as in the paper.

    yade -j1 -n -x scripts/bench/benchmark_chosen_step.py [--cases impact rocking ...] [--repeats 2] [--out FOLDER]

A chosen step is constant for a millisecond: the next one gets h = sqrt(target / j), rounded down to 1 ms / 2^k. j
[m/s3] is the largest change, from one millisecond to the next, of a body's mean acceleration; rotation counts at the
radius of gyration. h^2 j is the change of velocity that leapfrog's local error is proportional to. "Foreseen" steps
take j from a run with steps of 1e-4 s, of this and the next two milliseconds: the same estimate without delay. The run
time counts the steps only, not the choice.
"""
import math
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import yade.wrapper as yw

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path[:0] = [str(ROOT / "scripts/bench")]

import yade_timber as yt
from bench_tools import write_table
from precision_cases import REFERENCE, SAMPLE, STEP_CASES, build_house, error, joint_forces
from timber_houses.base.time_step import DEFAULT_DT
from yade_timber.scene import engines
from timber_houses.study.options import Parser, count, results_folder, run_script

O = yw.Omega()

FIXED = (1e-4, 2.5e-4, 5e-4, 1e-3)
"""[s]"""
TARGETS = (0.0003, 0.003, 0.03)
"""h^2 j of the chosen steps [m/s]."""
HOUSES = ("standing house C", "collapsing house A", "falling house C")
CHANGES = ((5e-4,), (1e-3,), (2.5e-4, 5e-4), (1.25e-4, 2.5e-4, 5e-4, 1e-3))
"""Steps of which each millisecond takes one by chance [s]."""
SHAKEN = 1.5
"""Duration of strong shaking for the energy balance [s]."""
HEADS = ("case", "steps", "dt [s] or target [m/s]", "CPU [s]", "steps computed", "sweeps", "error [-]")


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--cases", nargs="+", choices=list(STEP_CASES), default=list(STEP_CASES), help="default: all")
    parser.add_argument("--repeats", type=count, default=2,
                        help="runs of which the median CPU time counts (default %(default)s)")
    parser.add_argument("--out", type=results_folder, default="results/performance",
                        help="folder of chosen_step.csv, chosen_gain.csv, changed_step.csv")
    return parser.parse_args()


# --- choice of the step -----------------------------------------------------------------------------------------------
class Motion:
    """Velocities of the free bodies, the rotation as speed at the radius of gyration: (bodies, 6) [m/s]."""

    def __init__(self):
        self.bodies = [b for b in O.bodies if b.state.blockedDOFs != "xyzXYZ"]
        self.radii = np.array([math.sqrt(max(b.state.inertia) / b.state.mass) for b in self.bodies])[:, None]
        self.velocities, self.change = self.read(), None

    def read(self):
        return np.hstack([[[*b.state.vel] for b in self.bodies], self.radii * [[*b.state.angVel] for b in self.bodies]])

    def jerk(self):
        """j of the last two samples [m/s3]."""
        now = self.read()
        change, before = now - self.velocities, self.change
        self.velocities, self.change = now, change
        return 0.0 if before is None else np.abs(change - before).max() / SAMPLE**2


def chosen(target, jerk, smallest):
    """Number of steps in the next millisecond."""
    wanted = SAMPLE * math.sqrt(jerk / target)
    return min(2 ** max(0, math.ceil(math.log2(max(wanted, 1.0)))), round(SAMPLE / smallest))


# --- runs -------------------------------------------------------------------------------------------------------------
class Run:
    """One run of a case. steps(k, jerk): number of steps in the k-th millisecond, after one with that jerk [m/s3]."""

    def __init__(self, case, steps, options):
        self.case, self.cpu, self.count, self.jerks, self.rows = STEP_CASES[case], 0.0, 0, [], []
        self.case.build(min(DEFAULT_DT, SAMPLE / steps(0, math.inf)), options)
        self.motion = Motion()
        try:
            self.compute(steps)
        except RuntimeError:  # the health check
            self.rows = None
        self.sweeps = engines.find_engine(yw.ContactForces).sweepsDone

    def compute(self, steps):
        jerk = math.inf  # short steps until the first estimate
        self.sample()
        for k in range(round(self.case.duration / SAMPLE)):
            n = steps(k, jerk)
            O.dt = SAMPLE / n
            since = time.process_time()
            for _ in range(n):
                O.step()
            self.cpu += time.process_time() - since
            self.count += n
            jerk = self.motion.jerk()
            self.jerks.append(jerk)
            self.sample()

    def sample(self):
        forces = {"joint forces": joint_forces()} if self.case.with_joints else {}
        self.rows.append({**self.case.curves(), **forces})

    def found(self):
        """{quantity: values}; None if the run failed. Joint forces: the peak of each joint."""
        if self.rows is None:
            return None
        values = {name: np.array([row[name] for row in self.rows]) for name in self.rows[0]}
        if "joint forces" in values:
            values["joint forces"] = values["joint forces"].max(axis=0)
        return values

    def error(self, reference):
        """Largest error of all quantities [-]."""
        found = self.found()
        return max(error(found and found[name], reference[name]) for name in reference)


def plan(case, foreseen):
    """[(kind, dt or target, steps(k, jerk), options)] of a case; foreseen: jerks of a run with short steps [m/s3]."""
    smallest = STEP_CASES[case].smallest
    ahead = [max(foreseen[max(0, k - 1) : k + 3]) for k in range(len(foreseen))]
    runs = [("fixed", dt, lambda k, j, n=round(SAMPLE / dt): n, {}) for dt in FIXED]
    for t in TARGETS:
        runs.append(
            ("chosen", t, lambda k, j, t=t: round(SAMPLE / smallest) if j == math.inf else chosen(t, j, smallest), {})
        )
        runs.append(("foreseen", t, lambda k, j, t=t: chosen(t, ahead[k], smallest), {}))
    return runs


def study(case, repeats):
    """Rows of one case."""
    finest, explicit = (round(SAMPLE / dt) for dt in (STEP_CASES[case].finest, STEP_CASES[case].explicit))
    reference = Run(case, lambda k, j: finest, REFERENCE).found()
    foreseen = Run(case, lambda k, j: round(SAMPLE / FIXED[0]), {}).jerks
    done = {}
    for _ in range(repeats):  # alternately, so that a slower machine affects all alike
        for kind, dt, steps, options in plan(case, foreseen):
            done.setdefault((kind, dt), []).append(Run(case, steps, options))
    done["explicit", SAMPLE / explicit] = [Run(case, lambda k, j: explicit, {"sweeps": 0})]
    rows = [
        (case, *key, statistics.median(r.cpu for r in runs), runs[0].count, runs[0].sweeps, runs[0].error(reference))
        for key, runs in done.items()
    ]
    for row in rows:
        print("{}, {} {:g}: {:.3f} s, {} steps, {} sweeps, error {:.2g}".format(*row), flush=True)
    return rows


def balance(steps):
    """Largest energy gain of house C in strong shaking over its input, if each millisecond takes one of these steps by
    chance [-].
    """
    build_house("C", start=18.0)(DEFAULT_DT, {})
    chance, residuals = np.random.default_rng(1), []
    for _ in range(round(SHAKEN / SAMPLE)):
        O.dt = chance.choice(steps)
        for _ in range(round(SAMPLE / O.dt)):
            O.step()
        residuals.append(yt.energy_residual())
    terms = yt.energy()
    return max(residuals) / (abs(terms["ground_motion"]) + max(0.0, -terms["gravity"]))


# --- gain -------------------------------------------------------------------------------------------------------------
def curve(rows, case, kind):
    """[(CPU time [s], error, dt or target)] of runs that did not fail, in the order of the CPU time."""
    return sorted((cpu, e, dt) for c, k, dt, cpu, _, _, e in rows if (c, k) == (case, kind) and math.isfinite(e))


def cost_of_fixed(rows, case, wanted):
    """CPU time of fixed steps with that error, interpolated between them in logarithms [s]; beyond them nan."""
    # errors of a case with chance need not grow with the step: the cheapest run at least as exact counts
    points = [(min(cpu for cpu, other, _ in curve(rows, case, "fixed") if other <= e), e)
              for _, e, _ in curve(rows, case, "fixed")]
    points.sort(key=lambda p: p[1])
    if not points or not points[0][1] <= wanted:
        return math.nan
    logs = np.log(points)
    return float(np.exp(np.interp(math.log(wanted), logs[:, 1], logs[:, 0])))


def gains(rows, kind):
    """[(case, target, gain)]: CPU time of fixed steps over that of the chosen ones at their error [-]."""
    return [(c, dt, cost_of_fixed(rows, c, e) / cpu) for c, k, dt, cpu, _, _, e in rows
            if k == kind and math.isfinite(e)]


def bound(rows, case):
    """CPU time at the default step over that at the largest one: about what a choice of the step can gain at most [-].
    """
    cpu = {dt: spent for c, kind, dt, spent, *_ in rows if (c, kind) == (case, "fixed")}
    return cpu[DEFAULT_DT] / cpu[FIXED[-1]]


def verdict(rows):
    """The conclusion in numbers, for the houses."""
    text = []
    houses = [case for case in HOUSES if any(r[0] == case for r in rows)]
    for kind in ("chosen", "foreseen"):
        found = [gain for case, _, gain in gains(rows, kind) if case in houses and math.isfinite(gain)]
        if found:
            spread = f"median of {len(found)} runs of houses, {min(found):.2f} to {max(found):.2f}"
            text.append(
                f"At equal error, {kind} steps are {statistics.median(found):.2f} times as fast as fixed ones"
                f" ({spread})."
            )
    bounds = ", ".join(f"{bound(rows, case):.2f} ({case})" for case in houses)
    return (
        " ".join(text)
        + f" Steps of {FIXED[-1]:g} s throughout are faster than the default step by a factor of {bounds}: a choice"
        " between these two steps can gain little more."
    )


def main():
    options = arguments()
    changes = [(" ".join(f"{dt:g}" for dt in steps), balance(steps)) for steps in CHANGES]
    write_table(options.out, "changed_step", ("steps [s]", "energy gained [-]"), changes)
    rows = []
    for case in options.cases:
        rows += study(case, options.repeats)
        write_table(options.out, "chosen_step", HEADS, rows)
    gained = [(case, kind, target, gain) for kind in ("chosen", "foreseen") for case, target, gain in gains(rows, kind)]
    write_table(options.out, "chosen_gain",
                ("case", "steps", "target [m/s]", "CPU time of fixed steps over it at equal error [-]"), gained)
    print(verdict(rows))
    print(f"written to {options.out}")


run_script(main)
