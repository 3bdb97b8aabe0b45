# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Pictures: what hides what, where things are drawn, and that a picture comes out whole. Needs no YADE."""
import dataclasses

import numpy as np
import pytest
from small_frames import frames
from yade_timber.pictures import all_pictures as pictures
from yade_timber.pictures import raster
from yade_timber.pictures import sheets
from yade_timber.pictures import snapshot
from yade_timber.pictures import views
from yade_timber.recording import frames as recorded
from yade_timber.pictures.views import FRONT, SIDE, Solid

FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
BOX = (-2.0, 2.0, -1.0, 3.0)


def cube(centre, size=1.0, kind="column", color=(1.0, 0.0, 0.0)):
    """A cube whose faces run counter-clockwise seen from outside."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * size + centre
    return Solid(kind, corners, FACES, color)


def test_faces_of_the_cube_point_outwards():
    box = cube((0, 0, 0))
    for face in FACES:
        a, b, c = box.vertices[face[:3]]
        assert np.cross(b - a, c - a) @ box.vertices[face].mean(0) > 0


@pytest.mark.parametrize("view", [FRONT, SIDE])
def test_nearer_hides_farther_in_any_order(view):
    near, far = cube(np.array(view.toward) * 1.0, 0.5, color=(0, 0, 1)), cube(np.array(view.toward) * -1.0, 1.0)
    for solids in ([near, far], [far, near]):
        picture, depth = raster.shade(solids, view, BOX, 20)
        middle = picture[60, 40]  # x = 0, z = 0
        assert middle[2] > middle[0] and depth[60, 40] == pytest.approx(1.25)


def test_place_and_size():
    """A unit cube at y = 1, z = 2 seen from the east is at the upper right; a pixel is 5 cm."""
    _, depth = raster.shade([cube((0, 1, 2))], FRONT, BOX, 20)
    rows, columns = np.nonzero(np.isfinite(depth))
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (10, 29, 50, 69)


def test_sides_are_not_mirrored():
    """From the east, north is to the right; from the north, east is to the left."""
    assert np.allclose(np.cross(FRONT.toward, FRONT.right), (0, 0, 1)) and np.allclose(np.cross(SIDE.toward, SIDE.right), (0, 0, 1))


def test_crossing_bodies_share_the_picture():
    """Two slabs that cross: each is seen where it is nearer."""
    slabs = [cube((0, 0, 0.5)), cube((0.25, 0.5, 0.5), color=(0, 1, 0))]
    _, depth = raster.shade(slabs, FRONT, BOX, 20)
    assert depth[50, 32] == pytest.approx(0.5) and depth[50, 45] == pytest.approx(0.75)


def test_outline_is_filled():
    frame = [cube((0, y, 0.5), 0.2) for y in np.arange(-1, 1.01, 0.2)] + [cube((0, y, 2.5), 0.2) for y in np.arange(-1, 1.01, 0.2)]
    frame += [cube((0, y, z), 0.2) for y in (-1, 1) for z in np.arange(0.5, 2.51, 0.2)]
    assert raster.outline(frame, FRONT, BOX, 20)[30, 40]


def test_marks_sit_on_the_damaged_joints():
    made = frames()
    found = {m.state: m.place for m in snapshot.marks(made, made.at(2.0))}
    assert set(found) == {"before", "broken", "partly"} and np.allclose(found["broken"], (0.5, 0, 1))
    assert [m.state for m in snapshot.marks(made, 0)] == ["before"]


@pytest.fixture
def coarse(monkeypatch):
    monkeypatch.setattr(sheets, "PRINT", dataclasses.replace(sheets.PRINT, dpi=60))


def test_pictures_are_written_whole(tmp_path, coarse):
    recorded.save(tmp_path / recorded.NAME, frames())
    written = pictures.write(tmp_path)
    assert [path.name for path in written] == pictures.NAMES and {path.name for path in tmp_path.iterdir()} == {recorded.NAME, *pictures.NAMES}
    assert all(path.read_bytes()[:4] in (b"\x89PNG", b"%PDF", b"<!DO") for path in written)


def test_pictures_of_a_run_that_is_not_over(tmp_path, coarse):
    """No curves, no sentence; and the pictures may go elsewhere."""
    recorded.save(tmp_path / recorded.NAME, frames(ended=False, shaken=False))
    (tmp_path / "out").mkdir()
    written = pictures.write(tmp_path / "out", tmp_path)
    assert {path.name for path in written} == {"end_state.png", "front.png", "front.pdf", "side.png", "side.pdf", "player.html"}


def test_far_wreckage_does_not_shrink_the_house():
    start = [cube((0, 0, 0.5))]
    left, right, _, _ = views.window(FRONT, start, [[cube((0, 100, 0.5))]])
    assert -0.5 - views.MARGIN - views.GRID < left <= -0.5 - views.MARGIN and 0 <= right - (0.5 + views.FAR + views.MARGIN) < views.GRID
