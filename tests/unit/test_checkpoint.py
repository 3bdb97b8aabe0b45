# SPDX-License-Identifier: GPL-2.0-or-later
"""Identity of a run: everything that decides its results and nothing else. Damaged checkpoints: test_cli_errors; whole runs: test_run."""
import copy
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yade.system as system
import yade.wrapper as yw
from yade_timber.base.errors import RunError
from yade_timber.run import checkpoint
from yade_timber.run import identity as identities
from yade_timber.house import build_house, load_house
from yade_timber.motion import GroundMotion
from yade_timber.scene.scenario import Scenario

O = yw.Omega()
SCENARIO = Scenario("run", "A", GroundMotion(0.01, np.ones((9, 3)), "shove"), 0.5, scale=0.8, duration=3.0)


@pytest.fixture(scope="module")
def model():
    return build_house(load_house("A"), snow_depth=0.5)


def identity(model, scenario=SCENARIO):
    return identities.identity(scenario, model)


@pytest.mark.parametrize(
    "key, change",
    [
        ("name", {"name": "other"}),
        ("house", {"house": "B"}),
        ("motion", {"motion": None}),
        ("motion", {"motion": GroundMotion(0.01, 2 * np.ones((9, 3)), "shove")}),
        ("motion", {"motion": GroundMotion(0.02, np.ones((9, 3)), "shove")}),
        ("snow_depth", {"snow_depth": 0.6}),
        ("scale", {"scale": 0.9}),
        ("dt", {"dt": 1e-4}),
        ("options", {"options": {"skip_rest": 0}}),
    ],
)
def test_another_scenario(model, key, change):
    one, other = identity(model), identity(model, replace(SCENARIO, **change))
    assert [name for name in one if one[name] != other[name]] == [key]


def move_vertex(model):
    model.elements[3].vertices = model.elements[3].vertices + [1e-13, 0, 0]


def move_spring(model):
    model.joints[5].points = model.joints[5].points + [1e-13, 0, 0]


def joint_change(name, value):
    return lambda model: setattr(model.joints[5], name, value)


@pytest.mark.parametrize(
    "key, change",
    [
        ("elements", move_vertex),
        ("joints", move_spring),
        ("element values", lambda model: setattr(model.elements[3], "density", 1.0)),
        ("element values", lambda model: setattr(model.elements[-1], "fixed", not model.elements[-1].fixed)),
        *(("joint values", joint_change(name, value)) for name, value in (("kn", 1.0), ("ks", 1.0), ("strength", 1.0), ("per", "spring"), ("damping_ratio", 0.1), ("broken", True), ("law", "slip"), ("ultimate_stretch", 0.1))),
        ("materials", lambda model: model.materials["timber"].update(density=1.0)),
        ("materials", lambda model: model.friction.append(("timber", "snow", 0.1))),
        ("law", lambda model: model.law.update(hertz="increment")),
    ],
)
def test_another_house(model, key, change):
    other = copy.deepcopy(model)
    change(other)
    one, two = identity(model), identity(other)
    assert [name for name in one if one[name] != two[name]] == [key]


def test_what_may_differ(model, tmp_path):
    """The duration, and the folder of the house file."""
    assert identity(model) == identity(model, replace(SCENARIO, duration=9.0)) == identity(model, replace(SCENARIO, house=str(tmp_path / "A.yaml")))


def test_another_package(model, monkeypatch):
    one = identity(model)
    monkeypatch.setattr(identities, "package", lambda: "another")
    assert [key for key in one if one[key] != identity(model)[key]] == ["package"]


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the package's folder."""
    folder = tmp_path_factory.mktemp("package") / "yade_timber"
    shutil.copytree(Path(identities.__file__).resolve().parents[1], folder, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


@pytest.mark.parametrize(
    "name, decides",
    [
        ("base/colors.py", False),
        ("pictures/raster.py", False),
        ("pictures/player.py", False),
        ("data/player/page.css", False),
        ("study/driver.py", False),
        ("recording/sentences.py", False),
        ("scene/engines.py", True),
        ("scene/scenario.py", True),
        ("run/runner.py", True),
        ("run/summary.py", True),
        ("house/build.py", True),
        ("motion/readers.py", True),
        ("recording/drift.py", True),
        ("base/time_step.py", True),
        ("data/houses/base.yaml", True),
    ],
)
def test_files_that_decide_results(package, name, decides):
    """A changed file changes the fingerprint of the package if, and only if, it decides results."""
    before = identities.of_files(identities.decisive_files(package))
    with open(package / name, "a") as file:
        file.write("\n# changed\n")
    assert (identities.of_files(identities.decisive_files(package)) != before) is decides


def test_another_users_checkpoint_is_not_loaded(tmp_path, monkeypatch):
    """It could harm the process."""
    O.reset()
    checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {"wall_s": 1.0})
    assert checkpoint.load(tmp_path / "a.yade", {"name": "x"}) == {"wall_s": 1.0}
    owner = (tmp_path / "a.yade").stat().st_uid
    monkeypatch.setattr(checkpoint.os, "geteuid", lambda: owner + 1)
    with pytest.raises(RunError, match="another user; copy it"):
        checkpoint.load(tmp_path / "a.yade", {"name": "x"})


@pytest.mark.parametrize("nested", [False, True])
def test_a_forged_checkpoint_is_refused_before_it_is_loaded(tmp_path, monkeypatch, nested):
    """A PyRunner in the list of engines or in an engine; its command runs where nothing refuses it."""
    path, marker = tmp_path / "a.yade", tmp_path / "marker"
    runner = yw.PyRunner(command=f"open({str(marker)!r}, 'w')", iterPeriod=1, initRun=True)
    O.reset()
    O.engines = [yw.ParallelEngine([runner]) if nested else runner]
    checkpoint.save(path, {"name": "x"}, {})
    O.reset()
    with pytest.raises(RunError, match="a.yade: holds P.*, which no run of this package saves; run without --resume"):
        checkpoint.load(path, {"name": "x"})
    assert O.engines == [] and not marker.exists()
    monkeypatch.setattr(checkpoint, "CLASSES", checkpoint.CLASSES | {"PyRunner", "ParallelEngine"})
    checkpoint.load(path, {"name": "x"})
    O.step()
    assert marker.exists()
    O.reset()


def test_every_class_of_yade_has_a_name_that_is_checked(tmp_path):
    """An object of each kind of engine, in a binary file, is named with its namespace."""
    O.reset()
    for name in system.childClasses("Engine"):
        try:
            O.engines = [getattr(yw, name)()]
            O.save(str(tmp_path / "a.yade"), quiet=True)
        except Exception:  # an engine that needs arguments
            continue
        assert f"yade::{name}".encode() in (tmp_path / "a.yade").read_bytes(), name
    O.reset()


def test_a_writer_that_fails_leaves_the_earlier_checkpoint(tmp_path, monkeypatch):
    """As on a full disk."""
    checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {})
    before = (tmp_path / "a.yade").read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("yade_timber.base.atomic_write.shutil.copyfileobj", full)
    with pytest.raises(OSError, match="No space"):
        checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {})
    assert [path.name for path in tmp_path.iterdir()] == ["a.yade"] and (tmp_path / "a.yade").read_bytes() == before
