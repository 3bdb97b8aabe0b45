# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The README's two commands and the Debian package in fresh roots of the supported releases, and the kernel's bits on
arm64 (opt-in: ctest -L hosts; root and mmdebstrap; a cross compiler and qemu).
"""
import os
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
CHECK = HERE / "check_host"


@pytest.mark.skipif(os.geteuid() != 0 or not shutil.which("mmdebstrap"), reason="needs root and mmdebstrap")
@pytest.mark.parametrize("suite", ["bookworm", "trixie"])
def test_readme_commands_and_package(suite):
    done = subprocess.run([CHECK, suite], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.skipif(not shutil.which("aarch64-linux-gnu-g++") or not shutil.which("qemu-aarch64-static"),
                    reason="needs g++-aarch64-linux-gnu and qemu-user-static")
def test_the_kernel_has_the_same_bits_on_arm64(tmp_path):
    done = subprocess.run([HERE / "check_arm64", tmp_path], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(done.stdout.splitlines()) == 5


def test_a_suite_is_required():
    done = subprocess.run([CHECK], capture_output=True, text=True)
    assert done.returncode == 1 and "usage" in done.stderr


@pytest.mark.skipif(os.geteuid() != 0 or not shutil.which("mmdebstrap"), reason="needs root and mmdebstrap")
def test_an_unknown_part_is_refused(tmp_path):
    done = subprocess.run([CHECK, "trixie", tmp_path, "everything"], capture_output=True, text=True)
    assert done.returncode == 1 and "unknown part 'everything'" in done.stderr
