# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Imports of the plugin, and between the rooms of the application: house + motion -> scene -> run -> recording -> text
-> pictures; study starts runs and reads recordings; api over all.

The plugin knows no house: it imports neither the application nor what only houses need. Inside study: driver -> batch
-> retrofit; driver -> ensemble. The packages, their scripts and tests never import the research beside them.
"""
import ast
import graphlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PLUGIN, PACKAGE = ROOT / "py" / "yade_timber", ROOT / "py" / "timber_houses"
MOST_LINES = 1900
"""Of the plugin's Python."""
RESEARCH = "timber_research"
"""Package beside the installed ones."""
YADE = {"yade"}
"""YADE itself, and all of the plugin but WITHOUT_YADE."""
WITHOUT_YADE = {"yade_timber.energy_terms", "yade_timber.log"}
NOT_OF_THE_PLUGIN = {"timber_houses", "h5py", "matplotlib", "yaml", "scipy"}
ALL = {"house", "motion", "scene", "run", "recording", "text", "pictures", "study", "api"}
FORBIDDEN = {
    "base": YADE | ALL,
    "house": YADE | ALL - {"house", "motion"},
    "motion": YADE | ALL - {"house", "motion"},
    "scene": {"run", "recording", "text", "pictures", "study", "api"},
    "run": {"study", "api"},
    "recording": YADE | ALL - {"recording"},
    "text": YADE | ALL - {"recording", "text"},
    "pictures": YADE | {"scene", "run", "study", "api"},
    "study": {"api"},
}
"""Room: what its modules must not import. api may import everything."""
STUDY = {"options", "driver", "batch", "ensemble", "retrofit", "probe"}
FORBIDDEN_IN_STUDY = {
    "options": STUDY - {"options"},
    "driver": STUDY - {"driver"},
    "batch": {"options", "ensemble", "retrofit"},
    "ensemble": {"options", "batch", "retrofit"},
    "retrofit": {"options", "ensemble"},
    "probe": STUDY - {"probe", "driver"},
}
"""Part of study, a module or a folder: the parts that it must not import."""


def imported(text, module, room="timber_houses"):
    """Parts of a room, 'yade' (also for what of the plugin needs YADE) and top-level modules that a module's source
    imports anywhere.

    module: its path below the package, as 'run/live.py'; room: the package, or one of its rooms: 'timber_houses.study'
    """
    depth, names_of_parts = len(room.split(".")), set()
    parents = Path(module).parts[:-1]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = parents[: len(parents) + 1 - node.level] if node.level else ()
            start = [room.split(".")[0], *above] if node.level else []
            start += node.module.split(".") if node.module else []
            names = [start + alias.name.split(".") for alias in node.names]
        else:
            continue
        names_of_parts |= {name[depth] if name[:depth] == room.split(".") and len(name) > depth else name[0]
                           for name in names if ".".join(name[:2]) not in WITHOUT_YADE}
    return {"yade" if name == "yade_timber" else name for name in names_of_parts}


def offences(package, forbidden=FORBIDDEN, room="timber_houses"):
    """['module imports part', ...] of the modules in the parts of a room. package: the folder of timber_houses."""
    inside = Path(*room.split(".")[1:])
    paths = [
        path for part in forbidden
        for path in (package / inside / f"{part}.py", *sorted((package / inside / part).rglob("*.py")))
        if path.is_file()
    ]
    return [f"{path.relative_to(package).as_posix()} imports {name}" for path in paths
            for name in sorted(imported(path.read_text(), path.relative_to(package).as_posix(),
                                        room) & forbidden[path.relative_to(package / inside).with_suffix("").parts[0]])]


def test_rooms():
    assert offences(PACKAGE) == []


def test_every_room_is_there():
    assert {path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()} == {*FORBIDDEN, "api"}


def arrows(package):
    """{room: rooms that its modules import}"""
    rooms = {path.name for path in package.iterdir() if (path / "__init__.py").exists()}
    return {room: {part for path in (package / room).rglob("*.py")
                   for part in imported(path.read_text(), path.relative_to(package).as_posix()) & rooms} - {room}
            for room in rooms}


def test_no_circle():
    graphlib.TopologicalSorter(arrows(PACKAGE)).prepare()


def test_a_circle_is_found(tmp_path):
    for name, other in (("house", "motion"), ("motion", "house")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(f"def f():\n    from ..{other} import g\n")
    with pytest.raises(graphlib.CycleError):
        graphlib.TopologicalSorter(arrows(tmp_path)).prepare()


def plugin_offences(folder):
    """['module imports module', ...] of the plugin's modules that import what is not of it."""
    return [f"{path.relative_to(folder).as_posix()} imports {name}" for path in sorted(folder.rglob("*.py"))
            for name in sorted(imported(path.read_text(), path.name, "yade_timber") & NOT_OF_THE_PLUGIN)]


def test_the_plugin_knows_no_house():
    assert plugin_offences(PLUGIN) == []
    assert sum(path.read_text().count("\n") for path in PLUGIN.rglob("*.py")) <= MOST_LINES


@pytest.mark.parametrize("line, name", [("from timber_houses.house import load_house", "timber_houses"),
                                        ("def f():\n    from scipy import sparse", "scipy")])
def test_an_offence_of_the_plugin_is_found(tmp_path, line, name):
    (tmp_path / "joints.py").write_text(line + "\n")
    assert plugin_offences(tmp_path) == [f"joints.py imports {name}"]


def test_rooms_inside_study():
    assert offences(PACKAGE, FORBIDDEN_IN_STUDY, "timber_houses.study") == []
    assert {path.stem for path in (PACKAGE / "study").iterdir() if path.suffix == ".py"
            or (path / "__init__.py").exists()} == {*STUDY, "__init__"}


@pytest.mark.parametrize("line, part", [
    ("from ..driver import Task", None),
    ("from . import results", None),
    ("from ..batch.table import COLUMNS", "batch"),
    ("from .. import retrofit", "retrofit"),
    ("import timber_houses.study.options", "options"),
])
def test_an_offence_inside_study_is_found(tmp_path, line, part):
    (tmp_path / "study" / "ensemble").mkdir(parents=True)
    (tmp_path / "study" / "ensemble" / "runs.py").write_text(line + "\n")
    assert offences(tmp_path, FORBIDDEN_IN_STUDY,
                    "timber_houses.study") == ([f"study/ensemble/runs.py imports {part}"] if part else [])


def importers_of_research(root):
    """Python files of the package, its scripts and their tests that import the research."""
    paths = [path for folder in ("py", "scripts", "tests") for path in sorted((root / folder).rglob("*.py"))]
    return [path.relative_to(root).as_posix() for path in paths if RESEARCH in imported(path.read_text(), path.name)]


def test_research_imports_the_package_and_never_the_reverse():
    assert importers_of_research(ROOT) == []
    assert all((ROOT / "research" / RESEARCH / name).is_file() for name in ("claims.py", "screening/cells.py"))


@pytest.mark.parametrize("line", ["import timber_research", "from timber_research.claims import STILL",
                                  "def f():\n    from timber_research import design"])
def test_an_import_of_research_is_found(tmp_path, line):
    (tmp_path / "scripts").mkdir()
    (tmp_path / "scripts" / "study.py").write_text(line + "\n")
    assert importers_of_research(tmp_path) == ["scripts/study.py"]


@pytest.mark.parametrize("line, room", [
    ("import yade.wrapper as yw", "yade"),
    ("from yade import O", "yade"),
    ("from yade_timber.plugin import compiled", "yade"),
    ("from yade_timber import energy_terms, box", "yade"),
    ("from ..scene import engines", "scene"),
    ("from ..run.options import RunOptions", "run"),
    ("import timber_houses.study.driver", "study"),
    ("from timber_houses import scene", "scene"),
    ("def f():\n    from ..scene.bodies import box", "scene"),
])
def test_an_offence_is_found(tmp_path, line, room):
    for name in ("pictures", "recording"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "module.py").write_text(line + "\n")
    assert offences(tmp_path) == [f"{name}/module.py imports {room}" for name in ("recording", "pictures")]


def test_imports_within_the_flow_are_allowed(tmp_path):
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures" / "module.py").write_text(
        "from ..recording import frames\nfrom . import views\nfrom ..base.colors import KINDS\n"
        "from yade_timber.energy_terms import SUPPLIED\nimport numpy\n")
    assert offences(tmp_path) == []
