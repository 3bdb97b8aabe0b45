# SPDX-License-Identifier: GPL-2.0-or-later
"""Run the scenes in one program and write its column, docs/mechanics/PROGRAM.csv.

    yade -n -x scripts/bench/mechanics/run_column.py timber [--dt S ...] [--rows KEY ...] [--out FOLDER]
    python3 scripts/bench/mechanics/run_column.py jolt

Programs in YADE: timber, polyhedra. Others: dart, dart_fcl (python3-dartpy), lammps, ode (libode-dev),
siconos (python3-siconos), simbody (libsimbody-dev); jolt, rapier, havok, cannon, bullet, physx,
mujoco (`npm ci` in programs/npm), and those with other settings: jolt_safe, rapier_safe, havok_safe,
bullet_safe, physx_safe, mujoco_safe, simbody_safe.
"""
import argparse
import importlib
import sys
from pathlib import Path

HERE = Path(sys.argv[0]).resolve().parent  # YADE runs a script without setting __file__
sys.path.insert(0, str(HERE.parent))

from mechanics.program import column, write_column

IN_PYTHON = ("timber", "polyhedra", "dart", "lammps", "ode", "siconos", "simbody")


def find(name):
    """A program by its name: MODULE or MODULE_VARIANT, or a function of npm_programs."""
    module, _, variant = name.partition("_")
    if module in IN_PYTHON:
        return getattr(importlib.import_module(f"mechanics.programs.{module}"), variant or "program")()
    return getattr(importlib.import_module("mechanics.programs.npm_programs"), name)()


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("program")
    options.add_argument("--dt", type=float, nargs="+", help="time steps [s]")
    options.add_argument("--rows", nargs="+", help="rows by their keys (default: all)")
    options.add_argument("--out", type=Path, default=HERE.parents[2] / "docs/mechanics", help="folder of the CSV file")
    given = options.parse_args()
    program = find(given.program)
    given.out.mkdir(parents=True, exist_ok=True)
    for row in column(program, given.dt, given.rows):
        write_column(given.out / f"{given.program}.csv", [row])


main()
