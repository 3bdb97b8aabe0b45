# SPDX-License-Identifier: GPL-2.0-or-later
"""`th.run` in a YADE session: several runs, the same results as the script's, refusals, an interruption, results as an
object.
"""
import pydoc
import re
import signal
import subprocess
import sys
from os import kill, getpid
from pathlib import Path

import numpy as np
import pytest
import timber_houses as th
import yade_timber as yt
from yade import O
from timber_houses.base.errors import RunError
from timber_houses.motion import GroundMotion
from timber_houses.run.runner import Run

HOUSE_SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "house.py"
SHORT = {"duration": 0.3, "dt": 2e-4, "quiet": True, "no_frames": True}


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_runs_one_after_the_other_have_folders_of_their_own():
    house = th.house("A")
    first = th.run(house, motion="shipped", **SHORT)
    with pytest.raises(RunError):
        th.run(house, dt=1)  # takes no folder
    second = th.run(house, motion="shipped", snow=0.5, **SHORT)
    assert (first.folder.name, second.folder.name) == ("A", "A_2")
    assert first.summary.snow_mass_kg == 0 < second.summary.snow_mass_kg
    assert first.drift != second.drift


def test_the_script_gives_the_same_result():
    """Bit for bit, also after another run in the session, and with the motion as an object."""
    options = ["--quake", "--scale", "2", "--duration", "0.3", "--dt", "2e-4", "--quiet", "--no-frames", "--out",
               "script"]
    subprocess.run(["yade", "-n", "-x", HOUSE_SCRIPT, "A", *options], check=True, capture_output=True,
                   stdin=subprocess.DEVNULL)
    th.run("B", **{**SHORT, "duration": 0.01})
    for motion in ("shipped", th.motion("shipped")):
        run = th.run("A", motion=motion, scale=2, **SHORT)
        assert np.array_equal(run.history.rows, th.load_run("script").history.rows)


def test_numbers_of_a_run():
    run = th.run("A", motion="shipped", **SHORT)
    assert run.drift == max(value for storey in run.drifts.values() for value in storey.values() if value is not None)
    assert (run.broken, run.collapsed, run.collapse_time, run.events, run.breaks) == (0, False, None, [], [])
    assert run.energy is run.summary.energy and run.energy.input > 0
    assert run.history.time[-1] == pytest.approx(0.3, abs=0.011)  # one sample in 0.01 s
    assert run.sentence in repr(run) and len(repr(run)) < 400


@pytest.mark.parametrize("error, words, options", [
    (TypeError, "did you mean 'duration'", {"durration": 1}),
    (TypeError, "motion 3: must be", {"motion": 3}),
    (RunError, "no earthquake; give motion=", {"scale": 2}),
    (RunError, "dt 1: must be between", {"dt": 1}),
    (RunError, "a path must not be empty", {"out": ""}),
    (RunError, "joint_damping 2: must be between 0 and 1", {"joint_damping": 2}),
    (TypeError, "run: dt '1e-4': must be a number", {"dt": "1e-4"}),
    (TypeError, "give motion='shipped'", {"quake": True}),
    (ValueError, "no such file", {"motion": "nowhere"}),
    (ValueError, "did you mean 'shipped'?", {"motion": "shiped"}),
    (ValueError, "seed: a GroundMotion is given; leave one of them out",
     {"motion": GroundMotion(0.01, np.ones((100, 3))), "seed": 3}),
])
def test_wrong_options_are_refused_in_a_line(error, words, options):
    with pytest.raises(error) as refusal:
        th.run("A", **options)
    assert words in str(refusal.value) and "\n" not in str(refusal.value)


def test_interrupted_run_continues(monkeypatch):
    """Ctrl-C in the first interval between two frames; the handlers are the session's own again."""
    def interrupted(run, step):
        advance(run, step)
        kill(getpid(), signal.SIGINT)

    advance = Run.advance
    before = signal.getsignal(signal.SIGINT)
    options = {**SHORT, "duration": 2, "every_step": True, "out": "stopped"}
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt, match="resume=True"):
        patch.setattr(Run, "advance", interrupted)
        th.run("A", **options)
    assert signal.getsignal(signal.SIGINT) is before
    reached = O.time
    assert reached == pytest.approx(0.05)  # one frame
    assert th.run("A", **{**options, "duration": reached + 0.1, "resume": True}).summary.duration_s == pytest.approx(
        reached + 0.1, abs=2e-4)


def test_player_and_pictures():
    run = th.run("A", motion="shipped", **{**SHORT, "no_frames": False})
    other = th.run("B", motion="shipped", **{**SHORT, "no_frames": False})
    assert run.player() == run.folder / "player.html" and run.player().stat().st_size > 1e5
    assert run.player(other) == run.folder / "compare_with_B.html"
    assert len(run.frames.time) == 7 and len(repr(run.frames)) < 300
    assert (run.folder / "front.png") in run.pictures()


def test_names_outside_yade():
    """A plain Python has houses, motions and finished runs, and says what it lacks."""
    code = ("import yade_timber as yt, timber_houses as th\nfor name in ('box', 'nothing'):\n    try:\n"
            "        getattr(yt, name)\n    except AttributeError as problem:\n        print(problem)\nth.run('A')")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "yade_timber.box needs YADE" in done.stdout and "no attribute 'nothing'" in done.stdout
    assert done.stderr.splitlines()[-1].endswith("or call it in a YADE session") and done.returncode == 1


def test_every_name_is_there():
    """Those of `yt.<tab>` and `th.<tab>` are public; the help names all but the classes of YADE, on one screen."""
    for package, names in ((yt, {*yt.IN_YADE}), (th, {*dir(th)})):
        assert [name for name in dir(package) if not hasattr(package, name) or name.startswith("_")] == []
        screen = pydoc.plaintext.document(package)
        assert screen.count("\n") < 50 and names <= set(re.findall(r"\w+", screen)) and names <= {*dir(package)}
    assert "TimberMat" in dir(yt) and not {"host", "scene", "plugin", "compiled"} & set(dir(yt))
