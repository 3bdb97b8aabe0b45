# SPDX-License-Identifier: GPL-2.0-or-later
"""A row of a table in YADE: the Scenario it becomes, its record when it ends well or badly, resuming, the lock; and yade-batch's own reader."""
import json

import pytest
from yade.utils import TableParamReader
from yade_timber.base import lock
from yade_timber.study.batch import BatchError, read_table
from yade_timber.study.batch import run as batch_run
from yade_timber.house import HouseError, load_house
from yade_timber.motion import RecordError, pga

QUICK = "house dt duration"


@pytest.fixture
def row(tmp_path):
    def make(columns, values):
        path = tmp_path / "runs.txt"
        path.write_text(f"{columns}\n{values}\n")
        return read_table(path)[0]

    return make


def test_same_reading_as_yade_batch(tmp_path):
    path = tmp_path / "runs.txt"
    path.write_text("# x\nhouse! scale snow\n\nB 0.5 *  # calm\n= 2 1\nA = =\n")
    theirs = {line: {k: v for k, v in cells.items() if k != "description" and v != "*"} for line, cells in TableParamReader(str(path)).paramDict().items()}
    assert {row.line: row.cells for row in read_table(path)} == theirs


def test_every_column_reaches_the_scenario(row, tmp_path):
    made = batch_run.scenario(row("house snow scale dt duration seed start azimuth", "C2 0.4 1.5 5e-5 3 0 14 90"), tmp_path)
    assert (made.house, made.snow_depth, made.scale, made.dt, made.duration) == ("C2", 0.4, 1.5, 5e-5, 3.0)
    assert "turned by 90 degrees; cut to 14-40 s" in made.motion.source
    made = batch_run.scenario(row("house pga set braces strength", "B 300 plumb.drift=0.002 main.brace1.EW.y0.3-4 0.5"), tmp_path)
    house = load_house(made.house).data
    assert pga(made.motion, "level") == pytest.approx(300) and made.scale == 1.0 and made.duration == made.motion.duration
    assert house["plumb"]["drift"] == 0.002 and house["joint_types"]["corner_fitting"]["strength"] == 2940
    assert house["structures"]["main"]["braces"]["lines"][-1]["runs"] == [[3, 4]]


def test_a_row_without_earthquake(row, tmp_path):
    made = batch_run.scenario(row("house record snow", "A none 1"), tmp_path)
    assert made.motion is None and made.snow_depth == 1.0 and made.duration == 30.0


def test_snow_is_the_house_s_own_where_the_table_says_none(row, tmp_path):
    assert batch_run.scenario(row("house set", "A snow.depth=0.7"), tmp_path).snow_depth == 0.7
    assert batch_run.scenario(row("house set snow", "A snow.depth=0.7 0"), tmp_path).snow_depth == 0.0


@pytest.mark.parametrize(
    "columns, values, error, said",
    [
        ("house snow", "A -1", BatchError, "runs.txt:2, column snow: -1: must be between 0 and 20"),
        ("house dt", "A 1e-2", BatchError, "column dt: 0.01: must be between"),
        ("house duration", "A nan", BatchError, "column duration: nan: must be"),
        ("house record scale", "A none 2", BatchError, "column scale: this run has no earthquake"),
        ("house record", "A nowhere", RecordError, "no such file"),
        ("house pga", "A -3", RecordError, "runs.txt:2, column pga: -3: must be >= 0.001"),
        ("house set", "A plumb.drft=1", HouseError, "runs.txt:2, column set: plumb: unknown key 'drft'"),
    ],
)
def test_refused_rows(row, tmp_path, columns, values, error, said):
    with pytest.raises(error, match=said):
        batch_run.scenario(row(columns, values), tmp_path)


def test_done_once(row, tmp_path, monkeypatch):
    quick = row(QUICK, "A 2e-4 0.004")
    assert batch_run.finish(quick, tmp_path) == 0
    end = json.loads((tmp_path / "run.json").read_text())
    assert (end["status"], end["error"], end["cells"]) == ("done", None, quick.cells)
    assert json.loads((tmp_path / "summary.json").read_text())["steps"] == 20
    assert not (tmp_path / "checkpoint.yade").exists()
    monkeypatch.setattr(batch_run, "scenario", None)  # would fail
    assert batch_run.finish(quick, tmp_path) == 0


@pytest.mark.parametrize("values, said", [("nowhere 2e-4 0.004", "runs.txt:2: unknown house 'nowhere'"), ("A 1 0.004", "runs.txt:2, column dt: 1")])
def test_failure_is_recorded(row, tmp_path, values, said):
    failing = row(QUICK, values)
    assert batch_run.finish(failing, tmp_path) == 1
    end = json.loads((tmp_path / "run.json").read_text())
    assert end["status"] == "failed" and said in end["error"]
    assert batch_run.finish(failing, tmp_path) == 1  # and stays so, without trying again


def test_a_bug_is_one_run_s_loss(row, tmp_path, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("somewhere")

    monkeypatch.setattr(batch_run, "scenario", broken)
    assert batch_run.finish(row(QUICK, "A 2e-4 0.004"), tmp_path) == 1
    assert json.loads((tmp_path / "run.json").read_text())["error"] == "ZeroDivisionError: somewhere"


def test_an_unusable_checkpoint_is_no_failure(row, tmp_path):
    (tmp_path / "checkpoint.yade").write_bytes(b"rubbish")
    assert batch_run.finish(row(QUICK, "A 2e-4 0.004"), tmp_path) == 0


def test_one_process_a_run(tmp_path):
    assert not lock.held(tmp_path)
    with lock.locked(tmp_path) as free:
        assert free and lock.held(tmp_path)
        with lock.locked(tmp_path) as again:
            assert not again
    assert not lock.held(tmp_path)


def test_rows_by_line_and_name(row):
    there = row("house", "A")
    assert batch_run.row_at(f"{there.table}:2") == batch_run.row_at(f"{there.table}:{there.name}") == there
    for place, said in ((f"{there.table}:3", "no run in line 3"), ("", "give TABLE:LINE")):
        with pytest.raises(BatchError, match=said):
            batch_run.row_at(place)
