#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the player page of a recorded run, or of two runs side by side in step. Needs no YADE.

    make_player.py results/modelA_quake
    make_player.py results/modelA_quake results/modelC_quake --out compare.html
"""
import argparse

from show_common import RECORDED, Parser, errors_in_a_line, frames_path, path

from timber_houses.pictures import player
from timber_houses.pictures.all_pictures import PLAYER
from timber_houses.recording import frames


def arguments():
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=path, help=RECORDED)
    parser.add_argument("other", type=path, nargs="?", help="a second run, for comparison")
    parser.add_argument(
        "--out", type=path,
        help=f"page to write (default: {PLAYER} in the first folder; for two runs compare_with_<second>.html)"
    )
    return parser.parse_args()


def main():
    options = arguments()
    files = [frames_path(run) for run in (options.run, options.other) if run]
    name = PLAYER if len(files) == 1 else f"compare_with_{files[1].resolve().parent.name}.html"
    page = options.out or files[0].parent / name
    with errors_in_a_line(page):
        player.make([(file, frames.load(file)) for file in files], page)
    print(f"{page}: {page.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
