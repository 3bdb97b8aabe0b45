#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Make the README's pictures from finished runs: make_gallery.py [results] [--out docs]. Needs no YADE.

Reads the folders modelA_quake, modelC_quake, modelC2_snow, A_quake_snow and C_quake_snow in results; the
last two are runs of scripts/house.py A (or C) --quake --snow 1 --out results/A_quake_snow. Folders of FRAMES that are
there, runs of docs/frames.md, become DIR/gallery/*_fall.png. Writes DIR/modelC2_snow.png, DIR/l_house.png and
DIR/gallery/*.png, and two films of houses A and C under the same load, DIR/gallery/film.webp and
film_snow.webp; the picture of the player needs Chromium.
"""
import argparse
import io
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from PIL import Image

from timber_houses.base.atomic_write import written_whole
from timber_houses.base.errors import RunError
from timber_houses.house import build_house, load_house
from timber_houses.motion import default_motion
from timber_houses.pictures import curves, drawings, figures, film, motion_sheet, player, sheets
from timber_houses.pictures.views import FRONT, SIDE
from timber_houses.recording import frames

HISTORY = "modelA_quake"
LEAD = "modelC2_snow"
HOUSE, EXAMPLE = "C2", "l_house"
COMPARED = ("modelA_quake", "modelC_quake")
FILMS = {"film.webp": COMPARED, "film_snow.webp": ("A_quake_snow", "C_quake_snow")}
FRAMES, STILL = ("barn", "bell_tower", "footbridge"), film.Format(width=560, height=380)
"""Runs shown at their start and at their end, and the size of either picture."""
AFTER_COLLAPSE = 1.0
"""Time shown in the comparison, after the collapse of the first run. [s]"""
FILM, SPAN = film.Format(width=640, height=370, rate=10, quality=30), (-3.0, 2.2)
"""Films of the runs FILMS, from and to these times after the collapse of the first [s]: below 3 MB each."""
CHROMIUM = ("chromium", "--headless=new", "--no-sandbox", "--hide-scrollbars", "--use-gl=angle",
            "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1200,800",
            "--virtual-time-budget=5000")
DPI = 130
LARGEST = 150_000
"""Largest picture for a web page. [bytes]"""


def telling_view(run):
    """The view that shows the tilt of a run's house: N-S is seen from the east."""
    return SIDE if run.summary and run.summary.tilt_direction == "ew" else FRONT


def write(path, figure):
    """Write a figure as PNG with its own resolution; returns the path."""
    return save(path, figures.image_of(figure))


def save(path, picture):
    """Write an RGB image as PNG with the largest number of colours that LARGEST permits; returns the path."""
    contents = (packed(quantized(picture, colors) if colors else picture) for colors in (None, 256, 128, 64, 32))
    with written_whole(path) as part:
        part.write_bytes(next(content for content in contents if len(content) < LARGEST))
    return path


def quantized(picture, colors):
    return picture.quantize(colors, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)


def packed(picture):
    """Bytes of a picture as PNG."""
    data = io.BytesIO()
    picture.save(data, "png", optimize=True)
    return data.getvalue()


def compared(runs, time):
    """Screenshot of the player with the runs COMPARED side by side at a time [s], taken by Chromium. runs: {name:
    Frames}
    """
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder) / "page.html", Path(folder) / "page.png"
        player.make([(name, runs[name]) for name in COMPARED], page)
        subprocess.run([*CHROMIUM, f"--user-data-dir={folder}/profile", f"--screenshot={picture}",
                        f"{page.as_uri()}#t={time}"], env={**os.environ, "TMPDIR": folder}, check=True,
                       capture_output=True)
        return Image.open(picture).convert("RGB")


def start_and_end(run):
    """The first and the last state of a run side by side."""
    stage, both = film.Pictures([run], "space", STILL), Image.new("RGB", (2 * STILL.width, STILL.height))
    for number, time in enumerate((run.time[0], run.time[-1])):
        both.paste(stage.at(time), (number * STILL.width, 0))
    return both


def ended(folder):
    """Frames of a run that has ended. Raises RunError when it has not."""
    run = frames.load(folder / frames.NAME)
    if run.summary is None:
        raise RunError(f"{folder}: this run has not ended; finish it with --resume")
    return run


def fallen_at(run):
    """Time of collapse, or the end of the run. [s]"""
    return run.summary.collapse_time_s or run.time[-1]


def make(results, out):
    """All pictures; returns their paths."""
    gallery = out / "gallery"
    gallery.mkdir(parents=True, exist_ok=True)
    runs = {name: ended(results / name) for name in {*sum(FILMS.values(), ()), HISTORY, LEAD}}
    written = [write(gallery / f"{LEAD}.png", sheets.Stills(runs[LEAD]).sheet(telling_view(runs[LEAD]), sheets.SCREEN))]
    written.append(write(gallery / "history.png", curves.page(runs[HISTORY], DPI)))
    written.append(write(gallery / f"house{HOUSE}.png", drawings.page(build_house(load_house(HOUSE)), DPI)))
    written.append(write(out / f"{EXAMPLE}.png", drawings.page(build_house(load_house(EXAMPLE)), DPI)))
    written.append(write(gallery / "ground_motion.png", motion_sheet.page(default_motion(), 0.05, DPI)))
    if shutil.which(CHROMIUM[0]):
        written.append(save(gallery / "player.png", compared(runs, fallen_at(runs[COMPARED[0]]) + AFTER_COLLAPSE)))
    for name, pair in FILMS.items():
        begin, end = (fallen_at(runs[pair[0]]) + time for time in SPAN)
        film.write(gallery / name, [runs[run] for run in pair], form=FILM, begin=begin, end=end)
        written.append(gallery / name)
    written.append(write(out / f"{LEAD}.png", sheets.Stills(runs[LEAD]).both_views(-1, sheets.END_DPI)))
    return written + make_frames(results, gallery)


def make_frames(results, gallery):
    """Pictures of the runs of FRAMES that are there; returns their paths."""
    return [save(gallery / f"{name}_fall.png", start_and_end(ended(results / name)))
            for name in FRAMES if (results / name).is_dir()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=Path, nargs="?", default=Path("results"),
                        help="folder with the results of the runs (default: results)")
    parser.add_argument("--out", type=Path, default=Path("docs"), help="folder to write to (default: docs)")
    options = parser.parse_args()
    try:
        written = make(options.results, options.out)
    except (RunError, OSError) as problem:
        sys.exit(f"error: {problem}")
    for path in written:
        print(f"written: {path} ({path.stat().st_size / 1000:.0f} kB)")


if __name__ == "__main__":
    main()
