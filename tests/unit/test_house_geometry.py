# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Convex polyhedra of the house builder against closed forms."""
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from timber_houses.house.geometry import (Polyhedron, box, clip_convex, contact_polygon, halfspace_vertices,
                                          polygon_area, separation)
from timber_houses.house.joints import spring_points

UNIT_BOX = [((1, 0, 0), 1), ((-1, 0, 0), 0), ((0, 1, 0), 1), ((0, -1, 0), 0), ((0, 0, 1), 1), ((0, 0, -1), 0)]


def shifted(vertices, by):
    return Polyhedron(vertices + np.array(by, float))


def test_box_has_six_outward_faces_and_its_volume():
    solid = Polyhedron(box([0, 1, 2], [2, 4, 6]))
    assert len(solid.faces) == 6 and all(len(face.points) == 4 for face in solid.faces)
    assert solid.volume == pytest.approx(24, rel=1e-12)
    assert solid.centroid == pytest.approx([1, 2.5, 4], abs=1e-12)
    for face in solid.faces:
        assert face.normal @ (face.points.mean(0) - solid.centroid) > 0
        assert np.cross(face.points[1] - face.points[0], face.points[2] - face.points[1]) @ face.normal > 0


def test_halfspaces_give_vertices_without_repeats():
    assert sorted(map(tuple, halfspace_vertices(UNIT_BOX))) == sorted(map(tuple, box([0, 0, 0], [1, 1, 1])))
    redundant = UNIT_BOX + [((1, 1, 1), 3)]  # touches one corner only
    assert len(halfspace_vertices(redundant)) == 8


def test_empty_halfspaces_are_refused():
    with pytest.raises(ValueError, match="no volume"):
        halfspace_vertices(UNIT_BOX + [((1, 0, 0), -1)])


@pytest.mark.parametrize("vertices", [
    np.zeros((8, 3)),
    box([0, 0, 0], [1, 1, 0]),
    np.vstack([box([0, 0, 0], [1, 1, 1]), [[0.5, 0.5, 0.5]]]),
    np.full((8, 3), np.nan),
])
def test_flat_inner_point_and_nan_are_refused(vertices):
    with pytest.raises(ValueError):
        Polyhedron(vertices).hull


@given(gap=st.floats(-0.4, 0.4), angles=st.tuples(*[st.floats(-3, 3)] * 3))
@settings(max_examples=40, deadline=None, database=None, derandomize=True)
def test_separation_of_two_boxes_is_the_gap_in_any_orientation(gap, angles):
    a, b = box([0, 0, 0], [1, 1, 1]), box([1 + gap, 0.1, -0.2], [2 + gap, 0.9, 1.2])
    turn = Rotation.from_euler("xyz", angles).as_matrix()
    # Rounding of vertices about 3 m from the origin: 1e-12 leaves a margin of a thousand.
    assert separation(Polyhedron(a @ turn.T), Polyhedron(b @ turn.T)) == pytest.approx(gap, abs=1e-12)
    assert separation(Polyhedron(b @ turn.T), Polyhedron(a @ turn.T)) == pytest.approx(gap, abs=1e-12)


def test_separation_finds_edge_on_edge_gap():
    """Two crossed beams turned by 45 degrees about their axes: only an edge-edge axis separates them."""
    a = box([-2, -0.5, -0.5], [2, 0.5, 0.5]) @ Rotation.from_euler("x", 45, degrees=True).as_matrix().T
    b = box([-0.5, -2, -0.5], [0.5, 2, 0.5]) @ Rotation.from_euler("y", 45, degrees=True).as_matrix().T
    height = 2 * np.sqrt(0.5)
    assert separation(Polyhedron(a), shifted(b, [0, 0, height + 0.01])) == pytest.approx(0.01, abs=1e-12)
    assert separation(Polyhedron(a), shifted(b, [0, 0, height - 0.01])) == pytest.approx(-0.01, abs=1e-12)


def test_clip_of_two_squares():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    assert polygon_area(clip_convex(square, square + 0.25)) == pytest.approx(0.5625, rel=1e-12)
    assert polygon_area(clip_convex(square, square)) == pytest.approx(1, rel=1e-12)
    touching = clip_convex(square, square + [1, 0])
    assert len(touching) < 3 or abs(polygon_area(touching)) < 1e-12


def test_contact_polygon_is_the_common_area():
    column, beam = Polyhedron(box([0, 0, 1], [0.12, 0.12, 2])), Polyhedron(box([0.0075, -3, 0], [0.1125, 3, 1]))
    polygon, normal, area = contact_polygon(column, beam, 1e-6)
    assert normal == pytest.approx([0, 0, -1])
    assert area == pytest.approx(0.105 * 0.12, rel=1e-12)
    assert sorted(set(np.round(polygon[:, 0], 9))) == [0.0075, 0.1125]
    lifted = shifted(column.vertices, [0, 0, 2e-6])
    assert contact_polygon(lifted, beam, 1e-6) is None


def test_spring_points_of_a_triangle_and_of_a_pentagon():
    triangle = np.array([[0, 0, 0], [4, 0, 0], [0, 3, 0.0]])
    assert spring_points(triangle, np.array([0, 0, 1.0])).tolist() == [[0, 0, 0], [4, 0, 0], [2, 1.5, 0], [0, 3, 0]]
    pentagon = np.array([[0, 0, 0], [4, 0, 0], [4, 2, 0], [2, 2.1, 0], [0, 2, 0.0]])
    assert [2, 2.1, 0] not in spring_points(pentagon, np.array([0, 0, 1.0])).tolist()
