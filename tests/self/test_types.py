# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The type check of both packages with mypy, as mypy.ini states it, finds nothing."""
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
VERSION = "1.0"
"""Of Debian 12; other versions find other things."""
PACKAGES = "packages = yade_timber, timber_houses\n"
WRONG = """from timber_houses.motion.request import MotionRequest


def without_annotations():
    return MotionRequest(durration=3), MotionRequest().pgaa
"""


def version():
    """Version line of mypy, or an empty string."""
    found = shutil.which("mypy")
    return subprocess.run([found, "--version"], capture_output=True, text=True).stdout if found else ""


needs_mypy = pytest.mark.skipif(f"mypy {VERSION}." not in version(), reason=f"mypy {VERSION} is not installed")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("types")


def check(folder, *files):
    """mypy on both packages, or on files that import them. folder: of its cache"""
    settings = (ROOT / "mypy.ini").read_text()
    (folder / "mypy.ini").write_text(settings.replace(PACKAGES, "") if files else settings)
    return subprocess.run(["mypy", "--config-file", folder / "mypy.ini", "--cache-dir", folder / "cache", *files],
                          cwd=ROOT, capture_output=True, text=True)


@needs_mypy
def test_both_packages_pass(folder):
    done = check(folder)
    assert done.returncode == 0, done.stdout + done.stderr


@needs_mypy
def test_faults_are_found(folder):
    (folder / "wrong.py").write_text(WRONG)
    done = check(folder, folder / "wrong.py")
    assert done.returncode == 1 and "[call-arg]" in done.stdout and "[attr-defined]" in done.stdout
