# SPDX-License-Identifier: GPL-2.0-or-later
"""Time per contact pair and step: this package, YADE's Polyhedra, LAMMPS, Bullet and ODE.

    scripts/setup --with-bench && yade -j1 -n -x scripts/bench/benchmark_peers.py [--pairs 100] [--out FOLDER]

Cubes on plates, face on face: in YADE and in LAMMPS a step with many pairs in contact, minus the same step with the
cubes lifted, divided by the number of pairs. Steps are too short for motion. build/bench/benchmarks/benchmark_peers
(Google Benchmark) measures Bullet and ODE (contact points alone) and the kernel of this package, for several pairs.
CPU time throughout. LAMMPS: Debian's package.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yade.wrapper as yw
from yade import polyhedra_utils

ROOT = Path(sys.argv[0]).resolve().parents[2]  # YADE runs a script without setting __file__
sys.path.insert(0, str(ROOT / "scripts/bench"))

import yade_timber as yt
from bench_tools import cpu_per_step, interleaved, parser, publish
from mechanics.programs import lammps
from mechanics.scene import Body
from yade.minieigenHP import Vector3
from timber_houses.base.errors import RunError
from timber_houses.study.options import count, run_script

O = yw.Omega()

PROGRAM = ROOT / "build" / "bench" / "benchmarks" / "benchmark_peers"
DEPTH, LIFTED = 1e-4, -5.0
"""Overlap of the faces in contact, as in benchmarks/configurations.hpp, and of lifted cubes. [m]"""
PLATE, CUBE, ASIDE = (1.0, 1.0, 0.2), (0.3, 0.3, 0.3), (0.01, 0.02)
"""Extents, and horizontal position of the cube. [m]"""
SPACING, ROW = 3.0, 50
"""Between pairs [m]; pairs in a row."""
STEP = 1e-9
"""[s]"""
HEADS = ("program", "pair", "time per pair and step [us]", "contact points")


def places(pairs, depth):
    """[(plate's centre, cube's centre)] [m]"""
    grid = [(SPACING * (k % ROW), SPACING * (k // ROW)) for k in range(pairs)]
    return [((x, y, -PLATE[2] / 2), (x + ASIDE[0], y + ASIDE[1], CUBE[2] / 2 - depth)) for x, y in grid]


# --- YADE -------------------------------------------------------------------------------------------------------------
def polyhedra_body(extents, centre, fixed):
    corners = [Vector3(*(s * e / 2 for s, e in zip(sign, extents))) for sign in lammps.SIGNS.tolist()]
    material = yw.PolyhedraMat(young=8.8e9, poisson=0.4, density=340)
    body = polyhedra_utils.polyhedra(material, v=corners, fixed=fixed)
    body.state.pos = Vector3(*centre)
    return body


def timber_body(extents, centre, fixed):
    return yt.box(extents, centre, fixed=fixed)


def polyhedra_engines():
    loop = yw.InteractionLoop([yw.Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                              [yw.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                              [yw.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()])
    collider = yw.InsertionSortCollider([yw.Bo1_Polyhedra_Aabb()], verletDist=0.01)
    return [yw.ForceResetter(), collider, loop, yw.NewtonIntegrator()]


def timber_engines():
    return yt.engines(gravity=(0, 0, 0))


def load(body, engines, pairs, depth):
    """Pairs in a new scene; returns its number."""
    number = O.addScene()
    O.switchToScene(number)
    for plate, cube in places(pairs, depth):
        O.bodies.append(body(PLATE, plate, True))
        O.bodies.append(body(CUBE, cube, False))
    O.engines = engines()
    O.dt = STEP
    O.step()
    return number


def timed(number, steps):
    def measure():
        O.switchToScene(number)
        return cpu_per_step(steps)

    return measure


def yade_rows(options):
    O.reset()
    kinds = {"this package in YADE": (timber_body, timber_engines),
             "YADE Polyhedra": (polyhedra_body, polyhedra_engines)}
    scenes = {(name, depth): load(*kind, options.pairs, depth) for name, kind in kinds.items()
              for depth in (DEPTH, LIFTED)}
    times = interleaved([(key, timed(number, options.steps)) for key, number in scenes.items()], options.blocks)
    for name in kinds:
        O.switchToScene(scenes[name, DEPTH])
        points = getattr(O.interactions[0, 1].geom, "points", [None])  # Polyhedra: one force
        yield name, 1e6 * (times[name, DEPTH] - times[name, LIFTED]) / options.pairs, len(points)


# --- LAMMPS -----------------------------------------------------------------------------------------------------------
def lammps_time(pairs, depth, steps):
    """CPU time of a step [s]."""
    bodies = []
    for k, (plate, cube) in enumerate(places(pairs, depth)):
        bodies += [Body(f"plate{k}", plate, PLATE), Body(f"cube{k}", cube, CUBE, mass=9.18)]
    held = " ".join(str(2 * k + 1) for k in range(pairs))
    text = f"""units si
boundary f f f
atom_style body rounded/polyhedron 8 8
atom_modify map array sort 0 0
comm_modify vel yes
read_data bodies.data
pair_style body/rounded/polyhedron 0 0 0.5 1 {lammps.RADIUS}
pair_coeff * * {lammps.STIFFNESS} 0
neighbor 0.05 nsq
group held id {held}
group free subtract all held
neigh_modify exclude group held held
fix motion free nve/body
timestep {STEP}
thermo_modify lost ignore
run {steps}
"""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "bodies.data").write_text(lammps.data_file(bodies), encoding="ascii")
        (Path(folder) / "in.lmp").write_text(text, encoding="ascii")
        done = subprocess.run(["lmp", "-in", "in.lmp"], cwd=folder, capture_output=True, text=True, check=True,
                              env={"OMP_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"})
    share, seconds = (float(re.search(pattern, done.stdout)[1])
                      for pattern in (r"([\d.]+)% CPU use", r"Loop time of (\S+)"))
    return share / 100 * seconds / steps


def lammps_row(options):
    if not shutil.which("lmp"):
        raise RunError("LAMMPS is missing: apt-get install lammps")
    times = interleaved([(depth, lambda depth=depth: lammps_time(options.pairs, depth, options.steps))
                         for depth in (DEPTH, LIFTED)], options.blocks)
    return "LAMMPS body/rounded/polyhedron", 1e6 * (times[DEPTH] - times[LIFTED]) / options.pairs, ""


# --- Google Benchmark -------------------------------------------------------------------------------------------------
def program_rows(repetitions):
    """Rows of the C++ program."""
    if not PROGRAM.exists():
        raise RunError(f"{PROGRAM} is missing: scripts/setup --with-bench builds it")
    options = ["--benchmark_format=json", f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.1",
               "--benchmark_enable_random_interleaving=true"]  # other load affects all alike
    found = json.loads(subprocess.run([PROGRAM, *options], check=True, capture_output=True, text=True).stdout)
    median = [b for b in found["benchmarks"] if b.get("aggregate_name") == "median"]
    for b in sorted(median, key=lambda b: b["family_index"]):
        yield *b["run_name"].split("/", 1), b["cpu_time"] * 1e-3, round(b["points"])


def main():
    made = parser(__doc__, blocks=7, steps=50)
    made.add_argument("--pairs", type=count, default=100, help="of YADE and LAMMPS (default %(default)s)")
    made.add_argument("--repetitions", type=count, default=5,
                      help="of Google Benchmark; their median counts (default %(default)s)")
    options = made.parse_args()
    scenes = [(name, "face on face", *values) for name, *values in (*yade_rows(options), lammps_row(options))]
    rows = scenes + list(program_rows(options.repetitions))
    publish(options.out, "peers", "Time per contact pair and step", HEADS, rows)


if __name__ == "__main__":
    run_script(main)
