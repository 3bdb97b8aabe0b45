# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmark scripts share: timing of blocks of steps, the machine, the results page and its CSV files."""
import csv
import os
import platform
import re
import statistics
import time
from pathlib import Path

import yade.wrapper as yw


def resident_memory():
    """Memory of this process that is in RAM [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


BARE_MEMORY = resident_memory()
"""Before the package is imported, if this module is the first to do it: bare YADE [MB]."""

from yade_timber.base.atomic_write import write_text, written_whole  # noqa: E402

O = yw.Omega()

PAGE = "performance.md"
HEAD = "# Performance\n\nMade by `scripts/bench/benchmark_*.py`, each of which rewrites its own section.\n"
SETTLING = 1.0
"""Simulated time before the measurement in a state of STATES [s]."""
STATES = {"at rest": 0.0, "strong shaking": 18.5}
"""Where in the ground motion the run begins [s]."""
SECTIONS = ("step", "profile", "skips", "peers", "street", "precision")
"""Order on the page."""


def cpu_per_step(steps):
    """CPU time of this process per step over that many steps [s]. Other processes on the machine do not count."""
    since = time.process_time()
    for _ in range(steps):
        O.step()
    return (time.process_time() - since) / steps


def wall_per_step(steps):
    """Wall time per step over that many steps [s]; what counts with several threads."""
    since = time.perf_counter()
    for _ in range(steps):
        O.step()
    return (time.perf_counter() - since) / steps


def interleaved(measures, blocks):
    """Median of each of several measurements [(name, call)], made in turns, so that a machine that slows down hits all alike: {name: [s]}."""
    seen = {name: [] for name, _ in measures}
    for _ in range(blocks):
        for name, call in measures:
            seen[name].append(call())
    return {name: statistics.median(values) for name, values in seen.items()}


def machine():
    """One line: processor, cores, threads of this YADE, load, versions."""
    cpu = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    return f"{cpu.group(1) if cpu else platform.processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; {O.numThreads} thread(s)"


def markdown_table(heads, rows):
    """Rows of texts as a table."""
    line = "| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|\n"
    return line + "".join("| " + " | ".join(str(cell) for cell in row) + " |\n" for row in rows)


def write_csv(path, heads, rows):
    """Table with all digits."""
    with written_whole(path) as part, open(part, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        writer.writerows(rows)


def write_section(folder, name, text):
    """Replace a section of the results page, which lies in `folder`; its other sections stay."""
    page = Path(folder) / PAGE
    old = page.read_text(encoding="utf-8") if page.exists() else ""
    kept = dict(re.findall(r"<!-- (\w+) -->\n(.*?)<!-- /\1 -->\n", old, re.S))
    kept[name] = f"{text.strip()}\n"
    write_text(page, HEAD + "".join(f"\n<!-- {key} -->\n{kept[key]}<!-- /{key} -->\n" for key in SECTIONS if key in kept))


def publish(folder, name, text, heads, rows):
    """Print a section; with a folder, write it to the results page there and its rows to NAME.csv."""
    print(text)
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
        write_csv(folder / f"{name}.csv", heads, rows)
        write_section(folder, name, text)
