# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player obeys keys, mouse and touch; its controls have names, and it uses no network."""
from time import sleep

import frames_sample
import numpy as np
import pytest
from browser import errors, wait
from player_page import PHONE, ask, click, load, press, reshape
from timber_houses.pictures import player

pytest_plugins = ["player_fixtures"]


def test_keys(still):
    from selenium.webdriver.common.keys import Keys

    for key, time in ((Keys.END, 4.0), (Keys.HOME, 0.0), (Keys.ARROW_RIGHT, 0.5), (".", 0.55), (",", 0.5),
                      (Keys.ARROW_LEFT, 0.0)):
        press(still, key)
        assert ask(still, "player.time") == pytest.approx(time), key
    press(still, Keys.PAGE_DOWN)  # the next event
    assert ask(still, "player.time") > 0
    press(still, " ")
    wait(lambda: ask(still, "document.getElementById('play').getAttribute('aria-label')") == "Pause")
    wait(lambda: ask(still, "player.time") > 1.1)
    press(still, " ")
    assert not ask(still, "player.playing")
    for key, name in (("3", "free"), ("1", "front"), ("2", "side"), ("c", "free"), ("c", "front")):
        press(still, key)
        wait(lambda: ask(still, f"document.getElementById('camera-{name}').getAttribute('aria-pressed')") == "true")
    press(still, "?")
    assert ask(still, "document.getElementById('help').open")
    press(still, Keys.ESCAPE)
    assert not ask(still, "document.getElementById('help').open")
    press(still, "?")
    still.find_element("css selector", "#help form button").click()
    assert not ask(still, "document.getElementById('help').open")
    assert errors(still) == []


def test_space_plays_after_a_click_and_presses_a_button_reached_by_tab(still):
    from selenium.webdriver.common.keys import Keys

    side, front = (still.find_element("id", f"camera-{name}") for name in ("side", "front"))
    side.click()
    wait(lambda: side.get_attribute("aria-pressed") == "true")
    press(still, "1")
    wait(lambda: front.get_attribute("aria-pressed") == "true")
    press(still, " ")
    assert ask(still, "player.playing") and front.get_attribute("aria-pressed") == "true"
    press(still, " ")
    assert not ask(still, "player.playing")
    ask(still, "document.getElementById('camera-front').focus()")
    press(still, Keys.TAB, " ")
    wait(lambda: side.get_attribute("aria-pressed") == "true")
    assert not ask(still, "player.playing")


def test_space_opens_the_menu_reached_by_tab(still):
    from selenium.webdriver.common.keys import Keys

    ask(still, "document.getElementById('camera-free').focus()")
    press(still, Keys.TAB, " ")
    assert ask(still, "document.getElementById('more').open") and not ask(still, "player.playing")
    press(still, " ")
    assert not ask(still, "document.getElementById('more').open")


def test_a_click_keeps_the_camera(still):
    """A press is no movement; a drag makes the camera free."""
    press(still, "1")
    front = still.find_element("id", "camera-front")
    wait(lambda: front.get_attribute("aria-pressed") == "true")
    place = ask(still, "player.screen('roof')")
    click(still, place)
    assert front.get_attribute("aria-pressed") == "true"
    assert "east" in still.find_element("class name", "camera-name").text
    for kind, shift in (("mousePressed", 0), ("mouseMoved", 30), ("mouseMoved", 60), ("mouseReleased", 60)):
        still.execute_cdp_cmd(
            "Input.dispatchMouseEvent",
            {"type": kind, "button": "left", "buttons": 1, "clickCount": 1, "x": place["x"] + shift, "y": place["y"]})
    wait(lambda: front.get_attribute("aria-pressed") == "false")


def test_keys_turn_the_house(still):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    ask(still, "player.seek(0)")
    before, middle = ask(still, "player.screen('column.NE')"), ask(still, "player.screen('roof')")
    ActionChains(still).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(Keys.SHIFT).perform()
    wait(lambda: abs(ask(still, "player.screen('column.NE')")["x"] - before["x"]) > 3)
    assert ask(still, "player.screen('roof')")["x"] == pytest.approx(
        middle["x"], abs=15)  # about its middle: the wreck lies farther north
    assert ask(still, "player.time") == 0


def test_curves_events_and_slider_go_to_a_time(still):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By

    curves = still.find_element(By.CLASS_NAME, "curves")
    left, width = 42, curves.size["width"]
    ActionChains(still).move_to_element_with_offset(curves, round(left + 0.75 * (width - left) - width / 2),
                                                    0).click().perform()
    assert ask(still, "player.time") == pytest.approx(3.0, abs=0.02)
    events = still.find_elements(By.CSS_SELECTOR, ".events button")
    events[-1].click()
    assert ask(still, "player.time") == pytest.approx(2.9)
    assert "collapse" in events[-1].text
    wait(lambda: "past" in events[-1].get_attribute("class"))
    ask(still, "(e => { e.value = 0.8; e.dispatchEvent(new Event('input')); })(document.getElementById('scrub'))")
    assert ask(still, "player.time") == pytest.approx(0.8)
    wait(lambda: still.find_element(By.CLASS_NAME, "now").text.startswith("storey drift 1/"))
    assert "collapsed at 2.9 s" in still.find_element(By.CLASS_NAME, "result").text


def test_events_are_marked_on_the_time_line(still, pages):
    """A mark for each event, with its text; the text of the last event stands there for a while."""
    events = player.events(pages[2][0])
    marks = still.find_elements("css selector", "#ticks i")
    assert [mark.get_attribute("title").split(" s ", 1)[1] for mark in marks] == [event["text"] for event in events]
    marks[-1].click()
    assert ask(still, "player.time") == pytest.approx(events[-1]["time"])
    shown = still.find_element("id", "event")
    wait(lambda: shown.text == events[-1]["text"])
    ask(still, "player.seek(0)")
    wait(lambda: shown.text == "")


def test_every_control_has_a_name_and_no_network_is_used(still):
    nameless = """[...document.querySelectorAll('button, input, select, canvas.view')].filter(
        (e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.[0]?.textContent.trim())).length"""
    assert ask(still, nameless) == 0
    assert ask(still, "performance.getEntriesByType('resource').length") == 0


def touch(driver, *path):
    """A finger along points (x, y) of the page [pixel], by the browser's own events."""
    points = [[{"x": x, "y": y}] for x, y in path]
    for kind, touches in (("touchStart", points[0]), *(("touchMove", point) for point in points[1:]), ("touchEnd", [])):
        driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})


def place_of_curves(driver):
    """(x, y) at 0.8 of the width of the curves, scrolled to the middle of the page. [pixel]"""
    ask(driver, "document.querySelector('.curves').scrollIntoView({block: 'center'})")
    box = ask(driver, "document.querySelector('.curves').getBoundingClientRect().toJSON()")
    return box["left"] + 0.8 * box["width"], box["top"] + 0.5 * box["height"]


def has_stopped(driver):
    """Whether the page has not scrolled for 0.3 s."""
    place = ask(driver, "scrollY")
    sleep(0.3)
    return ask(driver, "scrollY") == place


def test_a_scroll_that_begins_on_a_curve_keeps_the_time(still):
    """A tap and a sideways drag go to a time, a drag upwards scrolls the page."""
    still.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    reshape(still, PHONE, phone=True)
    x, y = place_of_curves(still)
    before = ask(still, "scrollY")
    touch(still, (x, y), *((x, y - 10 * k) for k in range(1, 10)))
    wait(lambda: ask(still, "scrollY") != before)
    assert ask(still, "player.time") == 1.5
    wait(lambda: has_stopped(still))  # a tap on a page that still scrolls only stops it
    x, y = place_of_curves(still)
    touch(still, (x, y))
    wait(lambda: ask(still, "player.time") > 2.5)
    touch(still, (x, y), (x - 30, y), (x - 60, y), (x - 90, y))
    wait(lambda: ask(still, "player.time") < 2.5)
    still.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


def test_a_click_names_a_member_and_a_joint(still, pages):
    """The card of the roof, then that of a joint: names, load as recorded, break."""
    run = pages[2][0]
    ask(still, "player.seek(1)")
    click(still, ask(still, "player.screen('roof')"))
    card = wait(lambda: still.find_element("class name", "card").text)
    assert "roof" in card and not ask(still, "document.querySelector('.card').hidden")
    number = run.elements.name.index("column.NE")
    joint = int(np.flatnonzero(run.joints.a == number)[-1])
    click(still, ask(still, f"player.joint({joint})"))
    load = run.load[run.at(1.0), joint]
    card = wait(lambda: f"1.00 s: {load:.2f}" in (text := still.find_element("class name", "card").text) and text)
    assert "column-beam joint" in card and "column.NE" in card
    still.find_element("css selector", ".card .close").click()
    assert ask(still, "document.querySelector('.card').hidden")
    assert errors(still) == []


def card_of(driver, place):
    """Lines about the largest values in the card that a click at a place opens; the card is closed before."""
    ask(driver, "void document.querySelector('.card .close').click()")
    click(driver, place)
    wait(lambda: not ask(driver, "document.querySelector('.card').hidden"))
    return ask(driver, "document.querySelector('.card .most').textContent").split("\n")


def test_the_card_shows_largest_forces_and_uplift(driver, tmp_path):
    """Of a joint at a foot and at a head, of a column, in both languages; of a roof no uplift; nothing for a run
    without these tables.
    """
    for run in (frames_sample.run(), frames_sample.with_tables(frames_sample.run())):
        page = player.make([("frames.h5", run)], tmp_path / "page.html")
        load(driver, f"file://{page}#t=1", motion=False)
        ask(driver, "document.getElementById('camera-front').click()")
        foot, head, column, roof = (ask(driver, f"player.{place}")
                                    for place in ("joint(1)", "joint(7)", "screen('column.NE')", "screen('roof')"))
        if run.peaks is None:
            assert [card_of(driver, place) for place in (foot, head, column, roof)] == [[""]] * 4
    assert card_of(driver, foot) == ["largest pull 1.3 kN, shear 0.7 kN", "largest uplift of the column's foot 2.9 mm"]
    assert card_of(driver, head) == ["largest pull 8.8 kN, shear 0.1 kN"]
    assert card_of(driver, column) == ["its joints: largest pull 8.8 kN, shear 0.5 kN",
                                       "largest uplift of the column's foot 31 mm"]
    assert card_of(driver, roof) == ["its joints: largest pull 8.8 kN, shear 0.4 kN"]
    ask(driver, "player.speak('ja')")
    assert card_of(driver, foot) == ["最大引張 1.3 kN、せん断 0.7 kN", "柱脚の最大浮き上がり 2.9 mm"]
    assert errors(driver) == []


def test_the_card_says_up_to_when_forces_of_a_fallen_house_are(driver, tmp_path):
    run = frames_sample.with_tables(frames_sample.run())
    run.summary = run.summary.changed(quantities={"until_s": 2.3})
    page = player.make([(tmp_path / "frames.h5", run)], tmp_path / "page.html")
    load(driver, f"file://{page}#t=1", motion=False)
    ask(driver, "document.getElementById('camera-front').click()")
    foot = ask(driver, "player.joint(1)")
    assert card_of(driver, foot) == ["largest pull 1.3 kN, shear 0.7 kN before 2.30 s",
                                     "largest uplift of the column's foot 2.9 mm before 2.30 s"]
    ask(driver, "player.speak('ja')")
    assert card_of(driver, foot) == ["最大引張 1.3 kN、せん断 0.7 kN（2.30 秒まで）", "柱脚の最大浮き上がり 2.9 mm（2.30 秒まで）"]
