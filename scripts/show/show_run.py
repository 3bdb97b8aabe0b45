#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make every picture of a finished run again, from its recorded frames: show_run.py results/modelC2_snow [...]. Needs no YADE."""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.pictures import all_pictures as pictures  # noqa: E402
from yade_timber.base.errors import RunError  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="+", help="folder of a run's results (it holds frames.h5)")
    parser.add_argument("--out", type=Path, help="folder of the pictures, or of a folder for each of several runs (default: beside the frames)")
    return parser.parse_args()


def main():
    options = arguments()
    names = [folder.resolve().name for folder in options.folder]
    if options.out and len(set(names)) < len(names):
        sys.exit("error: --out: two of the runs have folders of the same name; show them one by one")
    for folder in options.folder:
        out = folder if options.out is None else options.out if len(options.folder) == 1 else options.out / folder.resolve().name
        try:
            out.mkdir(parents=True, exist_ok=True)
            written = pictures.write(out, folder)
        except RunError as problem:
            sys.exit(f"error: {problem}")
        except OSError as problem:
            sys.exit(f"error: {problem.filename}: cannot be written ({problem.strerror})")
        print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()
