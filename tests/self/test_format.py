# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The sources are formatted: scripts/format --check finds nothing."""
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
VERSION = "14"


def clang_format():
    """Version line of the clang-format that scripts/format uses, or an empty string."""
    found = shutil.which(f"clang-format-{VERSION}") or shutil.which("clang-format")
    return subprocess.run([found, "--version"], capture_output=True, text=True).stdout if found else ""


def check(root):
    return subprocess.run([root / "scripts" / "format", "--check"], capture_output=True, text=True)


needs_clang_format = pytest.mark.skipif(
    f"version {VERSION}." not in clang_format(),
    reason=f"clang-format {VERSION} is not installed; its other versions format differently")


@needs_clang_format
def test_sources_are_formatted():
    done = check(ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


@needs_clang_format
def test_check_finds_a_fault(tmp_path):
    for folder in ("pkg", "py", "scripts", "tests", "benchmarks", "cmake", "docs", "research"):
        (tmp_path / folder).mkdir()
    for file in (".clang-format", ".flake8", "scripts/format"):
        shutil.copy(ROOT / file, tmp_path / file)
    (tmp_path / "pkg" / "right.cpp").write_text("int f() { return 1; }\n")
    assert check(tmp_path).returncode == 0
    for name, text in (("pkg/wrong.cpp", "int  f( ){return 1 ;}\n"), ("py/wrong.py", "import os\n"),
                       ("scripts/wrong.py", "print( 1)\n")):
        (tmp_path / name).write_text(text)
        done = check(tmp_path)
        assert done.returncode == 1 and name in done.stdout + done.stderr
        (tmp_path / name).unlink()
