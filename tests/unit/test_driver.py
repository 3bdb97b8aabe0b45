# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Runs of the driver: only missing ones are done, and none is taken that was made from something else."""
import json
import os
import re
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.run import identity
from timber_houses.run.identity import made_from
from timber_houses.run.options import RunOptions, read_request, scripted, write_request
from timber_houses.study import driver
from timber_houses.study.driver import Task, run_missing


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """Processes of Python instead of YADE, which write a summary of their request; of the seed 7 they fail."""
    def command(_):
        return [sys.executable, str(tmp_path / "fake.py")]

    (tmp_path / "fake.py").write_text("""import sys
from pathlib import Path
from summaries import sample_summary
from timber_houses.run import identity
from timber_houses.run.options import read_request
from timber_houses.study import driver
options = read_request(Path(sys.argv[1]))
if options.seed == 7:
    driver.note_fault(options.folder, 'no')
    sys.exit(1)
if options.seed == 8:
    sys.exit(3)
sample_summary(dt=options.dt, made_from=identity.made_from(options)).write(options.folder)
""")
    monkeypatch.setattr(driver, "command", command)


@pytest.mark.parametrize("options", [
    scripted("modelA_snow", "A", snow=True, dt=1e-4),
    scripted("modelA_quake", "A", earthquake=True, record="x.csv", then="y@0.5", disturb=3),
    RunOptions(house="mine.yaml", seed=2, scale=0.1 + 0.2, no_frames=True, until_collapse=True),
])
def test_a_request_keeps_all_that_decides(tmp_path, options):
    """To the last bit; what a study does not pass on has its default."""
    request = Task(tmp_path, replace(options, ensemble=4, jobs=2, report=True, export=Path("x"))).request()
    write_request(request)
    read = read_request(tmp_path)
    assert read == request and (read.shaken, read.decisive()) == (options.shaken, options.decisive())
    assert (read.folder, read.resume, read.no_frames) == (tmp_path, True, options.no_frames)
    assert (read.ensemble, read.jobs, read.report, read.export) == (None, None, False, None)


def test_only_missing_runs_are_done(tmp_path, fake):
    """Options reach the process; a run with a summary of the same options is kept; a failed run records its error and
    does not stop the others.
    """
    given = {"a": {"dt": 2e-4}, "b": {"seed": 7}, "c": {}, "d": {"seed": 8}}
    tasks = [Task(tmp_path / name, RunOptions(house="A", **options)) for name, options in given.items()]
    tasks[2].folder.mkdir()
    old = sample_summary(made_from=made_from(RunOptions(house="A")))
    old.write(tasks[2].folder)
    said = []
    done = run_missing(tasks, 2, said.append)
    assert done[tasks[0]].dt == 2e-4
    assert done[tasks[1]] is None
    assert tasks[1].error == "no"
    assert tasks[1].status == "failed"
    assert any("b: failed: no" in line for line in said)
    assert done[tasks[2]] == old and said[0].startswith("3 of 4 ")
    assert tasks[3].error == f"exit status 3; see {tmp_path / 'd' / driver.LOG}"


def test_a_run_that_ended_without_its_driver_is_recorded(tmp_path):
    """Its summary is there, run.json is not: the driver was killed."""
    task = Task(tmp_path, RunOptions(house="A"))
    sample_summary(made_from=made_from(task.options)).write(tmp_path)
    assert run_missing([task])[task] is not None
    assert json.loads((tmp_path / driver.END).read_text()) == {"status": "done", "error": None}


def test_a_pipe_as_log_is_refused(tmp_path, fake):
    os.mkfifo(tmp_path / driver.LOG)
    with pytest.raises(RunError, match="run.log: not a regular file"):
        run_missing([Task(tmp_path, RunOptions(house="A"))], 1, print)


def test_results_made_from_something_else_are_not_taken(tmp_path, fake, monkeypatch):
    """Other options, another house file, another file that it extends, another record, another version of the package.
    """
    said = []
    house, beside, record = tmp_path / "own.yaml", tmp_path / "beside.yaml", tmp_path / "own.csv"
    house.write_text("extends: beside.yaml\n")
    beside.write_text("name: one\n")
    record.write_text("1\n")

    def runs_done(scale=1.0):
        task = Task(tmp_path / "a", RunOptions(house=str(house), record=str(record), scale=scale))
        del said[:]
        assert run_missing([task], 1, said.append)[task].made_from["options"]["scale"] == scale
        return len(said) and "again" in said[-1]

    assert runs_done() is False and runs_done() == 0
    assert runs_done(scale=2.0) and runs_done(scale=2.0) == 0
    for file in (house, beside, record):
        file.write_text(file.read_text() + "# changed\n")
        assert runs_done(scale=2.0) and runs_done(scale=2.0) == 0
    monkeypatch.setattr(identity, "package", lambda: "another")
    task = Task(tmp_path / "a", RunOptions(house=str(house), record=str(record), scale=2.0))
    assert task.summary is None and run_missing([task], 1, said.append) == {task: None}
    assert task.status == "failed" and "another timber_houses" in task.error and task.error in said[-1]


def test_the_first_run_tells_how_long_the_others_take(tmp_path, fake):
    """One line after the first run, before the other two start."""
    said = []
    run_missing([Task(tmp_path / name, RunOptions(house="A")) for name in "abc"], 1, said.append)
    assert said[1].startswith("[1/3]") and said[3].startswith("[2/3]")
    assert re.fullmatch(r"2 other runs as long as the first: about \d+ s, 1 at a time", said[2])


@pytest.mark.parametrize("seconds, text", [(89.4, "about 89 s"), (90.0, "about 2 min"), (5399, "about 90 min"),
                                           (9000, "about 2.5 h")])
def test_times_in_words(seconds, text):
    assert driver.about(seconds) == text
