#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Print counts, weights and diagnosis of a house, draw it and its pushover curves, and check that it bears its own
weight: show_house.py C2 [--snow 1.0] [--out house.png] [--draw-only].

Without YADE the check is left out.
"""
import json
from pathlib import Path

from show_common import Parser, errors_in_a_line, file_name, path

from timber_houses.base.atomic_write import write_text
from timber_houses.base.errors import RunError
from timber_houses.base.notes import noted
from timber_houses.house import btlx_text, build_house, diagnose, load_house, shipped_houses, weigh
from timber_houses.pictures import drawings, report_pictures
from timber_houses.pictures.figures import save, stem_and_endings
from timber_houses.study.probe import check_own_weight


def arguments():
    parser = Parser(description=__doc__)
    parser.add_argument("house", help=f"{', '.join(shipped_houses())}, a house file or a BTLx file")
    parser.add_argument("--yaml", type=path, help="write what is read of a BTLx file as a house file, and end")
    parser.add_argument("--snow", type=float, default=None, help="snow depth [m] (default: that of the house)")
    parser.add_argument("--out", type=path, help="picture to write, .png or .pdf (default: house_<name>.png)")
    parser.add_argument("--draw-only", action="store_true", help="leave the check out, which takes some seconds")
    return parser.parse_args()


def pushovers(path, structures):
    """Write the pushover curves of the structures beside the drawings; returns the paths."""
    stem, endings = stem_and_endings(path)
    drawn = {name: report_pictures.pushover(name, structure) for name, structure in structures.items()}
    return [written for name, figure in drawn.items() if figure is not None
            for written in save(figure, stem.with_name(f"{stem.name}_pushover_{name}"), endings)]


def write_yaml(house, target):
    """Write the frame of a BTLx file as a house file."""
    with noted():
        text = btlx_text(Path(house))
    write_text(target, f"# Read from {Path(house).name}\n{text}")
    print(f"written: {target}")


def main():
    options = arguments()
    if options.yaml:
        with errors_in_a_line(options.yaml):
            write_yaml(options.house, options.yaml)
        return
    with errors_in_a_line(options.out or "the picture"):
        with noted():
            model = build_house(load_house(options.house), options.snow)
        judged = diagnose(model)
        print(json.dumps({**model.counts(), "weight": weigh(model), "diagnosis": judged}, indent=2))
        path = options.out or file_name(f"house_{model.name}")
        print(judged["sentence"])
        written = drawings.write(path, model) + pushovers(path, judged["structures"])
    print("written: " + ", ".join(map(str, written)))
    if options.draw_only:
        return
    try:
        print(f"without shaking: {check_own_weight(options.house, options.snow)}")
    except RunError as problem:
        print(f"without shaking: not checked ({problem})")


if __name__ == "__main__":
    main()
