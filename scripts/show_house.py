#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Counts and pictures of a house: show_house.py C2 [--snow 1.0] [--out house.png]. Needs no YADE."""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

from yade_timber.house import HouseError, build_house, load_house  # noqa: E402

COLOURS = {"foundation": "#9a9a9a", "sill": "#8a6038", "column": "#d9a760", "beam": "#a87840", "floor": "#e6cfa0",
           "brace": "#c0392b", "roof": "#5d7a94", "snow": "#f4f8fc"}
LIGHT = np.array([0.45, -0.3, 0.84])  # direction towards the light, about unit length


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("house", help="A, B, C, B1, B2, C1, C2 or a YAML file")
    parser.add_argument("--snow", type=float, default=None, help="snow depth [m] (default: the house's own)")
    parser.add_argument("--out", default=None, help="picture to write (default: house_<name>.png)")
    return parser.parse_args()


def shaded(element, face):
    """Face colour: the kind's colour, darker where the face looks away from the light."""
    base = np.array(matplotlib.colors.to_rgb(COLOURS[element.kind]))
    return base * (0.72 + 0.28 * max(0.0, float(face.normal @ LIGHT)))


def draw_3d(axes, model):
    """View from the north-east, above; roof and snow are see-through."""
    elements = [e for e in model.elements if e.kind != "ground"]
    for alpha, kinds in ((1.0, set(COLOURS) - {"roof", "snow"}), (0.45, {"roof", "snow"})):
        faces = [(f.points, shaded(e, f)) for e in elements if e.kind in kinds for f in e.solid.faces]
        if faces:
            axes.add_collection3d(Poly3DCollection([p for p, _ in faces], facecolors=[(*c, alpha) for _, c in faces],
                                                   edgecolors=(0, 0, 0, 0.35), linewidths=0.3))
    points = np.vstack([e.vertices for e in elements])
    low, high = points.min(0), points.max(0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(0, high[2]), xlabel="east [m]", ylabel="north [m]", zlabel="[m]")
    axes.set_box_aspect(np.array([high[0] - low[0], high[1] - low[1], high[2]]))
    axes.view_init(20, 35)


def draw_view(axes, model, right, towards, title, keep=lambda element: True):
    """Parallel view: `right` = (axis, sign) drawn to the right, `towards` (3,) = direction to the viewer; painter's order."""
    elements = sorted((e for e in model.elements if e.kind != "ground" and keep(e)), key=lambda e: (e.solid.bounds @ towards).max())
    for element in elements:
        faces = [f for f in element.solid.faces if f.normal @ towards > 1e-6]
        flat = [np.column_stack([right[1] * f.points[:, right[0]], f.points[:, 1 if towards[2] else 2]]) for f in faces]
        axes.add_collection(PolyCollection(flat, facecolors=[shaded(element, f) for f in faces], edgecolors="black", linewidths=0.3))
    draw_broken(axes, model, right, towards, keep)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_title(title, fontsize=10)
    axes.xaxis.set_major_formatter(lambda value, _: f"{abs(value):g}")


def draw_broken(axes, model, right, towards, keep):
    """Joints broken from the start as black crosses."""
    centres = [j.centre for j in model.joints if j.broken and keep(model.element(j.a))]
    if centres:
        points = np.array(centres)
        axes.plot(right[1] * points[:, right[0]], points[:, 1 if towards[2] else 2], "kx", markersize=6, markeredgewidth=1.5)


def draw(model):
    figure = plt.figure(figsize=(15, 12))
    draw_3d(figure.add_subplot(2, 2, 1, projection="3d"), model)
    draw_view(figure.add_subplot(2, 2, 2), model, (1, 1), np.array([1.0, 0, 0]), "front view, from the east (south is left)")
    draw_view(figure.add_subplot(2, 2, 3), model, (0, -1), np.array([0, 1.0, 0]), "side view, from the north (east is left)")
    draw_view(figure.add_subplot(2, 2, 4), model, (0, 1), np.array([0, 0, 1.0]), "plan of the first floor: columns, braces (north is up)",
              lambda e: e.kind in ("sill", "column", "brace") and e.storey <= 1)
    figure.suptitle(f"House {model.name}: {model.description}")
    figure.tight_layout()
    return figure


def main():
    options = arguments()
    try:
        model = build_house(load_house(options.house), options.snow)
    except HouseError as problem:
        sys.exit(str(problem))
    print(json.dumps(model.counts(), indent=2))
    out = options.out or f"house_{model.name}.png"
    try:
        draw(model).savefig(out, dpi=90)
    except OSError as problem:
        sys.exit(f"cannot write {out}: {problem.strerror}")
    print(f"picture: {out}")


if __name__ == "__main__":
    main()
