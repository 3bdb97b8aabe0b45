# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Wall sheets in the record and in every picture: plates with openings, torn when broken; nodes in the plan."""
import frames_sample
import numpy as np
import pytest
from timber_houses.base import colors
from timber_houses.house import build_house, load_house
from timber_houses.pictures import camera, drawings, panels, player, sheets, stage
from timber_houses.pictures.figures import new_figure
from timber_houses.pictures.raster import Window, shade
from timber_houses.pictures.views import View
from timber_houses.recording import frames as recorded
from timber_houses.recording.record import placed

SOUTH = View("south", "From the south", (1, 0, 0), (0, -1, 0), "west", "east")
BEFORE, PARTLY, BROKEN = 1.95, 2.05, 2.15
"""Times at which the first sheet is whole, has lost one of its halves, both. [s]"""
OPENING = {"window": 0.6 * 0.45, "door": 0.6 * 0.75, "none": 0.0}
"""Share of a bay."""
HEIGHT = 2.7
"""Of the columns. [m]"""


@pytest.fixture(scope="module")
def run():
    return frames_sample.walled_run()


def volume(plate):
    """By the divergence theorem; positive when faces are counter-clockwise from outside. [m3]"""
    triangles = [(plate.vertices[face[0]], plate.vertices[i], plate.vertices[j])
                 for face in plate.faces for i, j in zip(face[1:], face[2:])]
    return sum(np.dot(a, np.cross(b, c)) for a, b, c in triangles) / 6


def test_plates_fill_the_bay_but_for_the_opening(run):
    """Both halves of a whole sheet: length x height x thickness, less the opening; a torn one is smaller."""
    plates, lengths = panels.plates(run), (3.8, 3.8, 5.8)
    for sheet, (length, opening) in enumerate(zip(lengths, run.sheets.opening)):
        whole, torn = (sum(volume(plate) for plate in plates if (plate.sheet, plate.torn) == (sheet, form))
                       for form in (False, True))
        assert whole == pytest.approx(length * HEIGHT * panels.THICKNESS * (1 - OPENING[opening]), rel=1e-9)
        assert 0.7 * whole < torn < 0.95 * whole


def test_sheets_of_a_bay_lie_beside_each_other(run):
    """Window and board on it: middle planes LAYER apart, symmetric to the plane of the columns at y = -2.9 - 3."""
    found = [np.mean([placed(plate.vertices, run.elements.position[plate.body], run.elements.orientation[plate.body])
                      [:, 1].mean() for plate in panels.plates(run) if plate.sheet == sheet]) for sheet in (0, 1)]
    assert sorted(found) == pytest.approx([-5.9 - panels.LAYER / 2, -5.9 + panels.LAYER / 2])


def test_halves_stay_at_their_columns(run):
    """After the fall to the north: both ends of the column's axis are within a layer of the plate that it carries."""
    shown = panels.states(run, -1)
    carried = [plate for plate in panels.plates(run) if plate.shows(shown)]
    for plate, solid in zip(carried, sheets.Stills(run).shot(-1).walls):
        ends = placed(np.array([[0, 0, -HEIGHT / 2], [0, 0, HEIGHT / 2]]), run.position[-1][plate.body],
                      run.orientation[-1][plate.body])
        away = np.linalg.norm(solid.vertices[:, None] - ends, axis=2).min(0)
        assert away == pytest.approx([away[0]] * 2) and away[0] < panels.LAYER


def test_states_and_marks(run):
    """One mark of each damaged sheet, on its plate: off the opening, and off the gap of a torn one."""
    for time, state, marked in ((BEFORE, "whole", 0), (PARTLY, "partly", 1), (BROKEN, "broken", 1)):
        frame = run.at(time)
        shot = sheets.Stills(run).shot(frame)
        assert panels.states(run, frame)[0] == state and len(shot.places) == len(shot.states) == marked
        assert shot.explained == {f"wall {state}", "wall whole"} | ({state} if marked else set())
    body, anchor = panels.mark_anchors(run)
    for k, sheet in enumerate(run.joints.sheet[:6]):
        for torn in (False, True):
            solids = [plate for plate in panels.plates(run) if (plate.sheet, plate.torn, plate.body) ==
                      (sheet, torn, body[k])]
            assert any(inside(anchor[k], corners) for plate in solids for corners in plate.vertices.reshape(-1, 8, 3))


def inside(point, corners):
    """Whether a point lies between the ends of a prism along both axes of its plane."""
    low, high = corners.min(0), corners.max(0)
    return sum(low[k] - 1e-9 < point[k] < high[k] + 1e-9 for k in range(3)) >= 2


def colour_at(picture, window, x, z):
    left, _, _, top = window.box
    return picture[int((top - z) * window.density), int((x - left) * window.density), :3] / 255


def test_still_view_shows_sheet_opening_and_tear(run):
    """From the south, without the board: sheet below the window, sky in it; orange when broken, sky in the tear."""
    run = frames_sample.walled_run()
    run.sheets.opening = ["window", "window", "door"]
    window = Window(SOUTH, (2, 8, -0.5, 4), 60)
    for time, state in ((BEFORE, "whole"), (run.time[-1], "broken")):
        frame = run.at(time)
        shown = sheets.Stills(run).shot(frame).walls
        south = [solid for solid in shown if np.ptp(solid.vertices[:, 1]) < 1.6]
        assert {solid.kind for solid in shown} == {f"wall {state}"}
        if state == "whole":
            picture, _ = shade(south, window, 0.0, sky=1.0)
            below, hole = colour_at(picture, window, 4.2, 0.7), colour_at(picture, window, 5.0, 1.8)
            assert hole == pytest.approx((1, 1, 1)) and np.ptp(below) < 0.15 and below.max() < 0.95
        else:
            assert all(solid.color == colors.SHEETS["broken"] for solid in south)


def test_film_shows_the_same(run):
    """A picture with sheets differs from one without; torn plates are shown instead of whole ones."""
    view = camera.look("space", stage.corners(run), 16 / 9)
    drawn = stage.Stage(run, (320, 180), view, camera.sun(stage.corners(run)))
    for time, torn in ((BEFORE, False), (run.time[-1], True)):
        drawn.picture(time)
        assert len(drawn.sheathing.vertices) == sum(len(plate.vertices) for plate in drawn.plates if plate.torn is torn)
    bare = frames_sample.run()
    view = camera.look("space", stage.corners(bare), 16 / 9)
    pictures = [np.asarray(stage.Stage(one, (320, 180), view, camera.sun(stage.corners(bare))).picture(BEFORE), int)
                for one in (run, bare)]
    assert (abs(pictures[0] - pictures[1]).max(axis=2) > 20).mean() > 0.03


def test_player_has_the_same_plates(run):
    plates, arrays = panels.plates(run), player.arrays(run)
    assert player.info(run)["plates"] == [
        {"body": plate.body, "sheet": plate.sheet, "torn": plate.torn} for plate in plates]
    assert arrays["plate_vertices"][0] == pytest.approx(np.concatenate([plate.vertices for plate in plates]))


def test_the_record_holds_the_sheets(run, tmp_path):
    recorded.save(tmp_path / "frames.h5", run)
    loaded = recorded.load(tmp_path / "frames.h5")
    assert list(loaded.joints.sheet) == [0, 0, 1, 1, 2, 2, -1, -1] and loaded.sheets.opening == run.sheets.opening
    assert list(loaded.sheets.low) == [2, 2, 3] and list(loaded.sheets.high) == [3, 3, 5]


def test_walls_are_seen_in_space():
    """Without its sheets the house has another picture in more than a tenth of its points, and no wall in the legend.
    """
    model = build_house(load_house("storehouse"))
    pictures, legends = [], []
    for _ in range(2):
        page = drawings.page(model, 40)
        pictures.append(page.axes[0].images[0].get_array().astype(int))
        legends.append([text.get_text() for text in page.legends[0].get_texts()])
        model.joints = [joint for joint in model.joints if not joint.sheet]
    assert (abs(pictures[0] - pictures[1]).max(axis=2) > 20).mean() > 0.1
    assert "wall" in legends[0] and "wall" not in legends[1]


def test_plan_numbers_the_nodes():
    """tiled_house: 9 nodes along x, 8 along y."""
    ax = new_figure(4, 4, 50).add_axes((0, 0, 1, 1))
    drawings.draw_plan(ax, build_house(load_house("tiled_house")))
    numbers = [text.get_text() for text in ax.texts if text.get_text().isdigit()]
    assert sorted(map(int, numbers)) == sorted([*range(9), *range(8)])


def test_house_sheet_states_the_weight():
    assert "weighs 266 kN, 2.87 kN per m2 of floor; carried by storey 1 232 kN, storey 2 97 kN" in drawings.describe(
        build_house(load_house("tiled_house")))
