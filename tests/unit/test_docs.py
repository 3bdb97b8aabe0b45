# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command in README.md and docs/ is run.

A fenced block of language `sh` is a list of commands: each must end with status 0. A comment in front of the block changes that:
`<!-- test: --duration 0.02 -->` adds these words to each of its commands (to make a run short), `<!-- test: fails -->` wants status 1,
`<!-- test: skip, REASON -->` does not run it and is listed with its reason. Other blocks with a comment in front: `<!-- file: NAME -->`
writes the block to that file first, `<!-- test: printed -->` wants each of the block's lines in what the last commands printed.
A page's blocks run one after the other in a folder of their own that looks like the repository.
"""
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"(?:^<!-- (?P<note>[^\n]*) -->\n+)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
WHOLE_REPOSITORY = ("scripts/setup", "ctest --preset default")  # lines that begin so are what .ci/run does on a fresh clone
OUTPUT = "output.txt"


@dataclass(frozen=True)
class Block:
    """A fenced block of a page; line: where it begins; note: the words of the comment in front of it, as (kind, rest)."""

    page: Path
    line: int
    language: str
    text: str
    note: tuple

    def __str__(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def blocks(page, text=None):
    """Blocks of a page that a test has to do with."""
    text = page.read_text() if text is None else text
    found = []
    for match in BLOCK.finditer(text):
        kind, _, rest = (match["note"] or "").partition(": ")
        block = Block(page, text[: match.start("language")].count("\n") + 1, match["language"], match["text"], (kind, rest.strip()))
        if block.language == "sh" or kind in ("file", "test"):
            found.append(block)
    return found


def commands(text):
    """Commands of a block: lines, without comments, continued ones joined."""
    lines = [re.sub(r"\s+#.*$", "", line).strip() for line in text.replace("\\\n", " ").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    """{page: folder that looks like the repository, made when first asked for}."""
    made = {}

    def place(page):
        if page not in made:
            made[page] = tmp_path_factory.mktemp(page.stem)
            for entry in ROOT.iterdir():
                if entry.name not in ("results", "build", ".git"):
                    (made[page] / entry.name).symlink_to(entry)
        return made[page]

    return place


def run(command, folder):
    """CompletedProcess of a command line, its output collected in the folder."""
    environment = {**os.environ, "MPLBACKEND": "Agg", "OMP_NUM_THREADS": "1", "PATH": f"{Path(shutil.which('yade') or sys.executable).parent}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=150)
    with open(folder / OUTPUT, "a") as file:
        file.write(done.stdout + done.stderr)
    return done


@pytest.mark.parametrize("block", [b for page in PAGES for b in blocks(page)], ids=str)
def test_block(block, places):
    folder, (kind, rest) = places(block.page), block.note
    if kind == "file":
        (folder / rest).write_text(block.text)
    elif block.language != "sh":
        printed = (folder / OUTPUT).read_text()
        assert rest == "printed" and [line for line in block.text.splitlines() if line not in printed] == []
    elif rest.startswith("skip,"):
        pytest.skip(f"{block}: {rest.removeprefix('skip,').strip()}")
    else:
        do(block, folder, rest)


def do(block, folder, rest):
    """Run the commands of a block with the extra words or the status that `rest` asks for."""
    (folder / OUTPUT).unlink(missing_ok=True)
    for command in commands(block.text):
        if command.startswith(WHOLE_REPOSITORY):
            continue
        expected, extra = (1, "") if rest == "fails" else (0, rest)
        done = run(f"{command} {extra}".strip(), folder)
        assert done.returncode == expected, f"{block}: {command}\n{done.stdout}\n{done.stderr}"


# --- the mechanism itself ---------------------------------------------------------------------------------------------

PAGE = """\
<!-- file: a.txt -->
```yaml
name: x
```
text
<!-- test: --more -->

```sh
cat a.txt   # shows it
false \\
  --or
```
```python
unseen
```
```sh
true
```
"""


def test_blocks_are_found():
    found = blocks(ROOT / "README.md", PAGE)
    assert [(b.line, b.language, b.note) for b in found] == [(2, "yaml", ("file", "a.txt")), (8, "sh", ("test", "--more")), (16, "sh", ("", ""))]
    assert commands(found[1].text) == ["cat a.txt", "false    --or"]


def test_a_command_that_fails_fails_the_test(tmp_path):
    block = Block(ROOT / "README.md", 1, "sh", "exit 3\n", ("", ""))
    with pytest.raises(AssertionError, match="exit 3"):
        do(block, tmp_path, "")
    do(Block(ROOT / "README.md", 1, "sh", "exit 1\n", ("", "")), tmp_path, "fails")


def test_what_is_left_to_the_ci_is_done_there():
    assert all(word in (ROOT / ".ci/run").read_text() for word in WHOLE_REPOSITORY)


def test_pages_have_commands():
    assert sum(b.language == "sh" for page in PAGES for b in blocks(page)) > 5
