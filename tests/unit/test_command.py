# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The command yade-timber: it starts the scripts, from a clone and from an installed tree."""
import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

COMMAND = Path(__file__).resolve().parents[2] / "scripts" / "yade-timber"
KNOWN = runpy.run_path(str(COMMAND))


def run(*words):
    return subprocess.run([sys.executable, COMMAND, *words], capture_output=True, text=True)


@pytest.mark.parametrize("script", [*KNOWN["IN_YADE"].values(), *KNOWN["IN_PYTHON"].values()])
def test_scripts_exist(script):
    assert (COMMAND.parent / script).is_file()


def test_help_names_each_command():
    shown = run("--help").stdout
    for name in [*KNOWN["IN_YADE"], *KNOWN["IN_PYTHON"]]:
        assert re.search(rf"^ +yade-timber {name} ", shown, re.MULTILINE)
    assert run().stdout == run("-h").stdout == shown


def test_arguments_reach_the_script(tmp_path):
    done = run("record", "--end", "20", "--out", str(tmp_path / "a.png"))
    assert done.returncode == 0 and (tmp_path / "a.png").is_file()


def test_run_starts_yade_with_the_script():
    assert KNOWN["command"](
        "run", ["C2", "--snow", "1"]) == ["yade", "-n", "-x",
                                          str(COMMAND.parent / "house.py"), "C2", "--snow", "1"]


def test_version():
    assert re.fullmatch(r"yade-timber \d+\.\d+\.\d+\n", run("--version").stdout)


def test_unknown_command():
    done = run("frobnicate")
    assert done.returncode == 1 and "frobnicate" in done.stderr and "batch" in done.stderr


def test_installed_tree(tmp_path):
    """usr/bin/yade-timber finds the scripts in usr/share."""
    for folder in ("bin", "share/yade-timber/scripts"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "bin" / "yade-timber").write_text(COMMAND.read_text())
    found = runpy.run_path(str(tmp_path / "bin" / "yade-timber"))
    assert found["SCRIPTS"] == tmp_path / "share" / "yade-timber" / "scripts"
