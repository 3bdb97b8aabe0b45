# SPDX-License-Identifier: GPL-2.0-or-later
"""Short form of tests/stress/test_scenes.py (label `stress`): a scene of some families; and the judges can fail."""
from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest
import scene_judge
import scenes
import yade_timber as yt
from scene_judge import Plan
from true_overlap import Core, overlap
from yade import O
from timber_houses.base.time_step import DEFAULT_DT

SCENES = [("post", 0), ("wall", 1), ("slope", 0), ("keystone", 5), ("hammer", 0), ("slip_chain", 2)]


@pytest.mark.parametrize("family, seed", SCENES)
def test_sound(family, seed):
    scenes.expect_sound([scenes.run(family, seed)])


# --- the judges -------------------------------------------------------------------------------------------------------
def cube(radius):
    """Core of a cube of 0.2 m."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return Core(0.1 * signs, radius)


@pytest.mark.parametrize("gap", [-0.05, -1e-3, 0.0, 1e-3, 0.015])
def test_overlap_of_cubes(gap):
    """Face on face, edge across edge, corner to corner, with this gap between the cores [m]; exact but for rounding."""
    radius = 0.01
    core, half, root = cube(radius), 0.1 - radius, 2**-0.5
    level = core.placed(np.zeros(3), np.eye(3))
    about_y = core.placed(np.zeros(3), np.array([[root, 0, root], [0, 1, 0], [-root, 0, root]]))
    about_x = np.array([[1, 0, 0], [0, root, -root], [0, root, root]])
    placements = [(level, [0.03, 0.02, 2 * half + gap], np.eye(3)), (about_y, [0, 0, 2 * 2**0.5 * half + gap], about_x)]
    if gap > 0:
        placements.append((level, np.full(3, 2 * half + gap / 3**0.5), np.eye(3)))
    for below, position, rotation in placements:
        assert overlap(below, core.placed(np.array(position), rotation)) == pytest.approx(2 * radius - gap, abs=1e-9)


def test_bodies_apart_have_no_overlap():
    core = cube(0.01)
    first, second = (core.placed(np.array([x, 0, 0]), np.eye(3)) for x in (0, 0.2001))
    assert overlap(first, second) == -inf


def through_a_seam(random):
    """Contacts of the paper alone carry no post between two slabs of 1 m."""
    for x in (-1, 1):
        O.bodies.append(yt.box((2, 2, 1), (x, 0, -0.5), fixed=True))
    O.bodies.append(yt.box((0.12, 0.12, 1), (0, 0, 0.5)))
    O.dt, O.engines = DEFAULT_DT, yt.engines(vertex_edge=False)
    return Plan(1.0, stands=2e-3)


def test_a_post_that_sinks_is_seen():
    found = " ".join(scene_judge.judge("seam", through_a_seam, None).faults())
    assert all(word in found for word in ("overlap", "moved", "creep", "weight")), found


@pytest.mark.parametrize("creep", [0.0, 2e-5])
def test_the_slope_is_that_of_the_creep(creep):
    """Beside swings of 0.1 mm and four periods or more in the window, to a quarter of the limit."""
    rest = scene_judge.Rest(Plan(10.0))
    rest.times = list(np.arange(80) * 0.05)
    for frequency in (1.0, 1.7, 3.0):
        for phase in np.arange(8) * np.pi / 4:
            swing = 1e-4 * np.sin(2 * np.pi * frequency * np.array(rest.times) + phase)
            rest.corners = [{1: np.array([[x + creep * t, 0, 0]])} for t, x in zip(rest.times, swing)]
            assert rest.slopes(0)[0] == pytest.approx(creep, abs=2.5e-6)


def test_each_bound_can_fail():
    """Of a sound verdict with one number changed."""
    sound = scenes.run("post", 0)
    assert sound.faults() == []
    for name, value in {"moved": 1.0, "creep": 1e-4, "weight": nan, "handed": 1.0, "answer": ["no"],
                        "speed_limit": 0.0}.items():
        assert len(replace(sound, **{name: value}).faults()) == 1, name
    for name, value in {"residual": 2e-4, "created": 2e-4, "unconverged": 1, "speed": inf, "unexplained": 1e-9,
                        "error": "stopped"}.items():
        assert replace(sound, outcome=replace(sound.outcome, **{name: value})).faults(), name
