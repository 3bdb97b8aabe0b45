# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/study/batch.py with the real yade-batch: a table of short runs, stopped and killed in the middle, resumed; then nothing is left to do."""

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber.base.lock import held  # noqa: E402

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
TABLE = """house  description  snow  dt    duration
A      quick        0     2e-4  0.004
B      wrong        0     1     0.004
B      long         1     2e-4  0.2
A      last         1     2e-4  0.004
"""

pytestmark = pytest.mark.skipif(shutil.which("yade-batch") is None, reason="yade-batch is not installed")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "runs.txt").write_text(TABLE)
    return tmp_path


def start(folder):
    """scripts/study/batch.py, two runs at a time."""
    command = [sys.executable, str(SCRIPTS / "study" / "batch.py"), "runs.txt", "-j", "2"]
    return subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def states(folder):
    """{description: status} of runs.csv."""
    with open(folder / "results" / "runs" / "runs.csv", newline="") as file:
        return {row["description"]: row["status"] for row in csv.DictReader(file)}


def wait_for(pattern, folder, process, condition=Path.exists):
    """Until a file of that pattern is among the results, for which the condition holds."""
    end = time.monotonic() + 120
    while not any(map(condition, (folder / "results" / "runs").glob(pattern))):
        assert process.poll() is None and time.monotonic() < end, process.stdout.read()
        time.sleep(0.02)


def test_stopped_killed_resumed(folder):
    stopped = start(folder)
    wait_for("long-*/.lock", folder, stopped)
    stopped.terminate()
    said, _ = stopped.communicate(timeout=120)
    assert stopped.returncode == 1 and "the same command goes on" in said
    assert states(folder)["long"] == "unfinished" and not any(map(held, (folder / "results" / "runs").glob("long-*")))

    killed = start(folder)
    wait_for("long-*", folder, killed, held)
    yade_batch = int(subprocess.run(["pgrep", "-P", str(killed.pid)], capture_output=True, text=True).stdout)
    os.killpg(yade_batch, signal.SIGKILL)  # yade-batch and its jobs
    said, _ = killed.communicate(timeout=120)
    assert killed.returncode == 1 and "yade-batch ended with status -9" in said and (states(folder)["wrong"], states(folder)["long"]) == ("failed", "unfinished")
    finished = {path: path.stat().st_mtime_ns for path in (folder / "results" / "runs").glob("*/run.json")}

    whole = start(folder)
    said, _ = whole.communicate(timeout=180)
    assert whole.returncode == 1 and "3 done, 1 failed" in said, said
    assert "failed: wrong-" in said and "runs.txt:3, column dt: 1: must be between" in said
    assert states(folder) == {"quick": "done", "wrong": "failed", "long": "done", "last": "done"}
    assert {path: path.stat().st_mtime_ns for path in finished} == finished
    assert not list(SCRIPTS.rglob("*.log")) and list((folder / "results" / "runs" / "logs").glob("*.log"))

    log = folder / "results" / "runs" / "logs" / "yade-batch.log"
    assert "All jobs finished" in log.read_text()
    log.unlink()
    again = start(folder)
    said, _ = again.communicate(timeout=60)
    assert not log.exists() and "3 done, 1 failed" in said, said


@pytest.mark.parametrize("table, said", [("house scael\nB 1\n", "unknown column 'scael'"), (None, "cannot be read")])
def test_refused(folder, table, said):
    (folder / "runs.txt").write_text(table) if table else (folder / "runs.txt").unlink()
    process = start(folder)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and out.startswith("error: ") and said in out and out.count("\n") == 1
