# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Pictures: what hides what, where things are drawn, and that a picture comes out whole. Needs no YADE."""
import dataclasses
import subprocess
import sys
from functools import partial

import numpy as np
import pytest
from matplotlib import image
from small_frames import frames
from timber_houses.pictures import all_pictures, curves, figures, key_times, raster, renderer, sheets, stage, views
from timber_houses.pictures.raster import Window
from timber_houses.pictures.views import FRONT, SIDE, Solid
from timber_houses.recording import frames as recorded

FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
BOX = (-2.0, 2.0, -1.0, 3.0)


def cube(centre, size=1.0, kind="column", color=(1.0, 0.0, 0.0)):
    """A cube whose faces run counter-clockwise seen from outside."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * size + centre
    return Solid(kind, corners, FACES, color)


@pytest.mark.parametrize("view", [FRONT, SIDE])
def test_nearer_hides_farther_in_any_order(view):
    near, far = cube(np.array(view.toward) * 1.0, 0.5, color=(0, 0, 1)), cube(np.array(view.toward) * -1.0, 1.0)
    for solids in ([near, far], [far, near]):
        picture, depth = raster.shade(solids, Window(view, BOX, 20), 1.25)
        middle = picture[60, 40]  # x = 0, z = 0
        assert middle[2] > middle[0] and depth[60, 40] == pytest.approx(1.25)


def test_place_and_size():
    """A unit cube at y = 1, z = 2 seen from the east is at the upper right; a pixel is 5 cm. The lines along its edges
    may reach one pixel beyond it.
    """
    _, depth = raster.shade([cube((0, 1, 2))], Window(FRONT, BOX, 20), 0.5)
    rows, columns = np.nonzero(depth > depth.min())
    assert np.allclose((rows.min(), rows.max(), columns.min(), columns.max()), (10, 29, 50, 69), atol=1)


def test_sides_are_not_mirrored():
    """From the east, north is to the right; from the north, east is to the left."""
    assert np.allclose(np.cross(FRONT.toward, FRONT.right), (0, 0, 1))
    assert np.allclose(np.cross(SIDE.toward, SIDE.right), (0, 0, 1))


def test_crossing_bodies_share_the_picture():
    """Two slabs that cross: each is seen where it is nearer."""
    slabs = [cube((0, 0, 0.5)), cube((0.25, 0.5, 0.5), color=(0, 1, 0))]
    _, depth = raster.shade(slabs, Window(FRONT, BOX, 20), 0.75)
    assert depth[50, 32] == pytest.approx(0.5) and depth[50, 45] == pytest.approx(0.75)


def test_silhouette_has_outer_outlines_only():
    """A square frame of 2.2 m: one closed line around it, within a pixel; none along its hole."""
    frame = [cube((0, y, 0.5), 0.2)
             for y in np.arange(-1, 1.01, 0.2)] + [cube((0, y, 2.5), 0.2) for y in np.arange(-1, 1.01, 0.2)]
    frame += [cube((0, y, z), 0.2) for y in (-1, 1) for z in np.arange(0.5, 2.51, 0.2)]
    (line,) = views.silhouette(frame, FRONT)
    assert np.allclose([line.min(0), line.max(0)], [(-1.1, 0.4), (1.1, 2.6)], atol=1 / views.OUTLINE_PIXELS)


def test_marks_sit_on_the_damaged_joints():
    made = frames()
    stills = sheets.Stills(made)
    shot = stills.shot(made.at(2.0))
    found = dict(zip(shot.states, shot.places))
    assert set(found) == {"before", "broken", "partly"} and np.allclose(found["broken"], (0.5, 0, 1))
    assert list(stills.shot(0).states) == ["before"]


def test_snow_neither_hazes_the_house_nor_belongs_to_its_outline():
    """A block of snow 5 m in front of a wall: the wall keeps its colour where it shows, the silhouette ends at the
    wall's top.
    """
    wall, snow = cube((0, 0, 0.5)), cube((5, 0, 1.0), kind="snow")
    window = Window(FRONT, BOX, 20)
    beside = raster.shade([wall], window, raster.front_of([wall], FRONT))[0][58, 32]
    behind = raster.shade([wall, cube((5, 0.4, 0.5), 0.5, "snow")], window, raster.front_of([wall, snow], FRONT))[0][58,
                                                                                                                     32]
    assert np.allclose(beside, behind)
    assert np.array_equal(views.silhouette([wall, snow], FRONT), views.silhouette([wall], FRONT))


@pytest.mark.parametrize("count, columns", [(2, 2), (6, 3)])
def test_sheets_are_cropped_to_their_panels(count, columns):
    """Wide panels: the sheet is lower than A4, and nothing but the legend is below the last row."""
    plan = sheets.layout(sheets.PRINT, count, (-7, 7, -0.5, 9.5), "")
    assert plan.columns == columns and plan.height < sheets.PRINT.height and plan.width <= sheets.PRINT.width
    lowest = min(y for _, y in plan.corners())
    assert lowest == pytest.approx(sheets.FOOT + sheets.GAP)


HOSTILE = ["A $\\frac{$ B", "$$$", "\\", "a\x00b\x1b[31m", "\ud800", "\u6728\u9020", "x" * 10**6, "", "{}%s",
           "<img src=x onerror=alert(1)>"]


@pytest.mark.parametrize("name", HOSTILE)
def test_any_text_can_be_drawn(tmp_path, name, recwarn):
    """Titles, headings, legends and tick labels draw as literal text, without mathtext and without a raster overflow.
    """
    figure = figures.new_figure(4, 3, 50)
    figures.heading(figure, name, name)
    axes = figure.add_subplot()
    axes.plot([0, 1], label=figures.drawable(name))
    axes.set_title(figures.drawable(name))
    axes.legend()
    assert len(figures.save(figure, tmp_path / "x", ("png", "pdf"))) == 2
    assert not [str(warning.message) for warning in recwarn if "Glyph" in str(warning.message)]


def test_drawable_keeps_plain_text():
    assert figures.drawable("House A: 1 m of snow, ±3°") == "House A: 1 m of snow, ±3°"
    assert figures.drawable("5 $ or  6 $") == r"5 \$ or 6 \$" and figures.drawable("x" * 500, 10) == "x" * 9 + "…"


def test_history_begins_shortly_before_the_shaking():
    """Onset at 1.2 s. A drift or a break before it is shown from 0."""
    made = frames()
    assert key_times.first_shown(made) == pytest.approx(1.2 - key_times.LEAD)
    made.breaks["time"][0] = 0.1
    assert key_times.first_shown(made) == 0
    made = frames(shaken=False)
    assert key_times.first_shown(made) == 0


def test_labels_of_drift_levels_do_not_overlap():
    """Levels 1/120 and 1/30 lie 8 pt apart on the page: their labels are moved to LABEL_GAP."""
    page = curves.page(frames(), 50)
    labels = [text for text in page.axes[2].texts if text.get_text().startswith("1/")]
    heights = sorted(text.get_window_extent().y0 for text in labels)
    assert len(heights) == 3 and np.diff(heights).min() >= 0.99 * curves.LABEL_GAP * 50 / 72


def test_a_house_without_breaks_has_no_panel_of_them():
    made = frames()
    labels = [axis.get_ylabel() for axis in curves.page(made, 50).axes]
    made.broken[:] = np.where(made.joints.damaged, made.joints.springs, 0)
    assert [axis.get_ylabel() for axis in curves.page(made, 50).axes] == [
        label for label in labels if label != "broken joints"] != labels


def test_pdf_files_embed_truetype_fonts(tmp_path):
    path = figures.save(curves.page(frames(), 50), tmp_path / "x", ("pdf",))[0]
    content = path.read_bytes()
    assert b"/Subtype /Type3" not in content and b"/FontFile2" in content


def test_a_run_without_pictures_imports_no_matplotlib():
    code = ("import sys, timber_houses.pictures.all_pictures; "
            "sys.exit(any(name in sys.modules for name in ('matplotlib', 'moderngl')))")
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


@pytest.fixture
def coarse(monkeypatch):
    monkeypatch.setattr(sheets, "PRINT", dataclasses.replace(sheets.PRINT, dpi=60))


def test_pictures_are_written_whole(tmp_path, coarse):
    recorded.save(tmp_path / recorded.NAME, frames())
    written = all_pictures.write(tmp_path, pdf=True)
    names = [name for name in all_pictures.NAMES if not name.startswith((all_pictures.QUANTITIES, all_pictures.BANDS))
             ]  # no tables of quantities, no ensemble
    assert [path.name for path in written] == names
    assert {path.name for path in tmp_path.iterdir()} == {recorded.NAME, *names}
    assert all(path.read_bytes()[:4] in (b"\x89PNG", b"%PDF", b"<!DO") for path in written)


def test_pictures_without_opengl(tmp_path, coarse, monkeypatch, capsys):
    """Those that need none are made, and one line names the others."""
    def fail(*_, **__):
        raise renderer.NoOpenGL("no OpenGL here")

    monkeypatch.setattr(renderer, "context", fail)
    monkeypatch.setattr(stage, "context", fail)
    recorded.save(tmp_path / recorded.NAME, frames())
    assert [path.name for path in all_pictures.write(tmp_path)] == ["history.png", "player.html"]
    assert capsys.readouterr().err == "note: without end_state, front, side: no OpenGL here\n"


def test_another_device_is_tried(monkeypatch):
    """The first one offers too little; packages are named where a library is missing only."""
    def create(fault="eglCreateContext failed", devices=(), **options):
        if options["device_index"] not in devices:
            raise Exception(fault)
        return options["device_index"]

    make = renderer.context.__wrapped__
    monkeypatch.setattr("moderngl.create_context", partial(create, devices=(2,)))
    assert make() == 2
    monkeypatch.setattr("moderngl.create_context", create)
    with pytest.raises(renderer.NoOpenGL, match="eglCreateContext failed") as raised:
        make()
    assert "install" not in str(raised.value)
    monkeypatch.setattr("moderngl.create_context", partial(create, "libEGL.so not loaded"))
    with pytest.raises(renderer.NoOpenGL, match="install python3-moderngl"):
        make()


def test_hostile_names_in_a_recording(tmp_path, coarse):
    """Title, model and kinds of elements and joints from a file that someone sends."""
    made = frames()
    made.title, made.joints.kind, made.elements.kind = HOSTILE[0], ["$\\frac{$", "_x",
                                                                    "y" * 10**5], ["ground", "$a$", "x" * 10**5]
    made.summary = made.summary.changed(model="$\\sqrt{$")
    recorded.save(tmp_path / recorded.NAME, made)
    for path in all_pictures.write(tmp_path):
        assert path.suffix != ".png" or image.imread(path).ndim == 3


def test_pictures_of_a_run_that_has_not_ended(tmp_path, coarse):
    """No curves, no sentence; and the pictures may go elsewhere."""
    recorded.save(tmp_path / recorded.NAME, frames(ended=False, shaken=False))
    (tmp_path / "out").mkdir()
    written = all_pictures.write(tmp_path / "out", tmp_path / recorded.NAME)
    assert {path.name for path in written} == {"end_state.png", "front.png", "side.png", "player.html"}


def test_far_wreckage_does_not_shrink_the_house():
    start = [cube((0, 0, 0.5))]
    left, right, _, _ = views.box_of(FRONT, start, [[cube((0, 100, 0.5))]])
    assert -0.5 - views.BORDER - views.GRID < left <= -0.5 - views.BORDER
    assert 0 <= right - (0.5 + views.FAR + views.BORDER) < views.GRID


@pytest.mark.parametrize("count, strays", [(5, 1), (200, 4)])
def test_strays_do_not_move_the_frame(count, strays):
    """One member of a small frame, and 2 % of those of a house, up to 100 m away and up; one more moves it."""
    start = [cube((0, 0.1 * k, 0.5)) for k in range(count)]
    house = views.box_of(FRONT, start, [start])
    far = [cube((0, 100.0, 100.0)) for _ in range(strays)]
    assert views.box_of(FRONT, start, [start[strays:] + far]) == house
    assert views.box_of(FRONT, start, [start[strays + 1:] + far + far[:1]])[1] > house[1]
