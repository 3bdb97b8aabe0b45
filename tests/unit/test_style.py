# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures do not depend on a user's settings of matplotlib, and these come back unchanged."""
import ast
import subprocess
import sys
from pathlib import Path

import in_process
import matplotlib
import pytest
from cycler import Cycler, cycler
from matplotlib import style
from matplotlib.style.core import STYLE_BLACKLIST
from small_frames import frames
from timber_houses.house import build_house, load_house
from timber_houses.motion import default_motion
from timber_houses.pictures import curves, drawings, figures, fonts, motion_sheet, report, report_pictures, sheets
from timber_houses.pictures.views import FRONT

OTHER_TEXTS = {"white": "black", "black": "white", "DejaVu Sans": "DejaVu Serif", "sans-serif": "serif",
               "normal": "italic", "left": "right"}
ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "py" / "timber_houses"
RECORD = ROOT / "scripts" / "show" / "show_record.py"


def other(value):
    """Another value of a setting, of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        return 3 * value + 1
    if isinstance(value, (list, tuple)):
        return [other(entry) for entry in value]
    if isinstance(value, Cycler):
        return cycler(color=["red", "green"])
    return OTHER_TEXTS.get(value, "red")


def estranged():
    """Set every setting of matplotlib to another value where one is admissible; returns their number."""
    changed = 0
    for key, value in list(matplotlib.rcParams.items()):
        if key in STYLE_BLACKLIST or key.startswith(("_internal", "keymap", "animation")):
            continue
        try:
            matplotlib.rcParams[key] = other(value)
            changed += matplotlib.rcParams[key] != value
        except (ValueError, TypeError, RuntimeError):
            pass
    return changed


def settings_of_a_user():
    style.use("dark_background")
    matplotlib.rcParams.update(
        {"text.usetex": True, "font.size": 30, "savefig.bbox": "tight", "savefig.dpi": 20, "savefig.transparent": True})


def pages():
    """{name: figure} of the pictures of a run, a house and a motion."""
    run = frames()
    return {
        "sheet": sheets.Stills(run).sheet(FRONT, sheets.SCREEN),
        "end": sheets.Stills(run).both_views(-1, 50),
        "curves": curves.page(run, 50),
        "house": drawings.page(build_house(load_house("C2")), 50),
        "motion": motion_sheet.page(default_motion(), 0.05, 50),
        "plans": report_pictures.plans(run),
        "spectra": report_pictures.motion(run),
    }


def files(folder, made):
    """{name: content} of the PNG and PDF files of figures, and their images in the report."""
    folder.mkdir()
    paths = [path for name, figure in made.items() for path in figures.save(figure, folder / name, ("png", "pdf"))]
    return {path.name: path.read_bytes()
            for path in paths} | {name: report.picture(figure)
                                  for name, figure in made.items()}


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    return files(tmp_path_factory.mktemp("pictures") / "expected", pages())


@pytest.mark.parametrize("settings", [pytest.param(estranged, marks=pytest.mark.rare), settings_of_a_user])
def test_pictures_do_not_depend_on_settings(expected, tmp_path, settings):
    with matplotlib.rc_context():
        settings()
        before = dict(matplotlib.rcParams)
        found = files(tmp_path / "found", pages())
        assert dict(matplotlib.rcParams) == before
    assert [name for name in expected if found[name] != expected[name]] == []


def test_another_value_of_most_settings_is_tried():
    with matplotlib.rc_context():
        assert estranged() > 150  # of 293


def test_font_files_do_not_depend_on_settings():
    expected = fonts.file(fonts.OWN), fonts.file(fonts.OWN, bold=True)
    with matplotlib.rc_context({"font.style": "italic", "font.stretch": "condensed"}):
        assert (fonts.file(fonts.OWN), fonts.file(fonts.OWN, bold=True)) == expected


def test_matplotlibrc_of_a_user(tmp_path):
    """As a user has it: the file that MATPLOTLIBRC names, LaTeX for all texts."""
    (tmp_path / "matplotlibrc").write_text("text.usetex: True\nfigure.facecolor: black\nfont.size: 30\n")
    words = ["--end", "20", "--out"]
    assert in_process.run(RECORD, *words, tmp_path / "plain").returncode == 0
    environment = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "MATPLOTLIBRC": str(tmp_path / "matplotlibrc")}
    subprocess.run([sys.executable, RECORD, *words, tmp_path / "own"], check=True, capture_output=True, env=environment)
    assert (tmp_path / "plain.png").read_bytes() == (tmp_path / "own.png").read_bytes()


def makers(path):
    """[(name, whether default_style decorates it)] of the functions of a module that make, draw or save a figure."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.FunctionDef):
            calls = {ast.unparse(call.func).split(".")[-1] for call in ast.walk(node) if isinstance(call, ast.Call)}
            if calls & {"new_figure", "Figure", "savefig", "findfont"}:
                yield f"{path.stem}.{node.name}", any(
                    "default_style" in ast.unparse(decorator) for decorator in node.decorator_list)


def test_defaults_stand_around_every_figure():
    found = [maker for path in sorted(PACKAGE.rglob("*.py")) for maker in makers(path)]
    assert len(found) >= 12 and [name for name, decorated in found if not decorated] == []
