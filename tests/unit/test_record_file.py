# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Record files of a folder of unknown origin: every reader refuses in one line what is no file of a run."""
import ast
import os
from pathlib import Path

import pytest
from timber_houses.base import record_file
from timber_houses.base.errors import RunError
from timber_houses.base.record_file import open_record, read_record
from timber_houses.base.table import read_rows
from timber_houses.recording import append_log, ensemble, frames
from timber_houses.recording.history import History
from timber_houses.recording.summary import Summary
from timber_houses.run.options import RunOptions
from timber_houses.study.driver import Task

PACKAGE = Path(record_file.__file__).parents[1]
READERS = {
    "frames.h5": lambda folder: frames.load(folder / "frames.h5"),
    "frames.log": lambda folder: list(append_log.read(folder / "frames.log", "run 1")),
    "samples.log": lambda folder: append_log.AppendLog(folder / "samples.log", "run 1").cut(0.0),
    "a.log": lambda folder: append_log.AppendLog(folder / "a.log", "run 1").flush(),
    "summary.json": Summary.read,
    "ensemble.json": ensemble.read,
    "history.csv": lambda folder: History.read(folder / "history.csv"),
    "breaks.csv": lambda folder: read_rows(folder / "breaks.csv"),
    "run.json": lambda folder: Task(folder, RunOptions(house="A")).error,
}
"""{file: what reads it in a folder}. The checkpoint: test_cli_errors."""


def large(path):
    """A file of 3 GB without content, which takes no place on the disk."""
    path.touch()
    os.truncate(path, 3_000_000_000)


def link(path):
    path.with_name("target").write_text("words of another file")
    path.symlink_to("target")


def loop(path):
    path.symlink_to(path.name)


KINDS = [os.mkfifo, os.mkdir, link, loop, large, lambda path: path.symlink_to("/dev/zero")]


@pytest.mark.parametrize("make", KINDS)
@pytest.mark.parametrize("name", READERS)
def test_what_is_no_record_file(tmp_path, name, make):
    """One line, without waiting for a pipe, without reading or changing what a link leads to."""
    make(tmp_path / name)
    with pytest.raises(RunError, match=f"{name}: ") as raised:
        READERS[name](tmp_path)
    assert "\n" not in str(raised.value) and "words" not in str(raised.value)
    assert make is not link or (tmp_path / "target").read_text() == "words of another file"


@pytest.mark.parametrize("content", [b"[]", b"[" * 100_000, b"{", b"3", b"\xff"])
@pytest.mark.parametrize("name", [name for name in READERS if name.endswith("json")])
def test_json_that_is_no_table_of_ours(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(RunError, match=f"{name}: ") as raised:
        READERS[name](tmp_path)
    assert "\n" not in str(raised.value)


def test_ensemble_of_impossible_runs(tmp_path):
    """Names of folders that the system refuses are no runs."""
    (tmp_path / "ensemble.json").write_text(f'{{"finished": [{"9" * 4000}], "shown": 1}}')
    assert not ensemble.has_runs(tmp_path)
    (tmp_path / "ensemble.json").write_text('{"finished": [1e999], "shown": 1}')
    with pytest.raises(RunError, match="ensemble.json: "):
        ensemble.has_runs(tmp_path)


def test_content(tmp_path):
    (tmp_path / "a").write_bytes(b"abc")
    assert read_record(tmp_path / "a", limit=3) == b"abc"
    with pytest.raises(RunError, match="a: 0 MB; at most"):
        read_record(tmp_path / "a", limit=2)
    with pytest.raises(RunError, match="none: no such file; make it"):
        read_record(tmp_path / "none", "make it")
    with pytest.raises(RunError, match="cannot be read"):
        read_record(tmp_path / "a\0b")
    with open_record(tmp_path / "new", os.O_RDWR | os.O_CREAT) as file:
        file.write(b"x")
    assert (tmp_path / "new").read_bytes() == b"x"


def readings(path):
    """Calls in a module that open a file by its path, beside those of record_file and input_file."""
    names = {"open", "read_text", "read_bytes", "File"}
    calls = (node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Call))
    return [ast.unparse(call)[:60] for call in calls
            if getattr(call.func, "attr", getattr(call.func, "id", "")) in names]


OTHERS = {"recording/table_file.py", "recording/frames.py", "run/checkpoint.py", "run/identity.py",
          "study/batch/table.py"}
"""Modules that open what `record_file` has opened, files in memory, and inputs that the user names."""


def test_every_reader_is_here():
    """Rooms that read files of runs do so through `record_file`."""
    found = [(path.relative_to(PACKAGE).as_posix(), call) for room in ("recording", "run", "study", "text", "api")
             for path in sorted((PACKAGE / room).rglob("*.py")) for call in readings(path)]
    assert {module for module, _ in found} == OTHERS
    hdf5 = [module for module, call in found if call.startswith("h5py.File")]
    assert sorted(hdf5) == ["recording/frames.py", "recording/table_file.py"]  # the first one writes
