#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Print counts, weights and diagnosis of a house, draw it and its pushover curves, and check that it bears its own
weight: show_house.py C2 [--snow 1.0] [--out house.png] [--draw-only].

Without YADE the check is left out.
"""
import json

from show_common import Parser, errors_in_a_line, file_name, path

from timber_houses.base.errors import RunError
from timber_houses.base.notes import noted
from timber_houses.house import build_house, diagnose, load_house, shipped_houses, weigh
from timber_houses.pictures import drawings, pushover
from timber_houses.pictures.figures import save, stem_and_endings
from timber_houses.study.own_weight import check_own_weight


def arguments():
    parser = Parser(description=__doc__)
    parser.add_argument("house", help=f"{', '.join(shipped_houses())} or a YAML file")
    parser.add_argument("--snow", type=float, default=None, help="snow depth [m] (default: that of the house)")
    parser.add_argument("--out", type=path, help="picture to write, .png or .pdf (default: house_<name>.png)")
    parser.add_argument("--draw-only", action="store_true", help="leave the check out, which takes some seconds")
    return parser.parse_args()


def pushovers(path, structures):
    """Write the pushover curves of the structures beside the drawings; returns the paths."""
    stem, endings = stem_and_endings(path)
    drawn = {name: pushover.figure(name, structure) for name, structure in structures.items()}
    return [written for name, figure in drawn.items() if figure is not None
            for written in save(figure, stem.with_name(f"{stem.name}_pushover_{name}"), endings)]


def main():
    options = arguments()
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
