#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Counts and drawings of a house: show_house.py C2 [--snow 1.0] [--out house.png]. Needs no YADE."""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.pictures import drawings  # noqa: E402
from yade_timber.pictures import sheets  # noqa: E402
from yade_timber.house import HouseError, build_house, load_house  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("house", help="A, B, C, B1, B2, C1, C2 or a YAML file")
    parser.add_argument("--snow", type=float, default=None, help="snow depth [m] (default: the house's own)")
    parser.add_argument("--out", type=Path, help="picture to write, as .png and .pdf (default: house_<name>.png)")
    return parser.parse_args()


def main():
    options = arguments()
    try:
        model = build_house(load_house(options.house), options.snow)
    except HouseError as problem:
        sys.exit(str(problem))
    print(json.dumps(model.counts(), indent=2))
    out = sheets.stem_of(options.out) if options.out else Path(f"house_{model.name}")
    try:
        written = drawings.write(out, model)
    except OSError as problem:
        sys.exit(f"error: {out}: cannot be written ({problem.strerror})")
    print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()
