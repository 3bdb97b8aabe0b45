# SPDX-License-Identifier: GPL-2.0-or-later
"""The player's page in a browser: open it, ask it, press keys, look at pixels."""
import numpy as np
from browser import picture, resize, wait

WIDE, PHONE, LYING_PHONE = (920, 620), (360, 740), (844, 390)
"""Sizes of the page. [pixel]"""
MIDDLE = [0, 0, 0]
"""Of an element, in its body frame. [m]"""
ROOF_IS_DARK = 0.5
"""Brightest channel of its pixels; sky and ground are above 0.7."""


def load(driver, address, size=WIDE, motion=True, phone=False):
    driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia",
        {"features": [{"name": "prefers-reduced-motion", "value": "no-preference" if motion else "reduce"}]})
    resize(driver, *size, phone)
    driver.get("about:blank")
    driver.get(address)
    wait(lambda: driver.execute_script("return !!window.player"))


def reshape(driver, size, phone=False):
    """Set the size of the page and wait until it is drawn."""
    resize(driver, *size, phone)
    wait(lambda: ask(driver, "innerWidth") == size[0])
    driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")


def ask(driver, expression):
    return driver.execute_script(f"return {expression}")


def at_rest(driver, page):
    """The driver with a page, seen from the front, at 1.5 s; a page that is open is not loaded again."""
    address = page + "#t=1.5"
    if driver.current_url != address:
        load(driver, address, motion=False)
        assert ask(driver, "player.time") == 1.5 and not ask(driver, "player.playing")
    reshape(driver, WIDE)
    ask(driver, "document.getElementById('camera-front').click()")
    ask(driver, "player.seek(1.5)")
    return driver


def press(driver, *keys):
    from selenium.webdriver.common.action_chains import ActionChains

    ActionChains(driver).send_keys(*keys).perform()


def click(driver, place):
    """A click at {x, y} of the page."""
    for kind in ("mousePressed", "mouseReleased"):
        driver.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": kind, "button": "left", "clickCount": 1, **place})


def pixels(driver, *points):
    """RGB where points are drawn; a point: (name of an element, number of the run, point in its body frame)."""
    places = [ask(driver, f"player.screen('{name}', {run}, {list(point)})") for name, run, point in points]
    seen = picture(driver)
    return [seen[round(place["y"]), round(place["x"])] for place in places]


def roof_is_drawn(driver, *runs):
    return all(color.max() < ROOF_IS_DARK for color in pixels(driver, *(("roof", run, MIDDLE) for run in runs)))


def between(run, name, time):
    """Position of an element, linear between the recorded frames. [m]"""
    k = run.elements.name.index(name)
    return [np.interp(time, run.time, run.position[:, k, axis]) for axis in range(3)]
