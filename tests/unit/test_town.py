# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of towns in separate YADE processes: each house as if alone, whatever the number of threads; resume; misuse."""
import csv
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from timber_houses.motion import GroundMotion, write_csv
from timber_houses.pictures import key_times
from timber_houses.recording import frames

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
SHORT = ["--dt", "4e-4", "--quiet", "--no-views"]
SAME = ("history.csv", "breaks.csv", "storeys.csv", "joints.csv", "columns.csv")
TOWN = """wave: {velocity: 100, direction: 90}
lots:
  near: {house: B1, x: 0, y: 0, snow: 0}
  far: {house: B1, x: 20, y: 0, snow: 0}
  turned: {house: A, x: 0, y: 30, rotation: 90, snow: 0.5}
  walled: {house: walled.yaml, x: 40, y: 30, snow: 0}
"""
WALLED = """extends: A
name: walled
structures: {main: {walls: [{along: y, at: 8, from: 0, to: 3, type: plywood}]}}
"""


def write_town(folder, text=TOWN):
    (folder / "town.yaml").write_text(text)
    (folder / "walled.yaml").write_text(WALLED)


def run(script, *options, threads=1):
    """CompletedProcess of a script."""
    command = [
        shutil.which("yade") or "yade", "-n", "-x", f"-j{threads}",
        str(SCRIPTS / f"{script}.py"), *map(str, options)
    ]
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)


def last_error(process):
    return process.stderr.strip().splitlines()[-1]


@pytest.fixture(scope="module")
def shove(tmp_path_factory):
    """A record that breaks joints within half a second: 4 g to the east and 2 g to the south, and up."""
    path = tmp_path_factory.mktemp("record") / "shove.csv"
    write_csv(GroundMotion(0.01, np.tile([40.0, -20.0, 15.0], (60, 1))), path, ["test"])
    return path


@pytest.fixture(scope="module")
def town(tmp_path_factory, shove):
    """(town file, folder of its run on one thread)"""
    folder = tmp_path_factory.mktemp("town")
    write_town(folder)
    done = run("town", folder / "town.yaml", *SHORT, "--record", shove, "--duration", 0.4, "--out", folder / "out")
    assert done.returncode == 0, done.stderr
    return folder / "town.yaml", folder / "out"


def lot(folder, name):
    """{file: bytes} of a lot's tables."""
    return {file: (folder / "lots" / name / file).read_bytes() for file in SAME}


def test_a_house_is_as_alone(tmp_path, shove, town):
    """The lot that the wave reaches first, and a turned one with its motion turned by hand: the same to the last bit.
    """
    turned = tmp_path / "turned.csv"
    write_csv(GroundMotion(0.01, np.tile([-20.0, -40.0, 15.0], (60, 1))), turned, ["test"])
    for name, house, record, snow in (("near", "B1", shove, 0), ("turned", "A", turned, 0.5)):
        out = tmp_path / name
        done = run("house", house, *SHORT, "--record", record, "--duration", 0.4, "--snow", snow, "--out", out)
        assert done.returncode == 0, done.stderr
        assert {file: (out / file).read_bytes() for file in SAME} == lot(town[1], name)
    assert len((tmp_path / "near" / "breaks.csv").read_text().splitlines()) > 10


def test_delayed_motion(town):
    """20 m at 100 m/s: the motion of `far` is that of `near`, 0.2 s later; until then the house has not moved."""
    near, far = (frames.load(town[1] / "lots" / name / "frames.h5") for name in ("near", "far"))
    assert (near.motion.start, far.motion.start) == (0, pytest.approx(0.2, abs=1e-12))
    assert (near.motion.acceleration == far.motion.acceleration).all()
    before = far.history.time < 0.2
    assert far.history.largest_drift()[before].max() < 1e-3 < near.history.largest_drift()[before].max()


@pytest.mark.rare
def test_two_threads_do_what_one_does(tmp_path, shove, town):
    file, alone = town
    done = run("town", file, *SHORT, "--record", shove, "--duration", 0.4, "--out", tmp_path, threads=2)
    assert done.returncode == 0, done.stderr
    for name in ("near", "far", "turned"):
        assert lot(tmp_path, name) == lot(alone, name)
        assert json.loads((tmp_path / "lots" / name / "summary.json").read_text())["threads"] == 2
    both = [frames.load(folder / "frames.h5") for folder in (tmp_path, alone)]
    assert all((a == b).all() for a, b in zip(both[0].position, both[1].position))


@pytest.mark.rare
def test_resumed(tmp_path, shove, town):
    """A town that ended at 0.25 s is continued to 0.4 s: the same to the last bit."""
    file, straight = town
    for duration in (0.25, 0.4):
        options = ["--record", shove, "--duration", duration, "--out", tmp_path, "--resume", "--checkpoint", 0.1]
        done = run("town", file, *SHORT, *options)
        assert done.returncode == 0, done.stderr
    assert all(lot(tmp_path, name) == lot(straight, name) for name in ("near", "far", "turned"))


def houses(folder):
    """Rows of houses.csv."""
    with open(folder / "houses.csv", newline="", encoding="utf-8-sig") as file:  # a mark for letters beyond ASCII
        return list(csv.DictReader(file))


def test_houses_and_frames_of_the_town(town):
    rows = houses(town[1])
    assert [(row["lot"], row["house"], row["snow [m]"], row["delay [s]"])
            for row in rows] == [("near", "B1", "0", "0"), ("far", "B1", "0", "0.2"), ("turned", "A", "0.5", "0"),
                                 ("walled", "walled", "0", "0.4")]
    whole, part = frames.load(town[1] / "frames.h5"), frames.load(town[1] / "lots" / "turned" / "frames.h5")
    number, own = whole.elements.name.index("turned.main.floor1"), part.elements.name.index("main.floor1")
    placed, alone = whole.corners(-1, number), part.corners(-1, own)
    turned = alone @ [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]  # x to the north, y to the west
    assert placed - placed.mean(0) == pytest.approx(turned - turned.mean(0), abs=1e-4)  # float32 at 30 m
    assert key_times.first_shown(whole) == 0  # a town has no history of its own
    assert len(whole.breaks["time"]) == sum(
        len(frames.load(town[1] / "lots" / row["lot"] / "frames.h5").breaks["time"]) for row in rows)


def test_joints_and_wall_sheets_of_the_town_are_those_of_the_summaries(town):
    for row in houses(town[1]):
        found = json.loads((town[1] / "lots" / row["lot"] / "summary.json").read_text())
        counts = [part.get(key, 0) for key in ("total", "wall_sheets") for part in (found["broken"], found["joints"])]
        assert [int(row[head]) for head in ("broken joints", "joints", "broken wall sheets", "wall sheets")] == counts
        assert row["sentence"] == found["sentence"]
    assert row["lot"] == "walled" and int(row["wall sheets"]) == 6  # three bays in two storeys


@pytest.mark.parametrize("text, options, message", [
    (TOWN.replace("x: 20", "x: 3"), [],
     "error: town.yaml:4: town.lots.far: the house overlaps that of lot near: move it by x or y, or turn it"),
    (TOWN, ["--export", "x.json"], "error: --export: not for towns; run a house with scripts/house.py"),
    (TOWN, ["--report"], "error: --report: not for towns; run a house with scripts/house.py"),
    (TOWN.replace("velocity: 100", "velocity: 0"), [],
     "error: town.yaml:1: town.wave.velocity: must be a number in [50, 20000] m/s, got 0"),
    (TOWN, ["--scale", "2"], "error: --scale: this run has no earthquake; add --quake or --record FILE"),
])
def test_misuse(tmp_path, text, options, message):
    write_town(tmp_path, text)
    done = run("town", tmp_path / "town.yaml", *SHORT, *options, "--duration", 0.1, "--out", tmp_path / "out")
    assert (done.returncode, last_error(done)) == (1, message)
