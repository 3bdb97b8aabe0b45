# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls in pictures: corners, states, openings of panels; walls and node numbers in the plan."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "py"))

from timber_houses.house import build_house, load_house
from timber_houses.pictures import drawings
from timber_houses.pictures.figures import new_figure
from timber_houses.pictures.panels import draw_panels, panels
from timber_houses.pictures.views import FRONT, SIDE, Snapshot


def column(y):
    """Corners of a column of 0.1 x 0.1 x 2.5 m on the ground at x = 0."""
    return np.array([[dx, y + dy, z] for z in (0, 2.5) for dx in (-0.05, 0.05) for dy in (-0.05, 0.05)])


def frames(*states):
    """Two columns 2 m apart, the second one lifted by 0.1 m in frame 0, with one sheet for each two states: of its
    joints.
    """
    start = [column(0.0), column(2.0)]
    moved = [start[0], start[1] + [0, 0, 0.1]]
    count = len(states)
    names = [f"h.wall1.NS.x0.0-1.{layer}.window.{half}" for layer in range(count // 2) for half in ("beams", "columns")]
    joints = SimpleNamespace(kind=["wall_beam", "wall_column"] * (count // 2), a=[0] * count, b=[1] * count,
                             side=["east"] * count, name=names)
    elements = SimpleNamespace(storey=np.array([1, 1]))
    return SimpleNamespace(elements=elements, joints=joints, joint_states=lambda frame: np.array(states),
                           corners=lambda frame, k: moved[k], corners_at_start=lambda k: start[k])


@pytest.mark.parametrize("states, state", [
    ("whole whole", "whole"), ("broken whole", "partly"), ("whole broken", "partly"), ("broken broken", "broken"),
    ("broken broken whole whole", "partly"), ("broken broken broken broken", "broken"),
])
def test_corners_and_states(states, state):
    panel, = panels(frames(*states.split()), 0)
    assert panel.corners == pytest.approx(np.array([[0, 0, 0], [0, 2, 0.1], [0, 2, 2.6], [0, 0, 2.5]]))
    assert (panel.state, panel.storey, panel.sides, panel.opening) == (state, 1, ("east",), "window")
    assert Snapshot([], [], [panel]).states == {f"wall {state}"}


def test_opening_lies_within_the_bay():
    panel, = panels(frames("whole", "whole"), 0)
    corners = panel.opening_corners()
    assert corners[0] == pytest.approx([0, 0.4, 0.33 * 2.5 + 0.2 * 0.1])
    assert corners[2] == pytest.approx([0, 1.6, 0.78 * 2.5 + 0.8 * 0.1])


def test_walls_that_face_the_viewer_are_drawn():
    """The wall of the east side in the front view: its panel and its window; none in the side view."""
    for view, drawn in ((FRONT, 2), (SIDE, 0)):
        ax = new_figure(2, 2, 50).add_axes((0, 0, 1, 1))
        draw_panels(ax, view, panels(frames("whole", "whole"), 0))
        assert len(ax.patches) == drawn


def test_plan_numbers_the_nodes():
    """tiled_house: 9 nodes along x, 8 along y."""
    ax = new_figure(4, 4, 50).add_axes((0, 0, 1, 1))
    drawings.draw_plan(ax, build_house(load_house("tiled_house")))
    numbers = [text.get_text() for text in ax.texts if text.get_text().isdigit()]
    assert sorted(map(int, numbers)) == sorted([*range(9), *range(8)])


def test_house_sheet_states_the_weight():
    assert "weighs 266 kN, 2.87 kN per m2 of floor; carried by storey 1 232 kN, storey 2 97 kN" in drawings.describe(
        build_house(load_house("tiled_house")))
