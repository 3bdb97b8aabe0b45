# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""scripts/benchmark_parts.py: the share of parts at rest in made-up runs of which it is known."""
import csv
import shutil
import subprocess
from pathlib import Path

import frames_sample
import numpy as np
import pytest
from yade_timber import frames

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "benchmark_parts.py"
OTHERS = 7 + 8  # elements and joints of the sample
BASE, SOUTHWEST, SOUTHEAST = 1, 2, 3


def sample(folder, pairs, shaking=False, moves=True):
    """A run of 81 frames, 51 of them after 1.5 s; all joints broken; at most the south-west column moves."""
    run = frames_sample.run()
    run.position = np.repeat(run.elements.position[None], len(run.time), axis=0)
    run.position[:, SOUTHWEST, 0] += 0.1 * run.time * moves
    run.orientation = np.repeat(run.elements.orientation[None], len(run.time), axis=0)
    run.broken = np.full((len(run.time), 8), 4)
    run.contacts = frames.Contacts([0.0], [np.array(pairs)], [np.zeros((len(pairs), 3))], [np.zeros((len(pairs), 3))])
    run.motion = run.motion if shaking else None
    frames.save(folder / "frames.h5", run)


def shares(folder):
    """(whole scene at rest, parts at rest) that the script finds, as shares."""
    done = subprocess.run([shutil.which("yade"), "-n", "-x", SCRIPT, folder / "frames.h5", "--out", folder], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with open(folder / "parts.csv", encoding="utf-8") as file:
        row = list(csv.reader(file))[1]
    return float(row[1]) / 100, float(row[2]) / 100


@pytest.mark.parametrize(
    "pairs, calm_points, calm_elements",
    [
        ([(BASE, SOUTHWEST)] * 2 + [(BASE, SOUTHEAST)] * 3, 3, 4),  # the base is fixed: it does not join the columns
        ([(BASE, SOUTHWEST)] * 2 + [(SOUTHWEST, SOUTHEAST)] * 3, 0, 3),
    ],
)
def test_parts(tmp_path, pairs, calm_points, calm_elements):
    sample(tmp_path, pairs)
    assert shares(tmp_path) == pytest.approx((0, 51 * (calm_points + calm_elements) / (81 * (5 + OTHERS))))


def test_whole_scene_and_shaking(tmp_path):
    sample(tmp_path, [(BASE, SOUTHWEST)], moves=False)
    assert shares(tmp_path) == pytest.approx((51 / 81, 0))
    sample(tmp_path, [(BASE, SOUTHWEST)], moves=False, shaking=True)
    assert shares(tmp_path) == (0, 0)
