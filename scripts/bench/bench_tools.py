# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared by the benchmarks: options, timing of blocks of steps, description of the machine, CSV files."""
import csv
import os
import platform
import re
import statistics
import time
from pathlib import Path

import yade.wrapper as yw
from tables import markdown_table
from timber_houses.base.atomic_write import written_whole
from timber_houses.study.options import Parser, count, house, results_folder

O = yw.Omega()

MACHINES = "machines.csv"
"""Where each table of the folder was measured."""
SETTLING = 1.0
"""Simulated time before the measurement in one of STATES [s]."""
STATES = {"at rest": 0.0, "strong shaking": 18.5}
"""{state: start of the run in the time of the ground motion [s]}."""


def parser(about, steps, blocks=None):
    """ArgumentParser of a benchmark of a house; blocks, steps: defaults of --blocks (None: no such option), --steps."""
    made = Parser(about)
    made.add_argument("--house", type=house, default="C2", help="shipped house or YAML file (default %(default)s)")
    if blocks:
        made.add_argument("--blocks", type=count, default=blocks,
                          help="number of repeated measurements; their median counts (default %(default)s)")
    made.add_argument("--steps", type=count, default=steps, help="steps per block (default %(default)s)")
    made.add_argument("--out", type=results_folder, help="folder of the CSV file (default: print only)")
    return made


def cpu_per_step(steps):
    """CPU time of this process per step, mean of that many steps [s]; independent of other processes."""
    since = time.process_time()
    for _ in range(steps):
        O.step()
    return (time.process_time() - since) / steps


def wall_per_step(steps):
    """Wall time per step, mean of that many steps [s]; for runs with several threads."""
    since = time.perf_counter()
    for _ in range(steps):
        O.step()
    return (time.perf_counter() - since) / steps


def interleaved(measures, blocks):
    """{name: median [s]} of several measurements [(name, call)], made alternately so that a slower machine affects all
    alike.
    """
    times = {name: [] for name, _ in measures}
    for _ in range(blocks):
        for name, call in measures:
            times[name].append(call())
    return {name: statistics.median(values) for name, values in times.items()}


def machine():
    """One line: processor, cores, threads of this YADE, load, versions."""
    cpu = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    return (
        f"{cpu.group(1) if cpu else platform.processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f};"
        f" {O.numThreads} thread(s)"
    )


def write_csv(path, heads, rows):
    """Write a CSV file with all digits."""
    with written_whole(path) as part, open(part, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        writer.writerows(rows)


def write_table(folder, name, heads, rows):
    """Write NAME.csv to a folder, and the machine of this process to its list of machines."""
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(folder / f"{name}.csv", heads, rows)
    path = folder / MACHINES
    machines = dict(csv.reader(path.read_text(encoding="utf-8").splitlines())) if path.exists() else {}
    machines.pop("table", None)
    write_csv(path, ("table", "machine"), sorted({**machines, name: machine()}.items()))


def publish(folder, name, title, heads, rows):
    """Print a measurement as a table; with a folder, write its rows to NAME.csv there."""
    shown = [[f"{cell:.4g}" if isinstance(cell, float) else cell for cell in row] for row in rows]
    print(f"## {title}. {machine()}\n\n{markdown_table(heads, shown)}")
    if folder:
        write_table(folder, name, heads, rows)
