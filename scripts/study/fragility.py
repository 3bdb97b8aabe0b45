#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Fragility of houses: share of runs that collapse against the strength of the ground motion, with and without snow.

    scripts/study/fragility.py [-j 2] [--seeds 20] [--houses A,B,C] [--snow 0,1] [--scales 0.4,0.8,1.2] [--start 14
    --end 34]

Each seed is a synthetic motion with the published values of the Ojiya record, multiplied by the scale.
Writes fragility.csv (one row per point, with its binomial confidence interval) and fragility.png. A curve with its band
is drawn only where every point has at least 20 motions.
"""

from pathlib import Path
from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from scipy import optimize, stats
from scipy.special import ndtr
from study_common import house_name, parser, run_all, save, write_table

from timber_houses.base.colors import BLUE, GREEN, GREY, ORANGE
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.run.options import RunOptions
from timber_houses.study.batch import Row
from timber_houses.study.options import count, list_of, non_negative, positive, run_script

SCALES = {"A": [0.5, 0.7, 0.85, 1.0, 1.25], "B": [0.8, 1.0, 1.25, 1.6, 2.0], "C": [1.0, 1.25, 1.6, 2.0, 2.5]}
"""Factors on the motion that cover the curve of each house; --scales replaces them."""
CONFIDENCE = 0.95
LEAST_RUNS = 20
"""Motions at each point below which no curve is fitted."""
RESAMPLED, RESAMPLING_SEED = 200, 1
"""Number of curves of the parametric bootstrap that gives a band, and its seed."""
SPREAD = (0.05, 1.0)
"""Limits of the logarithmic standard deviation of a fitted curve: few runs do not distinguish a steep curve from a
step.
"""
STYLES = {"A": (ORANGE, "o"), "B": (BLUE, "s"), "C": (GREEN, "^")}


def arguments():
    made = parser(__doc__, "results/study_fragility")
    made.add_argument("--seeds", type=count, default=LEAST_RUNS, metavar="N",
                      help="motions per point (default %(default)s)")
    made.add_argument("--houses", default="A,B,C", help="shipped houses or house files (default %(default)s)")
    made.add_argument("--snow", type=list_of(non_negative), default=[0.0, 1.0], metavar="M,M",
                      help="snow depths [m] (default 0,1)")
    made.add_argument("--scales", type=list_of(positive), metavar="X,X",
                      help="factors on the motion (default: a range for each house)")
    return made.parse_args()


def rows(options):
    """Rows of the batch: house x snow x scale x seed."""
    return [row(options, house, snow, scale, seed) for house in options.houses.split(",") for snow in options.snow
            for scale in options.scales or SCALES.get(house, SCALES["B"]) for seed in range(1, options.seeds + 1)]


def row(options, house, snow, scale, seed):
    name = f"snow{snow:g}_scale{scale:g}_seed{seed}"
    return Row(RunOptions(house=house_name(house), quake=True, snow=snow, scale=scale, seed=seed, until_collapse=True,
                          start=options.start, end=options.end, dt=options.dt or DEFAULT_DT), description=name,
               place=name)


def points(found):
    """One row per house, snow depth and scale: runs, collapses, their share and its Clopper-Pearson interval. Failed
    runs count only in `failed`.
    """
    groups = {}
    for entry in found:
        groups.setdefault((entry["house"], entry["snow"], entry["scale"]), []).append(entry)
    return [_point(label(house), snow, scale, entries) for (house, snow, scale), entries in groups.items()]


def label(house):
    """Name of a house in tables and pictures."""
    return Path(house).stem


def _point(house, snow, scale, entries):
    done = [entry for entry in entries if entry["status"] == "done"]
    collapsed = sum(entry["collapsed"] for entry in done)
    low, high = stats.binomtest(collapsed, len(done)).proportion_ci(CONFIDENCE, "exact") if done else (0.0, 1.0)
    times = [entry["collapse_time_s"] for entry in done if entry["collapsed"]]
    return {"house": house, "snow_m": snow, "scale": scale, "runs": len(done), "collapsed": collapsed,
            "share": collapsed / len(done) if done else float("nan"), "low": float(low), "high": float(high),
            "failed": len(entries) - len(done), "median_collapse_time_s": float(np.median(times)) if times else ""}


def fit(curve, start=None):
    """(median, logarithmic standard deviation) of the lognormal curve of maximum likelihood; None if no run or every
    run is a collapse.

    start: values from which to search, by default the best of a grid
    """
    scale, runs, collapsed = (
        np.array([point[key] for point in curve], float) for key in ("scale", "runs", "collapsed")
    )
    if collapsed.sum() in (0, runs.sum()):
        return None

    def cost(logs):
        share = np.clip(ndtr((np.log(scale) - logs[0]) / np.exp(logs[1])), 1e-9, 1 - 1e-9)
        return -(collapsed * np.log(share) + (runs - collapsed) * np.log(1 - share)).sum()

    bounds = [tuple(np.log([scale.min() / 2, scale.max() * 2])), tuple(np.log(SPREAD))]
    grid = [np.linspace(*bound, 60) for bound in bounds]
    first = min(((a, b) for a in grid[0] for b in grid[1]), key=cost) if start is None else np.log(start)
    return tuple(np.exp(optimize.minimize(cost, first, bounds=bounds, method="L-BFGS-B").x))


def has_curve(curve):
    """Whether every point has the motions that a curve needs."""
    return all(point["runs"] >= LEAST_RUNS for point in curve)


def share_at(fitted, scales):
    """Share of collapses of a fitted curve at these strengths. [-]"""
    return ndtr(np.log(np.asarray(scales) / fitted[0]) / fitted[1])


def resampled(curve, fitted):
    """Fits to samples drawn from a fitted curve (parametric bootstrap); samples without a transition are left out."""
    random, expected = np.random.default_rng(RESAMPLING_SEED), share_at(fitted, [point["scale"] for point in curve])
    samples = random.binomial([point["runs"] for point in curve], expected, (RESAMPLED, len(curve)))
    fits = [fit([{**point, "collapsed": n} for point, n in zip(curve, sample)], fitted) for sample in samples]
    return [found for found in fits if found is not None]


def band(values):
    """(lower, upper) end of the CONFIDENCE interval of (n, ...) bootstrap values."""
    return np.quantile(values, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2], axis=0)


def median_text(curve):
    """The strength at which half of the runs collapse, as text; no extrapolation beyond the strengths that were run."""
    if not has_curve(curve):
        return f"{min(point['runs'] for point in curve)} motions a point; a curve needs {LEAST_RUNS}"
    fitted, scales = fit(curve), [point["scale"] for point in curve]
    if fitted is None:
        collapsed, runs = (sum(point[key] for point in curve) for key in ("collapsed", "runs"))
        return "all collapse" if collapsed == runs else "none collapses"
    if fitted[0] > max(scales):
        return f"fewer than half collapse up to {max(scales):g}"
    if fitted[0] < min(scales):
        return f"more than half collapse from {min(scales):g} on"
    low, high = band([median for median, _ in resampled(curve, fitted)])
    return f"half collapse at {fitted[0]:.2f} ({low:.2f} to {high:.2f})"


def plot(table, snows, path):
    figure, axes = plt.subplots(1, len(snows), figsize=(5.8 * len(snows), 5.4), sharey=True, squeeze=False,
                                constrained_layout=True)
    for axis, snow in zip(axes[0], snows):
        for number, house in enumerate(dict.fromkeys(point["house"] for point in table)):
            curve = [point for point in table if point["house"] == house and point["snow_m"] == snow]
            draw(axis, house, curve, 1 + 0.025 * (number - 1))
        axis.set(title=f"{snow:g} m of snow" if snow else "no snow", xscale="log", ylim=(-0.04, 1.04))
        axis.set_xlabel("factor on the Ojiya-like motion (PGA 1501 gal, JMA intensity 6.7 at 1)")
        ticks = sorted({point["scale"] for point in table})
        axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks], rotation=60, fontsize=8)
        axis.set_xticks([], minor=True)
        axis.grid(alpha=0.3)
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), fontsize=8, frameon=False)
    axes[0, 0].set_ylabel("share of runs in which the house collapses")
    runs = max(point["runs"] for point in table)
    caption = (
        f"Points: {runs} motions each; bars: {100 * CONFIDENCE:g} % confidence (Clopper and Pearson); curves:"
        " lognormal, maximum likelihood, with bands"
    )
    figure.suptitle(fill(caption, 75 * len(snows)), fontsize=9)
    save(figure, path)
    plt.close(figure)


def draw(axis, house, curve, shift):
    """Points with their intervals, the fitted curve and its band. shift: factor on the abscissa that separates the
    houses.
    """
    colour, marker = STYLES.get(house, (GREY, "D"))
    x, share, low, high = (np.array([point[key] for point in curve]) for key in ("scale", "share", "low", "high"))
    fitted = fit(curve) if has_curve(curve) else None
    axis.errorbar(x * shift, share, [share - low, high - share], fmt=marker, color=colour, ms=5, lw=1, capsize=2,
                  label=f"house {house}: {median_text(curve)}")
    if fitted:
        line = np.geomspace(x.min(), x.max(), 200)
        axis.plot(line, share_at(fitted, line), color=colour, lw=1.5)
        axis.fill_between(line, *band([share_at(found, line) for found in resampled(curve, fitted)]), color=colour,
                          alpha=0.15, lw=0)


def main():
    options = arguments()
    table = points(run_all(rows(options), options))
    write_table((options.to or options.out) / "fragility.csv", table)
    plot(table, options.snow, (options.to or options.out) / "fragility.png")
    for house in map(label, options.houses.split(",")):
        for snow in options.snow:
            curve = [point for point in table if point["house"] == house and point["snow_m"] == snow]
            print(f"house {house}, {snow:g} m of snow: {median_text(curve)}")
    return int(any(point["failed"] for point in table))


if __name__ == "__main__":
    run_script(main)
