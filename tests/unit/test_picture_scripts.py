# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The show scripts and the gallery: pictures of finished runs, one line and status 1 for wrong input. Need no YADE."""
import subprocess
import sys
from pathlib import Path

import in_process
import pytest
from small_frames import frames
from timber_houses.pictures.figures import stem_and_endings
from timber_houses.recording import frames as recorded

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


def run(script, *arguments):
    """CompletedProcess of a script; it finds no Chromium, whose picture of the player has a test of its own."""
    return in_process.run(SCRIPTS / script, *arguments)


def check_one_line(done, *parts):
    """Status 1, one line on stderr that begins with 'error: ' and has the parts in it."""
    assert done.returncode == 1 and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1, done.stderr
    assert all(part in done.stderr for part in parts), done.stderr


def save_runs(folder, ended):
    for name in ("modelA_quake", "modelC_quake", "modelC2_snow", "A_quake_snow", "C_quake_snow"):
        (folder / name).mkdir()
        recorded.save(folder / name / recorded.NAME, frames(ended))


@pytest.mark.rare
def test_gallery(tmp_path):
    save_runs(tmp_path, ended=True)
    done = run("paper/make_gallery.py", tmp_path, "--out", tmp_path / "docs")
    assert done.returncode == 0, done.stderr
    made = {path.name: path for path in (tmp_path / "docs").rglob("*.png")}
    assert set(made) == {"modelC2_snow.png", "history.png", "houseC2.png", "l_house.png", "ground_motion.png"}
    assert all(5_000 < path.stat().st_size < 150_000 for path in made.values())


def test_gallery_of_runs_that_have_not_ended(tmp_path):
    save_runs(tmp_path, ended=False)
    done = run("paper/make_gallery.py", tmp_path, "--out", tmp_path / "docs")
    check_one_line(done, "has not ended")


def truncated(path):
    recorded.save(path, frames())
    path.write_bytes(path.read_bytes()[:20_000])


@pytest.mark.parametrize("script", ["show/show_run.py", "show/make_player.py", "show/export_vtk.py"])
@pytest.mark.parametrize("damage", [lambda path: None, truncated])
def test_frames_that_cannot_be_used(tmp_path, script, damage):
    """Of all that may be wrong with them: test_frames.py."""
    damage(tmp_path / recorded.NAME)
    check_one_line(run(script, tmp_path, "--out", tmp_path / "out"), "frames.h5: ")
    assert not list(tmp_path.glob("out/*"))


def test_gallery_of_nothing(tmp_path):
    """In a process of its own, as a user starts it."""
    words = [sys.executable, SCRIPTS / "paper" / "make_gallery.py", tmp_path, "--out", tmp_path]
    check_one_line(subprocess.run(words, capture_output=True, text=True), "frames.h5: no such file")


@pytest.mark.parametrize("script, arguments", [
    ("show_run.py", ["."]),
    ("make_player.py", ["."]),
    ("export_vtk.py", ["."]),
    ("show_house.py", ["A"]),
    ("show_record.py", []),
])
def test_empty_output(script, arguments):
    check_one_line(run(f"show/{script}", *arguments, "--out", ""), "--out", "empty")


@pytest.mark.parametrize("every", ["0", "-1", "1.5", "nine", "9" * 5000])
def test_every_that_is_no_number(tmp_path, every):
    check_one_line(run("show/export_vtk.py", tmp_path, f"--every={every}"), "--every")


def test_pictures_of_several_runs_lie_apart(tmp_path):
    save_runs(tmp_path, ended=True)
    names = ("modelA_quake", "modelC_quake")
    done = run("show/show_run.py", *(tmp_path / name for name in names), "--out", tmp_path / "pictures")
    assert done.returncode == 0, done.stderr
    assert {path.parent.name for path in (tmp_path / "pictures").rglob("front.png")} == {*names}


def test_a_dot_in_a_name_is_no_ending(tmp_path, monkeypatch):
    site = tmp_path / "site.a"
    assert stem_and_endings(site) == (site, ("png",)) == stem_and_endings(tmp_path / "site.a.png")
    assert stem_and_endings(tmp_path / "site.a.PDF") == (site, ("pdf",))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text("extends: A\nname: house 1.5\n")
    done = run("show/show_house.py", "mine.yaml")
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.glob("house_*")} == {"house_house 1.5.png"}


def test_a_folder_that_cannot_be_written(tmp_path):
    recorded.save(tmp_path / recorded.NAME, frames())
    done = run("show/show_run.py", tmp_path, "--out", tmp_path / recorded.NAME)
    check_one_line(done, "cannot be written")


@pytest.mark.parametrize("script, first", [("show_house.py", "A"), ("show_record.py", "--pga=400")])
def test_a_picture_that_cannot_be_written(tmp_path, script, first):
    check_one_line(run(f"show/{script}", first, "--out", tmp_path / "none" / "x.png"), "x.png: cannot be written")


def test_a_motion_without_intensity_or_acceleration(tmp_path):
    short = run("show/show_record.py", "--start", "20", "--end", "20.2", "--out", tmp_path / "short.png")
    assert short.returncode == 0 and "JMA intensity         none" in short.stdout, short.stderr
    check_one_line(run("show/show_record.py", "--scale", "0", "--out", tmp_path / "x.png"), "no acceleration")
    exact = run("show/show_record.py", "--resample", "--start", "18", "--end", "22", "--out", tmp_path / "exact.png")
    assert "errs by at most 0 % of the PGA\n" in exact.stdout, exact.stderr


@pytest.mark.parametrize("name, file", [("a/../b", "house_a_.._b.png"), ("$\\\\frac{$", None),
                                        ("y" * 60, f"house_{'y' * 60}.png")])
def test_any_name_of_a_house(tmp_path, monkeypatch, name, file):
    """Drawn literally, and a file name in this folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text(f'extends: A\nname: "{name}"\n')
    done = run("show/show_house.py", "mine.yaml")
    made = [path.name for path in tmp_path.glob("*.png")]
    assert done.returncode == 0 and len(made) == 1 and file in (None, *made), (done.stderr, made)
