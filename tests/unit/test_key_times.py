# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Key times of a run: named ones, frames chosen by their motion, no two alike. Needs no YADE."""
import numpy as np
import pytest
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from small_frames import frames
from timber_houses.pictures import key_times, report_pictures, sheets
from timber_houses.pictures.views import FRONT
from timber_houses.recording.events import Event, StructureFallen


def test_named_times():
    """The box moves between 1 s and 2 s. The collapse at 2 s looks like the end; the strongest shaking at 1.2 s is
    CLOSE to a tilt at 1.6 s.
    """
    made = frames()
    made.summary = made.summary.changed(tilt_time_s=1.75)
    found = {chosen.reason: made.time[chosen.frame] for chosen in key_times.choose(made)}
    assert {"start", "drift 1/10", "strongest shaking", "end"} <= set(found)
    assert (found["start"], found["strongest shaking"], found["drift 1/10"], found["end"]) == pytest.approx(
        (0, 1.2, 1.75, 3))
    assert "collapse" not in found
    made.summary = made.summary.changed(tilt_time_s=1.6)
    assert "strongest shaking" not in [chosen.reason for chosen in key_times.choose(made)]


def test_recorded_events_are_named():
    made = frames()
    made.summary = made.summary.changed(tilt_time_s=None, events=[Event(1.8, StructureFallen("porch"))])
    assert 1.8 in [made.time[chosen.frame] for chosen in key_times.choose(made) if chosen.reason == "porch has fallen"]


def test_frames_chosen_by_their_motion():
    """Without names: all times but the ends lie in the second of motion, apart in time and in position."""
    made = frames(ended=False, shaken=False)
    times = [made.time[chosen.frame] for chosen in key_times.choose(made)]
    assert (times[0], times[-1]) == (0, 3) and len(times) >= 3 and all(1 < t < 2 for t in times[1:-1])
    assert np.diff(times).min() >= key_times.CLOSE


def test_each_panel_says_what_it_shows():
    """Frames chosen by their motion have the state of the house: its drift, after a collapse that, without a history
    the number of broken joints.
    """
    made = frames()
    assert all(chosen.reason for chosen in key_times.choose(made))
    assert [key_times.state(made, frame)
            for frame in (10, 30, 40)] == ["drift below 1/1000", "drift 1/4", "after the collapse"]
    assert key_times.state(frames(ended=False), 40) == "1 broken joint"


@pytest.mark.parametrize("form", [sheets.PRINT, sheets.SCREEN, report_pictures.SHOTS, sheets.Format(3.6, 6.0, 100, 6)])
def test_titles_fit_their_panels(form):
    """Whole, and no wider than the panel and the gap beside it."""
    made = frames()
    made.summary = made.summary.changed(tilt_time_s=None, events=[Event(1.8, StructureFallen("entrance"))])
    figure = sheets.Stills(made).sheet(FRONT, form)
    figure.canvas.draw()
    frames_of_panels = [artist for artist in figure.artists if isinstance(artist, Rectangle)]
    titles = [artist for artist in figure.artists if isinstance(artist, Text) and " s:" in artist.get_text()]
    assert len(titles) == len(frames_of_panels) >= 3
    for title, panel in zip(titles, frames_of_panels):
        assert "…" not in title.get_text()
        assert title.get_window_extent().width <= panel.get_window_extent().width + sheets.GAP * figure.dpi


def test_no_panel_repeats_another():
    """A house that does not move has a start and an end; one that moves by less than DIFFERENT counts as at rest."""
    made = frames(ended=False, shaken=False)
    for motion in (0, 0.9 * key_times.DIFFERENT):
        made.position = np.zeros((len(made.time), 3, 3))
        made.position[:, :, 0] = motion * np.sin(made.time)[:, None]
        assert [chosen.reason for chosen in key_times.choose(made)] == ["start", "so far, no visible change"]
    made.position[:, :, 0] = 3 * key_times.DIFFERENT * np.sin(made.time)[:, None]
    assert len(key_times.choose(made)) > 2


@pytest.mark.parametrize("count, reasons", [(1, ["start"]), (2, ["start", "so far, no visible change"])])
def test_short_runs(count, reasons):
    made = frames(ended=False, shaken=False)
    made.time, made.position = made.time[:count], made.position[:count]
    assert [chosen.reason for chosen in key_times.choose(made)] == reasons
