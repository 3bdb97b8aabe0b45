# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player in a browser: it shows the recorded data, fits a phone, plays, and records a film."""
import re

import frames_sample
import numpy as np
import pytest
from browser import errors, picture, wait
from player_page import (LYING_PHONE, MIDDLE, PHONE, ROOF_IS_DARK, WIDE, ask, at_rest, between, click, load, pixels,
                         press, reshape, roof_is_drawn)
from timber_houses.pictures import key_times, player
from timber_houses.recording.record import placed

pytest_plugins = ["player_fixtures"]

HEAD, FOOT = [0, 0, 1.1], [0, 0, -1.1]
"""Points of a column near its ends, in its body frame. [m]"""


def is_wood(color):
    """Whether red is well above blue: neither sky nor ground, roof or foundation."""
    return color[0] - color[2] > 0.2


def recorded(run, name, time, point=(0, 0, 0)):
    """Where a point of an element is at the time of a frame. [m]"""
    k, frame = run.elements.name.index(name), run.at(time)
    return placed([point], run.position[frame, k], run.orientation[frame, k])[0]


def test_the_page_shows_what_the_data_say(still, pages):
    run = pages[2][0]
    for time in (0.0, 1.5, 2.5125, 2.987, 4.0):
        ask(still, f"player.seek({time})")
        for name in ("roof", "column.NE", "base"):
            assert ask(still, f"player.position('{name}')") == pytest.approx(between(run, name, time), abs=1e-3)
    for time in (2.3, 2.65, 2.95):
        ask(still, f"player.seek({time})")
        assert ask(still, f"player.position('column.NE', 0, {HEAD})") == pytest.approx(
            recorded(run, "column.NE", time, HEAD), abs=1e-3)


def test_the_house_is_drawn_where_the_data_say(still):
    ask(still, "player.seek(0)")
    where = ask(still, "player.screen('roof')")
    assert roof_is_drawn(still, 0)
    north, south = (ask(still, f"player.screen('column.{side}')") for side in ("NE", "SE"))
    assert north["x"] > where["x"] > south["x"] and where["y"] < north["y"]  # from the east
    ask(still, "player.seek(2.65)")
    head, foot, roof = pixels(still, ("column.NE", 0, HEAD), ("column.NE", 0, FOOT), ("roof", 0, MIDDLE))
    assert is_wood(head) and is_wood(foot) and roof.max() < ROOF_IS_DARK  # moved and turned as it should be
    ask(still, "player.seek(4)")
    assert picture(still)[round(where["y"]), round(where["x"])].max() > 0.7  # it is there no more
    press(still, "2")
    wait(lambda: ask(still, "player.screen('column.NE').x < player.screen('column.NW').x"))  # from the north
    assert errors(still) == []


def test_broken_joints_are_marked(still):
    """Orange crosses at the columns' ends, which are not there without joints."""
    box = ask(still, "document.querySelector('canvas.view').getBoundingClientRect().toJSON()")

    def orange():
        stage = picture(still)[int(box["top"]) : int(box["bottom"]), : int(box["right"]) - 60]  # without the compass
        red, green, blue = np.moveaxis(stage, -1, 0)
        return int(((red > 0.75) & (green > 0.3) & (green < 0.45) & (blue < 0.15)).sum())

    ask(still, "player.seek(1)")
    assert orange() == 0
    ask(still, "player.seek(4)")
    marked = orange()
    press(still, "j")
    wait(lambda: orange() == 0)
    assert marked > 50  # 7 crosses
    press(still, "j")


def test_the_ground_moves_or_stands_still(still):
    """A quarter of a second into a swing of 20 cm to the east, seen from the north: to the left."""
    ask(still, "document.getElementById('camera-side').click()")
    ask(still, "player.seek(1.25)")
    moved = ask(still, "player.screen('base')")["x"]
    press(still, "g")
    wait(lambda: ask(still, "player.screen('base')")["x"] - moved > 3)
    assert ask(still, "player.position('base')") == pytest.approx([5, -3, 0.15], abs=1e-3)
    press(still, "g")


def check_fits(driver):
    """Nothing is wider than the phone, and the controls stay in sight."""
    assert ask(driver, "document.documentElement.scrollWidth") <= PHONE[0]
    box = ask(driver, "document.getElementById('transport').getBoundingClientRect().toJSON()")
    assert box["left"] >= 0 and box["right"] <= PHONE[0] and box["bottom"] <= PHONE[1] + 1
    outside = ("[...document.querySelectorAll('#transport *')]"
               ".filter((e) => e.getBoundingClientRect().right > innerWidth + 1).length")
    assert ask(driver, outside) == 0


def test_it_fits_a_phone(still):
    reshape(still, PHONE, phone=True)
    check_fits(still)
    wait(lambda: roof_is_drawn(still, 0))
    small = ("[...document.querySelectorAll('#transport button, #transport select')]"
             ".filter((e) => e.checkVisibility() && e.getBoundingClientRect().height < 36).length")
    for _ in ("menu closed", "menu open"):
        assert ask(still, small) == 0
        ask(still, "void document.querySelector('#more summary').click()")
        check_fits(still)


def test_the_state_is_in_sight_on_a_lying_phone(still):
    """A long result takes two lines; the line with the state is not below the controls."""
    reshape(still, LYING_PHONE, phone=True)
    ask(still, "scrollTo(0, 0)")
    before = ask(still, "document.querySelector('.result').textContent")
    ask(still, "void (document.querySelector('.result').textContent = 'a long result '.repeat(15))")
    now, controls = (ask(still, f"document.querySelector('{name}').getBoundingClientRect().toJSON()")
                     for name in (".now", "#transport"))
    assert now["top"] >= 0 and now["bottom"] <= controls["top"] and controls["bottom"] <= LYING_PHONE[1] + 1
    ask(still, f"void (document.querySelector('.result').textContent = {before!r})")


def box(driver, selector):
    return ask(driver, f"document.querySelector('{selector}').getBoundingClientRect().toJSON()")


def test_card_menu_event_and_help_are_in_sight_on_a_lying_phone(still):
    reshape(still, LYING_PHONE, phone=True)
    ask(still, "scrollTo(0, 0)")
    ask(still, "player.seek(2.9)")
    place = ask(still, "player.screen('roof')")
    click(still, place)
    controls, card = box(still, "#transport"), wait(lambda: (found := box(still, ".card"))["height"] and found)
    assert card["top"] >= box(still, ".stage")["top"] and card["bottom"] <= controls["top"]
    line, event = box(still, "#ticks"), box(still, "#event")
    assert ask(still, "document.getElementById('event').textContent") != ""
    assert line["left"] - 1 <= event["left"] and event["right"] <= line["right"] + 1
    ask(still, "void document.querySelector('#more summary').click()")
    menu = box(still, ".menu")
    assert 0 <= menu["top"]
    assert menu["bottom"] <= controls["bottom"]
    assert ask(still, "(m => m.scrollHeight <= m.clientHeight + 1)(document.querySelector('.menu'))")
    press(still, "?")
    assert ask(still, "document.getElementById('help').open && document.getElementById('help').scrollTop") == 0
    assert errors(still) == []
    still.find_element("css selector", "#help form button").click()


def test_labels_of_the_drift_limits_are_in_order(still):
    """From the top down 1/10, 1/30, 1/120, apart by the height of a letter; recorded while the curves are drawn again.
    """
    ask(
        still, """(() => {
        window.labels = {};
        const draw = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            labels[text] = y;
            draw.call(this, text, x, y);
        };
    })()""")
    reshape(still, (1280, 800))
    high, middle, low = wait(
        lambda: ask(still, "'1/120' in labels && [labels['1/10'], labels['1/30'], labels['1/120']]"))
    assert high > 0 and middle - high >= 9 and low - middle >= 9


def test_full_screen(still):
    for shown in (True, False):
        press(still, "f")
        wait(lambda: ask(still, "!!document.fullscreenElement") == shown)
    assert errors(still) == []


def test_the_page_speaks_japanese(still):
    english = still.find_element("class name", "now").text
    ask(still, "player.speak('ja')")
    ask(still, "player.seek(1.4)")
    assert "層間変形角" in still.find_element("class name", "now").text
    assert "できごと" in still.find_element("class name", "event-list").get_attribute("textContent")
    assert still.find_element("id", "camera-front").text == "正面" and ask(still, "document.documentElement.lang") == "ja"
    names = ask(
        still,
        "[...document.querySelectorAll('[aria-label]')].filter((e) => e.offsetParent).map((e) => "
        "e.getAttribute('aria-label'))"
    )
    assert [name for name in names if not re.search("[\u3040-\u9fff]", name)] == []
    ask(still, "player.speak('en')")
    ask(still, "player.seek(1.5)")
    assert still.find_element("class name", "now").text == english
    assert still.find_element("id", "camera-front").text == "Front"


def test_things_for_scale_are_drawn(still):
    """Glass walls, the house at the start and a person change the picture, and leave it when they are switched off."""
    ask(still, "player.seek(3.5)")
    before = picture(still)
    for name in ("walls", "ghost", "person"):
        ask(still, f"void document.getElementById('{name}').click()")
        wait(lambda: (abs(picture(still) - before) > 0.02).sum() > 100)
        ask(still, f"void document.getElementById('{name}').click()")
        wait(lambda: (abs(picture(still) - before) > 0.02).sum() == 0)
    assert errors(still) == []


def test_it_plays_slowly_around_the_main_event(still, pages):
    ask(still, "player.seek(0.5)")
    assert ask(still, "player.pace") == 1
    ask(still, "void document.getElementById('slow').click()")
    main = player.main_event(pages[2][0])
    ask(still, f"player.seek({main})")
    assert ask(still, "player.pace") == 0.25


def test_a_film_is_recorded(still, tmp_path):
    """A click starts it, a second one ends it and saves a WebM file."""
    still.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    ask(still, "player.seek(3)")
    ask(still, "void document.getElementById('film').click()")
    wait(lambda: ask(still, "player.time > 3.5"))
    ask(still, "void document.getElementById('film').click()")
    (film,) = wait(lambda: [path for path in tmp_path.glob("*.webm") if path.stat().st_size])
    assert film.read_bytes()[:4] == b"\x1aE\xdf\xa3" and not ask(still, "player.playing")  # EBML
    assert errors(still) == []


@pytest.mark.parametrize("number", [0, 1])
def test_the_house_has_most_of_the_window(driver, pages, number):
    at_rest(driver, pages[number])
    for size, share in (((1280, 800), 0.55), ((1920, 1080), 0.6)):
        reshape(driver, size)
        boxes = ask(driver, "[...document.querySelectorAll('.stage')].map((e) => e.clientWidth * e.clientHeight)")
        assert sum(boxes) > share * size[0] * size[1]


def test_two_runs_in_step(two, pages):
    for time in (2.5, 2.875, 3.6):
        ask(two, f"player.seek({time})")
        for k, run in enumerate(pages[2]):
            assert ask(two, f"player.position('roof', {k})") == pytest.approx(between(run, "roof", time), abs=1e-3)
    whole = "[...document.querySelectorAll('.origin')].every((e) => e.textContent && e.scrollWidth <= e.clientWidth)"
    assert ask(two, whole)
    assert [place.text.startswith("recorded up to 3.0 s: ")
            for place in two.find_elements("class name", "now")] == [False, True]
    ask(two, "player.seek(1)")
    first, second = (ask(two, f"player.screen('roof', {k})") for k in (0, 1))
    assert second["x"] - first["x"] == pytest.approx(WIDE[0] / 2, abs=5)
    assert second["y"] == pytest.approx(first["y"], abs=1)
    assert roof_is_drawn(two, 0, 1)

    reshape(two, PHONE, phone=True)
    check_fits(two)
    assert ask(two, whole)
    first, second = (ask(two, f"player.screen('roof', {k})") for k in (0, 1))
    assert second["y"] - first["y"] > 100 and second["x"] == pytest.approx(first["x"], abs=1)  # one above the other
    assert second["y"] < ask(two, "document.getElementById('transport').getBoundingClientRect().top")
    assert errors(two) == []


def test_the_current_event_is_marked_and_in_view(two, pages):
    """Of a list that is higher than its place, too."""
    for time in (1.2, 2.95):
        ask(two, f"player.seek({time})")
        past = [event["text"] for event in player.events(pages[2][0]) if event["time"] <= time]
        current = two.find_element("css selector", ".run .events [aria-current]")
        assert current.text.endswith(past[-1])
        assert len(two.find_elements("css selector", ".run:first-child .events [aria-current]")) == 1
        box, place = (ask(two, f"document.querySelector('.run {name}').getBoundingClientRect().toJSON()")
                      for name in (".events [aria-current]", ".event-list"))
        assert place["top"] <= box["top"] and box["bottom"] <= place["bottom"]


def test_it_plays_by_itself(driver, pages):
    load(driver, pages[0], PHONE, motion=True)
    assert ask(driver, "player.playing || player.time > 0")
    assert errors(driver) == []


def test_it_opens_before_an_event_that_is_earlier_than_the_shaking(driver, tmp_path):
    """It does not play when the user wants no motion."""
    run = frames_sample.run()
    run.motion.start = 3.0
    first = min(event["time"] for event in player.events(run))
    player.make([("x", run)], tmp_path / "x.html")
    load(driver, (tmp_path / "x.html").as_uri(), PHONE, motion=False)
    assert not ask(driver, "player.playing")
    assert ask(driver, "player.time") == pytest.approx(max(0, first - 2), abs=1e-3)
    assert first < key_times.onset(run.motion)


def test_wall_sheets_are_counted_apart(driver, tmp_path):
    page = player.make([("walled", frames_sample.walled_run())], tmp_path / "walled.html")
    load(driver, f"file://{page}#t=2.45", motion=False)
    now = driver.find_element("class name", "now")
    assert now.text.endswith("0 of 2 joints and 2 of 3 wall sheets broken, 1 partly")
    ask(driver, "player.seek(2.65)")
    assert now.text.endswith("1 of 2 joints and 3 of 3 wall sheets broken")
    assert "wall partly broken" in driver.find_element("tag name", "body").text
    assert "joint or wall broken" in driver.find_element("tag name", "body").text
    assert driver.find_element("class name", "result").text.count("2 of 2 joints and 3 of 3 wall sheets broken") == 1
    assert errors(driver) == []


def test_a_drift_beyond_the_scale_is_drawn_at_the_border(still):
    """The drift N-S after the fall is 1.3, the largest of the scale 1/5: its colour is in the first rows of pixels, and
    grey, of which all channels are within 20, is not enough.
    """
    spreads = ask(still, """(() => {
        const canvas = document.querySelector('figure.drift canvas');
        const rgba = canvas.getContext('2d').getImageData(Math.round(0.9 * canvas.width), 0, 1, 3).data;
        return [0, 4, 8].map((k) => rgba.slice(k, k + 3)).map((rgb) => Math.max(...rgb) - Math.min(...rgb));
    })()""")
    assert max(spreads) > 60


def test_stages_of_a_comparison_have_one_size(driver, tmp_path):
    """But for the line between them, also where one title is longer than its panel."""
    short, long = frames_sample.run(name="A"), frames_sample.run(name="B" + " with a title of many words" * 4)
    page = player.make([("a", short), ("b", long)], tmp_path / "two.html")
    load(driver, f"file://{page}#t=1", motion=False)
    for size, phone in ((WIDE, False), (PHONE, True)):
        reshape(driver, size, phone)
        boxes = "[...document.querySelectorAll('.stage')].map((e) => [e.clientWidth, e.clientHeight])"
        first, second = ask(driver, boxes)
        assert first == pytest.approx(second, abs=4) and min(first) > 100
