# SPDX-License-Identifier: GPL-2.0-or-later
"""Towns: time per element and step, memory per element, speed-up with two threads.

    yade -n -x scripts/bench/benchmark_town.py [--houses 1 5 50 200] [--threads 1 2] [--chunks 4] [--rounds 3] [--out
    FOLDER]

Each town runs in a YADE process of its own, with frames and monitors as in scripts/town.py: the same house on each lot,
in the strongest part of the synthetic motion. A chunk is the steps between two frames.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import BARE_MEMORY, SCALING, machine, parser, publish, resident_memory, scaling
from tables import markdown_table
from yade_timber.plugin import compiled
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.run import cli, town
from timber_houses.run.plan import planned
from timber_houses.study.driver import command
from timber_houses.study.options import count, run_script

SPACING = 14.0
"""Distance of the lots, which form rows of ten. [m]"""
START = 17.6
"""Start of the run in the time of the ground motion [s]."""
WARM_UP = 1
"""Chunks before the measurement."""
HEADS = ("houses", "threads", "elements", "time per element and step [us]", "wall time per step of all houses [us]",
         "memory per element [kB]", "memory above bare YADE [MB]")


def arguments():
    made = parser(__doc__, blocks=1, steps=1, house_name="C")
    made.add_argument("--houses", type=count, nargs="+", default=[1, 5, 50, 200], metavar="N",
                      help="numbers of houses (default 1 5 50 200)")
    made.add_argument("--threads", type=count, nargs="+", default=[1, 2], metavar="N",
                      help="numbers of threads (default 1 2)")
    made.add_argument("--chunks", type=count, default=10,
                      help="measured chunks of steps; their median counts (default %(default)s)")
    made.add_argument("--rounds", type=count, default=3,
                      help="processes for each row, run alternately; their median counts (default %(default)s)")
    made.add_argument("--single", action="store_true", help=argparse.SUPPRESS)  # of the process that measures one town
    return made.parse_args()


def town_file(folder, house, houses):
    """Write a town file of equal houses; returns its path."""
    lots = "".join(f"  h{k}: {{house: {house}, x: {SPACING * (k % 10)}, y: {SPACING * (k // 10)}}}\n"
                   for k in range(houses))
    path = Path(folder) / "town.yaml"
    path.write_text(f"lots:\n{lots}")
    return path


def single(options):
    """Measurements of one town as a dictionary."""
    houses = options.houses[0]
    with tempfile.TemporaryDirectory() as folder:
        path = town_file(folder, options.house, houses)
        given = ["town.py", str(path), "--quake", "--start", str(START), "--snow", "0", "--out", folder, "--checkpoint",
                 "0", "--quiet", "--no-views"]
        chosen = cli.read_town(given)
        plan = planned(chosen)
        run = town.TownRun(plan, chosen)
        active = run._first_steps()
        for _ in range(WARM_UP):
            active = run._chunk(active)
        steps = run.runs[0].chunk
        found = {"wall": [], "cpu": []}
        for _ in range(options.chunks):
            since = time.perf_counter(), time.process_time()
            active = run._chunk(active)
            for key, begin, now in zip(found, since, (time.perf_counter(), time.process_time())):
                found[key].append((now - begin) / steps)
        elements = sum(len(one.model.elements) for one in run.runs)
        memory = resident_memory() - BARE_MEMORY
    times = {key: statistics.median(values) for key, values in found.items()}
    return {"houses": houses, "threads": compiled.thread_count(), "elements": elements, "memory": memory, **times}


def measure(options, houses, threads):
    """`single` in a process of its own."""
    arguments = [*command(sys.argv[0], threads), "--single", "--house", options.house, "--houses", str(houses),
                 "--chunks", str(options.chunks)]
    done = subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        raise RunError(f"{houses} houses on {threads} thread(s): {done.stderr.strip().splitlines()[-1:]}")
    return json.loads(lines[-1])


def measure_all(options):
    """Measurement of each number of houses and threads: medians of alternating rounds."""
    cases = [(houses, threads) for houses in options.houses for threads in options.threads]
    rounds = [[measure(options, *case) for case in cases] for _ in range(options.rounds)]
    return [{**same[0], **{key: statistics.median(m[key] for m in same) for key in ("cpu", "wall", "memory")}}
            for same in zip(*rounds)]


def row(m):
    return (m["houses"], m["threads"], m["elements"], m["cpu"] * 1e6 / m["elements"], m["wall"] * 1e6,
            m["memory"] * 1e3 / m["elements"], m["memory"])


def section(found, options):
    """Section of the results page."""
    return (
        f"## Towns\n\nHouse {options.house} on each lot, in strong shaking, dt = {DEFAULT_DT:g} s, with frames: medians"
        f" of {options.chunks} chunks in {options.rounds} process(es) each, run alternately."
        f" {machine()}.\n\n{markdown_table(SCALING, list(scaling(found)))}"
    )


def main():
    options = arguments()
    if options.single:
        print(json.dumps(single(options)), flush=True)
        return
    found = measure_all(options)
    publish(options.out, "town", section(found, options), HEADS, [row(m) for m in found])


run_script(main)
