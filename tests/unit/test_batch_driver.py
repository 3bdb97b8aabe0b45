# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/study/batch.py with real runs: stopped, killed, resumed; tables and options with errors are refused before
the first run.
"""
import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from timber_houses.base.lock import LOCK, is_locked, locked
from timber_houses.study.batch import read_table
from timber_houses.study.driver import DRIVER

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
TABLE = """house  description  snow  set                                dt    duration
A      quick        0     *                                  2e-4  0.004
B      stiff        0     joint_types.corner_fitting.kn=1e12  2e-4  0.004
B      long         1     *                                  2e-4  0.2
A      last         1     *                                  2e-4  0.004
"""
"""The second run fails when its scene is built: its joints are too stiff for the time step."""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "runs.txt").write_text(TABLE)
    return tmp_path


def start(folder, *options):
    """scripts/study/batch.py, two runs at a time."""
    command = [sys.executable, str(SCRIPTS / "study" / "batch.py"), "runs.txt", "-j", "2", *options]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def states(folder):
    """{description: status} of runs.csv."""
    with open(folder / "results" / "runs" / "runs.csv", newline="") as file:
        return {row["description"]: row["status"] for row in csv.DictReader(file)}


def wait_for(folder, pattern, process, condition):
    """Wait until the condition holds for a file or folder of that pattern among the results; returns it."""
    deadline = time.monotonic() + 120
    while True:
        found = [path for path in (folder / "results" / "runs").glob(pattern) if condition(path)]
        if found:
            return found[0]
        assert process.poll() is None and time.monotonic() < deadline, process.stdout.read()
        time.sleep(0.02)


def children(process):
    return [int(pid) for pid in subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True,
                                               text=True).stdout.split()]


@pytest.mark.rare
@pytest.mark.skipif(shutil.which("yade") is None, reason="yade is not installed")
def test_stopped_killed_resumed(folder):
    stopped = start(folder)
    wait_for(folder, "long-*", stopped, is_locked)
    stopped.terminate()
    output, _ = stopped.communicate(timeout=120)
    assert stopped.returncode == 1 and "same command continues" in output
    assert states(folder)["long"] == "unfinished"
    assert not any(map(is_locked, (folder / "results" / "runs").glob("long-*")))

    killed = start(folder)
    long = wait_for(folder, "long-*", killed, is_locked)
    runs = children(killed)
    for pid in [killed.pid, *runs]:
        os.kill(pid, signal.SIGKILL)
    killed.wait()
    while is_locked(long):
        time.sleep(0.02)
    finished = {path: path.stat().st_mtime_ns for path in (folder / "results" / "runs").glob("*/run.json")}

    whole = start(folder)
    output, _ = whole.communicate(timeout=180)
    assert whole.returncode == 1 and "3 done, 1 failed" in output, output
    assert "failed: stiff-" in output and "runs.txt:3: " in output and "--dt" in output
    assert states(folder) == {"quick": "done", "stiff": "failed", "long": "done", "last": "done"}
    assert {path: path.stat().st_mtime_ns for path in finished} == finished

    again = start(folder)
    output, _ = again.communicate(timeout=60)
    assert "runs to do" not in output and "3 done, 1 failed" in output, output


@pytest.mark.parametrize("name", [LOCK, DRIVER])
def test_a_run_of_another_process_is_left_alone(folder, name):
    """Of a run, or of another driver whose YADE has not started yet."""
    row = next(row for row in read_table(folder / "runs.txt") if row.description == "long")
    run = folder / "results" / "runs" / row.name
    run.mkdir(parents=True)
    with locked(run, name):
        process = start(folder, "--only", row.name)
        output, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and "another process" in output and {path.name for path in run.iterdir()} == {name}


@pytest.mark.parametrize("table, place", [
    ("house scael\nB 1\n", "runs.txt:1: "),
    ("house dt\nB 2e-4\nB 1\n", "runs.txt:3, column dt: "),
    ("house\nB\nnope\n", "runs.txt:3: "),
    ("house record\nB none\nB nowhere.csv\n", "runs.txt:3: "),
    (None, "runs.txt: "),
])
def test_tables_are_checked_before_the_first_run(folder, table, place):
    (folder / "runs.txt").write_text(table) if table else (folder / "runs.txt").unlink()
    process = start(folder)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and output.startswith("error: ") and place in output and output.count(
        "\n") == 1, output
    assert not list(folder.rglob("run.json"))


@pytest.mark.parametrize("options", [("--jobs", "-3"), ("--jobs", "9" * 30), ("--out", ""), ("--out", "/proc/x"),
                                     ("--only", "none"), ("--frob", )])
def test_options_are_refused_in_one_line(folder, options):
    process = start(folder, *options)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and output.startswith("error: ") and options[0] in output and output.count(
        "\n") == 1, output
