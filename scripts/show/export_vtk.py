#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Recorded frames of a run as VTK time series: export_vtk.py results/modelC2_snow [--every 4] [--out DIR]. Needs VTK (python3-vtk9), not YADE.

ParaView opens elements.pvd, joints.pvd and contacts.pvd in DIR (default: the folder vtk beside the frames).
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.recording import frames  # noqa: E402
from yade_timber.base.errors import RunError  # noqa: E402


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: it must be 1 or more")
    return number


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="folder of a run's results (it holds frames.h5)")
    parser.add_argument("--every", type=positive, default=1, metavar="N", help=f"take each N-th of the {frames.FRAMES_PER_SECOND} frames a second (default 1)")
    parser.add_argument("--out", type=Path, help="folder to write to (default: the folder vtk beside the frames)")
    return parser.parse_args()


def main():
    options = arguments()
    try:
        from yade_timber.pictures import vtk as vtk_export

        written = vtk_export.export(options.out or options.folder / "vtk", frames.load(options.folder / frames.NAME), options.every)
    except RunError as problem:
        sys.exit(f"error: {problem}")
    except OSError as problem:
        sys.exit(f"error: {problem}")
    print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()
