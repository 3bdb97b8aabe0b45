# SPDX-License-Identifier: GPL-2.0-or-later
"""What a checkpoint must agree with: everything that decides a run and nothing else. Files that are damaged: test_cli_errors; whole runs: test_run."""
import copy
from dataclasses import replace

import numpy as np
import pytest
from yade_timber.run import checkpoint
from yade_timber.house import build_house, load_house
from yade_timber.motion import GroundMotion
from yade_timber.scene.scenario import Scenario

SCENARIO = Scenario("run", "A", GroundMotion(0.01, np.ones((9, 3)), "shove"), 0.5, scale=0.8, duration=3.0)


@pytest.fixture(scope="module")
def model():
    return build_house(load_house("A"), snow_depth=0.5)


def identity(model, scenario=SCENARIO, version="1"):
    return checkpoint.identity(scenario, model, version)


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
        *(("joint values", joint_change(name, value)) for name, value in (("kn", 1.0), ("ks", 1.0), ("strength", 1.0), ("per", "joint"), ("broken", True))),
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
    """How long the run is to be, and where the house file lies."""
    assert identity(model) == identity(model, replace(SCENARIO, duration=9.0)) == identity(model, replace(SCENARIO, house=str(tmp_path / "A.yaml")))


def test_another_package(model, monkeypatch):
    one = identity(model)
    assert identity(model, version="2") != one
    monkeypatch.setattr(checkpoint, "package", lambda: "another")
    assert identity(model) != one
