# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Runs of the driver: only missing ones are done, and none is taken that was made from something else."""
import json
import os
import re
import sys

import pytest
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.run import identity
from timber_houses.run.identity import made_from
from timber_houses.run.options import RunOptions
from timber_houses.study import driver
from timber_houses.study.driver import Task, run_missing


def fake_script(folder, body):
    """A folder of scripts with run.py, called like a run script."""
    (folder / "run.py").write_text(body)
    return folder


WRITES = """import sys
from summaries import sample_summary
from timber_houses.run import cli, identity
options = cli.read_house(sys.argv)
sample_summary(scenario=' '.join(sys.argv), made_from=identity.made_from(options)).write(options.folder)
"""


def test_only_missing_runs_are_done(tmp_path, monkeypatch):
    """Options reach the script; a run with a summary of the same options is kept; a failed run records its error and
    does not stop the others.
    """
    monkeypatch.setattr(driver, "command", lambda script: [sys.executable, str(script)])
    scripts = fake_script(tmp_path, "import sys\nif '--seed=7' in sys.argv: sys.exit('error: no')\n" + WRITES)
    tasks = [
        Task("run", tmp_path / name, RunOptions(house="A", **given))
        for name, given in (("a", {"dt": 2e-4}), ("b", {"seed": 7}), ("c", {}))
    ]
    tasks[2].folder.mkdir()
    old = sample_summary(made_from=made_from(RunOptions(house="A")))
    old.write(tasks[2].folder)
    said = []
    done = run_missing(tasks, scripts, 2, said.append)
    assert "--dt=0.0002" in done[tasks[0]].scenario
    assert done[tasks[1]] is None
    assert tasks[1].error == "no"
    assert tasks[1].status == "failed"
    assert any("b: failed: no" in line for line in said)
    assert done[tasks[2]] == old and said[0].startswith("2 of 3 ")


def test_a_run_that_ended_without_its_driver_is_recorded(tmp_path):
    """Its summary is there, run.json is not: the driver was killed."""
    task = Task("run", tmp_path, RunOptions(house="A"))
    sample_summary(made_from=made_from(task.options)).write(tmp_path)
    assert run_missing([task], tmp_path)[task] is not None
    assert json.loads((tmp_path / driver.END).read_text()) == {"status": "done", "error": None}


def test_a_pipe_as_log_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(driver, "command", lambda script: [sys.executable, str(script)])
    scripts = fake_script(tmp_path, WRITES)
    os.mkfifo(tmp_path / driver.LOG)
    with pytest.raises(RunError, match="run.log: not a regular file"):
        run_missing([Task("run", tmp_path, RunOptions(house="A"))], scripts, 1, print)


def test_results_made_from_something_else_are_not_taken(tmp_path, monkeypatch):
    """Other options, another house file, another file that it extends, another record, another version of the package.
    """
    monkeypatch.setattr(driver, "command", lambda script: [sys.executable, str(script)])
    scripts, said = fake_script(tmp_path, WRITES), []
    house, beside, record = tmp_path / "own.yaml", tmp_path / "beside.yaml", tmp_path / "own.csv"
    house.write_text("extends: beside.yaml\n")
    beside.write_text("name: one\n")
    record.write_text("1\n")

    def runs_done(scale=1.0):
        task = Task("run", tmp_path / "a", RunOptions(house=str(house), record=str(record), scale=scale))
        del said[:]
        assert run_missing([task], scripts, 1, said.append)[task].made_from["options"]["scale"] == scale
        return len(said) and "again" in said[-1]

    assert runs_done() is False and runs_done() == 0
    assert runs_done(scale=2.0) and runs_done(scale=2.0) == 0
    for file in (house, beside, record):
        file.write_text(file.read_text() + "# changed\n")
        assert runs_done(scale=2.0) and runs_done(scale=2.0) == 0
    monkeypatch.setattr(identity, "package", lambda: "another")
    task = Task("run", tmp_path / "a", RunOptions(house=str(house), record=str(record), scale=2.0))
    assert task.summary is None and run_missing([task], scripts, 1, said.append) == {task: None}
    assert task.status == "failed" and "another timber_houses" in task.error and task.error in said[-1]


def test_the_first_run_tells_how_long_the_others_take(tmp_path, monkeypatch):
    """One line after the first run, before the other two start."""
    monkeypatch.setattr(driver, "command", lambda script: [sys.executable, str(script)])
    scripts, said = fake_script(tmp_path, WRITES), []
    run_missing([Task("run", tmp_path / name, RunOptions(house="A")) for name in "abc"], scripts, 1, said.append)
    assert said[1].startswith("[1/3]") and said[3].startswith("[2/3]")
    assert re.fullmatch(r"2 other runs as long as the first: about \d+ s, 1 at a time", said[2])


@pytest.mark.parametrize("seconds, text", [(89.4, "about 89 s"), (90.0, "about 2 min"), (5399, "about 90 min"),
                                           (9000, "about 2.5 h")])
def test_times_in_words(seconds, text):
    assert driver.about(seconds) == text
