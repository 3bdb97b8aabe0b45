# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""--ensemble with real runs of a few steps: results, extension by a run, Ctrl-C; what else stands in the folder."""
import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from timber_houses.base.lock import is_locked
from timber_houses.recording.ensemble import histories, read

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
SHORT = ("--dt", "4e-4", "--start", "18.5", "--duration", "0.1")
pytestmark = pytest.mark.skipif(shutil.which("yade") is None, reason="yade is not installed")


def start(folder, *options, script="modelC2_snow"):
    """Process of a run script with results in a folder."""
    command = ["yade", "-n", "-x", "-j1", str(SCRIPTS / f"{script}.py"), *options, "--out", str(folder)]
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True)


def run(folder, *options, **script):
    """Its output; it ends with status 0."""
    process = start(folder, *options, **script)
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 0, said
    return said


@pytest.mark.rare
def test_an_ensemble_is_extended_and_replaced(tmp_path):
    """The first run is the run without --ensemble, bit for bit; the others differ from it by little: after 0.1 s by
    less than 1e-6 of drift.
    """
    said = run(tmp_path, *SHORT, "--ensemble", "2", "--no-views")
    assert "2 of 2 runs to do" in said and "2 runs of house C2" in said and not (tmp_path / "ensemble.png").exists()
    kept = {path: path.stat().st_mtime_ns for path in tmp_path.glob("runs/*/summary.json")}
    said = run(tmp_path, *SHORT, "--ensemble", "3", "--jobs", "1")
    assert "1 of 3 runs to do" in said and {path: path.stat().st_mtime_ns for path in kept} == kept
    found, summary = read(tmp_path), json.loads((tmp_path / "summary.json").read_text())
    assert found["finished"] == [1, 2, 3]
    assert summary["ensemble"]["runs"] == 3
    assert summary["sentence"].startswith(f"Run {found['shown']} of 3 (3 undamaged")
    assert all((tmp_path / name).exists()
               for name in ("ensemble.csv", "ensemble.png", "front.png", "player.html", "history.csv"))

    first, second, third = (history.rows[:, 1:5] for history in histories(tmp_path).values())
    assert all(1e-13 < np.abs(other - first).max() < 1e-6 for other in (second, third, second - third + first))
    run(tmp_path, *SHORT, "--no-views", "--quiet")
    for name in ("history.csv", "breaks.csv", "storeys.csv", "joints.csv"):
        assert (tmp_path / name).read_bytes() == (tmp_path / "runs" / "001" / name).read_bytes()
    assert not list(tmp_path.glob("ensemble.*"))
    assert "ensemble" not in json.loads((tmp_path / "summary.json").read_text())


def test_ctrl_c_and_faults(tmp_path):
    """The runs save their checkpoints and end with the ensemble; the same command continues from these. A fault of the
    house is reported once.
    """
    process = start(tmp_path, "C2", "--dt", "4e-4", "--every-step", "--ensemble", "2", "--jobs", "1", script="house")
    deadline = time.monotonic() + 60
    while not is_locked(tmp_path / "runs" / "001"):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.05)
    os.kill(process.pid, signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGINT and said.rstrip().endswith(
        "stopped; the same command continues"), said
    assert not is_locked(tmp_path / "runs" / "001")
    assert not (tmp_path / "summary.json").exists()
    assert not (tmp_path / "runs" / "002").exists()
    house = tmp_path / "bad.yaml"
    house.write_text("extends: C2\nstructures: {main: 3}\n")
    process = start(tmp_path, str(house), "--ensemble", "2", script="house")
    said, _ = process.communicate(timeout=60)
    assert process.returncode == 1 and said.count("error: ") == 1 and "bad.yaml" in said, said
