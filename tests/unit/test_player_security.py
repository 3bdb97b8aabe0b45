# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player runs no code from data, and its policy stops foreign code."""
import frames_sample
import pytest
from browser import errors
from player_page import ask, load
from timber_houses.pictures import player
from timber_houses.recording.events import Event, StructureFallen

pytest_plugins = ["player_fixtures"]

HOSTILE = ["".join(("<img src=x onerror=\"document.title='RUN'\">", "</script><script>document.title='RUN'</script>",
                    "'\"><svg/onload=document.title='RUN'>", "$\\frac{$")), "__proto__"]
SMALL = 320, 240
"""Size of the page: its text counts, not its picture. [pixel]"""


def hostile_run(text):
    """A run whose every text is hostile."""
    run = frames_sample.run(name=text)
    run.title = text
    run.elements.kind[2:4] = [text, text + "2"]
    run.elements.name[2], run.joints.name[0], run.joints.kind[0], run.joints.side[0] = text, text, text, text
    run.summary = run.summary.changed(events=[Event(1.0, StructureFallen(text))])
    return run


@pytest.mark.parametrize("number", range(len(HOSTILE)))
def test_no_text_from_data_runs(driver, tmp_path, number):
    """Names, titles, kinds and events appear as text; the page has the elements that it has without them."""
    text = HOSTILE[number]
    page = player.make([("x", hostile_run(text))], tmp_path / "hostile.html")
    load(driver, f"file://{page}#t=2.5", SMALL, motion=False)
    assert driver.title == text and ask(driver, "document.querySelector('h1').textContent") == text
    assert f"House {text} " in ask(driver, "document.querySelector('.result').textContent")
    labels = ask(driver, "[...document.querySelectorAll('#legend-list li')].map((e) => e.textContent)")
    assert {text, text + "2", "roof"} <= set(labels)
    assert any(text in event
               for event in ask(driver, "[...document.querySelectorAll('.events button')].map((e) => e.textContent)"))
    assert ask(driver,
               "document.querySelectorAll('img, iframe, [onerror], [onload], script:not(.run-data)').length") == 1
    assert errors(driver) == []


def test_the_policy_stops_foreign_code(driver, tmp_path):
    """Were markup from data in the page, the browser would not run it: script, handler, style, picture and network are
    refused.
    """
    page = player.make([("x", frames_sample.run())], tmp_path / "page.html")
    foreign = ("<script>document.title = 'RUN'</script><img src=x onerror=\"document.title = 'RUN'\">"
               "<style>h1 { display: none }</style>")
    page.write_text(
        page.read_text(encoding="utf-8").replace('<main id="runs">', foreign + '<main id="runs">'), encoding="utf-8")
    load(driver, f"file://{page}#t=2.5", SMALL, motion=False)
    assert driver.title == "House A: earthquake" and driver.find_element("css selector", "h1").is_displayed()
    assert ask(driver, "fetch('https://example.org/').then(() => 'reached', () => 'refused')") == "refused"
    assert sum("Content Security Policy" in line for line in errors(driver)) >= 4
