# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of a table as runs of scripts/house.py: options, house files, checks before the first run."""
import pytest
from timber_houses.house import load_house
from timber_houses.run.options import RunOptions
from timber_houses.study.batch import BatchError, check_rows, read_table


@pytest.fixture
def row(tmp_path):
    def make(columns, values):
        path = tmp_path / "runs.txt"
        path.write_text(f"{columns}\n{values}\n")
        return read_table(path)[0]

    return make


def test_every_column_becomes_an_option(row, tmp_path):
    shaken = row("house snow joint_damping scale dt duration until_collapse seed start azimuth resample shortest",
                 "C2 0.4 0.03 1.5 5e-5 3 yes 0 14 90 yes no").task(tmp_path)
    assert shaken.options == RunOptions(
        house="C2", quake=True, snow=0.4, joint_damping=0.03, scale=1.5, dt=5e-5, duration=3.0, until_collapse=True,
        seed=0, start=14.0, azimuth=90.0, resample=True, no_frames=True)
    assert row("house record snow", "A none 1").task(tmp_path).options == RunOptions(
        house="A", snow=1.0, no_frames=True)
    assert row("house", "A").task(tmp_path).options == RunOptions(house="A", quake=True, no_frames=True)


def test_paths_are_those_beside_the_table(row, tmp_path):
    options = row("house record", "mine.yaml a.csv,b.csv").task(tmp_path).options
    assert (options.house, options.record) == (str(
        tmp_path / "mine.yaml"), f"{tmp_path / 'a.csv'},{tmp_path / 'b.csv'}")


def test_changed_houses_are_written(row, tmp_path):
    changed = row("house set braces strength", "B plumb.drift=0.002 main.brace1.EW.y0.3-4 0.5")
    check_rows([changed], tmp_path)
    house = load_house(changed.task(tmp_path).options.house).data
    assert house["plumb"]["drift"] == 0.002 and house["joint_types"]["corner_fitting"]["strength"] == 2940
    assert house["structures"]["main"]["braces"]["lines"][-1]["runs"] == [[3, 4]]


@pytest.mark.parametrize("columns, values, parts", [
    ("house snow", "A 0.0005", ["runs.txt:2", "0.001", "6"]),
    ("house snow", "A -1", ["runs.txt:2, column snow", "0", "6"]),
    ("house joint_damping", "A 1.5", ["runs.txt:2, column joint_damping", "0", "1"]),
    ("house dt", "A 1e-2", ["runs.txt:2, column dt"]),
    ("house dt", "A nan", ["runs.txt:2, column dt"]),
    ("house duration", "A nan", ["runs.txt:2, column duration"]),
    ("house record scale", "A none 2", ["runs.txt:2, column scale"]),
    ("house record", "A nowhere", ["runs.txt:2", "nowhere"]),
    ("house pga", "A -3", ["runs.txt:2, column pga"]),
    ("house walls", "A weak", ["runs.txt:2, column walls", "mean", "design"]),
    ("house set", "A plumb.drft=1", ["runs.txt:2, column set", "plumb", "drft"]),
    ("house braces", "A main.brace9.EW.y0.3-4", ["runs.txt:2"]),
    ("house strength", "A 0", ["runs.txt:2, column strength"]),
    ("house", "nowhere", ["runs.txt:2", "nowhere"]),
])
def test_refused_rows(row, tmp_path, columns, values, parts):
    with pytest.raises(BatchError) as caught:
        check_rows([row(columns, values)], tmp_path)
    assert all(part in str(caught.value) for part in parts) and "\n" not in str(caught.value)
