# SPDX-License-Identifier: GPL-2.0-or-later
"""Two retrofits of house A under the shipped motion: braces in the corners of its outer walls, or joints of twice the
strength.

    yade -n -x scripts/examples/compare_retrofits.py [--duration S] [--out DIR]

Writes two house files, the results of three runs, drifts.png, and a page that plays both retrofits side by side.
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt

import timber_houses as th
from timber_houses.base.colors import BLUE, GREEN, ORANGE
from timber_houses.text.english import DRIFT_LINES, ratio

SHAKING = {"motion": "shipped", "start": 17}  # strong shaking begins at 18.8 s
OUTER_WALLS = ("NS.x0", "NS.x8", "EW.y0", "EW.y9")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--duration", type=float, default=10.0,
                        help="simulated time of each run [s] (default %(default)g)")
    parser.add_argument("--out", type=Path, default=Path("results/compare_retrofits"),
                        help="folder (default %(default)s)")
    return parser.parse_args()


def corner_bays(house):
    """First and last free bay of each outer wall, in both storeys of the main structure."""
    walls = {}
    for name in house.free_bays:
        structure, storey, direction, line, bay = name.split(".")
        if structure == "main" and f"{direction}.{line}" in OUTER_WALLS:
            walls.setdefault((storey, direction, line), []).append(name)
    return [bay for bays in walls.values() for bay in (bays[0], bays[-1])]


def plot(runs, path):
    """Largest storey drift of each run over time."""
    figure, axes = plt.subplots(figsize=(7.2, 3.6), constrained_layout=True)
    for (name, run), colour, width in zip(runs.items(), (ORANGE, BLUE, GREEN), (4, 1.2, 1.2)):
        axes.plot(run.history.time, run.history.largest_drift(), color=colour, lw=width,
                  label=f"{name}: peak {ratio(run.drift)}, {run.broken} joints broken")
    for value, text in DRIFT_LINES:
        axes.axhline(value, color="0.75", lw=0.8, zorder=0)
        axes.text(axes.get_xlim()[1], value, f" {text.partition(' ')[0]}", va="center", color="0.4")
    axes.set(yscale="log", ylim=(1e-4, 2), xlabel="time [s]", ylabel="largest storey drift [-]",
             title="House A and two retrofits")
    axes.legend(loc="lower right")
    figure.savefig(path, dpi=150)


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    house = th.house("A")
    houses = {"as it is": house, "16 braces": house.variant(options.out / "braced.yaml", braces=corner_bays(house)),
              "joints of twice the strength": house.variant(options.out / "strong_joints.yaml", strength=2.0)}
    runs = {name: th.run(h, duration=options.duration, out=options.out / Path(h.given).stem, **SHAKING)
            for name, h in houses.items()}
    plot(runs, options.out / "drifts.png")
    _, braced, strong = runs.values()
    print(braced.player(strong, options.out / "side_by_side.html"))


main()
