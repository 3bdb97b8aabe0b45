#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Export recorded frames as VTK time series: export_vtk.py results/modelC2_snow [--every 4] [--out DIR]. Needs VTK
(python3-vtk9), not YADE.

ParaView opens elements.pvd, joints.pvd and contacts.pvd in DIR (default: the folder vtk beside the frames).
"""
import argparse

from show_common import RECORDED, Parser, errors_in_a_line, frames_path, path

from timber_houses.recording import frames


def positive(text):
    if not text.isdecimal() or int(text[:9]) < 1:
        raise argparse.ArgumentTypeError(f"{text[:40]}: must be a whole number of 1 or more")
    return int(text)


def arguments():
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=path, metavar="folder", help=RECORDED)
    parser.add_argument("--every", type=positive, default=1, metavar="N",
                        help=f"export every N-th of the {frames.FRAMES_PER_SECOND} frames per second (default 1)")
    parser.add_argument("--out", type=path, help="folder to write to (default: the folder vtk beside the frames)")
    return parser.parse_args()


def main():
    options = arguments()
    file = frames_path(options.run)
    out = options.out or file.parent / "vtk"
    with errors_in_a_line(out):
        from timber_houses.pictures import vtk

        written = vtk.export(out, frames.load(file), options.every)
    print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()
