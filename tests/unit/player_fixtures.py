# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures of the tests of the player: a browser, and pages with the runs of frames_sample.py."""
import browser
import frames_sample
import pytest
from player_page import ask, load
from yade_timber.pictures import player


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
