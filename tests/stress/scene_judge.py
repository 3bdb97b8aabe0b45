# SPDX-License-Identifier: GPL-2.0-or-later
"""Judges of a scene: energies, overlaps of cores, speeds, rest, forces on the fixed bodies."""
import math
import pathlib
import sys
import time
from dataclasses import dataclass, field

TESTS = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(TESTS / "physics"), str(TESTS)]

import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from assembly_cases import load_on_fixed, weight
from cases import G
from collapses import SAMPLE, Watch, judged
from overlap_watch import bodies
from yade_timber.scene.engines import gravity_now

O = yw.Omega()

RESIDUAL = 1e-4
"""Of the energy balance over the energy put in. [-]"""
SPEED_SHARE = 1.5
"""Largest speed over that of the fall plus that of the ground [-]: a light body struck by a heavy one leaves with 1 +
e_r = 1.12 times its speed, an end of a falling column with 3^(1/2) / 2^(1/2) = 1.22 times that of a free fall."""
FINER, SAME = 5, 1.1
"""A member that is squeezed out between closing surfaces may leave faster, and leave its stack. That is no error of
the step if it does so at the step over FINER, within this factor of speed and displacement. [-]"""
CREEP, CREEP_TIME = 1e-5, 4.0
"""Largest slope of the place of a corner over the last seconds [s] of a scene at rest [m/s]. A heavy block on light
ones has the dashpots of these (Eqs. 41, 42): it swings by up to 0.1 mm at 3 Hz for ten seconds, and does not creep."""
LATER = 10.0
"""A body that stands on two edges may rock for some seconds: a scene that creeps at its end is judged again this much
later. A creep that the solver makes goes on. [s]"""
WEIGHT = 1e-4
"""Difference of the mean force on the fixed bodies from the weight, at rest, in this time. [-]"""


@dataclass
class Plan:
    """What is done in a scene and expected of it; its bodies, `O.dt` and `O.engines` are in YADE."""

    duration: float  # [s]
    events: list = field(default_factory=list)  # (time [s], function), in order of time
    rests: bool = True  # at the end
    stands: float = None  # largest displacement of a body, None: any [m]
    speed: float = 0.0  # of the ground, and of bodies at the start [m/s]
    answer: callable = None  # at the end -> words for what is wrong


@dataclass
class Verdict:
    """Of a scene. outcome: collapses.Outcome, shares of the energy put in."""

    outcome: object
    plan: Plan
    speed_limit: float  # [m/s]
    moved: float  # largest displacement of a body [m]
    creep: float  # at the end [m/s]
    weight: float  # error of the contact and joint forces on fixed bodies [-]
    handed: float  # of the forces that YADE's container has for them [-]
    answer: list
    finer: "Verdict" = None  # at a smaller step, sound but for a body that is too fast or moves too far

    def faults(self):
        """Words for all that is not sound; empty for a sound scene."""
        run, found = self.outcome, list(self.outcome.faults())
        fastest, farthest = (SAME * self.finer.outcome.speed, SAME * self.finer.moved) if self.finer else (0.0, 0.0)
        bounds = [("residual", run.residual, RESIDUAL), ("speed", run.speed, max(self.speed_limit, fastest)),
                  ("unconverged steps", run.unconverged, 0), (f"overlap {run.pair}, by", run.unexplained, 0.0)]
        if self.plan.stands is not None:
            bounds.append(("moved", self.moved, max(self.plan.stands, farthest)))
        if self.plan.rests and not run.error:
            bounds += [("creep", self.creep, CREEP), ("weight", self.weight, WEIGHT),
                       ("forces handed over", self.handed, WEIGHT)]
        return found + [f"{name} {value:.2g}" for name, value, bound in bounds if not value <= bound] + self.answer

    def row(self):
        """Line of the table."""
        run = self.outcome
        shares = f"{run.created:8.0e} {run.residual:8.0e} {run.unconverged:5} {run.sweeps:6.1f}"
        lengths = f"{1e3 * run.deepest:7.2f} {1e3 * run.unexplained:7.2f} {1e3 * self.moved:8.2f}"
        forces = f"{self.creep:8.0e} {self.weight:8.0e}"
        speeds = f"{run.speed:6.2f} {self.speed_limit:6.2f}"
        words = "; ".join(self.faults()) or "sound"
        return f"{run.name:14} {shares} {lengths} {speeds} {forces} {run.wall:5.1f}  {words}"


HEADER = (f"{'scene':14} {'created':>8} {'residual':>8} {'unc.':>5} {'sweeps':>6} {'deep/mm':>7} {'over/mm':>7} "
          f"{'moved/mm':>8} {'m/s':>6} {'limit':>6} {'creep':>8} {'weight':>8} {'cpu/s':>5}")


class SceneWatch(Watch):
    """Extremes of the scene that is loaded, also while bodies are erased and added."""

    def __init__(self, plan):
        super().__init__()
        self.plan, self.erased = plan, {}
        self.top = max(corners[:, 2].max() for corners in self.corners().values())

    def energies(self):
        """Terms of the energy balance without what bodies that were erased or added have changed. [J]"""
        return {name: value - self.erased.get(name, 0.0) for name, value in yt.energy().items()}

    def change(self, event):
        """Let an event change the scene. Terms of the balance follow within a step."""
        before = self.energies()
        event()
        O.step()
        self.erased = {name: value - before.get(name, 0.0) for name, value in yt.energy().items()}
        self.top = max(self.top, *(corners[:, 2].max() for corners in self.corners().values()))

    def sample(self):
        self.free = [b for b in bodies() if b.dynamic]
        super().sample()

    def corners(self):
        """Body id -> corners of its core in the world, of free bodies. [m]"""
        return {k: core.corners for k, core in self.overlaps.placed().items() if O.bodies[k].dynamic}


def handed_over():
    """Downward force on the fixed bodies in YADE's container. [N]"""
    return -sum(O.forces.f(b.id)[2] for b in bodies() if not b.dynamic)


class Rest:
    """Samples of the end of a scene, at most half of the time after its last event: corners of the free bodies, forces
    on the fixed ones."""

    def __init__(self, plan):
        last = max([0.0, *(when for when, _ in plan.events)])
        self.start = plan.duration - min(CREEP_TIME, (plan.duration - last) / 2)
        self.times, self.corners, self.loads = [], [], []

    def sample(self, watch):
        if O.time < self.start - O.dt / 2:
            return
        self.times.append(O.time)
        self.corners.append(watch.corners())
        self.loads.append((load_on_fixed(), handed_over()))

    def windows(self):
        """First samples of the two windows that are judged: all, and the last quarter. A swing averages to nothing in
        the first; what has come to rest late does in the second."""
        count = len(self.times)
        return 0, count - max(2, count // 4)

    def slopes(self, first):
        """Of each body's fastest corner from a sample on: slope of the least-squares line. [m/s]

        Hann's weights: a swing of four periods or more in the window has hardly any slope, a creep has its own."""
        times = np.array(self.times[first:])
        weights = np.sin(np.pi * (np.arange(len(times)) + 0.5) / len(times))**2
        times -= weights @ times / weights.sum()
        weights *= times / (weights @ times**2)
        ids = set.intersection(*map(set, self.corners))
        slopes = (np.tensordot(weights, [corners[k] for corners in self.corners[first:]], 1) for k in ids)
        return np.array([np.linalg.norm(slope, axis=1).max() for slope in slopes])

    def creep(self):
        """Of the fastest body. [m/s]"""
        return np.min([self.slopes(first) for first in self.windows()], axis=0).max() if len(self.times) > 1 else 0.0

    def errors(self, downward):
        """Of the mean forces on fixed bodies: of contacts and joints, and those handed over. downward: weight [N]"""
        if not self.loads:
            return math.inf, math.inf
        if not downward:
            return 0.0, 0.0
        means = [np.mean(self.loads[first:], axis=0) for first in self.windows()]
        return np.min([abs(mean / downward - 1) for mean in means], axis=0)


def advance(watch, rest):
    """Run the scene that is loaded as planned."""
    plan, events = watch.plan, list(watch.plan.events)
    samples = 0
    while O.time < plan.duration - O.dt / 2:
        while events and events[0][0] <= O.time + O.dt / 2:
            watch.change(events.pop(0)[1])
        samples += 1
        stop = min([samples * SAMPLE, plan.duration, *(when for when, _ in events[:1])])
        samples -= stop < samples * SAMPLE
        while O.time < stop - O.dt / 2:
            O.step()
        watch.sample()
        rest.sample(watch)
        watch.overlaps.measure_at_intervals()
    watch.overlaps.measure()


def judge(name, build, seed):
    """Build a scene with random numbers of a seed, run it -> Verdict. Errors of the health check end it."""
    verdict = judged_at(name, build, seed, 1)
    if verdict.plan.rests and verdict.creep > CREEP and not verdict.outcome.error:
        verdict = judged_at(name, build, seed, 1, LATER)
    stands = verdict.plan.stands
    if verdict.outcome.speed > verdict.speed_limit or (stands is not None and verdict.moved > stands):
        finer = judged_at(name, build, seed, FINER)
        if all(fault.startswith(("speed", "moved")) for fault in finer.faults()):
            verdict.finer = finer
    return verdict


def judged_at(name, build, seed, steps, later=0.0):
    """The same with that many steps in one. later: added to the duration [s]"""
    O.reset()
    plan = build(np.random.default_rng(seed))
    plan.duration += later
    O.dt /= steps
    watch, rest, since, error = SceneWatch(plan), Rest(plan), time.process_time(), ""
    try:
        advance(watch, rest)
    except RuntimeError as problem:
        error = str(problem)
        watch.sample()
    outcome = judged(name, watch, error, time.process_time() - since, watch.energies())
    free = [b for b in bodies() if b.dynamic]
    downward = -weight() * gravity_now()[2] / G
    loads = rest.errors(downward)
    limit = SPEED_SHARE * (math.sqrt(2 * G * watch.top) + plan.speed)
    moved = max((b.state.pos - b.state.refPos).norm() for b in free)
    answer = plan.answer() if plan.answer and not error else []
    return Verdict(outcome, plan, limit, moved, math.inf if error else rest.creep(), *loads, answer)
