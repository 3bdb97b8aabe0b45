# SPDX-License-Identifier: GPL-2.0-or-later
"""A row of houses: time per element and step, memory per element, speed-up with two threads.

    yade -n -x scripts/bench/benchmark_street.py [--houses 1 2 5 10 50] [--threads 1 2] [--steps 100] [--blocks 7]
    [--rounds 3] [--out FOLDER]

Each row runs in a YADE process of its own: houses at a spacing of 12 m in the strongest part of the synthetic motion.
"""
import argparse
import dataclasses
import json
import statistics
import subprocess
import sys
from pathlib import Path

import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import (BARE_MEMORY, SCALING, cpu_per_step, interleaved, machine, parser, publish, resident_memory,
                         scaling, wall_per_step)
from tables import markdown_table
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.house import build_house, load_house
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines
from timber_houses.study.driver import command
from timber_houses.study.options import count, run_script

O = yw.Omega()

SPACING = 12.0
"""Distance of the centres of two houses, east-west [m]."""
START = 17.6
"""Start of the run in the time of the ground motion [s]."""
WARM_UP = 500
"""Steps before the measurement."""
HEADS = ("houses", "threads", "elements", "CPU time per step [us]", "wall time per step [us]",
         "CPU time per element and step [us]", "memory per element [kB]", "memory above bare YADE [MB]")


def arguments():
    made = parser(__doc__, blocks=7, steps=100, house_name="C")
    made.add_argument("--houses", type=count, nargs="+", default=[1, 2, 5, 10, 50], metavar="N",
                      help="numbers of houses (default 1 2 5 10 50)")
    made.add_argument("--threads", type=count, nargs="+", default=[1, 2], metavar="N",
                      help="numbers of threads (default 1 2)")
    made.add_argument("--rounds", type=count, default=3,
                      help="processes for each row, run alternately; their median counts (default %(default)s)")
    # Of the process that measures one row of houses
    made.add_argument("--single", action="store_true", help=argparse.SUPPRESS)
    return made.parse_args()


# --- one street -------------------------------------------------------------------------------------------------------
def moved(part, displacement, **changes):
    """Element or joint of another house of the row."""
    points = "vertices" if hasattr(part, "vertices") else "points"
    return dataclasses.replace(part, **{points: getattr(part, points) + displacement}, **changes)


def street(model, houses):
    """Model of a row: elements and joints of all houses, on the lengthened ground of the first one."""
    elements, joints = [], []
    for k in range(houses):
        displacement = (SPACING * k, 0.0, 0.0)
        elements += [moved(e, displacement, name=f"{k}.{e.name}") for e in model.elements if e.kind != "ground"]
        joints += [moved(j, displacement, a=f"{k}.{j.a}", b=f"{k}.{j.b}") for j in model.joints]
    for ground in model.of_kind("ground"):
        corners = ground.vertices.copy()
        corners[corners[:, 0] > corners[:, 0].mean(), 0] += SPACING * (houses - 1)
        elements.append(dataclasses.replace(ground, vertices=corners))
    return dataclasses.replace(model, elements=elements, joints=joints)


def build(options, houses):
    """The row of houses in YADE, in strong shaking."""
    model = street(build_house(load_house(options.house), snow_depth=0.0), houses)
    O.reset()
    joints = scenario.add_joints(model, scenario.add_elements(model))
    motion = engines.ground_motion_engine(default_motion(), start=-START)
    O.engines = engines.engines(ground_motion=motion, joints=joints, **scenario.law_options(model.law))
    O.dt = DEFAULT_DT
    cpu_per_step(WARM_UP)


def engine_times(steps):
    """{engine: wall time per step [us]} of the present scene."""
    O.timingEnabled = True
    for engine in O.engines:
        engine.execTime = 0
    cpu_per_step(steps)
    O.timingEnabled = False
    return {type(engine).__name__: engine.execTime * 1e-3 / steps for engine in O.engines}


def single(options):
    """Measurements of one row of houses as a dictionary."""
    build(options, options.houses[0])
    times = interleaved([("cpu", lambda: cpu_per_step(options.steps)), ("wall", lambda: wall_per_step(options.steps))],
                        options.blocks)
    memory = resident_memory() - BARE_MEMORY
    return {"houses": options.houses[0], "threads": O.numThreads, "elements": len(O.bodies), "memory": memory, **times,
            "engines": engine_times(options.steps)}


# --- all of them ------------------------------------------------------------------------------------------------------
def measure(options, houses, threads):
    """`single` in a process of its own."""
    arguments = [*command(sys.argv[0], threads), "--single", "--house", options.house, "--houses", str(houses),
                 "--steps", str(options.steps)]
    done = subprocess.run([*arguments, "--blocks", str(options.blocks)], stdin=subprocess.DEVNULL, capture_output=True,
                          text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        raise RunError(f"{houses} houses on {threads} thread(s): {done.stderr.strip().splitlines()[-1:]}")
    return json.loads(lines[-1])


def median(measured):
    """Medians of the measurements of one row; a single measurement may err by half when other processes use the memory.
    """
    engines = {name: statistics.median(m["engines"][name] for m in measured) for name in measured[0]["engines"]}
    return {**measured[0], **{key: statistics.median(m[key] for m in measured) for key in ("cpu", "wall", "memory")},
            "engines": engines}


def measure_all(options):
    """Measurement of each number of houses and threads, in alternating rounds."""
    cases = [(houses, threads) for houses in options.houses for threads in options.threads]
    rounds = [[measure(options, *case) for case in cases] for _ in range(options.rounds)]
    return [median(same) for same in zip(*rounds)]


def row(m):
    return (m["houses"], m["threads"], m["elements"], m["cpu"] * 1e6, m["wall"] * 1e6, m["cpu"] * 1e6 / m["elements"],
            m["memory"] * 1e3 / m["elements"], m["memory"])


def section(found, house, rounds):
    """Section of the results page."""
    names = [name for name in found[0]["engines"] if any(m["engines"][name] > 0.01 for m in found)]
    engines = [(m["houses"], m["threads"], *(f"{m['engines'][n] / m['elements'] * 1e3:.0f}" for n in names))
               for m in found]
    return (
        f"## Rows of houses\n\nHouse {house} in strong shaking, dt = {DEFAULT_DT:g} s: medians of {rounds} processes"
        f" each, run alternately. {machine()}.\n\n{markdown_table(SCALING, list(scaling(found)))}\n"
        f"Wall time of each engine per element and step [ns]:\n\n"
        f"{markdown_table(('houses', 'threads', *names), engines)}"
    )


def main():
    options = arguments()
    if options.single:
        print(json.dumps(single(options)), flush=True)
        return
    found = measure_all(options)
    publish(options.out, "street", section(found, options.house, options.rounds), HEADS, [row(m) for m in found])


run_script(main)
