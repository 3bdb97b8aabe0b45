# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Films: the right picture at the right time, shadows, captions, both formats; and the script's messages. Needs no
YADE.
"""
import shutil
import subprocess
import warnings
from pathlib import Path

import frames_sample
import in_process
import numpy as np
import pytest
from PIL import Image
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.house import build_house, load_house
from timber_houses.pictures import camera, caption, film, fonts, key_times, provenance, stage
from timber_houses.recording import frames

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "show" / "make_film.py"
SMALL = film.Format(width=320, height=180, rate=10)


def test_slerp_is_the_shorter_arc():
    """A third of the way between turns of 0.2 and 1.1 rad about z is 0.5 rad, whatever the sign of the second
    quaternion.
    """
    def turned(angle):
        return np.array([[np.cos(angle / 2), 0, 0, np.sin(angle / 2)]])

    for sign in (1, -1):
        assert stage.slerp(turned(0.2), sign * turned(1.1), 1 / 3) == pytest.approx(turned(0.5), abs=1e-12)
    assert stage.slerp(turned(0.2), turned(0.2), 0.7) == pytest.approx(turned(0.2), abs=1e-12)


def test_placements_between_frames():
    run = frames_sample.run()
    roof, k = run.elements.name.index("roof"), run.at(2.5)
    position, orientation = stage.placements(run, 0.25 * run.time[k] + 0.75 * run.time[k + 1])
    assert position[roof] == pytest.approx(0.25 * run.position[k, roof] + 0.75 * run.position[k + 1, roof], abs=1e-9)
    assert np.linalg.norm(orientation, axis=1) == pytest.approx(np.ones(len(orientation)), abs=1e-12)
    for time, frame in ((-1.0, 0), (99.0, -1)):
        assert stage.placements(run, time)[0] == pytest.approx(np.asarray(run.position[frame], float))


def seen(view, point, size):
    """(row, column) of a point (3,) in a picture of (width, height)."""
    x, y, _, w = view.matrix @ np.append(point, 1.0)
    return round((0.5 - 0.5 * y / w) * size[1]), round((0.5 + 0.5 * x / w) * size[0])


@pytest.mark.parametrize("name", list(camera.CAMERAS))
def test_the_whole_house_is_in_the_picture(name):
    points = stage.corners(frames_sample.run())
    view = camera.look(name, points, 16 / 9)
    clip = np.c_[points, np.ones(len(points))] @ view.matrix.T
    across, up = clip[:, 0] / clip[:, 3], clip[:, 1] / clip[:, 3]
    most = max(abs(across).max(), abs(up).max())
    assert most == pytest.approx(1 / camera.SPARE, rel=0.02)  # the camera is as near as the margin permits


def test_the_roof_is_where_it_should_be_and_throws_a_shadow():
    """The middle of the roof has the roof's dark grey. The ground is darker where a ray to the sun meets the roof."""
    run, size = frames_sample.run(), (640, 360)
    run.motion = None
    points = stage.corners(run)
    view, (matrix, light) = camera.look("space", points, size[0] / size[1]), camera.sun(points)
    picture = np.asarray(stage.Stage(run, size, view, (matrix, light)).picture(0.0)).astype(int)
    e = run.elements
    top = e.position[e.name.index("roof")] + (0, 0, 0.1)
    assert picture[seen(view, top, size)].max() < 130
    shaded = e.position[e.name.index("roof")] - (0, 0, 0.1)
    shaded = shaded - light * shaded[2] / light[2] + (-1.2, 0, 0)  # on the ground, outside the foundation
    lit = top + (3.5, -5.0, 0)
    lit[2] = 0.0
    dark, bright = picture[seen(view, shaded, size)], picture[seen(view, lit, size)]
    assert (dark < 0.85 * bright).all() and bright.min() > 150


def test_the_ground_moves():
    """The picture is displaced to the right by a displacement to the north, seen from the east."""
    run, size = frames_sample.run(), (320, 180)
    run.motion.displacement[:] = (0.0, 1.0, 0.0)
    points = stage.corners(run)
    view = camera.look("front", points, size[0] / size[1])
    moved = np.array(stage.Stage(run, size, view, camera.sun(points)).picture(0.5))
    run.motion.displacement[:] = 0.0
    still = np.array(stage.Stage(run, size, view, camera.sun(points)).picture(0.5))
    columns = [np.flatnonzero((picture.max(2) < 110).any(0)).mean() for picture in (still, moved)]
    far, near = (seen(view, corner + (0, 1, 0), size)[1] - seen(view, corner, size)[1]
                 for corner in (points[points[:, 0].argmin()], points[points[:, 0].argmax()]))
    assert far - 1 <= columns[1] - columns[0] <= near + 1  # perspective; whole pixels


@pytest.mark.parametrize("size", [(1920, 1080), (640, 370)])
def test_a_house_fills_at_least_half_of_the_height(size):
    """House A at the start, beside another one, seen from the north-east."""
    stage = film.Pictures([frames_sample.run()] * 2, "space", film.Format(*size)).stages[0]
    points = np.concatenate(
        [element.vertices for element in build_house(load_house("A")).elements if element.kind != "ground"])
    rows = [seen(camera.look("space", points, stage.canvas.size[0] / stage.canvas.size[1]), point, stage.canvas.size)[0]
            for point in points]
    assert 0 < min(rows) and max(rows) < stage.canvas.size[1] and max(rows) - min(rows) > size[1] / 2


def test_captions_state_what_an_owner_sees():
    words = caption.Caption(frames_sample.run(), (640, 360))
    assert words.state(1.3) == "storey drift 1/53"
    assert words.state(3.9) == "4 of 4 columns fallen, 7 of 8 joints broken"


def test_a_house_that_leans_too_far_has_no_drift():
    run = frames_sample.run()
    words = caption.Caption(run, (640, 360))
    words.drifts = np.full_like(words.drifts, 0.63)
    assert words.state(1.5) == "leaning by more than 1/10"


def test_captions_count_wall_sheets_apart():
    words = caption.Caption(frames_sample.walled_run(), (640, 360))
    assert words.state(2.45).endswith("0 of 2 joints and 2 of 3 wall sheets broken")  # of the third sheet one joint
    assert words.state(3.9).endswith("2 of 2 joints and 3 of 3 wall sheets broken")


def test_the_origin_stands_once_for_both_runs_of_the_same_load():
    runs, other = [frames_sample.run(name="A"), frames_sample.run(name="B")], frames_sample.run(name="C")
    other.version = "another"
    assert len(film.Pictures(runs, "space", SMALL).strips) == 1
    assert len(film.Pictures([runs[0], other], "space", SMALL).strips) == 2


def test_real_time_until_the_fall_then_slower():
    run = frames_sample.run()
    fall = run.summary.collapse_time_s
    steps = np.diff(film.picture_times([run], SMALL, 0.0, run.time[-1]))
    times = film.picture_times([run], SMALL, 0.0, run.time[-1])[:-1]
    slow = [fall - film.BEFORE_FALL <= time < fall + film.AFTER_FALL for time in times]
    assert steps == pytest.approx(np.where(slow, film.SLOW, 1.0) / SMALL.rate) and any(slow) and not all(slow)


def test_webp_has_every_picture_and_holds_the_last(tmp_path):
    """Each decoded picture is that of a file with the rendered picture alone: nothing stays of the pictures before."""
    run, times = frames_sample.run(), np.arange(1.0, 2.95, 0.1)
    form = film.Format(width=320, height=180, rate=10, speed=1.0, quality=36)
    count = film.write(tmp_path / "x.webp", [run], "front", form, 1.0, 3.0)
    made = Image.open(tmp_path / "x.webp")
    assert count == made.n_frames == 20 and made.size == (320, 180)
    for number, image in enumerate(map(film.Pictures([run], "front", form).at, times)):
        made.seek(number)
        made.load()
        assert made.info["duration"] == 100 + 2000 * (number == 19)
        image.save(tmp_path / "alone.webp", quality=form.quality, method=film.WEBP["method"])
        alone = np.asarray(Image.open(tmp_path / "alone.webp").convert("RGB"), int)
        assert abs(np.asarray(made.convert("RGB")) - alone).max() <= 1


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is missing (package ffmpeg)")
def test_mp4_of_two_runs_at_a_quarter_of_the_speed(tmp_path):
    """0.5 s of simulated time at 0.25 and 10 pictures per second: 20 pictures of two halves, and 20 of the end."""
    runs = [frames_sample.run(name="A"), frames_sample.run(name="B", until=3.0)]
    form = film.Format(width=320, height=180, rate=10, speed=0.25)
    assert film.write(tmp_path / "x.mp4", runs, "space", form, 2.5, 3.0) == 20
    words = ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames", "-of",
             "csv=p=0", str(tmp_path / "x.mp4")]
    assert subprocess.run(words, capture_output=True, text=True).stdout.strip() == "320,180,40"


def test_a_film_begins_shortly_before_the_shaking():
    run = frames_sample.run()
    assert 0 <= key_times.first_shown(run) <= key_times.onset(run.motion)


def test_a_film_that_ends_before_the_shaking_begins_at_the_start(tmp_path, monkeypatch):
    monkeypatch.setattr(film, "first_shown", lambda run: 2.0)
    assert film.write(tmp_path / "x.webp", [frames_sample.run()], form=SMALL, end=1.0) == 10


def test_films_that_cannot_be_made(tmp_path):
    run = frames_sample.run()
    with pytest.raises(RunError, match="no pictures"):
        film.write(tmp_path / "x.webp", [run], begin=3.0, end=2.0)
    with pytest.raises(RunError, match="more than 36000"):
        film.write(tmp_path / "x.webp", [run], form=film.Format(rate=100, speed=0.01), begin=0.0, end=4.0)
    assert not list(tmp_path.iterdir())


def test_script(tmp_path):
    frames_sample.write(tmp_path / frames.NAME)
    done = in_process.run(SCRIPT, tmp_path, "--size", "160x90", "--rate", 5, "--start", 1, "--end", 2, "--out",
                          tmp_path / "x.webp")
    assert done.returncode == 0 and "5 pictures" in done.stdout and (tmp_path / "x.webp").exists()
    wrong = [("--speed", "0", "0.01 to 20"), ("--size", "10x10", "64 to 4096"), ("--out", "x.gif", ".mp4 or .webp"),
             ("--end", "0", "no pictures")]
    for *words, said in wrong:
        done = in_process.run(SCRIPT, tmp_path, *words)
        assert done.returncode == 1 and said in done.stderr and done.stderr.count("\n") == 1


def test_origin_names_record_peak_step_and_versions():
    run = frames_sample.run()
    run.summary = sample_summary(dt=2.5e-4, record={"source": "kobe.csv", "scale": 0.5}, versions={"yade": "2023.02a"})
    run.version = "9.9"
    text = provenance.provenance(run)
    peak = np.abs(run.motion.acceleration).max() * 100
    for part in ("Record kobe.csv x 0.5", f"PGA {peak:.0f} gal", "JMA intensity", "time step 0.00025 s",
                 "yade-timber 9.9, YADE 2023.02a"):
        assert part in text


def test_a_letter_without_a_font_gives_one_notice(capsys, monkeypatch):
    monkeypatch.setattr(fonts, "east_asian", lambda: None)
    monkeypatch.setattr(fonts, "_missed", set())
    assert not fonts.has("木") and not fonts.has("造") and fonts.has("A")
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.skipif(not fonts.east_asian(), reason=f"no Japanese font is installed (package {fonts.PACKAGE})")
def test_japanese_names_are_drawn(tmp_path):
    """Ink where a missing letter would leave an empty box, of which matplotlib warns; the PDF embeds TrueType outlines.
    """
    from timber_houses.pictures import figures, report

    def sheet():
        figure = figures.new_figure(4, 2, 100)
        figures.heading(figure, "木造住宅", "耐震")
        return figure

    figure = sheet()
    assert figures.drawable("木造住宅") == "木造住宅"
    written = figures.save(figure, tmp_path / "x", ("png", "pdf"))
    content = written[1].read_bytes()
    assert b"/Subtype /Type3" not in content and b"/FontFile2" in content
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report.picture(sheet())
    assert "IPA" in fonts.best_file("木造 A") or fonts.best_file("木造 A") != fonts.best_file("A")
