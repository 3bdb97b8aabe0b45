# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands in README.md and docs/ run, links resolve, pages keep their limits of length, each key of summary.json is
defined.

A fenced block of language `sh` is a list of commands; each must exit with status 0. A comment above the block changes
this:
`<!-- test: --duration 0.02 -->` adds these options to each command, `<!-- test: fails -->` requires status 1,
`<!-- test: skip, REASON -->` skips the block. Two comments apply to other blocks: `<!-- file: NAME -->` writes the
block to that file, `<!-- test: printed -->` requires each of its lines in the output of the last commands.
The blocks of a page run in order, in a temporary folder that links to the repository's files.
"""
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *(page for folder in ("docs", "research")
                               for page in sorted((ROOT / folder).rglob("*.md")))]
DEFAULT = [ROOT / "README.md", *(ROOT / "docs" / name for name in ("describe_a_house.md", "scenes.md", "python.md"))]
LINKED = [*PAGES, ROOT / "CONTRIBUTING.md"]
PROSE = [*LINKED, ROOT / "CHANGELOG.md"]
LONGEST_SENTENCE, README_WORDS, CHANGELOG_LINES = 40, 700, 40
ALL_WORDS = 27_300
"""Of README, CHANGELOG, CONTRIBUTING and docs; research counts apart."""
LINK = re.compile(r"\]\(([^)\s]+)\)")
SOURCE = re.compile(r"`((?:\w+/)*[\w.*]+\.(?:[ch]pp|py|yaml|\*))(?:: (\w+))?`")
SOURCE_ROOTS = (".", "pkg", "py/yade_timber", "py/timber_houses")
BLOCK = re.compile(r"(?:^<!-- (?P<note>[^\n]*) -->\n+)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
WHOLE_REPOSITORY = ("scripts/setup", "ctest --preset default")  # .ci/run executes lines that begin so, on a fresh clone
OUTPUT = "output.txt"


@dataclass(frozen=True)
class Block:
    """A fenced block of a page. line: of its start; note: the comment above it, as (kind, rest)."""

    page: Path
    line: int
    language: str
    text: str
    note: tuple

    def __str__(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def blocks(page, text=None):
    """Blocks of a page that are tested."""
    text = page.read_text() if text is None else text
    found = []
    for match in BLOCK.finditer(text):
        kind, _, rest = (match["note"] or "").partition(": ")
        block = Block(page, text[:match.start("language")].count("\n") + 1, match["language"], match["text"],
                      (kind, rest.strip()))
        if block.language == "sh" or kind in ("file", "test"):
            found.append(block)
    return found


def commands(text):
    """Commands of a block: lines without comments, continuation lines joined."""
    lines = [re.sub(r"\s+#.*$", "", line).strip() for line in text.replace("\\\n", " ").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    """Function page -> folder that links to the repository's files."""
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
    """CompletedProcess of a command line; its output is appended to OUTPUT in the folder."""
    environment = {**os.environ, "MPLBACKEND": "Agg", "OMP_NUM_THREADS": "1",
                   "PATH": f"{Path(shutil.which('yade') or sys.executable).parent}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=150)
    with open(folder / OUTPUT, "a") as file:
        file.write(done.stdout + done.stderr)
    return done


def marked(block):
    """The commands of most pages take minutes in all."""
    return block if block.page in DEFAULT else pytest.param(block, marks=pytest.mark.rare)


@pytest.mark.parametrize("block", [marked(b) for page in PAGES for b in blocks(page)], ids=str)
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
    """Run the commands of a block; rest: extra options, or 'fails'."""
    (folder / OUTPUT).unlink(missing_ok=True)
    for command in commands(block.text):
        if command.startswith(WHOLE_REPOSITORY):
            continue
        expected, extra = (1, "") if rest == "fails" else (0, rest)
        done = run(f"{command} {extra}".strip(), folder)
        assert done.returncode == expected, f"{block}: {command}\n{done.stdout}\n{done.stderr}"


# --- links and length -------------------------------------------------------------------------------------------------


def anchors(page):
    """Anchors of a page's headings, as GitHub forms them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(page, text):
    """Links of a text to files or headings that do not exist, relative to the page."""
    found = []
    for target in LINK.findall(text):
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if "://" not in target and not (file.exists() and (not anchor or anchor in anchors(file))):
            found.append(target)
    return found


def sentences(text):
    """Sentences of a page's prose. Code, headings, tables, images and formulas end a sentence; so does a list item."""
    text = re.sub(r"^```.*?^```$", ".", text, flags=re.M | re.S)
    text = re.sub(r"^(?: *[#|!<]|    ).*$|^\s*$", ".", text, flags=re.M)
    text = re.sub(r"^ *(?:[-*]|\d+\.) ", ". ", text, flags=re.M)
    return re.split(r"[.!?:;](?= |$)", " ".join(text.split()))


def longest_sentence(text):
    return max(sentences(text), key=lambda sentence: len(sentence.split()))


def unknown_sources(text):
    """Sources that a text names as `folder/file.py` or `folder/file.py: function` and that do not exist."""
    unknown = []
    for path, function in SOURCE.findall(text):
        files = [file for root in SOURCE_ROOTS for file in (ROOT / root).glob(path)]
        if not any(re.search(rf"\b{function}\b", file.read_text()) for file in files):
            unknown.append(f"{path}: {function}" if function else path)
    return unknown


def test_named_sources_exist():
    assert unknown_sources((ROOT / "CONTRIBUTING.md").read_text()) == []
    assert unknown_sources(
        "`house/joints.py: find_joints` `house/joints.py: no_function` `house/no.py` `No.cpp` `kernel/joint_law.*`"
    ) == [
        "house/joints.py: no_function",
        "house/no.py",
        "No.cpp",
    ]


@pytest.mark.parametrize("page", LINKED, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_resolve(page):
    assert broken_links(page, page.read_text()) == []


@pytest.mark.parametrize("page", PROSE, ids=lambda page: str(page.relative_to(ROOT)))
def test_sentences_are_short(page):
    longest = longest_sentence(page.read_text())
    assert len(longest.split()) <= LONGEST_SENTENCE, longest


def test_readme_and_change_list_are_short():
    assert len((ROOT / "README.md").read_text().split()) <= README_WORDS
    assert len((ROOT / "CHANGELOG.md").read_text().splitlines()) <= CHANGELOG_LINES


def test_documents_are_short():
    assert sum(len(page.read_text().split()) for page in PROSE if "research" not in page.parts) <= ALL_WORDS


def test_links_and_sentences_are_found():
    page = ROOT / "docs" / "results.md"
    assert broken_links(page,
                        "[a](limits.md#limits) [b](no.md) [c](limits.md#no) [d](#drift) [e](https://yade-dem.org)") == [
                            "no.md", "limits.md#no"
                        ]
    words = "word " * 41
    assert all(
        longest_sentence(text).split() == words.split()
        for text in (words, f"Short. {words}", f"- {words}", f"1. Short.\n   {words}"))
    assert longest_sentence(f"```\n{words}\n```\n# {words}\n| {words} |\n\n    {words}\n").strip() == ""


# --- keys of summary.json ---------------------------------------------------------------------------------------------


def defined_keys(text):
    """Keys in the first column of the table of results.md that lists all keys; `*` stands for any name."""
    table = text[text.index("## All keys of `summary.json`"):]
    return [key for row in re.findall(r"^\| (`[^|]*`) \|", table, re.M) for key in re.findall(r"`([^`]+)`", row)]


def leaves(value, path=""):
    """Paths of all entries of nested dictionaries that are no dictionaries themselves: 'energy.dissipated.friction'."""
    if not isinstance(value, dict):
        return [path]
    return [leaf for key, entry in value.items() for leaf in leaves(entry, f"{path}.{key}".lstrip("."))]


def differences(defined, found):
    """(keys of a summary without a definition, definitions without a key). A key without parts, as `record`, may be
    defined beside its parts.
    """
    undefined = [key for key in found if not any(fnmatchcase(key, pattern) for pattern in defined)]
    unused = [
        pattern for pattern in defined
        if not any(fnmatchcase(key, pattern) or key.startswith(pattern + ".") for key in found)
    ]
    return undefined, unused


def test_keys_of_the_summary_are_defined(tmp_path):
    done = run(f"yade -n -x {ROOT}/scripts/modelB1_snow.py --duration 0.01 --no-frames --quiet --out out", tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    found = leaves(json.loads((tmp_path / "out" / "summary.json").read_text()))
    assert differences(defined_keys((ROOT / "docs" / "results.md").read_text()), found) == ([], [])


def test_missing_and_superfluous_keys_are_found():
    text = "| `before` | x |\n## All keys of `summary.json`\n| `a`, `b.*` | x |\n| `c` | of `d` |\n"
    assert defined_keys(text) == ["a", "b.*", "c"]
    assert leaves({"a": {}, "b": {"x": {"y": 1}}, "d": None}) == ["b.x.y", "d"]
    assert differences(["a", "b.*", "c"], ["a", "b.x.y", "d"]) == (["d"], ["c"])


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
    assert [(b.line, b.language, b.note)
            for b in found] == [(2, "yaml", ("file", "a.txt")), (8, "sh", ("test", "--more")), (16, "sh", ("", ""))]
    assert commands(found[1].text) == ["cat a.txt", "false    --or"]


def test_a_command_that_fails_fails_the_test(tmp_path):
    block = Block(ROOT / "README.md", 1, "sh", "exit 3\n", ("", ""))
    with pytest.raises(AssertionError, match="exit 3"):
        do(block, tmp_path, "")
    do(Block(ROOT / "README.md", 1, "sh", "exit 1\n", ("", "")), tmp_path, "fails")


def test_ci_runs_the_commands_that_are_skipped_here():
    assert all(word in (ROOT / ".ci/run").read_text() for word in WHOLE_REPOSITORY)


def test_pages_have_commands():
    assert sum(b.language == "sh" for page in PAGES for b in blocks(page)) > 5
