# SPDX-License-Identifier: GPL-2.0-or-later
"""Time per contact pair and step, contact points (of four) and their errors: this package and YADE's Polyhedra.

    yade -j1 -n -x scripts/bench/benchmark_peers.py [--pairs 100] [--out FOLDER]

A step with many separate pairs, minus the same step without functors, divided by the number of pairs; CPU time. The
program build/bench/benchmarks/benchmark_peers (scripts/setup --with-bench) has the kernel of this package, Bullet, ODE.
"""
import math
import sys
from pathlib import Path

import yade.wrapper as yw
from yade import polyhedra_utils

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import yade_timber as yt
from bench_tools import cpu_per_step, interleaved, parser, publish
from yade.minieigenHP import Vector3
from timber_houses.study.options import count, run_script

O = yw.Omega()

DEPTH = 1e-4
"""Overlap of the touching faces [m]; that of benchmarks/configurations.hpp."""
PLATE, CUBE, ASIDE = (1.0, 1.0, 0.2), (0.3, 0.3, 0.3), (0.01, 0.02)
"""Extents of the face configuration, and horizontal position of the cube [m]."""
SPACING = 3.0
"""Between pairs [m]."""
WHOLE, POLYHEDRA = "this package in YADE", "YADE Polyhedra"
HEADS = ("program", "time per pair and step [us]", "contact points", "error of normal [rad]", "error of depth [m]")


def arguments():
    made = parser(__doc__, blocks=7, steps=50)
    made.add_argument("--pairs", type=count, default=100, help="pairs in the scenes of YADE (default %(default)s)")
    return made.parse_args()


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
    return program, seconds * 1e6, len(found), tilt, max(abs(d - DEPTH) for _, d in found)


def main():
    options = arguments()
    publish(options.out, "peers", "Pairs of bodies, face on face", HEADS, yade_rows(options))


run_script(main)
