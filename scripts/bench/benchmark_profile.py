# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the time of a step goes: instructions of each part of it, counted by callgrind, which no other load disturbs.

    yade -j1 -n -x scripts/bench/benchmark_profile.py [--house C2] [--steps 200] [--against FOLDER] [--out FOLDER]

The house stands under snow at rest, and in strong shaking. --against: another build of the package (a folder for PYTHONPATH), counted
as well, for before and after. Needs valgrind (scripts/setup --with-bench).
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import SETTLING, STATES, markdown_table, publish  # noqa: E402
from yade_timber.scene import scenario  # noqa: E402
from yade_timber.scene import engines as scene  # noqa: E402
from yade_timber.motion import default_motion  # noqa: E402

O = yw.Omega()

STEP = "Scene::moveToNextTimeStep()"
PARTS = {  # part -> functions that it consists of, and those within them that are parts of their own
    "contact points: search for candidates": (("timber::searchCandidates(",), ()),
    "contact points: of the candidates": (("timber::updateManifold(",), ("timber::searchCandidates(",)),
    "elastic law": (("Law2_ManifoldGeom_TimberPhys_Hertz::go(", "Law2_ManifoldGeom_SnowPhys_Linear::go("), ()),
    "dashpots: rows": (("ContactForces::collectPairs()", "ContactForces::collectBodies()", "timber::setRows("), ()),
    "dashpots: sweeps": (("DashpotSolver::solve(",), ()),
    "forces and energies of the points": (("timber::takeForces(",), ()),
    "joints": (("JointEngine::action()",), ()),
    "integrator": (("SymplecticIntegrator::action()",), ()),
    "collider": (("CollisionTrigger::action()", "InsertionSortCollider::action()"), ()),
}
REST = "loop over contacts, gravity, ground motion, monitor"
HEADS = ("part", *(f"{state} [1000 instructions a step]" for state in STATES), *(f"{state}, share" for state in STATES))


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark_profile.py", description=__doc__.splitlines()[0])
    parser.add_argument("--house", default="C2", help="shipped house or YAML file (default %(default)s)")
    parser.add_argument("--steps", type=int, default=200, help="counted steps (default %(default)s)")
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="another build of the package: the folder that holds yade_timber")
    parser.add_argument("--out", type=Path, help="folder whose performance.md and profile.csv get the result")
    parser.add_argument("--state", choices=STATES, help=argparse.SUPPRESS)  # what this script asks of itself under callgrind
    return parser.parse_args()


def run_state(options):
    """The house in one state, with counting switched on once it has settled."""
    scenario.build(scenario.Scenario("profile", options.house, default_motion(), 1.0, options={"skip_rest": 0}))
    scene.find_engine(yw.GroundMotionEngine).start = -STATES[options.state]
    O.run(round(SETTLING / O.dt), True)
    subprocess.run(["callgrind_control", "--instr=on", str(os.getpid())], check=True, stdout=subprocess.DEVNULL)
    O.run(options.steps, True)


def count(options, state, package, folder):
    """Instructions per step of each function with what it calls, {name: number}; package: folder for PYTHONPATH, or None for this one."""
    out = Path(folder) / "callgrind.out"
    yade = ["--tool=callgrind", "--instr-atstart=no", f"--toggle-collect=*{STEP}", f"--callgrind-out-file={out}", sys.executable, shutil.which("yade")]
    child = ["-j1", "-n", "-x", sys.argv[0], "--house", options.house, "--steps", str(options.steps), "--state", state]
    path = {"PYTHONPATH": os.pathsep.join([str(package), os.environ.get("PYTHONPATH", "")])} if package else {}
    subprocess.run(["valgrind", *yade, *child], check=True, env={**os.environ, **path}, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(out)], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"^\s*([\d,]+) \([^)]*\)\s+\S+?:(.*?)(?: \[[^]]*\])?$", text, re.M)
    return {name: int(number.replace(",", "")) / options.steps for number, name in found}


def of(counts, functions):
    """Instructions of these functions; of several that match, as a parallel region within its engine, the outermost."""
    return sum(max((number for name, number in counts.items() if function in name and "[clone" not in name), default=0) for function in functions)


def parts(counts):
    """Instructions per step of each part, and of a whole step, [1000]."""
    numbers = {part: (of(counts, functions) - of(counts, within)) / 1000 for part, (functions, within) in PARTS.items()}
    whole = of(counts, (STEP,)) / 1000
    return {**numbers, REST: whole - sum(numbers.values()), "whole step": whole}


def profile(options, package):
    """Rows of the table for a build of the package."""
    with tempfile.TemporaryDirectory() as folder:
        states = {state: parts(count(options, state, package, folder)) for state in STATES}
    shares = {state: [number / found["whole step"] for number in found.values()] for state, found in states.items()}
    names = [*PARTS, REST, "whole step"]
    return [(name, *(states[state][name] for state in STATES), *(shares[state][k] for state in STATES)) for k, name in enumerate(names)]


def shown(rows):
    half = len(STATES) + 1
    return markdown_table(HEADS, [(row[0], *(f"{n:.0f}" for n in row[1:half]), *(f"{100 * n:.0f} %" for n in row[half:])) for row in rows])


def main():
    options = arguments()
    if options.state:
        return run_state(options)
    if not shutil.which("valgrind"):
        sys.exit("error: no valgrind on the PATH: install it (scripts/setup --with-bench)")
    rows = profile(options, None)
    text = f"## Where the time goes\n\nHouse {options.house}, 1 m of snow: instructions of {options.steps} steps, counted by callgrind; one thread.\n\n{shown(rows)}"
    if options.against:
        text += f"\nBefore:\n\n{shown(profile(options, options.against))}"
    publish(options.out, "profile", text, HEADS, rows)


main()
