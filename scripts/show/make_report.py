#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the one-page report of finished runs: report.html, and report.pdf where Chromium is installed. Needs no YADE.

    make_report.py results/modelC2_snow [...]
    make_report.py results/harbour/lots/corner --language ja

With --language it makes the shorter page for the owner of the house: owner.en.html or owner.ja.html.
"""
from show_common import Parser, errors_in_a_line, path

from timber_houses.pictures import owner, report


def arguments():
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=path, nargs="+",
                        help="folder of a run's results (with frames.h5 and summary.json)")
    parser.add_argument("--language", choices=tuple(owner.LANGUAGES), help="make the owner's page in it instead")
    return parser.parse_args()


def main():
    options = arguments()
    for folder in options.folder:
        with errors_in_a_line(folder):
            written = owner.write(folder, report.recorded(folder), [options.language]) if options.language else (
                report.write(folder))
        missing = "" if options.language or len(written) == 2 else f" (no {report.PDF}: it needs chromium)"
        print(f"written: {', '.join(map(str, written))}{missing}")


if __name__ == "__main__":
    main()
