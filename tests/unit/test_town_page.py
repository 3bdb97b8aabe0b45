# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Map and page of a town, pages for owners in both languages, format of its films. Needs no YADE."""
from html import unescape

import frames_sample
import numpy as np
import pytest
from summaries import sample_summary
from timber_houses.pictures import VERDICTS, all_pictures, film, figures, owner, player, town_page
from timber_houses.recording import frames
from timber_houses.recording.summary import LotResult, TownSummary
from timber_houses.recording.town import summary as town_summary
from timber_houses.recording.town import town_frames
from timber_houses.text import english, japanese

PLACES = {"corner": (0.0, 0.0, "collapsed"), "shop": (20.0, 0.0, "undamaged")}


def town(count=None):
    """Frames of a town of invented houses at PLACES, or of `count` in a row."""
    places = PLACES if count is None else {f"lot{k}": (12.0 * k, 0.0, "unsafe") for k in range(count)}
    lots, results = [], {}
    for name, (x, y, verdict) in places.items():
        run = frames_sample.run()
        run.summary = run.summary.changed(lot=name, verdict=verdict)
        square = [[x - 3.0, y - 2.0], [x + 3.0, y - 2.0], [x + 3.0, y + 2.0], [x - 3.0, y + 2.0]]
        sentences = {"en": english.sentence(run.summary), "ja": japanese.result(run.summary)}
        results[name] = (run.summary, np.eye(3), LotResult(name, "A", verdict, [square], sentences))
        lots.append((name, np.eye(3), np.array([x, y, 0.0]), run))
    return town_frames(town_summary("Harbour", results, None), lots)


def test_the_summary_of_a_town_is_read_back(tmp_path):
    made = town()
    frames.save(tmp_path / "frames.h5", made)
    found = frames.load(tmp_path / "frames.h5").summary
    assert isinstance(found, TownSummary) and found.lots == made.summary.lots
    assert found.verdicts == ["collapsed", "undamaged"] and found.verdict == "collapsed"


def test_a_town_has_a_map_and_a_page_instead_of_sheets(tmp_path):
    frames.save(tmp_path / "frames.h5", town())
    written = {path.name for path in all_pictures.write(tmp_path)}
    assert written == {"map.png", "town.html", "player.html"}


def test_the_map_is_coloured_by_verdict():
    """Each house has the colour of its verdict in its middle; names are below the houses; both in the legend."""
    figure = town_page.figure(town())
    picture = np.asarray(figures.image_of(figure))
    ax = figure.axes[0]
    for x, y, verdict in PLACES.values():
        column, row = ax.transData.transform((x, y))
        colour = "#{:02X}{:02X}{:02X}".format(*picture[int(picture.shape[0] - row), int(column)])
        assert colour == VERDICTS[verdict].upper()
    assert {text.get_text() for text in ax.texts} >= set(PLACES)
    path = next(text for text in ax.texts if text.get_text() == "N").arrow_patch.get_path()
    arrow = path.vertices if path.codes is None else path.vertices[path.codes != path.CLOSEPOLY]
    assert 2 * np.ptp(arrow[:, 0]) < np.ptp(arrow[:, 1]) and arrow[0, 1] < arrow[-1, 1]  # upright, its head above
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["undamaged: 1", "collapsed: 1"]


def test_the_page_leads_to_the_owners():
    page = town_page.page(town())
    for name, (_, _, verdict) in PLACES.items():
        assert f">{name}</text>" in page and f"{verdict} {japanese.OUTCOMES[verdict]}" in page
        assert all(f'href="lots/{name}/owner.{language}.html"' in page for language in ("en", "ja"))
    assert "2 棟のうち無被害 1 棟、倒壊 1 棟。" in page and "Lot corner (house A) " in unescape(page)


@pytest.mark.parametrize("language, words", [
    ("en", ["Lot corner (house A)", "collapsed", english.MEANING["collapsed"], "What happens", "At the end"]),
    ("ja", ["区画 corner（住宅 A）：", "倒壊", japanese.MEANING["collapsed"], "できごと", "終わり"]),
])
def test_the_page_for_an_owner(tmp_path, language, words):
    run = frames_sample.run()
    run.summary = run.summary.changed(lot="corner", verdict="collapsed")
    run.title = f"{english.house_name('A', 'corner')}: earthquake"
    path, = owner.write(tmp_path, run, [language])
    page = unescape(path.read_text(encoding="utf-8"))
    assert path.name == f"owner.{language}.html" and f'lang="{language}"' in page
    assert all(word in page for word in words) and page.count("data:image/jpeg") == 2


def test_every_verdict_has_its_words():
    for words in (english, japanese):
        assert set(words.MEANING) == set(VERDICTS) <= set(words.OUTCOMES) and set(words.OWNER) == set(english.OWNER)


def test_the_player_has_a_japanese_headline():
    """Of a house, of a lot, of a town."""
    assert player.info(frames_sample.run())["japanese"]["title"].startswith("住宅 A：")
    found = player.info(town())["japanese"]
    assert (found["title"], found["result"]) == ("町 Harbour", "2 棟のうち無被害 1 棟、倒壊 1 棟。")
    assert japanese.title(sample_summary(lot="corner")).startswith("区画 corner（住宅 A）：")


def test_films_of_towns_are_smaller():
    """Elements times pictures stay below MOST_DRAWN, down to the lowest rate; what is given is taken."""
    small, run = film.chosen_form([frames_sample.run()]), town(80)
    assert (small.width, small.height, small.rate) == (1920, 1080, 30)
    run.time = list(np.linspace(0, 20, len(run.time)))
    large = film.chosen_form([run])
    pictures = large.rate * (film.last_change(run) - film.first_shown(run))
    assert (large.width, large.height) == film.SMALL_SIZE and 4 <= large.rate < 30
    assert pictures * len(run.shown) <= film.MOST_DRAWN * 1.001
    assert film.chosen_form([run], (640, 360), 25.0) == film.Format(640, 360, 25.0)
