# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables: yade-batch's format, names of runs that follow their content, refusals; one table of results."""

import csv
import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.study.batch import BatchError, read_table, write_runs  # noqa: E402
from yade_timber.study.batch.collect import RESULTS  # noqa: E402
from yade_timber.study.batch.table import check_shell_safe  # noqa: E402

TABLE = """# comment
house  description!  scale  !THREADS  snow   # of the roof

'B'    calm          0.5    1         *
=      strong        2      1         1.0
A      =             =      1         =
"""


@pytest.fixture
def table(tmp_path):
    def write(text):
        path = tmp_path / "runs.txt"
        path.write_text(text)
        return read_table(path)

    return write


def test_yade_batch_s_format(table):
    """Comments, empty lines, quotes, defaults, repetition, yade-batch's own columns."""
    rows = table(TABLE)
    assert [row.line for row in rows] == [4, 5, 6]
    assert rows[0].cells == {"house": "B", "scale": "0.5"} and rows[0].value("snow", 0.25) == 0.25
    assert rows[1].cells == {"house": "B", "scale": "2", "snow": "1.0"} and rows[1].value("snow") == 1.0
    assert rows[2].cells == {"house": "A", "scale": "2", "snow": "1.0"} and rows[2].description == "strong"


def test_names_follow_content_not_place(table):
    first = [row.name for row in table(TABLE)]
    head, *body = TABLE.split("\n\n")[0], TABLE.split("\n\n")[1]
    moved = table(head + "\n" + "B other 3 1 *\n" + body[0])
    assert [row.name for row in moved][1:] == first and len(set(first)) == 3
    assert first[0].startswith("calm-") and table("house scale\nB 1\n")[0].name.startswith("B-")
    assert table(TABLE.replace("0.5", "0.6"))[0].name != first[0]


def test_house_files_lie_beside_the_table_wherever_the_process_runs(table, tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "mine.yaml").write_text("extends: A")
    monkeypatch.chdir(tmp_path / "elsewhere")
    rows = table("house scale\nmine.yaml 1\nA 1\nnope 1\n")
    assert [row.house for row in rows] == [str(tmp_path / "mine.yaml"), "A", "nope"]


def test_names_follow_house_and_record(table, tmp_path):
    """What is in the files counts: a house that differs in one number, a record that differs in one letter."""
    base = (Path(__file__).resolve().parents[2] / "py/yade_timber/data/houses/base.yaml").read_text()
    for folder, density, letter in (("a", 340, "x"), ("b", 341, "x"), ("c", 340, "y"), ("d", 340, "x")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "mine.yaml").write_text(base.replace("density: 340", f"density: {density}"))
        (tmp_path / folder / "rec.csv").write_text(letter)
    rows = {}
    for folder in "abcd":
        (tmp_path / folder / "runs.txt").write_text("house record\nmine.yaml rec.csv\n")
        rows[folder] = read_table(tmp_path / folder / "runs.txt")[0]
        assert rows[folder].house == str(tmp_path / folder / "mine.yaml") and rows[folder].record == str(tmp_path / folder / "rec.csv")
    assert len({row.name for row in rows.values()}) == 3 and rows["a"].name == rows["d"].name


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "empty"),
        ("house scael\nB 1\n", "runs.txt:1: unknown column 'scael', did you mean 'scale'?"),
        ("scale\n1\n", "no column 'house'"),
        ("house scale scale\nB 1 1\n", "column 'scale' is given twice"),
        ("house scale\nB\n", "runs.txt:2: 1 values for 2 columns"),
        ("house scale\n= 1\n", "'=' repeats the line above"),
        ("house scale\n* 1\n", "runs.txt:2, column house: every run needs a house"),
        ("house scale\nB 1\nB 1\n", "runs.txt:3: the same run as in line 2"),
        ("house scale\nB 1", "its last line has no line end"),
    ],
)
def test_refused_tables(table, text, said):
    with pytest.raises(BatchError) as caught:
        table(text)
    assert said in str(caught.value) and "\n" not in str(caught.value)


def test_refused_values(table):
    row = table("house scale seed resample\nB two 1.5 maybe\n")[0]
    for column, said in (("scale", "'two' is not a number"), ("seed", "'1.5' is not a whole number"), ("resample", "'maybe' is not yes or no")):
        with pytest.raises(BatchError, match=f"runs.txt:2, column {column}: {said}"):
            row.value(column)


def test_paths_for_the_shell():
    check_shell_safe("/a-b/c_d/e=1,2.txt")
    for path in ("/a b/c.txt", "/a/c;d.txt", "/a/$c.txt", "/a/c'.txt"):
        with pytest.raises(BatchError, match="yade-batch takes no blanks"):
            check_shell_safe(path)


def test_one_row_of_results_a_run(table, tmp_path):
    """Done, failed and unfinished runs, in the order of the table."""
    rows = table(TABLE)
    for row, status, error in zip(rows, ("done", "failed"), (None, "runs.txt:5: it broke")):
        (tmp_path / row.name).mkdir()
        (tmp_path / row.name / "run.json").write_text(json.dumps({"status": status, "error": error}))
    found = {"collapsed": True, "collapse_time_s": 21.5, "peak_drift": {"storey1": {"ns": 0.25, "ew": None}}, "broken": {"total": 7}, "record": None}
    (tmp_path / rows[0].name / "summary.json").write_text(json.dumps(found))
    write_runs(rows, tmp_path)
    with open(tmp_path / "runs.csv", newline="") as file:
        done, failed, unfinished = csv.DictReader(file)
    assert [r["status"] for r in (done, failed, unfinished)] == ["done", "failed", "unfinished"]
    assert (done["house"], done["scale"], done["snow"], done["description"]) == ("B", "0.5", "", "calm")
    assert done["peak_drift"] == "0.25" and (done["collapsed"], done["collapse_time_s"], done["peak_drift_1_ns"], done["peak_drift_1_ew"], done["broken"]) == ("True", "21.5", "0.25", "", "7")
    assert failed["error"] == "runs.txt:5: it broke" and not any(failed[column] for column in RESULTS)
