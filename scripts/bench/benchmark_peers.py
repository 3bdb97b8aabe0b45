# SPDX-License-Identifier: GPL-2.0-or-later
"""Time per contact pair and step, contact points and their errors: this package, YADE's Polyhedra, Bullet and ODE.

    scripts/setup --with-bench && yade -j1 -n -x scripts/bench/benchmark_peers.py [--pairs 100] [--out FOLDER]

build/bench/benchmarks/benchmark_peers (Google Benchmark) measures Bullet, ODE (contact points alone) and the kernel of
this package (contact points, contact law, solver). YADE's Polyhedra and this package in YADE are measured here: a step
with many separate pairs, minus the same step without functors, divided by the number of pairs. CPU time throughout.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import yade.wrapper as yw
from yade import polyhedra_utils

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path.insert(0, str(ROOT / "scripts/bench"))

import yade_timber as yt
from bench_tools import cpu_per_step, interleaved, machine, parser, publish
from tables import markdown_table
from yade.minieigenHP import Vector3
from timber_houses.base.errors import RunError
from timber_houses.study.options import count, run_script

O = yw.Omega()

PROGRAM = ROOT / "build" / "bench" / "benchmarks" / "benchmark_peers"
FACE = "face on face"
DEPTH = 1e-4
"""Overlap of the touching faces [m]; that of benchmarks/configurations.hpp."""
PLATE, CUBE, ASIDE = (1.0, 1.0, 0.2), (0.3, 0.3, 0.3), (0.01, 0.02)
"""Extents of the face configuration, and horizontal position of the cube [m]."""
SPACING = 3.0
"""Between pairs [m]."""
WHOLE, POLYHEDRA, KERNEL = "this package in YADE", "YADE Polyhedra", "timber"
HEADS = ("program", "pair", "time per pair and step [us]", "contact points", "expected", "error of normal [rad]",
         "error of depth [m]")
PAGE_HEADS = ("pair", "program", "time [us]", "contact points", "error of normal [rad]", "error of depth [m]")
NAMES = {"timber": "this package: points, law, solver", "timber points": "this package: points alone",
         "timber cold": "this package: points, nothing cached", "Bullet": "Bullet: points",
         "Bullet hulls": "Bullet: points, boxes as hulls", "Bullet cold": "Bullet: points, nothing cached",
         "ODE": "ODE: points (never cached)"}


def arguments():
    made = parser(__doc__, blocks=7, steps=50)
    made.add_argument("--pairs", type=count, default=100, help="pairs in the scenes of YADE (default %(default)s)")
    made.add_argument("--repetitions", type=count, default=5,
                      help="repetitions of Google Benchmark; their median counts (default %(default)s)")
    return made.parse_args()


# --- Google Benchmark -------------------------------------------------------------------------------------------------
def kernel_rows(repetitions):
    """Rows of the C++ program."""
    if not PROGRAM.exists():
        raise RunError(f"{PROGRAM} is missing: scripts/setup --with-bench builds it")
    interleaving = "--benchmark_enable_random_interleaving=true"  # other load affects all alike
    options = ["--benchmark_format=json", f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.1",
               interleaving]
    found = json.loads(subprocess.run([PROGRAM, *options], check=True, capture_output=True, text=True).stdout)
    median = [b for b in found["benchmarks"] if b.get("aggregate_name") == "median"]
    rows = []
    for b in sorted(median, key=lambda b: b["family_index"]):
        program, pair = b["run_name"].split("/", 1)
        rows.append((program, pair, b["cpu_time"] * 1e-3, round(b["points"]), round(b["expected"]), b["normal_error"],
                     b["depth_error"]))
    return rows


# --- scenes in YADE ---------------------------------------------------------------------------------------------------
def corners(extents):
    return [Vector3(*(s * e / 2 for s, e in zip(sign, extents)))
            for sign in ((x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))]


def polyhedra_body(extents, centre, fixed):
    body = polyhedra_utils.polyhedra(yw.PolyhedraMat(young=8.8e9, poisson=0.4, density=340), v=corners(extents),
                                     fixed=fixed)
    body.state.pos = Vector3(*centre)
    return body


def timber_body(extents, centre, fixed):
    return yt.box(extents, centre, fixed=fixed)


def polyhedra_engines():
    return [
        yw.ForceResetter(),
        yw.InsertionSortCollider([yw.Bo1_Polyhedra_Aabb()], verletDist=0),
        yw.InteractionLoop([yw.Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                           [yw.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                           [yw.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    ]


def timber_engines():
    """The engines of `yt.engines` without the integrator."""
    return [e for e in yt.engines(gravity=(0, 0, 0)) if not isinstance(e, yw.SymplecticIntegrator)]


def without_functors(engines):
    """The same engines up to the interaction loop, which is empty."""
    index = next(k for k, e in enumerate(engines) if isinstance(e, (yw.ContactLoop, yw.InteractionLoop)))
    return engines[:index] + [yw.InteractionLoop([], [], [])]


def load(body, engines, pairs, functors=True):
    """Pairs in the face configuration, at rest, in a new scene; returns its number."""
    number = O.addScene()
    O.switchToScene(number)
    for k in range(pairs):
        O.bodies.append(body(PLATE, (SPACING * k, 0, -PLATE[2] / 2), True))
        O.bodies.append(body(CUBE, (SPACING * k + ASIDE[0], ASIDE[1], CUBE[2] / 2 - DEPTH), False))
    O.engines = engines() if functors else without_functors(engines())
    O.dt = 1e-6
    O.step()
    return number


def timed(number, steps):
    def measure():
        O.switchToScene(number)
        return cpu_per_step(steps)

    return measure


def yade_rows(options):
    """Rows of the face configuration: YADE's Polyhedra and this package in YADE."""
    O.reset()
    kinds = {WHOLE: (timber_body, timber_engines), POLYHEDRA: (polyhedra_body, polyhedra_engines)}
    scenes = {(program, full): load(*kind, options.pairs, full) for program, kind in kinds.items()
              for full in (True, False)}
    times = interleaved([(key, timed(number, options.steps)) for key, number in scenes.items()], options.blocks)
    return [row_of(program, scenes[program, True], (times[program, True] - times[program, False]) / options.pairs)
            for program in kinds]


def row_of(program, number, seconds):
    """Row with the contact points of the first pair of a scene."""
    O.switchToScene(number)
    geometry = O.interactions[0, 1].geom
    if program == POLYHEDRA:
        found = [(geometry.normal, geometry.equivalentPenetrationDepth)]
    else:
        found = [(normal, overlap) for _, normal, overlap, _ in geometry.points]
    tilt = max(math.atan2(n.cross(Vector3(0, 0, 1)).norm(), n[2]) for n, _ in found)
    return program, FACE, seconds * 1e6, len(found), 4, tilt, max(abs(d - DEPTH) for _, d in found)


# --- page -------------------------------------------------------------------------------------------------------------
def section(rows):
    """Section of the results page."""
    time = {(r[0], r[1]): r[2] for r in rows}
    whole, own = time[WHOLE, FACE], time[KERNEL, FACE]
    shown = [(r[1], NAMES.get(r[0], r[0]), f"{r[2]:.3f}", f"{r[3]} of {r[4]}" if r[4] else "-", f"{r[5]:.1g}",
              f"{r[6]:.1g}") for r in sorted(rows, key=lambda r: r[1])]
    return f"""## Contact pairs against peers

CPU time per pair and step. Touching pairs overlap by 0.1 mm, near ones are 2 mm apart; normal and depth of all of them
are known in closed form. Contact law and solver are included only where stated.
For the face contact YADE's Polyhedra takes {time[POLYHEDRA, FACE] / whole:.0f} times as long as this package in YADE,
and {time[POLYHEDRA, FACE] / own:.0f} times as long as its kernel. {machine()}.

{markdown_table(PAGE_HEADS, shown)}
The depth of Polyhedra is its equivalent depth, the cube root of the overlap volume. Bullet and ODE find one or two of
the four points of a prism that stands on its cut end.
"""


def main():
    options = arguments()
    rows = yade_rows(options) + kernel_rows(options.repetitions)
    publish(options.out, "peers", section(rows), HEADS, rows)


run_script(main)
