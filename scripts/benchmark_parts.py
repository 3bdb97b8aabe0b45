# SPDX-License-Identifier: GPL-2.0-or-later
"""What there is to gain from parts that rest while others move: a bound from recorded runs.

    yade -n -x scripts/benchmark_parts.py [results/*/frames.h5] [--out FOLDER]

A part is what contacts and unbroken joints hold together; fixed elements join nothing. It rests, as in RestSkipper, when the ground is quiet
and none of its elements has moved or been fast for its `hold`. Costs of a step are counted as its contact points, and as many as a
house has joints and members for all else.
"""
import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import markdown_table, publish  # noqa: E402
from yade_timber import frames  # noqa: E402

HOLD, SPEED, WAY, QUIET = 1.5, 1e-3, 2e-5, 1e-2
"""As RestSkipper's, [s], [m/s], [m], [m/s2]; the way is wider by the rounding of recorded places."""
HEADS = ("run", "whole scene at rest [% of the cost]", "parts at rest while others move [% of the cost]")


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark_parts.py", description=__doc__.splitlines()[0])
    parser.add_argument("frames", type=Path, nargs="*", help="recorded runs (default results/*/frames.h5)")
    parser.add_argument("--out", type=Path, help="folder whose performance.md and parts.csv get the result")
    return parser.parse_args()


def ground_is_quiet(motion, time):
    """Whether the ground is quiet at each time [s] and until the next."""
    if motion is None:
        return np.ones(len(time), bool)
    strength, step = np.linalg.norm(motion.acceleration, axis=1), np.diff(time, append=2 * time[-1] - time[-2])
    return np.array([strength[(motion.time >= t - motion.dt) & (motion.time <= t + s + motion.dt)].max(initial=0) < QUIET for t, s in zip(time, step)])


def resting(run, first, frame):
    """Whether each element has rested from one frame to another."""
    places = np.asarray(run.position[first : frame + 1], float)
    ways = np.linalg.norm(np.diff(places, axis=0), axis=2)
    return (np.linalg.norm(places - places[0], axis=2).max(axis=0) < WAY) & (ways.max(axis=0) < SPEED * np.diff(run.time[first : frame + 1]).min())


def touching(run, frame):
    """Pairs of elements (n, 2), one row for each contact point, as last recorded."""
    number = np.searchsorted(run.contacts.time, run.time[frame] + 1e-9) - 1
    return np.asarray(run.contacts.pair[max(0, number)]).reshape(-1, 2)


def restful_parts(run, frame, rest, pairs):
    """Whether the part that each element belongs to rests as a whole."""
    fixed, joints = run.elements.fixed, run.joints
    whole = joints.springs > run.broken[frame]
    ties = np.vstack([pairs, np.column_stack([joints.a, joints.b])[whole]])
    ties = ties[~fixed[ties].any(axis=1)]
    _, part = connected_components(coo_matrix((np.ones(len(ties)), ties.T), shape=(len(fixed), len(fixed))), directed=False)
    return ~np.isin(part, part[~rest & ~fixed])


def bound(path):
    """A row of the table."""
    run = frames.load(path)
    fixed, time = run.elements.fixed, np.asarray(run.time)
    others = len(fixed) + len(run.joints.a)
    quiet = ground_is_quiet(run.motion, time)
    total = whole = parts = 0
    for frame, now in enumerate(time):
        pairs, first = touching(run, frame), np.searchsorted(time, now - HOLD - 1e-9)
        total += len(pairs) + others
        if not quiet[frame] or now < HOLD:
            continue
        calm = restful_parts(run, frame, resting(run, first, frame), pairs)
        if calm[~fixed].all():
            whole += len(pairs) + others
        else:
            parts += calm[np.where(fixed[pairs[:, 0]], pairs[:, 1], pairs[:, 0])].sum() + calm[~fixed].sum()
    return run.scenario, 100 * whole / total, 100 * parts / total


def main():
    options = arguments()
    rows = [bound(path) for path in options.frames or sorted(Path("results").glob("*/frames.h5"))]
    if not rows:
        sys.exit("error: no recorded runs in results/*/frames.h5; name some")
    text = (
        "## Parts at rest\n\nHow much of a run's cost belongs to parts (what contacts and joints hold together) that have rested for "
        f"{HOLD:g} s while others move, the ground being quiet: "
        "the most that putting parts to sleep could gain. Scenes that rest as a whole are what RestSkipper is for.\n\n"
        + markdown_table(HEADS, [(name, f"{whole:.1f}", f"{parts:.2f}") for name, whole, parts in rows])
    )
    publish(options.out, "parts", text, HEADS, rows)


main()
