# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Limits of the verdict stand in recording/verdict.py alone: rooms that judge or state a verdict take them from there,
the player's page and sources have the same ones.
"""
import ast
import math
import re
from pathlib import Path

import pytest
from timber_houses.recording.verdict import FALLEN_ANGLE, LIMITS

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ("run", "recording", "text", "pictures", "study", "api")
DENOMINATORS = {round(1 / limit.drift) for limit in LIMITS}
STATED = re.compile(rf"\b1/({'|'.join(map(str, DENOMINATORS))})\b")


def copies(source):
    """Lines of a module that state a limit, in a number or a text; docstrings explain."""
    tree = ast.parse(source)
    explained = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div):
            parts = [getattr(part, "value", None) for part in (node.left, node.right)]
            if parts[0] == 1 and parts[1] in DENOMINATORS:
                yield node.lineno
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in explained:
            if STATED.search(node.value):
                yield node.lineno


def test_limits_stand_once():
    paths = [path for room in ROOMS for path in sorted((ROOT / "py" / "timber_houses" / room).rglob("*.py"))]
    assert [f"{path.name}:{line}" for path in paths if path.name != "verdict.py"
            for line in copies(path.read_text())] == []


@pytest.mark.parametrize("source, found", [("SAFETY = 1 / 30", [1]), ("x = f'passes 1/{n}, over 1/10'", [1]),
                                           ("'''1/10'''\nx = 1 / 31", [])])
def test_a_copy_is_found(source, found):
    assert list(copies(source)) == found


def test_the_player_states_the_same_limits():
    page = (ROOT / "py" / "timber_houses" / "data" / "player" / "page.html").read_text()
    texts = (ROOT / "player" / "src" / "texts.js").read_text()
    stated = {f"1/{number}" for number in DENOMINATORS}
    glossary = [re.search(r"Storey drift: the .*", page)[0], *re.findall(r'"Storey drift: the .*\n.*', texts)]
    assert all({match[0] for match in STATED.finditer(text)} == stated for text in glossary)
    parts = re.search(r"FALLEN = Math.cos\(Math.PI / (\d+)\)", (ROOT / "player" / "src" / "run.js").read_text())
    assert math.pi / int(parts[1]) == FALLEN_ANGLE
