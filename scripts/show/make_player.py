#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The player, from the recorded frames of a finished run; with a second run both side by side in step. Needs no YADE.

    make_player.py results/modelA_quake
    make_player.py results/modelA_quake results/modelC_quake --out compare.html
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.recording import frames  # noqa: E402
from yade_timber.pictures import player  # noqa: E402
from yade_timber.base.errors import RunError  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path, help="folder of the results, or its frames.h5")
    parser.add_argument("other", type=Path, nargs="?", help="of the run to compare with")
    parser.add_argument("--out", type=Path, help=f"page to write (default: {player.NAME} in the first folder, of two runs compare_with_<second>.html)")
    return parser.parse_args()


def frames_of(run):
    return run / frames.NAME if run.is_dir() else run


def default_page(run, other):
    folder = frames_of(run).parent
    return folder / (f"compare_with_{frames_of(other).resolve().parent.name}.html" if other else player.NAME)


def main():
    given = arguments()
    page = given.out or default_page(given.run, given.other)
    try:
        player.make([frames_of(run) for run in (given.run, given.other) if run], page)
    except RunError as problem:
        sys.exit(f"error: {problem}")
    except OSError as problem:
        sys.exit(f"error: {page}: cannot write it: {problem.strerror}")
    print(f"{page}: {page.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
