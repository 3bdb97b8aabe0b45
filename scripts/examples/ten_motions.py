# SPDX-License-Identifier: GPL-2.0-or-later
"""One house under ten motions of the same published strength: bands of the storey drift.

    yade -n -x scripts/examples/ten_motions.py [--house storehouse] [--motions 10] [--duration S] [--out DIR]

Writes the results of the runs, bands.png, and peaks.csv with the peak drift of each motion.
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import timber_houses as th
from timber_houses.base.colors import BLUE, ORANGE
from timber_houses.base.table import csv_text
from timber_houses.text.english import DRIFT_LINES, ratio

START = 17.0
"""The motions are cut there; strong shaking begins at about 19 s. [s]"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--house", default="storehouse", help="shipped house or house file (default %(default)s)")
    parser.add_argument("--motions", type=int, default=10, help="number of motions (default %(default)s)")
    parser.add_argument("--duration", type=float, default=10.0,
                        help="simulated time of each run [s] (default %(default)g)")
    parser.add_argument("--out", type=Path, default=Path("results/ten_motions"), help="folder (default %(default)s)")
    return parser.parse_args()


def plot(house, runs, path):
    """Median and bands of the largest storey drift so far, and the peaks of the motions in order."""
    time = runs[0].history.time
    so_far = np.array([np.maximum.accumulate(run.history.largest_drift()) for run in runs])
    low, first, median, third, high = np.percentile(so_far, (0, 25, 50, 75, 100), axis=0)
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.6), width_ratios=[3, 1], sharey=True,
                                         constrained_layout=True)
    left.fill_between(time, low, high, color=BLUE, alpha=0.15, lw=0, label="all motions")
    left.fill_between(time, first, third, color=BLUE, alpha=0.35, lw=0, label="quartiles")
    left.plot(time, median, color=BLUE, lw=1.2, label="median")
    left.set(xlabel="time [s]", ylabel="largest storey drift so far [-]", xlim=(0, time[-1]), ylim=(0, 1.15 * high[-1]))
    left.set_title(f"House {house.name}, {len(runs)} motions")
    left.legend(loc="upper left")
    right.plot((np.arange(len(runs)) + 0.5) / len(runs), np.sort(so_far[:, -1]), "o", color=ORANGE)
    right.set(xlabel="share of motions [-]", xlim=(0, 1), xticks=(0, 0.5, 1),
              title=f"peaks, median {ratio(median[-1])}")
    for value, text in DRIFT_LINES:
        if value < left.get_ylim()[1]:
            left.axhline(value, color="0.7", lw=0.8, zorder=0)
            right.axhline(value, color="0.7", lw=0.8, zorder=0)
            right.annotate(text.partition(" ")[0], (1.02, value), xycoords=("axes fraction", "data"), va="center",
                           color="0.4")
    figure.savefig(path, dpi=150)


def main():
    options = arguments()
    house, seeds = th.house(options.house), range(1, options.motions + 1)
    runs = [th.run(house, seed=seed, start=START, duration=options.duration, out=options.out / f"seed_{seed}",
                   no_frames=True) for seed in seeds]
    plot(house, runs, options.out / "bands.png")
    rows = [(seed, run.drift, run.broken, run.collapsed) for seed, run in zip(seeds, runs)]
    (options.out / "peaks.csv").write_text(csv_text(("seed", "peak drift [-]", "broken joints [-]", "collapsed"), rows))


main()
