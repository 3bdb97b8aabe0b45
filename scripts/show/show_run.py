#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the pictures of recorded runs again: show_run.py results/C2 [...] [--out DIR] [--pdf]. Needs no YADE."""
import sys

from show_common import RECORDED, Parser, errors_in_a_line, frames_path, path

from timber_houses.base.files import make_folder
from timber_houses.pictures import all_pictures


def arguments():
    parser = Parser(description=__doc__)
    parser.add_argument("folder", type=path, nargs="+", help=RECORDED)
    parser.add_argument("--out", type=path,
                        help="folder to write to; for several runs a folder for each (default: beside the frames)")
    parser.add_argument("--pdf", action="store_true", help="write sheets and curves as PDF, too")
    return parser.parse_args()


def main():
    options = arguments()
    names = [folder.resolve().name for folder in options.folder]
    if options.out and len(set(names)) < len(names):
        sys.exit("error: --out: two runs have folders of the same name; show them one by one")
    for given in options.folder:
        file = frames_path(given)
        out = (file.parent if options.out is None else options.out if len(options.folder) == 1
               else options.out / given.resolve().name)
        with errors_in_a_line(out):
            if out != file.parent:
                make_folder(out)
            written = all_pictures.write(out, file, options.pdf)
        print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()
