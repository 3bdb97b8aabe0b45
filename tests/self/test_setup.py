# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/setup with stand-ins for apt, dpkg, cmake and yade: what it does, and the one line for each way it can fail.
"""
import hashlib
import io
import os
import re
import shutil
import subprocess
import tarfile
from pathlib import Path

import pytest

SETUP = Path(__file__).resolve().parents[2] / "scripts" / "setup"

# Each stand-in writes its call to $LOG and answers from the environment.
STUBS = {
    "id": 'case $1 in -u) echo "${UID_NUMBER:-0}" ;; *) echo someone ;; esac',
    "sudo": "exit 1",
    "nproc": "echo 1",
    "yade": "true",
    "dpkg-query": """
case "$*" in
  *db:Status*) case " $MISSING " in *" ${*: -1} "*) exit 1 ;; esac; echo installed ;;
  *Version*) [ -n "$YADE_VERSION" ] || exit 1; echo "$YADE_VERSION-1+b2" ;;
  *Depends*) echo "libc6, libboost-serialization1.74.0 (>= 1.74.0)" ;;
esac""",
    "apt-get": """
case "$*" in
  *indextargets*) [ -z "$SITE" ] || echo "$SITE" ;;
  *update*) [ -z "$UPDATE_FAILS" ] || { echo "E: Could not connect"; exit 100; } ;;
  *install*) [ -z "$INSTALL_FAILS" ] || exit 100 ;;
esac""",
    "apt-cache": """
printf 'Package: yade\\nVersion: 2025.2.0-4\\nChecksums-Sha256:\\n %s 1 yade_2025.2.0.orig.tar.bz2\\n' "$SUM"
printf ' 00 1 yade_2025.2.0-4.debian.tar.xz\\nDirectory: pool/main/y/yade\\n\\n'""",
    "apt-helper": '[ -f "$ARCHIVE" ] || { echo "E: 404 Not Found"; exit 100; }; cp "$ARCHIVE" "${@: -1}"',
    "cmake": """
mkdir -p build/default
echo "TIMBER_SITE_DIR:PATH=$SITE_DIR" >build/default/CMakeCache.txt""",
}


def make_archive(path, names):
    with tarfile.open(path, "w:bz2") as archive:
        for name in names:
            archive.addfile(tarfile.TarInfo(f"trunk/{name}"), io.BytesIO())
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture
def machine(tmp_path):
    """A folder with its own copy of scripts/setup; returns run(arguments..., VARIABLE=value...) -> (process, calls)."""
    (tmp_path / "scripts").mkdir()
    shutil.copy(SETUP, tmp_path / "scripts")
    stubs = tmp_path / "stubs"
    stubs.mkdir()
    for name, body in STUBS.items():
        (stubs / name).write_text(f'#!/bin/bash\necho "{name} $*" >>"$LOG"\n{body}\n')
        (stubs / name).chmod(0o755)
    archive = tmp_path / "archive"
    checksum = make_archive(
        archive, ["RELEASE", "LICENSE", "core/Scene.hpp", "lib/factory/ClassFactory.hpp", "pkg/a.hpp", "doc/b"])
    defaults = {
        "PATH": f"{stubs}:{os.environ['PATH']}",
        "LOG": str(tmp_path / "log"),
        "SITE": "stand-in:/archive",
        "SUM": checksum,
        "ARCHIVE": str(archive),
        "YADE_VERSION": "2023.02a",
        "SITE_DIR": str(tmp_path),
        "MISSING": "",
    }

    def run(*arguments, **variables):
        (tmp_path / "log").write_text("")
        environment = {**defaults, **variables}
        process = subprocess.run(["scripts/setup", *arguments], cwd=tmp_path, env=environment, stdin=subprocess.DEVNULL,
                                 capture_output=True, text=True)
        return process, (tmp_path / "log").read_text().splitlines()

    return run


def complaint(process):
    """The single line on standard error of a refused run."""
    assert process.returncode == 1
    lines = process.stderr.splitlines()
    assert len(lines) == 1, process.stderr
    return lines[0]


def installs(calls):
    return [call for call in calls if call.startswith("apt-get") and "install" in call]


def test_fetches_headers_builds_and_installs(machine, tmp_path):
    process, calls = machine()
    assert process.returncode == 0, process.stderr
    assert installs(calls) == []
    tree = tmp_path / "build" / "yade-source" / "2025.2.0"
    assert (tree / "core" / "Scene.hpp").exists() and not (tree / "doc").exists()
    builds = [call for call in calls if call.startswith("cmake")]
    assert f"-DYADE_SOURCE_DIR={tree}" in builds[0] and "--build" in builds[1] and "--install" in builds[2]


def test_second_call_leaves_apt_alone(machine):
    machine()
    process, calls = machine()
    assert process.returncode == 0
    assert [call for call in calls if call.startswith("apt-")] == []


def test_missing_packages_are_installed_lean(machine):
    process, calls = machine("--with-tests", MISSING="ninja-build libgtest-dev libboost-log1.74-dev")
    assert process.returncode == 0
    assert [call.split("--no-install-recommends ")[1]
            for call in installs(calls)] == ["ninja-build libgtest-dev", "libboost-log1.74-dev"]
    assert any("-DTIMBER_TESTS=ON" in call for call in calls)


def test_own_tree(machine, tmp_path):
    machine()
    process, calls = machine(YADE_SOURCE_DIR=str(tmp_path / "build" / "yade-source" / "2025.2.0"),
                             YADE_VERSION="2099.1")
    assert process.returncode == 0
    assert [call for call in calls if call.startswith("apt-")] == []


@pytest.mark.parametrize("words, variables, said", [
    (["--fast"], {}, "unknown argument '--fast'"),
    ([], {"MISSING": "ninja-build", "UID_NUMBER": "1000"}, "needs root.*apt-get install.*ninja-build$"),
    ([], {"MISSING": "ninja-build", "INSTALL_FAILS": "1"}, "could not be installed: ninja-build"),
    ([], {"SITE": ""}, "apt has no Debian package list"),
    ([], {"UPDATE_FAILS": "1"}, r"source index of trixie unreachable \(E: Could not connect\)"),
    ([], {"ARCHIVE": ""}, r"2025.2.0.orig.tar.bz2 not to be had \(E: 404 Not Found\).*set YADE_SOURCE_DIR"),
    ([], {"YADE_VERSION": "2099.1"}, "no headers for YADE 2099.1.*has no source package of YADE 2099.1"),
    ([], {"YADE_VERSION": ""}, "no Debian package"),
])
def test_failures_are_one_line(machine, words, variables, said):
    assert re.search(said, complaint(machine(*words, **variables)[0]))


def test_own_tree_is_none(machine, tmp_path):
    assert "is not a YADE source tree" in complaint(machine(YADE_SOURCE_DIR=str(tmp_path))[0])


def test_wrong_checksum(machine, tmp_path):
    assert "wrong checksum" in complaint(machine(SUM="0" * 64)[0])
    assert not (tmp_path / "build" / "yade-source").exists()


def test_archive_is_no_yade(machine, tmp_path):
    other = tmp_path / "other"
    checksum = make_archive(other, ["RELEASE", "LICENSE", "core/a.hpp", "lib/b.hpp", "pkg/c.hpp"])
    assert "holds no YADE tree" in complaint(machine(ARCHIVE=str(other), SUM=checksum)[0])
