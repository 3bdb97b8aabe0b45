# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Names in any encoding and cells that a spreadsheet would evaluate: a run ends with its results, a table is text, no
file is quoted.
"""
import csv
import io
import json
import os
import subprocess
from pathlib import Path

import pytest
from timber_houses.base.atomic_write import write_text
from timber_houses.base.table import csv_text
from timber_houses.house import HouseError, load_house, load_town

ROOT = Path(__file__).resolve().parents[2]
JAPANESE, BYTES = "結果", os.fsdecode(b"\xff\xfe")
"""Folders: one that ASCII lacks, one that is not UTF-8."""
C_LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
STRICT = {"LC_ALL": "C.UTF-8", "PYTHONIOENCODING": "utf-8:strict"}


def run(folder, arguments, environment):
    """A short run, which must end with its results."""
    command = ["yade", "-n", "-x", str(ROOT / "scripts/house.py"), *arguments, "--snow", "0", "--duration", "0.01"]
    done = subprocess.run([os.fsencode(word) for word in command], cwd=folder, capture_output=True,
                          env={**os.environ, **environment}, timeout=300)
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    assert b"Traceback" not in done.stderr


@pytest.mark.parametrize("out, environment", [
    (JAPANESE, C_LOCALE), pytest.param(JAPANESE, {"LC_ALL": "C"}, marks=pytest.mark.rare), (BYTES, STRICT)],
                         ids=["ASCII", "C", "bytes"])
def test_folder_of_the_results(tmp_path, out, environment):
    """Written and resumed."""
    for options in ([], ["--resume"]):
        run(tmp_path, ["A", "--no-views", "--out", out, *options], environment)
    assert json.loads((tmp_path / out / "summary.json").read_text())["verdict"] == "undamaged"


@pytest.mark.rare
def test_names_of_house_and_record(tmp_path):
    """Undecodable bytes in the names of files become escapes in results, pictures and report."""
    house, record = (tmp_path / os.fsdecode(name) for name in (b"house\xff.yaml", b"record\xff.csv"))
    house.write_text("extends: A\n")
    record.write_text("# units: gal\n# dt: 0.01\nns\n" + "1\n-1\n" * 50)
    run(tmp_path, [house.name, "--record", record.name, "--report"], STRICT)
    folder = tmp_path / "results" / "house\\udcff"
    assert json.loads((folder / "summary.json").read_text())["scenario"] == "house\\udcff"
    assert "record\\udcff.csv" in (folder / "report.html").read_text(encoding="utf-8")
    assert (folder / "front.png").exists()


def test_text_files_take_any_text(tmp_path):
    write_text(tmp_path / "a.txt", "a\udcffb 小\n")
    assert (tmp_path / "a.txt").read_text(encoding="utf-8") == "a\\udcffb 小\n"


FORMULAS = ("=HYPERLINK(1)", "+1+1", "-2+3", "@SUM(A1)", "\t=1", "=1", "-a")
PLAIN = ("-", "-0.5", "+2", "-1e-3", "a=b", "", "House =1", "1/120", 3, -0.5, None, True)


def test_cells_are_no_formulas():
    rows = list(csv.reader(io.StringIO(csv_text(("name",), [[value] for value in FORMULAS]), newline="")))[1:]
    assert [row[0] for row in rows] == [f"'{value}" for value in FORMULAS]
    assert csv_text(("a", ), [[value] for value in PLAIN]).splitlines()[1:] == [
        "-", "-0.5", "+2", "-1e-3", "a=b", '""', "House =1", "1/120", "3", "-0.5", '""', "True"
    ]


SECRET = "root:x1y2z3:0:0\n"


@pytest.mark.parametrize("name", ["passwd", "shadow.conf", "link.yaml"])
def test_a_file_that_is_no_house_file_is_not_quoted(tmp_path, name):
    """Named by `extends` or by a lot of a town; a link counts by what it points to."""
    (tmp_path / "passwd").write_text(SECRET)
    (tmp_path / "shadow.conf").write_text(SECRET)
    (tmp_path / "link.yaml").symlink_to(tmp_path / "passwd")
    (tmp_path / "house.yaml").write_text(f"extends: {name}\n")
    (tmp_path / "town.yaml").write_text(f"name: t\nlots:\n  a: {{house: {name}, x: 0, y: 0}}\n")
    for load, file in ((load_house, "house.yaml"), (load_town, "town.yaml")):
        with pytest.raises(HouseError,
                           match=rf"^{file}:\d: .*is not a house file; its name must end in .yaml or .yml") as caught:
            load(tmp_path / file)
        assert "x1y2z3" not in str(caught.value)


def test_house_files_of_either_ending(tmp_path):
    (tmp_path / "base.yml").write_text("extends: A\nname: base\n")
    (tmp_path / "house.yaml").write_text("extends: base.yml\nname: mine\n")
    assert load_house(tmp_path / "house.yaml").name == "mine"
