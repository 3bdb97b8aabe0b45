# SPDX-License-Identifier: GPL-2.0-or-later
"""A street of houses: time per element and step, memory per element, speed-up with two threads.

    yade -n -x scripts/bench/benchmark_street.py [--houses 1 2 5 10 50] [--threads 1 2] [--steps 100] [--blocks 7] [--rounds 3] [--out FOLDER]

Each street runs in a YADE process of its own: house C, 12 m from the next one, in the strongest part of the synthetic motion.
"""
import argparse
import dataclasses
import json
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import BARE_MEMORY, cpu_per_step, interleaved, machine, markdown_table, publish, resident_memory, wall_per_step  # noqa: E402
from yade_timber.scene import scenario  # noqa: E402
from yade_timber.scene import engines as scene  # noqa: E402
from yade_timber.house import build_house, load_house  # noqa: E402
from yade_timber.motion import default_motion  # noqa: E402

O = yw.Omega()

SPACING = 12.0
"""Between houses, from centre to centre, east-west [m]."""
START = 17.6
"""Where in the motion the run begins [s]."""
WARM_UP = 500
"""Steps before the measurement."""
HEADS = ("houses", "threads", "elements", "CPU time per step [us]", "wall time per step [us]", "CPU time per element and step [us]", "memory per element [kB]", "memory above bare YADE [MB]")


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark_street.py", description=__doc__.splitlines()[0])
    parser.add_argument("--house", default="C", help="shipped house or YAML file (default %(default)s)")
    parser.add_argument("--houses", type=int, nargs="+", default=[1, 2, 5, 10, 50], metavar="N", help="lengths of the street (default 1 2 5 10 50)")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2], metavar="N", help="numbers of threads (default 1 2)")
    parser.add_argument("--steps", type=int, default=100, help="steps per block (default %(default)s)")
    parser.add_argument("--blocks", type=int, default=7, help="blocks; the median counts (default %(default)s)")
    parser.add_argument("--rounds", type=int, default=3, help="processes of each street, in turns; medians count (default %(default)s)")
    parser.add_argument("--out", type=Path, help="folder whose performance.md and street.csv get the result")
    parser.add_argument("--single", action="store_true", help="measure one street in this process and print it as JSON")
    return parser.parse_args()


# --- one street --------------------------------------------------------------------------------------------------------
def moved(part, way, **changes):
    """Element or joint of another house of the street."""
    places = "vertices" if hasattr(part, "vertices") else "points"
    return dataclasses.replace(part, **{places: getattr(part, places) + way}, **changes)


def street(model, houses):
    """Model of a street: elements and joints of all houses, on the ground of the first one, made long enough."""
    elements, joints = [], []
    for k in range(houses):
        way = (SPACING * k, 0.0, 0.0)
        elements += [moved(e, way, name=f"{k}.{e.name}") for e in model.elements if e.kind != "ground"]
        joints += [moved(j, way, a=f"{k}.{j.a}", b=f"{k}.{j.b}") for j in model.joints]
    for ground in model.of_kind("ground"):
        corners = ground.vertices.copy()
        corners[corners[:, 0] > corners[:, 0].mean(), 0] += SPACING * (houses - 1)
        elements.append(dataclasses.replace(ground, vertices=corners))
    return dataclasses.replace(model, elements=elements, joints=joints)


def build(options, houses):
    """The street in YADE, in strong shaking."""
    model = street(build_house(load_house(options.house), snow_depth=0.0), houses)
    O.reset()
    joints = scenario.add_joints(model, scenario.add_elements(model))
    motion = scene.ground_motion_engine(default_motion(), start=-START)
    O.engines = scene.engines(ground_motion=motion, joints=joints, **scenario.law_options(model.law))
    O.dt = scenario.DEFAULT_DT
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
    """Measurements of one street as a dictionary."""
    build(options, options.houses[0])
    times = interleaved([("cpu", lambda: cpu_per_step(options.steps)), ("wall", lambda: wall_per_step(options.steps))], options.blocks)
    memory = resident_memory() - BARE_MEMORY
    return {"houses": options.houses[0], "threads": O.numThreads, "elements": len(O.bodies), "memory": memory, **times, "engines": engine_times(options.steps)}


# --- all of them -------------------------------------------------------------------------------------------------------
def measure(options, houses, threads):
    """`single` in a process of its own."""
    command = [shutil.which("yade") or "yade", f"-j{threads}", "-n", "-x", sys.argv[0], "--single", "--house", options.house]
    command += ["--houses", str(houses), "--steps", str(options.steps), "--blocks", str(options.blocks)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        sys.exit(f"error: street of {houses} houses on {threads} thread(s): {done.stderr.strip().splitlines()[-1:]}")
    return json.loads(lines[-1])


def median(measured):
    """Medians of the measurements of one street: neighbours on the machine share its memory, and one round alone may be off by half."""
    engines = {name: statistics.median(m["engines"][name] for m in measured) for name in measured[0]["engines"]}
    return {**measured[0], **{key: statistics.median(m[key] for m in measured) for key in ("cpu", "wall", "memory")}, "engines": engines}


def measure_all(options):
    """A measurement of each street and number of threads; rounds in turns."""
    streets = [(houses, threads) for houses in options.houses for threads in options.threads]
    rounds = [[measure(options, *street) for street in streets] for _ in range(options.rounds)]
    return [median(same) for same in zip(*rounds)]


def row(m):
    return m["houses"], m["threads"], m["elements"], m["cpu"] * 1e6, m["wall"] * 1e6, m["cpu"] * 1e6 / m["elements"], m["memory"] * 1e3 / m["elements"], m["memory"]


def section(found, house, rounds):
    """Text of the results page."""
    one = {m["houses"]: m for m in found if m["threads"] == 1}
    shown = []
    for m in found:
        base, same = one.get(min(one, default=None)), one.get(m["houses"])
        share = m["cpu"] / m["elements"] / (base["cpu"] / base["elements"]) if m["threads"] == 1 else None
        speed_up = same["wall"] / m["wall"] if same and m["threads"] > 1 else None
        cells = [m["houses"], m["threads"], m["elements"], f"{m['wall'] * 1e6:.0f}", f"{m['cpu'] * 1e6 / m['elements']:.2f}"]
        shown.append(cells + [f"{x:.2f}" if x else "" for x in (share, speed_up)] + [f"{m['memory'] * 1e3 / m['elements']:.0f}", f"{m['memory']:.0f}"])
    heads = ("houses", "threads", "elements", "wall time per step [us]", "CPU time per element and step [us]", "cost per element against one house", "speed-up", "memory per element [kB]", "above bare YADE [MB]")
    names = [name for name in found[0]["engines"] if any(m["engines"][name] > 0.01 for m in found)]
    engines = [(m["houses"], m["threads"], *(f"{m['engines'][n] / m['elements'] * 1e3:.0f}" for n in names)) for m in found]
    return (
        f"## A street of houses\n\nHouse {house} in strong shaking, dt = {scenario.DEFAULT_DT:g} s: medians of {rounds} processes each, in turns. {machine()}.\n\n{markdown_table(heads, shown)}\n"
        f"Wall time of each engine per element and step [ns]:\n\n{markdown_table(('houses', 'threads', *names), engines)}"
    )


def main():
    options = arguments()
    if options.single:
        print(json.dumps(single(options)), flush=True)
        return
    found = measure_all(options)
    publish(options.out, "street", section(found, options.house, options.rounds), HEADS, [row(m) for m in found])


main()
