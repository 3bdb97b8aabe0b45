# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables: both formats, names of runs, refused tables, the table of results."""
import csv
import json
import os
from pathlib import Path

import pytest
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.recording.events import Event, StructureFallen, Tilt
from timber_houses.study.batch import BatchError, check_rows, read_table, write_runs
from timber_houses.study.batch.rows import RESULTS
from timber_houses.run.identity import made_from

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


def test_format_of_yade_batch(table):
    """Comments, empty lines, quotes, defaults, repetition, yade-batch's own columns."""
    rows = table(TABLE)
    assert [row.line for row in rows] == [4, 5, 6]
    assert [row.cells for row in rows] == [{"house": "B", "scale": 0.5}, {"house": "B", "scale": 2.0, "snow": 1.0},
                                           {"house": "A", "scale": 2.0, "snow": 1.0}]
    assert rows[2].description == "strong"


def test_names_follow_content_not_line(table):
    first = [row.name for row in table(TABLE)]
    head, *body = TABLE.split("\n\n")[0], TABLE.split("\n\n")[1]
    moved = table(head + "\n" + "B other 3 1 *\n" + body[0])
    assert [row.name for row in moved][1:] == first and len(set(first)) == 3
    assert first[0].startswith("calm-") and table("house scale\nB 1\n")[0].name.startswith("B-")
    assert table(TABLE.replace("0.5", "0.6"))[0].name != first[0]


def test_house_files_are_relative_to_the_table(table, tmp_path, monkeypatch):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "mine.yaml").write_text("extends: A")
    monkeypatch.chdir(tmp_path / "elsewhere")
    rows = table("house scale\nmine.yaml 1\nA 1\nnope 1\n")
    assert [row.options.house for row in rows] == [str(tmp_path / "mine.yaml"), "A", "nope"]


def test_names_follow_house_and_record(table, tmp_path):
    """The content of files counts: a house that differs in one number, a record that differs in one letter."""
    for folder, density, letter in (("a", 340, "x"), ("b", 341, "x"), ("c", 340, "y"), ("d", 340, "x")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "mine.yaml").write_text(f"extends: A\nmaterials: {{timber: {{density: {density}}}}}\n")
        (tmp_path / folder / "rec.csv").write_text(letter)
    rows = {}
    for folder in "abcd":
        (tmp_path / folder / "runs.txt").write_text("house record\nmine.yaml rec.csv\n")
        rows[folder] = read_table(tmp_path / folder / "runs.txt")[0]
        assert rows[folder].options.house == str(tmp_path / folder / "mine.yaml")
        assert rows[folder].options.record == str(tmp_path / folder / "rec.csv")
    assert len({row.name for row in rows.values()}) == 3 and rows["a"].name == rows["d"].name


@pytest.mark.parametrize("text, part", [
    ("", "empty"),
    ("house scael\nB 1\n", "runs.txt:1: unknown column 'scael', did you mean 'scale'?"),
    ("scale\n1\n", "no column 'house'"),
    ("house scale scale\nB 1 1\n", "column 'scale' is given twice"),
    ("house scale\nB\n", "runs.txt:2: 1 values for 2 columns"),
    ("house scale\n= 1\n", "'=' repeats the line above"),
    ("house scale\n* 1\n", "runs.txt:2, column house: every run needs a house"),
    ("house scale\nB 1\nB 1\n", "runs.txt:3: the same run as in line 2"),
    ("house;scale\nB;1\n", "runs.txt:1: "),
    ("house,scale\nB,1,2\n", "runs.txt:2: 3 values for 2 columns"),
    (f"house,scale\nB,1\nB,{'1' * 140_000}\n", "runs.txt:3: field larger than field limit"),
])
def test_refused_tables(table, text, part):
    with pytest.raises(BatchError) as caught:
        table(text)
    assert part in str(caught.value) and "\n" not in str(caught.value)


@pytest.mark.parametrize("column, value", [("scale", "two"), ("seed", "1.5"), ("resample", "maybe")])
def test_refused_values(table, column, value):
    with pytest.raises(RunError, match=f"runs.txt:2, column {column}: '{value}'"):
        table(f"house {column}\nB {value}\n")


def test_a_seed_without_an_earthquake(table):
    with pytest.raises(RunError, match="runs.txt:2, column seed: the column record is none"):
        table("house record seed\nB none 5\n")


def test_comma_separated_values(table):
    """CSV as a spreadsheet writes it: byte order mark, quotes, blanks in a value, empty cells for defaults, no line
    end.
    """
    (first, second) = table('\ufeffhouse,description,scale,set,snow\nB,"calm, long",0.5,,\n=,strong,2,a=1;b=2,1')
    assert (first.cells, first.description) == ({"house": "B", "scale": 0.5}, "calm, long")
    assert second.cells == {"house": "B", "scale": 2.0, "set": "a=1;b=2", "snow": 1.0}
    assert first.name.startswith("calm_long-")


def test_a_value_may_contain_a_number_sign(table, tmp_path):
    """A comment begins at the start of the line or after a blank, outside quotes."""
    rows = table('house,record,set # columns\nA,rec#1.csv,"a=b # c"  # first\n# none\n')
    assert [row.cells for row in rows] == [{"house": "A", "record": str(tmp_path / "rec#1.csv"), "set": "a=b # c"}]


def test_records_are_named_as_on_the_command_line(table, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path / "me"))
    first, second = table('house,record\nA,"a.NS, b/a.EW"\nA,~/a.csv')
    assert first.options.record == f"{tmp_path / 'a.NS'},{tmp_path / 'b' / 'a.EW'}"
    assert second.options.record == str(tmp_path / "me" / "a.csv")


@pytest.mark.parametrize("text, remedy", [
    ("house,scale\nC,0,5", "write decimal points"),
    ("house scale\nC 1,5", "write a decimal point: 1.5"),
    ("house scale\nC,0.5", "separate the names in it by commas"),
    ("house scale\nC, 0.5", "separate the names in it by commas"),
    ("house, record, scale\nC, a.NS,a.EW, 0.5", "in quotes"),
    ("house;scale\nC;0.5", "semicolons"),
])
def test_commas_are_answered_with_the_remedy(table, text, remedy):
    with pytest.raises(RunError, match=remedy):
        table(text)


SUMMARY = {"collapsed": True, "collapse_time_s": 21.5, "peak_drift": {"storey1": {"ns": 0.25, "ew": None}},
           "broken": {"total": 7}}


def result(rows, folder, summary, errors=()):
    """Rows of runs.csv after the first run has this summary (changes of a sample) and later ones these errors."""
    for row, error in zip(rows[1:], errors):
        (folder / row.name).mkdir()
        (folder / row.name / "run.json").write_text(json.dumps({"status": "failed", "error": error}))
    (folder / rows[0].name).mkdir()
    sample_summary(**summary, made_from=made_from(rows[0].task(folder).options)).write(folder / rows[0].name)
    write_runs(rows, folder)
    with open(folder / "runs.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_one_row_of_results_per_run(table, tmp_path):
    """Done, failed and unfinished runs, in the order of the table."""
    done, failed, unfinished = result(table(TABLE), tmp_path, SUMMARY, ["it broke"])
    assert [r["status"] for r in (done, failed, unfinished)] == ["done", "failed", "unfinished"]
    assert (done["house"], done["scale"], done["snow"], done["description"]) == ("B", "0.5", "", "calm")
    assert (done["peak_drift"], done["peak_drift_1_ns"], done["peak_drift_1_ew"]) == ("0.25", "0.25", "")
    assert (done["collapsed"], done["collapse_time_s"], done["broken"], done["events"]) == ("True", "21.5", "7", "")
    assert failed["error"] == "runs.txt:5: it broke" and not any(failed[column] for column in RESULTS)


def test_events_of_a_run(table, tmp_path):
    events = [Event(2.3, Tilt("ew")), Event(21.5, StructureFallen("carport"))]
    (run,) = result(table("house\nB\n"), tmp_path, {**SUMMARY, "events": events})
    assert run["events"] == ("2.30 s a storey drift E-W passes 1/10; "
                             "21.50 s carport has fallen: a level is down by half a storey")


def test_wall_sheets_stand_apart_from_joints(table, tmp_path):
    walls = {"joints": {"total": 376, "wall_sheets": 44}, "broken": {"total": 7, "wall_sheets": 5}}
    (run,) = result(table("house\nB\n"), tmp_path, {**SUMMARY, **walls})
    assert [run[column]
            for column in ("joints", "broken", "wall_sheets", "broken_wall_sheets")] == ["376", "7", "44", "5"]


def test_results_made_from_something_else_do_not_count(table, tmp_path):
    rows = table("house scale\nB 1\n")
    assert result(rows, tmp_path, SUMMARY)[0]["status"] == "done"
    path = tmp_path / rows[0].name / "summary.json"
    path.write_text(path.read_text().replace('"quake"', '"other"'))
    assert write_runs(rows, tmp_path)[0]["status"] == "unfinished"


def test_a_pipe_or_device_is_no_table(tmp_path):
    """Refused at once: nothing is read, or waited for, that is no regular file."""
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path(os.devnull)):
        with pytest.raises(BatchError, match=f"{path}: cannot be read: not a regular file"):
            read_table(path)


def test_empty_columns_of_a_spreadsheet(tmp_path):
    """Columns and lines that were once used; a value without a column's name is refused."""
    (tmp_path / "a.csv").write_text("house,snow,duration,,,\nB,1,0.02,,,\n,,,,,\n", encoding="utf-8-sig")
    (row,) = read_table(tmp_path / "a.csv")
    assert row.cells == {"house": "B", "snow": 1.0, "duration": 0.02}
    (tmp_path / "a.csv").write_text("house,snow,,\nB,1,2,\n")
    with pytest.raises(BatchError, match="a.csv:2: the value '2' is in a column without a name"):
        read_table(tmp_path / "a.csv")


def test_a_table_in_another_encoding(tmp_path):
    (tmp_path / "a.csv").write_bytes("house,description\nB,\u57fa\u6e96\n".encode("cp932"))
    with pytest.raises(BatchError, match="save it as UTF-8"):
        read_table(tmp_path / "a.csv")


def test_a_house_of_too_long_a_name_is_one_that_is_not_there(tmp_path, table):
    """The system refuses such a path; the house is refused when the rows are checked."""
    (row,) = table(f"house snow\n{'9' * 400} 1\n")
    with pytest.raises(BatchError, match="runs.txt:2"):
        check_rows([row], tmp_path)
