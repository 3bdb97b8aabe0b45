# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player in a browser: it shows the recorded data, obeys mouse, touch and keys, fits a phone, uses no network, runs no code from data."""
import browser
import frames_sample
import numpy as np
import pytest
from browser import errors, picture, resize, wait
from yade_timber.pictures import key_times, player
from yade_timber.recording import frames

WIDE, PHONE, LYING_PHONE = (920, 620), (360, 740), (844, 390)
MIDDLE, HEAD, FOOT = [0, 0, 0], [0, 0, 1.1], [0, 0, -1.1]  # of an element; of a column, near its ends [m]
ROOF_IS_DARK = 0.5  # brightest channel of its pixels; sky and ground are above 0.7


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    with browser.chromium(tmp_path_factory.mktemp("chromium")) as opened:
        yield opened


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Addresses of a page with one run, and of one with two, of which the second ends earlier; and the runs."""
    folder = tmp_path_factory.mktemp("player")
    runs = [frames_sample.run(name="A"), frames_sample.run(name="B", until=3.0)]
    player.make([("a", runs[0])], folder / "one.html")
    player.make([("a", runs[0]), ("b", runs[1])], folder / "two.html")
    return f"file://{folder}/one.html", f"file://{folder}/two.html", runs


def load(driver, address, size=WIDE, motion=True, phone=False):
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "no-preference" if motion else "reduce"}]})
    resize(driver, *size, phone)
    driver.get("about:blank")
    driver.get(address)
    wait(lambda: driver.execute_script("return !!window.player"))


def ask(driver, expression):
    return driver.execute_script(f"return {expression}")


def press(driver, *keys):
    from selenium.webdriver.common.action_chains import ActionChains

    ActionChains(driver).send_keys(*keys).perform()


def pixels(driver, *points):
    """RGB where points are drawn; a point: (name of an element, number of the run, point in its body frame)."""
    places = [ask(driver, f"player.screen('{name}', {run}, {list(point)})") for name, run, point in points]
    seen = picture(driver)
    return [seen[round(place["y"]), round(place["x"])] for place in places]


def roof_is_drawn(driver, *runs):
    return all(color.max() < ROOF_IS_DARK for color in pixels(driver, *(("roof", run, MIDDLE) for run in runs)))


def is_wood(color):
    """Whether red is well above blue: neither sky nor ground, roof or foundation."""
    return color[0] - color[2] > 0.2


def recorded(run, name, time, point=(0, 0, 0)):
    """Where a point of an element is at the time of a frame. [m]"""
    k, frame = run.elements.name.index(name), run.at(time)
    return frames.placed([point], run.position[frame, k], run.orientation[frame, k])[0]


def between(run, name, time):
    """Position of an element, linear between the recorded frames. [m]"""
    k = run.elements.name.index(name)
    return [np.interp(time, run.time, run.position[:, k, axis]) for axis in range(3)]


@pytest.fixture(scope="module")
def one(driver, pages):
    """The page with one run, opened at 1.5 s."""
    load(driver, pages[0] + "#t=1.5", motion=False)
    assert ask(driver, "player.time") == 1.5 and not ask(driver, "player.playing")
    return driver


@pytest.fixture
def still(one):
    """The same, seen from the front, at 1.5 s."""
    ask(one, "document.getElementById('camera-front').click()")
    ask(one, "player.seek(1.5)")
    return one


def test_the_page_shows_what_the_data_say(still, pages):
    run = pages[2][0]
    for time in (0.0, 1.5, 2.5125, 2.987, 4.0):
        ask(still, f"player.seek({time})")
        for name in ("roof", "column.NE", "base"):
            assert ask(still, f"player.position('{name}')") == pytest.approx(between(run, name, time), abs=1e-3)
    for time in (2.3, 2.65, 2.95):
        ask(still, f"player.seek({time})")
        assert ask(still, f"player.position('column.NE', 0, {HEAD})") == pytest.approx(recorded(run, "column.NE", time, HEAD), abs=1e-3)


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


def test_keys(still):
    from selenium.webdriver.common.keys import Keys

    for key, time in ((Keys.END, 4.0), (Keys.HOME, 0.0), (Keys.ARROW_RIGHT, 0.5), (".", 0.55), (",", 0.5), (Keys.ARROW_LEFT, 0.0)):
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


def test_keys_turn_the_house(still):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    ask(still, "player.seek(0)")
    before, middle = ask(still, "player.screen('column.NE')"), ask(still, "player.screen('roof')")
    ActionChains(still).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(Keys.SHIFT).perform()
    wait(lambda: abs(ask(still, "player.screen('column.NE')")["x"] - before["x"]) > 3)
    assert ask(still, "player.screen('roof')")["x"] == pytest.approx(middle["x"], abs=15)  # about its middle: the wreck lies farther north
    assert ask(still, "player.time") == 0


def test_the_ground_moves_or_stands_still(still):
    """A quarter of a second into a swing of 20 cm to the east, seen from the north: to the left."""
    ask(still, "document.getElementById('camera-side').click()")
    ask(still, "player.seek(1.25)")
    moved = ask(still, "player.screen('base')")["x"]
    press(still, "g")
    wait(lambda: ask(still, "player.screen('base')")["x"] - moved > 3)
    assert ask(still, "player.position('base')") == pytest.approx([5, -3, 0.15], abs=1e-3)
    press(still, "g")


def test_curves_events_and_slider_go_to_a_time(still):
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By

    curves = still.find_element(By.CLASS_NAME, "curves")
    left, width = 42, curves.size["width"]
    ActionChains(still).move_to_element_with_offset(curves, round(left + 0.75 * (width - left) - width / 2), 0).click().perform()
    assert ask(still, "player.time") == pytest.approx(3.0, abs=0.02)
    events = still.find_elements(By.CSS_SELECTOR, ".events button")
    events[-1].click()
    assert ask(still, "player.time") == pytest.approx(2.9)
    assert "collapse" in events[-1].text
    wait(lambda: "past" in events[-1].get_attribute("class"))
    ask(still, "(e => { e.value = 0.8; e.dispatchEvent(new Event('input')); })(document.getElementById('scrub'))")
    assert ask(still, "player.time") == pytest.approx(0.8)
    assert "of 8 joints broken" in still.find_element(By.CLASS_NAME, "now").text
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


def check_fits(driver):
    """Nothing is wider than the phone, and the controls stay in sight."""
    assert ask(driver, "document.documentElement.scrollWidth") <= PHONE[0]
    box = ask(driver, "document.getElementById('transport').getBoundingClientRect().toJSON()")
    assert box["left"] >= 0 and box["right"] <= PHONE[0] and box["bottom"] <= PHONE[1] + 1
    outside = "[...document.querySelectorAll('#transport *')].filter((e) => e.getBoundingClientRect().right > innerWidth + 1).length"
    assert ask(driver, outside) == 0


def test_it_fits_a_phone(still):
    resize(still, *PHONE, phone=True)
    wait(lambda: ask(still, "innerWidth") == PHONE[0])
    check_fits(still)
    wait(lambda: roof_is_drawn(still, 0))
    small = "[...document.querySelectorAll('#transport button, #transport select')].filter((e) => e.checkVisibility() && e.getBoundingClientRect().height < 36).length"
    for _ in ("menu closed", "menu open"):
        assert ask(still, small) == 0
        ask(still, "void document.querySelector('#more summary').click()")
        check_fits(still)


def test_the_state_is_in_sight_on_a_lying_phone(still):
    """A long result takes two lines; the line with the state is not below the controls."""
    resize(still, *LYING_PHONE, phone=True)
    wait(lambda: ask(still, "innerWidth") == LYING_PHONE[0])
    ask(still, "scrollTo(0, 0)")
    before = ask(still, "document.querySelector('.result').textContent")
    ask(still, "void (document.querySelector('.result').textContent = 'a long result '.repeat(15))")
    now, controls = (ask(still, f"document.querySelector('{name}').getBoundingClientRect().toJSON()") for name in (".now", "#transport"))
    assert now["top"] >= 0 and now["bottom"] <= controls["top"] and controls["bottom"] <= LYING_PHONE[1] + 1
    ask(still, f"void (document.querySelector('.result').textContent = {before!r})")
    resize(still, *WIDE)


def test_it_plays_by_itself_unless_the_user_wants_no_motion(driver, pages):
    load(driver, pages[0], PHONE, motion=False)
    assert not ask(driver, "player.playing")
    load(driver, pages[0], PHONE, motion=True)
    assert ask(driver, "player.playing || player.time > 0")
    assert errors(driver) == []


def test_two_runs_in_step(driver, pages):
    load(driver, pages[1] + "#t=2.5", motion=False)
    for time in (2.5, 2.875, 3.6):
        ask(driver, f"player.seek({time})")
        for k, run in enumerate(pages[2]):
            assert ask(driver, f"player.position('roof', {k})") == pytest.approx(between(run, "roof", time), abs=1e-3)
    assert [place.text.startswith("recorded up to 3.0 s: ") for place in driver.find_elements("class name", "now")] == [False, True]
    ask(driver, "player.seek(1)")
    first, second = (ask(driver, f"player.screen('roof', {k})") for k in (0, 1))
    assert second["x"] - first["x"] == pytest.approx(WIDE[0] / 2, abs=5) and second["y"] == pytest.approx(first["y"], abs=1)
    assert roof_is_drawn(driver, 0, 1)

    resize(driver, *PHONE, phone=True)
    wait(lambda: ask(driver, "innerWidth") == PHONE[0])
    check_fits(driver)
    first, second = (ask(driver, f"player.screen('roof', {k})") for k in (0, 1))
    assert second["y"] - first["y"] > 100 and second["x"] == pytest.approx(first["x"], abs=1)  # one above the other
    assert second["y"] < ask(driver, "document.getElementById('transport').getBoundingClientRect().top")
    assert errors(driver) == []


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


def test_a_scroll_that_begins_on_a_curve_keeps_the_time(driver, pages):
    """A tap and a sideways drag go to a time, a drag upwards scrolls the page."""
    driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    load(driver, pages[0] + "#t=1.5", PHONE, motion=False, phone=True)
    x, y = place_of_curves(driver)
    before = ask(driver, "scrollY")
    touch(driver, (x, y), *((x, y - 10 * k) for k in range(1, 10)))
    wait(lambda: ask(driver, "scrollY") != before)
    assert ask(driver, "player.time") == 1.5
    load(driver, pages[0] + "#t=1.5", PHONE, motion=False, phone=True)
    x, y = place_of_curves(driver)
    touch(driver, (x, y))
    wait(lambda: ask(driver, "player.time") > 2.5)
    touch(driver, (x, y), (x - 30, y), (x - 60, y), (x - 90, y))
    wait(lambda: ask(driver, "player.time") < 2.5)
    driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


HOSTILE = ["<img src=x onerror=\"document.title='RUN'\">", "</script><script>document.title='RUN'</script>", "'\"><svg/onload=document.title='RUN'>", "$\\frac{$", "__proto__"]


def hostile_run(text):
    """A run whose every text is hostile."""
    run = frames_sample.run(name=text)
    run.title = text
    run.elements.kind[2:4] = [text, text + "2"]
    run.elements.name[2], run.joints.name[0], run.joints.kind[0], run.joints.side[0] = text, text, text, text
    run.summary["events"][0]["what"] = text
    return run


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_no_text_from_data_runs(driver, tmp_path, number):
    """Names, titles, kinds and events appear as text; the page has the elements that it has without them."""
    text = HOSTILE[number]
    page = player.make([("x", hostile_run(text))], tmp_path / "hostile.html")
    load(driver, f"file://{page}#t=2.5", WIDE, motion=False)
    assert driver.title == text and ask(driver, "document.querySelector('h1').textContent") == text
    assert f"House {text} " in ask(driver, "document.querySelector('.result').textContent")
    labels = ask(driver, "[...document.querySelectorAll('#legend-list li')].map((e) => e.textContent)")
    assert {text, text + "2", "roof"} <= set(labels)
    assert any(text in event for event in ask(driver, "[...document.querySelectorAll('.events button')].map((e) => e.textContent)"))
    assert ask(driver, "document.querySelectorAll('img, iframe, [onerror], [onload], script:not(.run-data)').length") == 1
    assert errors(driver) == []


def test_the_policy_stops_foreign_code(driver, tmp_path):
    """Were markup from data in the page, the browser would not run it: script, handler, style, picture and network are refused."""
    page = player.make([("x", frames_sample.run())], tmp_path / "page.html")
    foreign = "<script>document.title = 'RUN'</script><img src=x onerror=\"document.title = 'RUN'\"><style>h1 { display: none }</style>"
    page.write_text(page.read_text(encoding="utf-8").replace('<main id="runs">', foreign + '<main id="runs">'), encoding="utf-8")
    load(driver, f"file://{page}#t=2.5", WIDE, motion=False)
    assert driver.title == "House A: earthquake" and driver.find_element("css selector", "h1").is_displayed()
    assert ask(driver, "fetch('https://example.org/').then(() => 'reached', () => 'refused')") == "refused"
    assert sum("Content Security Policy" in line for line in errors(driver)) >= 4


def click(driver, place):
    """A click at {x, y} of the page."""
    for kind in ("mousePressed", "mouseReleased"):
        driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": kind, "button": "left", "clickCount": 1, **place})


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


def test_the_page_speaks_japanese(still):
    english = still.find_element("class name", "now").text
    ask(still, "player.speak('ja')")
    ask(still, "player.seek(1.4)")
    assert "接合部" in still.find_element("class name", "now").text and "できごと" in still.find_element("class name", "event-list").text
    assert still.find_element("id", "camera-front").text == "正面" and ask(still, "document.documentElement.lang") == "ja"
    ask(still, "player.speak('en')")
    ask(still, "player.seek(1.5)")
    assert still.find_element("class name", "now").text == english and still.find_element("id", "camera-front").text == "Front"


def choose(driver, name, value):
    ask(driver, f"void ((e) => {{ e.value = '{value}'; e.dispatchEvent(new Event('change')); }})(document.getElementById('{name}'))")


def test_movement_is_enlarged_about_the_start(driver, pages):
    """Displacements of the roof, below 0.1 m in the first seconds, are five times as large; the page says so."""
    load(driver, pages[0] + "#t=1.2", motion=False)
    start, plain = (np.array(between(pages[2][0], "roof", time)) for time in (0.0, 1.2))
    choose(driver, "factor", 5)
    ask(driver, "player.seek(1.2)")
    assert ask(driver, "player.position('roof')") == pytest.approx(start + 5 * (plain - start), abs=5e-3)
    assert "5×" in driver.find_element("class name", "now").text
    choose(driver, "factor", 1)


def test_things_for_scale_are_drawn(driver, pages):
    """Glass walls, the house at the start and a person change the picture, and leave it when they are switched off."""
    load(driver, pages[0] + "#t=3.5", motion=False)
    before = picture(driver)
    for name in ("walls", "ghost", "person"):
        ask(driver, f"void document.getElementById('{name}').click()")
        wait(lambda: (abs(picture(driver) - before) > 0.02).sum() > 100)
        ask(driver, f"void document.getElementById('{name}').click()")
        wait(lambda: (abs(picture(driver) - before) > 0.02).sum() == 0)
    assert errors(driver) == []


def test_it_plays_slowly_around_the_main_event(driver, pages):
    load(driver, pages[0] + "#t=0.5", motion=False)
    assert ask(driver, "player.pace") == 1
    ask(driver, "void document.getElementById('slow').click()")
    main = player.main_event(pages[2][0])
    ask(driver, f"player.seek({main})")
    assert ask(driver, "player.pace") == 0.25


def test_it_opens_before_an_event_that_is_earlier_than_the_shaking(driver, tmp_path):
    run = frames_sample.run()
    run.motion.start = 3.0
    first = min(event["time"] for event in player.events(run))
    player.make([("x", run)], tmp_path / "x.html")
    load(driver, (tmp_path / "x.html").as_uri(), motion=False)
    assert ask(driver, "player.time") == pytest.approx(max(0, first - 2), abs=1e-3) and first < key_times.onset(run.motion)


def test_a_film_is_recorded(driver, pages, tmp_path):
    """A click starts it, a second one ends it and saves a WebM file."""
    driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    load(driver, pages[0] + "#t=0", motion=False)
    ask(driver, "void document.getElementById('film').click()")
    wait(lambda: ask(driver, "player.time > 3.5"))
    ask(driver, "void document.getElementById('film').click()")
    (film,) = wait(lambda: [path for path in tmp_path.glob("*.webm") if path.stat().st_size])
    assert film.read_bytes()[:4] == b"\x1aE\xdf\xa3" and not ask(driver, "player.playing")  # EBML
    assert errors(driver) == []
