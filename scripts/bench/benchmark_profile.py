# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions of each part of a step, counted by callgrind, independent of the load of the machine.

    yade -j1 -n -x scripts/bench/benchmark_profile.py [--house C2] [--steps 200] [--out FOLDER]

The house stands under snow at rest, and in strong shaking. Needs valgrind (scripts/setup --with-bench).
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

from bench_tools import SETTLING, STATES, parser, publish
from timber_houses.base.errors import RunError
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines
from timber_houses.study.options import run_script

O = yw.Omega()

STEP = "Scene::moveToNextTimeStep()"
PARTS = {  # part -> its functions, and functions called by them that are parts of their own
    "contact points: search for feature pairs": (("timber::searchCandidates(",), ()),
    "contact points: update": (("timber::updateManifold(",), ("timber::searchCandidates(",)),
    "elastic law": (("Law2_ManifoldGeom_TimberPhys_Hertz::go(", "Law2_ManifoldGeom_SnowPhys_Linear::go("), ()),
    "contact solver: preparation": (
        ("ContactForces::collectPairs()", "ContactForces::collectBodies()", "timber::prepareContacts("), ()
    ),
    "contact solver: sweeps": (("ContactSolver::solve(",), ()),
    "contact solver: forces and energies": (("timber::storeForces(",), ()),
    "joints": (("JointEngine::action()",), ()),
    "integrator": (("SymplecticIntegrator::action()",), ()),
    "collider": (("CollisionTrigger::action()",), ()),
}
OTHERS = "contact loop, gravity, ground motion, monitor"
HEADS = ("part", *(f"{state} [1000 instructions a step]" for state in STATES), *(f"{state}, share" for state in STATES))


def arguments():
    made = parser(__doc__, steps=200)
    made.add_argument("--state", choices=STATES, help=argparse.SUPPRESS)  # of the process that callgrind observes
    return made.parse_args()


def run_state(options):
    """Run the house in one state; instructions are counted after it has settled."""
    scenario.build(scenario.Scenario("profile", options.house, default_motion(), 1.0, options={"skip_rest": 0}))
    engines.find_engine(yw.GroundMotionEngine).start = -STATES[options.state]
    O.run(round(SETTLING / O.dt), True)
    subprocess.run(["callgrind_control", "--instr=on", str(os.getpid())], check=True, stdout=subprocess.DEVNULL)
    O.run(options.steps, True)


def count(options, state, folder):
    """{function: instructions per step, with those of the functions it calls}."""
    out = Path(folder) / "callgrind.out"
    yade = ["--tool=callgrind", "--instr-atstart=no", f"--toggle-collect=*{STEP}", f"--callgrind-out-file={out}",
            sys.executable, shutil.which("yade")]
    child = ["-j1", "-n", "-x", sys.argv[0], "--house", options.house, "--steps", str(options.steps), "--state", state]
    subprocess.run(["valgrind", *yade, *child], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(out)], check=True,
                          capture_output=True, text=True).stdout
    found = re.findall(r"^\s*([\d,]+) \([^)]*\)\s+\S+?:(.*?)(?: \[[^]]*\])?$", text, re.M)
    return {name: int(number.replace(",", "")) / options.steps for number, name in found}


def instructions(counts, functions):
    """Instructions of these functions; of several matches (a parallel region and its engine) the outermost."""
    return sum(max((number for name, number in counts.items() if function in name and "[clone" not in name), default=0)
               for function in functions)


def parts(counts):
    """Instructions per step of each part, and of a whole step, [1000]."""
    numbers = {part: (instructions(counts, functions) - instructions(counts, within)) / 1000
               for part, (functions, within) in PARTS.items()}
    whole = instructions(counts, (STEP,)) / 1000
    return {**numbers, OTHERS: whole - sum(numbers.values()), "whole step": whole}


def check_names(counts):
    """Every function of PARTS occurs in one of the states; otherwise it was renamed. counts: [{function:
    instructions}]. Raises RunError.
    """
    for function in (name for functions, _ in PARTS.values() for name in functions):
        if not any(function in name for found in counts for name in found):
            raise RunError(f"callgrind has counted no function {function}...: has it been renamed?")


def profile(options):
    """Rows of the table."""
    with tempfile.TemporaryDirectory() as folder:
        counts = {state: count(options, state, folder) for state in STATES}
    check_names(counts.values())
    states = {state: parts(found) for state, found in counts.items()}
    shares = {state: [number / found["whole step"] for number in found.values()] for state, found in states.items()}
    names = [*PARTS, OTHERS, "whole step"]
    return [(name, *(states[state][name] for state in STATES), *(shares[state][k] for state in STATES))
            for k, name in enumerate(names)]


def main():
    options = arguments()
    if options.state:
        return run_state(options)
    if not shutil.which("valgrind"):
        raise RunError("no valgrind on the PATH: install it (scripts/setup --with-bench)")
    title = f"Instructions of a step, house {options.house}, 1 m of snow, {options.steps} steps"
    publish(options.out, "profile", title, HEADS, profile(options))


run_script(main)
