# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Scripts that make pictures of finished runs: gallery and pictures again; one line for what cannot be read. Need no YADE."""
import os
import subprocess
import sys
from pathlib import Path

import pytest
from small_frames import frames
from yade_timber.recording import frames as recorded
from yade_timber.pictures import sheets

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


def run(script, *words):
    """CompletedProcess of a script; it finds no Chromium, whose picture of the player has a test of its own."""
    return subprocess.run([sys.executable, SCRIPTS / script, *map(str, words)], capture_output=True, text=True, env={**os.environ, "PATH": ""})


def save_runs(folder, ended):
    for name in ("modelA_snow", "modelA_quake", "modelC2_snow"):
        (folder / name).mkdir()
        recorded.save(folder / name / recorded.NAME, frames(ended))


def test_gallery(tmp_path):
    save_runs(tmp_path, ended=True)
    done = run("paper/make_gallery.py", tmp_path, "--out", tmp_path / "docs")
    assert done.returncode == 0, done.stderr
    made = {path.name: path for path in (tmp_path / "docs").rglob("*.png")}
    assert set(made) == {"modelA_snow.png", "modelA_quake.png", "modelC2_snow.png", "history.png", "houseC2.png", "l_house.png", "ground_motion.png"}
    assert all(5_000 < path.stat().st_size < 150_000 for path in made.values())


def test_gallery_of_runs_that_are_not_over(tmp_path):
    save_runs(tmp_path, ended=False)
    done = run("paper/make_gallery.py", tmp_path, "--out", tmp_path / "docs")
    assert done.returncode == 1 and "not over" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("script", ["show/show_run.py", "paper/make_gallery.py"])
def test_nothing_there(tmp_path, script):
    done = run(script, tmp_path, "--out", tmp_path)
    assert done.returncode == 1 and done.stderr.startswith("error: ") and "frames.h5: no such file" in done.stderr and done.stderr.count("\n") == 1


def test_pictures_of_several_runs_lie_apart(tmp_path):
    save_runs(tmp_path, ended=True)
    done = run("show/show_run.py", tmp_path / "modelA_snow", tmp_path / "modelA_quake", "--out", tmp_path / "pictures")
    assert done.returncode == 0, done.stderr
    assert {path.parent.name for path in (tmp_path / "pictures").rglob("front.png")} == {"modelA_snow", "modelA_quake"}


def test_a_dot_in_a_name_is_no_ending(tmp_path):
    assert sheets.stem_of(tmp_path / "site.a") == tmp_path / "site.a" and sheets.stem_of(tmp_path / "site.a.png") == tmp_path / "site.a"
    (tmp_path / "mine.yaml").write_text("extends: A\nname: house 1.5\n")
    done = subprocess.run([sys.executable, SCRIPTS / "show" / "show_house.py", "mine.yaml"], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert {path.name for path in tmp_path.glob("house_*")} == {"house_house 1.5.png", "house_house 1.5.pdf"}


def test_a_folder_that_cannot_be_written(tmp_path):
    recorded.save(tmp_path / recorded.NAME, frames())
    done = run("show/show_run.py", tmp_path, "--out", tmp_path / recorded.NAME)
    assert done.returncode == 1 and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1
