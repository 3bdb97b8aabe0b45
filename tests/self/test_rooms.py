# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Imports between the rooms of the package: house + motion -> scene -> run -> recording -> pictures; study starts runs and reads recordings; api over all."""
import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "py" / "yade_timber"
YADE = {"yade", "_plugin", "host"}
"""YADE itself, the compiled module, and the module that loads it."""
ALL = {"house", "motion", "scene", "run", "recording", "pictures", "study", "api"}
FORBIDDEN = {
    "base": YADE | ALL,
    "house": YADE | ALL - {"house", "motion"},
    "motion": YADE | ALL - {"house", "motion"},
    "scene": {"run", "recording", "pictures", "study", "api"},
    "run": {"study", "api"},
    "recording": YADE | ALL - {"recording"},
    "pictures": YADE | {"scene", "run", "study", "api"},
    "study": {"api"},
}
"""Room: what its modules must not import. api may import everything."""


def imported(text, module):
    """Rooms, 'yade' and top-level modules that a module's source imports anywhere. module: its path below the package, as 'run/live.py'."""
    found = set()
    parents = Path(module).parts[:-1]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = parents[: len(parents) + 1 - node.level] if node.level else ()
            start = ["yade_timber", *above] if node.level else []
            start += node.module.split(".") if node.module else []
            names = [start + alias.name.split(".") for alias in node.names]
        else:
            continue
        found |= {name[1] if name[0] == "yade_timber" and len(name) > 1 else name[0] for name in names}
    return found


def offences(package, forbidden=FORBIDDEN):
    """['module imports room', ...] of the modules in the rooms of a package."""
    modules = [path.relative_to(package).as_posix() for room in forbidden for path in sorted((package / room).rglob("*.py"))]
    return [f"{module} imports {room}" for module in modules for room in sorted(imported((package / module).read_text(), module) & forbidden[module.split("/")[0]])]


def test_rooms():
    assert offences(PACKAGE) == []


def test_every_room_is_there():
    assert {path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()} == {*FORBIDDEN, "api"}


@pytest.mark.parametrize(
    "line, room",
    [
        ("import yade.wrapper as yw", "yade"),
        ("from yade import O", "yade"),
        ("from .. import _plugin", "_plugin"),
        ("from ..scene import engines", "scene"),
        ("from ..run.cli import Output", "run"),
        ("import yade_timber.study.claims", "study"),
        ("from yade_timber import scene", "scene"),
        ("def f():\n    from ..scene.bodies import box", "scene"),
    ],
)
def test_an_offence_is_found(tmp_path, line, room):
    for name in ("pictures", "recording"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "module.py").write_text(line + "\n")
    assert offences(tmp_path) == [f"{name}/module.py imports {room}" for name in ("recording", "pictures")]


def test_imports_within_the_flow_are_allowed(tmp_path):
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "module.py").write_text("from ..recording import frames\nfrom . import views\nfrom ..base.colors import KINDS\nimport numpy\n")
    assert offences(tmp_path) == []
