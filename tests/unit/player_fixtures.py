# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures of the tests of the player: a browser, and pages with the runs of frames_sample.py."""
import browser
import frames_sample
import pytest
from player_page import at_rest
from timber_houses.pictures import player


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


@pytest.fixture
def still(driver, pages):
    """The page with one run, at rest."""
    return at_rest(driver, pages[0])


@pytest.fixture
def two(driver, pages):
    """The page with two runs, at rest."""
    return at_rest(driver, pages[1])
