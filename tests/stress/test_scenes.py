# SPDX-License-Identifier: GPL-2.0-or-later
"""200 random scenes that are not houses; and that their judges can fail."""
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
from yade_timber.base.time_step import DEFAULT_DT


@pytest.mark.parametrize("family", scenes.FAMILIES)
def test_sound(family, capsys):
    with capsys.disabled():
        print()
        verdicts = scenes.show(scenes.wanted([family]))
    faults = {one.outcome.name: one.faults() for one in verdicts if one.faults()}
    assert not faults, "\n".join(f"{name}: {'; '.join(found)}" for name, found in faults.items())


def test_there_are_two_hundred():
    assert len(scenes.ALL) == 200


# --- the judges -------------------------------------------------------------------------------------------------------
def box(extents, radius):
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return Core(signs * np.array(extents) / 2, radius)


@pytest.mark.parametrize("gap", [-0.05, -1e-3, 0.0, 1e-3, 0.015])
def test_overlap_of_cubes(gap):
    """Cores side by side, edge over edge across, corner to corner; gap between the cores along the diagonal [m]."""
    cube, radius = box((0.2, 0.2, 0.2), 0.01), 0.01
    first = cube.placed(np.zeros(3), np.eye(3))
    half, root = 0.1 - radius, 2**-0.5
    quarter = np.array([[root, 0, root], [0, 1, 0], [-root, 0, root]])  # about y
    crossed = np.array([[1, 0, 0], [0, root, -root], [0, root, root]])  # about x
    placements = [(first, [0.03, 0.02, 2 * half + gap], np.eye(3)),
                  (cube.placed(np.zeros(3), quarter), [0, 0, 2 * 2**0.5 * half + gap], crossed)]
    if gap > 0:
        placements.append((first, np.full(3, 2 * half + gap / 3**0.5), np.eye(3)))
    for below, position, rotation in placements:
        assert overlap(below, cube.placed(np.array(position), rotation)) == pytest.approx(2 * radius - gap, abs=1e-9)


def through_a_seam(random):
    """Contacts of the paper alone carry no post between two slabs of 1 m."""
    for x in (-1, 1):
        O.bodies.append(yt.box((2, 2, 1), (x, 0, -0.5), fixed=True))
    O.bodies.append(yt.box((0.12, 0.12, 1), (0, 0, 0.5)))
    O.dt, O.engines = DEFAULT_DT, yt.engines(vertex_edge=False)
    return Plan(1.0, stands=2e-3)


def test_a_post_that_sinks_is_seen():
    found = " ".join(scene_judge.judge("seam", through_a_seam, None).faults())
    assert "overlap" in found and "moved" in found and "creep" in found and "weight" in found


def test_each_bound_can_fail():
    """Of a sound verdict with one number changed."""
    sound = scenes.run("post", 0)
    assert sound.faults() == []
    for name, value in {"moved": 1.0, "creep": 1e-4, "weight": nan, "handed": 1.0,
                        "answer": ["no"], "speed_limit": 0.0}.items():
        assert len(replace(sound, **{name: value}).faults()) == 1, name
    for name, value in {"residual": 2e-4, "created": 2e-4, "unconverged": 1, "speed": inf, "unexplained": 1e-9,
                        "error": "stopped"}.items():
        assert replace(sound, outcome=replace(sound.outcome, **{name: value})).faults(), name
