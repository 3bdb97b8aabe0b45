# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""What no committed file may hold: paths of one machine, hosts of archives; and what each must: the licence line."""
import os
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SKIPPED_FOLDERS = {"build", "results", ".git", "__pycache__", ".pytest_cache", ".hypothesis", "node_modules"}
SOURCE_ENDINGS = {".py", ".cpp", ".hpp", ".in", ".cmake", ".txt", ".json", ".yaml", ".yml", ".md", ".cff", ".csv", ""}
# A path that begins at a home folder, a scratch folder or a mounted working folder.
MACHINE_PATH = re.compile(r"(?<![\w.~$}])/(?:home|root|work|tmp|mnt|media|Users)/[\w.]")
ADDRESS = re.compile(r"\b(?:https?|ftp)://")


def sources():
    for folder, below, names in os.walk(ROOT):
        below[:] = sorted(set(below) - SKIPPED_FOLDERS)  # not entered: roots of other systems lie in build
        yield from (path for path in (Path(folder) / name for name in sorted(names))
                    if path.is_file() and path.suffix in SOURCE_ENDINGS)


def hits(pattern, files):
    """["file:line: text"] for each line of the files that matches; files that are no text are passed over."""
    found = []
    for path in files:
        try:
            lines = path.read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError:
            continue
        found += [
            f"{path.relative_to(ROOT)}:{number}: {line.strip()[:120]}" for number, line in enumerate(lines, 1)
            if pattern.search(line)
        ]
    return found


@pytest.mark.parametrize("text", ["/" + "home/someone/x", 'open("/' + 'work/main/a.csv")'])
def test_pattern_sees_a_machine_path(text):
    assert MACHINE_PATH.search(text)


@pytest.mark.parametrize(
    "text", ["build/tmp/x", "$HOME/work/x", "${dir}/tmp/x", "/usr/bin/python3", "pairs/work/step", "and/or"])
def test_pattern_passes_other_paths(text):
    assert not MACHINE_PATH.search(text)


def test_there_are_sources():
    assert len(list(sources())) > 20


def test_no_machine_path():
    assert hits(MACHINE_PATH, sources()) == []


def test_no_address_in_the_build():
    folders = (ROOT / "cmake", ROOT / "scripts", ROOT / ".ci", ROOT / "CMakeLists.txt", ROOT / "CMakePresets.json")
    assert hits(ADDRESS, [path for path in sources() if any(path.is_relative_to(folder) for folder in folders)]) == []


def test_licence_line():
    code = [path for path in sources() if path.suffix in {".py", ".cpp", ".hpp", ".cmake"} or path.name
            == "CMakeLists.txt"]
    missing = [
        str(path.relative_to(ROOT))
        for path in code
        if "SPDX-License-Identifier: GPL-2.0-or-later" not in path.read_text(encoding="utf-8")[:300]
    ]
    assert missing == []
