#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make a film of a recorded run, or of two runs side by side. Needs no YADE.

    make_film.py results/modelA_quake
    make_film.py results/modelA_quake --compare results/modelC_quake --out fall.mp4

Real time, a quarter of it around the first collapse; the last picture stays for 2 s. MP4 needs ffmpeg; a name that ends
in .webp gives an animated picture for a web page.
"""
import argparse
import math
import shutil
import time

from show_common import RECORDED, Parser, errors_in_a_line, frames_path, path

from timber_houses.pictures import camera, film
from timber_houses.recording import frames

ENDINGS = (".mp4", ".webp")


def number(low, high, kind=float):
    """A number within [low, high], for argparse."""
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(
                f"{text[:40]}: must be {'a whole number' if kind is int else 'a number'} from {low:g} to {high:g}"
            )
        return value
    return read


def size(text):
    """Width and height [pixel], for argparse."""
    parts = text.lower().split("x")
    if len(parts) != 2 or not all(part.isdecimal() and 64 <= int(part[:9]) <= 4096 for part in parts):
        raise argparse.ArgumentTypeError(f"{text[:40]}: must be WIDTHxHEIGHT, each from 64 to 4096, such as 1280x720")
    return tuple(map(int, parts))


def film_path(text):
    found = path(text)
    if found.suffix.lower() not in ENDINGS:
        raise argparse.ArgumentTypeError(f"{text[:80]}: the name of a film must end in {' or '.join(ENDINGS)}")
    return found


def arguments():
    form, instant = film.Format(), number(0, 1e5)
    fewer = "; less for a town, so that it is made in half a minute"
    parser = Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=path, help=RECORDED)
    parser.add_argument("--compare", type=path, metavar="RUN", help="a second run, shown at the right")
    parser.add_argument("--view", choices=tuple(camera.CAMERAS), default="space",
                        help="from the east, from the north, or from the north-east above (default)")
    parser.add_argument(
        "--speed", type=number(0.01, 20),
        help="simulated seconds in a second of the film (default: 1, and 0.25 around the first collapse)"
    )
    parser.add_argument("--start", type=instant, help="begin at this time [s] (default: 1 s before the shaking)")
    parser.add_argument("--end", type=instant,
                        help="end at this time [s] (default: when no picture differs visibly from the last one)")
    parser.add_argument("--size", type=size, metavar="WIDTHxHEIGHT",
                        help=f"[pixel] (default {form.width}x{form.height}{fewer})")
    parser.add_argument("--rate", type=number(1, 120), help=f"pictures per second (default {form.rate:g}{fewer})")
    parser.add_argument("--quality", type=number(1, 100, int), default=form.quality,
                        help="of WebP (default %(default)d)")
    parser.add_argument(
        "--out", type=film_path,
        help="film to write, .mp4 or .webp (default: film.mp4 in the folder of the run; film.webp without ffmpeg)"
    )
    return parser.parse_args()


def main():
    options = arguments()
    files = [frames_path(run) for run in (options.run, options.compare) if run]
    out = options.out or files[0].parent / ("film.mp4" if shutil.which("ffmpeg") else "film.webp")
    since = time.perf_counter()
    with errors_in_a_line(out):
        runs = [frames.load(file) for file in files]
        form = film.chosen_form(runs, options.size, options.rate, speed=options.speed, quality=options.quality)
        count = film.write(out, runs, options.view, form, options.start, options.end)
    print(
        f"{out}: {count / form.rate + film.HOLD:.1f} s, {count} pictures, {out.stat().st_size / 1e6:.1f} MB, made in"
        f" {time.perf_counter() - since:.1f} s"
    )


if __name__ == "__main__":
    main()
