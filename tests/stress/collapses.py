# SPDX-License-Identifier: GPL-2.0-or-later
"""Collapses, and what their numbers are worth: convergence, energy created, negative dissipation, spin, residual,
overlap.

`yade -j1 -n -x tests/stress/collapses.py frames|scenes|weights|houses` prints the table of a set, row by row.
"""
import itertools
import math
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from overlap_watch import Overlaps
from timber_houses.house.loader import shipped_houses
from timber_houses.motion import default_motion, synthetic_motion
from timber_houses.motion.processing import trim
from timber_houses.scene import scenario
from yade_timber.plugin import compiled
from yade_timber.scene.engines import find_engine

O = yw.Omega()

DISSIPATED = ("dashpot_normal", "dashpot_shear", "friction", "crushing", "broken_springs", "joint_dashpot",
              "joint_yield")
"""Terms of `yt.energy` that cannot fall. `lost_contacts` counts energy given to new points with the opposite sign."""
CREATED, NEGATIVE, CHANGE = 1e-4, 1e-9, 1e-9
"""Bounds of a sound run over the energy put in [-]: negative dissipation of single points and joints, fall of a
dissipated term within a SAMPLE, and last change of a pair in a step that ended unconverged."""
SAMPLE = 0.05
"""Time between two samples of spins and energies. [s]"""
DAMPINGS = (0.0, 0.01, 0.03, 0.1, 1.0)
"""Damping ratios of the joints of the plain frames. [-]"""
LIGHTEST, HEAVIEST = 0.1, 1e4
"""Masses of members. [kg]"""
DENSITY = 340.0
"""Of the boxes of a heap. [kg/m3]"""
FRAME = """extends: base
name: frame
materials: {{timber: {{density: {density}}}, roofing: {{density: {density}}}}}
structures:
  frame:
    place: {{origin: [0, 0]}}
    grid: {{x: {{module: {x}, count: 2}}, y: {{module: {y}, count: 2}}}}
    margin: {margin}
    lines: [{{along: y, at: [0, 2], from: 0, to: 2}}, {{along: x, at: [0, 2], from: 0, to: 2, cut: true}}]
    stack:
      - {{layer: sill, height: {section}, width: {section}}}
      - {{layer: columns, height: {height}}}
      - {{layer: beams, height: {section}, width: {section}}}
      - {{layer: roof, type: flat, thickness: {slab}}}
    columns: [{{section: {section}, grid: {{x: [0, 2], y: [0, 2]}}}}]
"""
"""House file of a roof slab on four columns; lengths [m], density [kg/m3]."""


@dataclass(frozen=True)
class Case:
    """A run. house: name of a shipped house or text of a house file; seed: of the motion, None: the default motion;
    start, duration: of the part of it that acts [s]; snow [m]; damping: of all joints, None: the house's."""

    name: str
    house: str
    scale: float = 1.0
    seed: int = None
    start: float = 16.0
    duration: float = 14.0
    snow: float = 0.0
    damping: float = None

    def build(self):
        """Its scene in an emptied YADE."""
        motion = default_motion() if self.seed is None else synthetic_motion(self.seed)
        motion = trim(motion, self.start, self.start + self.duration)
        with tempfile.TemporaryDirectory() as folder:
            house = self.house
            if "\n" in house:
                path = Path(folder) / "house.yaml"
                path.write_text(house)
                house = str(path)
            options = {"joint_damping": self.damping, "snow_depth": self.snow, "scale": self.scale}
            scenario.build(scenario.Scenario(self.name, house, motion, duration=self.duration, **options))


@dataclass(frozen=True)
class Heap:
    """Boxes of LIGHTEST to HEAVIEST one above the other fall, without joints; seed: of all numbers; duration [s]."""

    name: str
    seed: int
    duration: float = 4.0

    def build(self):
        random = np.random.default_rng(self.seed)
        O.reset()
        O.bodies.append(yt.box((20, 20, 1), (0, 0, -0.5), fixed=True))
        top = 0.0  # [m]
        for mass in random.permutation(np.geomspace(LIGHTEST, HEAVIEST, 12)):
            side = np.exp(random.uniform(-0.5, 0.5, 3))
            side *= np.cbrt(mass / DENSITY / side.prod())  # [m]
            bottom = top + random.uniform(0.1, 0.5)
            top = bottom + side[2]
            centre = (*random.uniform(-0.1, 0.1, 2), bottom + side[2] / 2)
            O.bodies.append(yt.box(side, centre, None, yt.timber(density=DENSITY)))
        O.dt, O.engines = scenario.DEFAULT_DT, yt.engines()


@dataclass
class Outcome:
    """Of a run. Shares are of the energy put in."""

    name: str
    error: str  # empty for a run that ended at its duration
    end: float  # [s]
    input: float  # [J]
    sweeps: float  # mean of a step [-]
    unconverged: int  # steps
    change: float  # largest of a pair in its last visit in an unconverged step, share [-]
    created: float  # share [-]
    negative: float  # largest fall of a dissipated term within a SAMPLE, share [-]
    term: str  # that fell so
    spin: float  # largest of a body [rad/s]
    speed: float  # largest of a body [m/s]
    residual: float  # of the energy balance, share [-]
    deepest: float  # largest overlap of two bodies [m]
    unexplained: float  # largest excess of an overlap over its bound [m]
    pair: str  # that has the excess
    wall: float  # [s]

    def faults(self):
        """Words for all that is not sound; empty for a sound run."""
        bounds = (("created", CREATED), ("negative", NEGATIVE), ("change", CHANGE))
        found = [f"{name} {getattr(self, name):.1e}" for name, bound in bounds if not getattr(self, name) <= bound]
        if not math.isfinite(self.residual):
            found.insert(0, "energy is not finite")
        return [self.error, *found] if self.error else found

    def row(self):
        """Line of the table."""
        fault = f"STOPPED at {self.end:.2f} s: {self.error[:60]}" if self.error else "finished"
        shares = " ".join(f"{value:9.1e}" for value in (self.change, self.created, self.negative, self.residual))
        counts = f"{self.input / 1e3:9.2f} {self.sweeps:7.1f} {self.unconverged:8}"
        overlaps = f"{1e3 * self.deepest:7.2f} {1e3 * self.unexplained:7.2f}"
        extremes = f"{self.spin:8.0f} {self.speed:6.1f} {overlaps} {self.wall:6.0f}"
        term = f" ({self.term})" if self.negative > NEGATIVE else ""
        return f"{self.name:28} {counts} {shares} {extremes}  {fault}{term}"


HEADER = (
    f"{'case':28} {'input/kJ':>9} {'sweeps':>7} {'unconv.':>8} {'change':>9} {'created':>9} {'negative':>9} "
    f"{'residual':>9} "
    f"{'rad/s':>8} {'m/s':>6} {'deep/mm':>7} {'over/mm':>7} {'wall/s':>6}")


class Watch:
    """Extremes of the scene that is loaded, sampled."""

    def __init__(self):
        self.free = [b for b in O.bodies if b.dynamic]
        self.terms = self.dissipated()
        self.overlaps = Overlaps()
        self.spin = self.speed = self.fall = 0.0
        self.term = ""

    @staticmethod
    def dissipated():
        terms = yt.energy()
        return {name: terms.get(name, 0.0) for name in DISSIPATED}

    def sample(self):
        """Take the scene as it is now; NaN in a term counts as a fall without bound."""
        self.spin = max([self.spin, *(b.state.angVel.norm() for b in self.free)])
        self.speed = max([self.speed, *(b.state.vel.norm() for b in self.free)])
        now = self.dissipated()
        for name, before in self.terms.items():
            fall = before - now[name]
            if not fall <= self.fall:
                self.fall, self.term = (fall if math.isfinite(fall) else math.inf), name
        self.terms = now


def outcome(case):
    """Build and run a Case or Heap -> Outcome. Errors of the health check end it; those of the house file are raised.
    """
    case.build()
    watch, since, error = Watch(), time.perf_counter(), ""
    try:
        while O.time < case.duration - O.dt / 2:
            stop = min(O.time + SAMPLE, case.duration)
            while O.time < stop - O.dt / 2:
                O.step()
            watch.sample()
            watch.overlaps.measure_at_intervals()
        watch.overlaps.measure()
        find_engine(yw.HealthCheck).check()
    except RuntimeError as problem:
        error = str(problem)
        watch.sample()
    return judged(case.name, watch, error, time.perf_counter() - since, yt.energy())


def judged(name, watch, error, wall, terms):
    """Outcome of the run that is loaded. wall [s]; terms: of the energy balance [J]"""
    forces = find_engine(yw.ContactForces)
    supplied = terms.get("ground_motion", 0.0) + terms["imposed_velocity"] - terms["gravity"]
    energies = {"change": forces.worstChange, "created": compiled.created_energy(), "negative": watch.fall}
    energies["residual"] = abs(yt.energy_residual(terms))
    shares = {name: value / supplied if supplied > 0 else math.inf for name, value in energies.items()}
    counts = {"sweeps": forces.sweepsDone / max(1, O.iter), "unconverged": forces.unconverged}
    extremes = {"term": watch.term, "spin": watch.spin, "speed": watch.speed}
    found = watch.overlaps
    overlaps = {"deepest": found.deepest, "unexplained": found.unexplained, "pair": found.pair}
    return Outcome(name, error, O.time, supplied, **counts, **shares, **extremes, **overlaps, wall=wall)


# --- sets -------------------------------------------------------------------------------------------------------------
def scenes():
    """Shipped house and motion whose collapse fails with a rule of impacts that has no fixed point."""
    return [Case("tiled_house 1.5", "tiled_house", 1.5), Case("tiled_house 2, seed 1", "tiled_house", 2.0, 1),
            Case("tiled_house 2, seed 1, snow", "tiled_house", 2.0, 1, snow=1.0)]


def frames(count=20, seed=49):
    """Random plausible plain frames under the default motion; every second one has half the size, DAMPINGS take turns.
    """
    random = np.random.default_rng(seed)
    return [plain_frame(k, random) for k in range(count)]


def plain_frame(number, random):
    """Case of a roof slab on four columns. random: numpy's Generator"""
    size = 1.0 - 0.5 * (number % 2)
    module, height = size * random.uniform(0.8, 1.4, 2), size * random.uniform(2.2, 2.8)
    section, density = size * random.choice((0.075, 0.09, 0.105)), random.uniform(200, 340)
    values = {"x": module[0], "y": module[1], "height": height, "section": section, "margin": section / 2}
    values["slab"] = size * random.uniform(0.06, 0.12)
    text = FRAME.format(**{name: f"{value:.4f}" for name, value in values.items()}, density=f"{density:.0f}")
    damping, scale = DAMPINGS[number % len(DAMPINGS)], random.uniform(1.0, 1.5)
    name = f"frame {number:2} {section * 1e3:3.0f} mm {density:3.0f} d {damping:g}"
    return Case(name, text, round(scale, 2), damping=damping)


def weights():
    """Members of LIGHTEST to HEAVIEST: heaps, and slabs of 1 to 10 t on columns of 0.1 kg."""
    light = {"x": 1.6, "y": 1.6, "margin": 0.1, "section": 0.035, "height": 0.25}
    heavy = FRAME.replace("roofing: {{density: {density}}}", "roofing: {{density: 2400}}")
    slabs = [heavy.format(**light, density=300, slab=slab) for slab in (0.04, 0.36)]
    heaps = [Heap(f"heap {seed}", seed) for seed in range(3)]
    return heaps + [Case(f"slab on 0.1 kg columns {k}", text, duration=6.0) for k, text in enumerate(slabs)]


def houses(seeds=(1, 2, 3, 4), scales=(1.0, 1.5, 2.0)):
    """The shipped houses under motions of several seeds and sizes."""
    runs = itertools.product(seeds, scales, shipped_houses())
    return [Case(f"{name} {scale:g}, seed {seed}", name, scale, seed) for seed, scale, name in runs]


SETS = {"scenes": scenes, "frames": frames, "weights": weights, "houses": houses}


def table(cases):
    """Run cases one after the other and print their rows -> outcomes."""
    print(HEADER, flush=True)
    outcomes = []
    for case in cases:
        outcomes.append(outcome(case))
        print(outcomes[-1].row(), flush=True)
    return outcomes


def expect_sound(outcomes):
    """No error, finite energies, bounds kept."""
    faults = {one.name: one.faults() for one in outcomes if one.faults()}
    assert not faults, "\n".join(f"{name}: {'; '.join(found)}" for name, found in faults.items())


if __name__ == "__main__":
    for wanted in sys.argv[1:] or ["frames"]:
        table(SETS[wanted]())
