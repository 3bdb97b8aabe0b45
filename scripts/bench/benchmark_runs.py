# SPDX-License-Identifier: GPL-2.0-or-later
"""CPU time, memory and disk of whole runs and of their pictures.

    yade -n -x scripts/bench/benchmark_runs.py [--duration S] [--out FOLDER]

Disk: files of the results by group.
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPTS = Path(sys.argv[0]).resolve().parents[1]  # YADE runs a script without setting __file__
sys.path.insert(0, str(SCRIPTS / "bench"))

from bench_tools import publish
from timber_houses.base.errors import RunError
from timber_houses.recording.summary import Summary
from timber_houses.study.options import Parser, positive, results_folder, run_script

RUNS = {"A, earthquake": ("modelA_quake.py",), "C2, earthquake and 1 m of snow": ("modelC2_snow.py",),
        "tiled_house, earthquake": ("house.py", "tiled_house", "--quake")}
GROUPS = {"frames": ("frames.h5",), "player": ("player.html",), "pictures": (".png", ".pdf"),
          "checkpoint": ("checkpoint.yade",), "tables": (".csv", ".json")}
"""{group: ends of the names of its files}"""
HEADS = ("run", "elements", "simulated [s]", "CPU time [s]", "CPU time of the pictures [s]", "largest memory [MB]",
         *(f"{group} [MB]" for group in GROUPS))


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--duration", type=positive, metavar="S",
                        help="simulated time [s] (default: that of the motion)")
    parser.add_argument("--out", type=results_folder, help="folder of the CSV file (default: print only)")
    return parser.parse_args()


def sizes(folder):
    """Disk of each group of files [MB]."""
    return [sum(path.stat().st_size for path in folder.iterdir() if path.name.endswith(ends)) / 1e6
            for ends in GROUPS.values()]


def spent(command):
    """(CPU time [s], largest memory [MB]) of a command."""
    process = subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise RunError(f"{' '.join(map(str, command))}: status {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3


def measure(name, command, duration):
    """Row of one run."""
    with tempfile.TemporaryDirectory() as folder:
        limit = ("--duration", f"{duration:g}") if duration else ()
        steps, memory = spent(["yade", "-n", "-x", "-j1", SCRIPTS / command[0], *command[1:], *limit, "--out", folder,
                               "--quiet", "--no-views"])
        pictures, _ = spent([SCRIPTS / "show" / "show_run.py", folder])
        summary = Summary.read(folder)
        return name, summary.elements, summary.duration_s, steps, pictures, memory, *sizes(Path(folder))


def main():
    options = arguments()
    rows = [measure(name, command, options.duration) for name, command in RUNS.items()]
    publish(options.out, "runs", "Whole runs", HEADS, rows)


run_script(main)
