# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Ranking of strengthening measures: candidates, motions, tests against known samples, rounds with stubbed runs,
overview.
"""
import math
from pathlib import Path

import numpy as np
import pytest
from timber_houses.base.errors import RunError
from timber_houses.house import BayName, changed_house
from timber_houses.study.batch import HouseChanges
from timber_houses.study.retrofit import candidates as measures
from timber_houses.study.retrofit import motions, overview, race
from timber_houses.study.retrofit import runs as rounds

ROOT = Path(__file__).resolve().parents[2]


# --- candidates and motions -------------------------------------------------------------------------------------------


def test_candidates_of_a_house():
    """Free bays, groups of joints that can break, and snow only where it lies."""
    found = measures.candidates("B", 1.0)
    names = [candidate.name for candidate in found]
    assert "main.brace1.EW.y0.3-4" in names and len(names) == len(set(names))
    assert [name for name in names
            if name.startswith("double")] == ["double_column_ends", "double_brace_ends", "double_brace_sides"]
    assert found[names.index("double_column_ends")].changes == HouseChanges(
        set=("joints.column_ends.number=4",))  # the shipped house has two fittings at each end
    assert names[-1] == "snow_cleared" and found[-1].options == {"snow": 0.0}
    assert "snow_cleared" not in [candidate.name for candidate in measures.candidates("B", 0.0)]
    walls = measures.candidates("B", 0.0, ("wall",), ("EW.y0.3-4",))
    assert [wall.changes.braces for wall in walls] == [(f"main.wall{storey}.EW.y0.3-4.plywood",) for storey in (1, 2)]
    assert [candidate.name for candidate in measures.candidates("B", 1.0, ("brace", ), ("EW.y0.3-4", ))] == [
        "main.brace1.EW.y0.3-4", "main.brace2.EW.y0.3-4"
    ]


def test_walls_that_cannot_be_built_are_no_measures(tmp_path):
    """Three bays of the middle line, which has no beams here."""
    house = tmp_path / "mine.yaml"
    outer = "[{along: y, at: [0, 4], from: 0, to: 6}, {along: x, at: [0, 6], from: 0, to: 4, cut: true}]"
    house.write_text(f"""extends: storehouse
structures:
  store:
    walls: []
    columns: [{{section: 0.12, lines: {outer.replace(", cut: true", "")}}}]
    stack:
      - {{layer: foundation, height: 0.30, width: 0.15}}
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2.40}}
      - {{layer: beams, height: 0.15, width: 0.12, lines: {outer}}}
      - {{layer: roof, type: gable, ridge: y, pitch: 0.45, eaves: 0.30, thickness: 0.20, material: tiles}}
""")
    free = measures.free_wall_bays(measures.load_house(house), measures.SHEATHING)
    found = [one.name for one in measures.candidates(house, 0.0, ("wall",))]
    assert set(free) - set(found) == {"store.wall1.EW.y3.0-4.plywood"} and len(found) > 10


@pytest.mark.parametrize("name, text", [
    ("main.brace1.EW.y0.3-4", "brace: main, storey 1, south wall, 3.2 m east"),
    ("main.brace1.NS.x8.4-5", "brace: main, storey 1, east wall, 4.1 m north"),
    ("main.brace2.NS.x4.1-3", "brace: main, storey 2, inner N-S wall, 1.8 m north"),
    ("main.wall1.EW.y0.3-4.plywood", "plywood wall: main, storey 1, south wall, 3.2 m east"),
])
def test_bays_as_text(name, text):
    model = measures.build_house(measures.load_house("B"), check=False)
    assert measures.bay_text(model, BayName.read(name)) == text


def test_measures_of_whole_walls():
    """Braces in the 6 free bays of B's south wall (docs of free_bays) are one measure of each storey; both walls of A's
    entrance are, too.
    """
    found = {one.name: one for one in measures.candidates("B", 0.0, ("brace", "wall"), group="wall")}
    south = found["main.brace1.EW.y0"]
    assert south.text == "braces in 6 bays: main, storey 1, south wall"
    assert list(south.changes.braces) == [
        one.name for one in measures.candidates("B", 0.0, ("brace", ), ("main.brace1.EW.y0.", ))
    ]
    assert found["main.wall2.NS.x4"].text == "plywood walls in 7 bays: main, storey 2, inner N-S wall"
    assert sum(name.startswith("main.brace") for name in found) == 2 * 6
    bays = [name for one in found.values() for name in one.changes.braces]
    assert sorted(bays) == sorted(one.name for one in measures.candidates("B", 0.0, ("brace", "wall")))


def test_no_measure_stands_in_a_window_or_a_door():
    """South wall of tiled_house: nodes 0 1 2 4 5 7 8, windows and doors at 2-4 and 5-7. Its inner walls have doors at
    1-3 and 6-7, with a lining above them.
    """
    names = [one.name for one in measures.candidates("tiled_house", 0.0, ("brace", "wall"))]
    assert [name.rpartition(".")[2] for name in names if name.startswith("main.brace1.EW.y0.")] == [
        "0-1", "1-2", "5-4", "8-7"
    ]
    walls = ("main.wall1.EW.y0.", "main.wall1.EW.y4.1-3", "main.wall1.EW.y4.6-7")
    assert not any(name.startswith(walls) for name in names)


def test_the_line_of_a_bay():
    """Nodes may be fractions, so that a point in a name need not separate two parts of it."""
    for name, line in (("main.brace1.NS.x4.1-3", "main.brace1.NS.x4"),
                       ("main.wall1.NS.x4.0.1.5-3.plywood", "main.wall1.NS.x4.0")):
        assert BayName.read(name).line == line and str(BayName.read(name)) == name
    assert not any(map(BayName.read, ("main.brace1.NS.x4.1-3.plywood", "main.wall1.NS.x4.1-3", "main.column1.x4y1")))


def test_seeds_and_target():
    found = motions.seeds(3, {"pga": 400.0})
    assert [name for name, _ in found] == ["seed1", "seed2", "seed3"]
    assert found[1][1] == {"seed": 2, "start": 14.0, "end": 34.0, "pga": 400.0}


def write_record(path, shaking=2.0):
    """A CSV record of 30 s that shakes for 10 to 20 s, in all components. shaking [m/s2]"""
    time = np.arange(0, 30, 0.01)
    values = shaking * np.sin(2 * np.pi * 2 * time) * ((time > 10) & (time < 20))
    path.write_text("time,ns,ew,ud\n" + "\n".join(f"{t:.2f},{v:.5f},{v:.5f},{v:.5f}" for t, v in zip(time, values)))


def test_records_of_a_folder(tmp_path):
    """Each file or set of three files is a motion, cut from 4 s before its strong shaking to 10 s after it."""
    for name in ("first.csv", "second.csv"):
        write_record(tmp_path / name)
    (tmp_path / "README.md").write_text("no record")
    found = motions.records(tmp_path, {"scale": 2.0}, "m/s2")
    assert [name for name, _ in found] == ["first", "second"] and found[0][1]["scale"] == 2.0
    start, end = (found[0][1][key] for key in ("start", "end"))
    assert start == pytest.approx(6.5,
                                  abs=0.2) and end == pytest.approx(29.5, abs=0.6)  # 5 % and 95 % of 10 s of shaking
    with pytest.raises(RunError, match="no records"):
        motions.records(ROOT / "docs")


def test_files_of_one_record_are_one_motion(tmp_path, monkeypatch):
    """Azimuths other than 000 and 090, two components, components with letters, K-NET, one file of three components."""
    names = ("RSN953_MUL009.AT2", "RSN953_MUL279.AT2", "RSN953_MUL-UP.AT2", "B-E.AT2", "B-N.AT2", "kobe_ns.csv",
             "kobe_ew.csv", "K1.NS", "K1.EW", "K1.UD", "whole.csv")
    for name in names:
        (tmp_path / name).write_text("ns,ew,ud\n1,2,3\n")
    (tmp_path / "_SearchResults.csv").write_text("Record,Magnitude\n953,6.7\n")
    monkeypatch.setattr(motions, "window", lambda *_: {})
    found = {name: record["record"] for name, record in motions.records(tmp_path)}
    joined = {
        name: ",".join(str(tmp_path / file) for file in files)
        for name, files in (("B", ("B-E.AT2", "B-N.AT2")), ("kobe", ("kobe_ew.csv", "kobe_ns.csv")))
    }
    whole = {
        name: str(tmp_path / file)
        for name, file in (("RSN953_MUL", "RSN953_MUL"), ("K1", "K1"), ("whole", "whole.csv"))
    }
    assert found == joined | whole


# --- statistics -------------------------------------------------------------------------------------------------------


def test_signed_rank_of_a_published_sample():
    """Nine pairs of Hollander and Wolfe, Nonparametric Statistical Methods, example 3.1 (depression scores): two-sided
    exact p = 0.0391.
    """
    before = [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30]
    after = [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29]
    assert race.signed_rank(np.subtract(after, before)) == pytest.approx(0.0391, abs=5e-5)
    assert race.signed_rank([-1.0 - 0.1 * k for k in range(10)]) == pytest.approx(2 / 2**10)
    assert race.signed_rank([0.0] * 12) == 1.0


def test_holm():
    """Holm (1979): 0.01, 0.02, 0.04 become 0.03, 0.04, 0.04; with two further tests that are not shown 0.05, 0.08,
    0.12.
    """
    assert race.holm([0.02, 0.01, 0.04], 3) == pytest.approx([0.04, 0.03, 0.04])
    assert race.holm([0.02, 0.01, 0.04], 5) == pytest.approx([0.08, 0.05, 0.12])


@pytest.mark.parametrize("count, needed, usual", [(1, 10, 16), (3, 10, 16), (4, 14, 20), (13, 14, 20), (81, 14, 24)])
def test_needed_motions(count, needed, usual):
    """Equal signs under the least number of motions are a difference for each of three finalists: 3 * 2 / 2^10 <= 0.05.
    """
    assert race.needed_motions(count) == needed and race.default_motions(count) == usual
    assert race.FINALISTS * 2 / 2**race.LEAST_TESTS <= race.SIGNIFICANCE


def test_rounds():
    assert race.rounds(24, 81) == [(4, 81), (8, 16), (24, 3)] and race.cost(24, 81) == 24 + 4 * 81 + 4 * 16 + 16 * 3
    assert race.rounds(20, 13) == [(4, 13), (20, 3)] and race.rounds(14, 81) == [
        (4, 81), (14, 3)
    ], "the test has ten motions at least"
    assert race.rounds(10, 3) == [(10, 3)] and race.cost(10, 3) == 40


def run(drift, collapsed=False):
    return {"peak_drift": drift, "collapsed": collapsed, "status": "done", "wall_s": 1.0, "run": f"run{drift:g}",
            "error": None}


def test_a_collapse_counts_as_the_largest_drift():
    assert race.response(run(0.02, True)) == race.response(run(3.0)) == math.log(race.CAP)
    assert race.response(run(0.0)) == math.log(race.FLOOR)


def entry(name, factors):
    """An Entry whose drifts are those of the house times factors; the house drifts by 0.01 everywhere. A factor of
    infinity is a collapse.
    """
    return race.Entry(measures.Candidate(name, name),
                      {f"seed{k}": run(0.01 * factor, math.isinf(factor))
                       for k, factor in enumerate(factors)})


def seeds(first, last):
    return [f"seed{k}" for k in range(first, last)]


SCATTER = [0.7, 1.5, 0.9, 1.2, 0.8, 1.3, 0.6, 1.4, 1.1, 0.95, 0.85, 1.25]
LOWER = [0.5 + 0.01 * k for k in range(12)]


def test_words_of_a_ranking():
    """Equal signs under 12 motions are a difference, a scatter about 1 is none; a dropped measure costs the three that
    are tested nothing.
    """
    house, good, none = entry("house", [1.0] * 12), entry("good", LOWER), entry("none", SCATTER)
    bad, dropped = entry("bad", [1 / factor for factor in LOWER]), entry("dropped", LOWER[:4])
    dropped.dropped = 4
    results = race.ranking([none, dropped, bad, good], house, seeds(0, 12))
    assert [(result.entry.candidate.name, result.words)
            for result in results] == [("good", "better"), ("none", race.NO_DIFFERENCE), ("bad", "worse"),
                                       ("dropped", "not tested: dropped after 4 motions")]
    assert results[0].ratio == pytest.approx(math.sqrt(0.55 * 0.56)) and results[0].motions == 12
    assert results[0].p == pytest.approx(3 * 2 / 2**12) and results[3].p is None


def test_the_motions_of_the_selection_do_not_test():
    """Four lucky motions select a measure; under the twelve others it scatters about 1."""
    house, lucky = entry("house", [1.0] * 16), entry("lucky", [0.01] * 4 + SCATTER)
    result, = race.ranking([lucky], house, seeds(4, 16))
    assert result.motions == 12 and result.p > 0.5 and result.words == race.NO_DIFFERENCE
    assert race.compare(lucky, house).p < 0.2 < race.compare(lucky, house, seeds(
        4, 16)).p, "with the motions that selected it, the measure looks better"


@pytest.mark.parametrize("measure, house, p, words", [(3, 10, 2 / 2**7, "better"), (10, 3, 2 / 2**7, "worse"),
                                                      (5, 10, 2 / 2**5, race.NO_DIFFERENCE),
                                                      (10, 10, 1.0, race.NO_DIFFERENCE)])
def test_collapses_are_compared_where_drifts_say_nothing(measure, house, p, words):
    """Collapses under so many of ten motions, of three measures with equal numbers: McNemar's exact test, by hand."""
    def fallen(number):
        return [math.inf] * number + [1.0] * (10 - number)

    entries = [entry(str(k), fallen(measure)) for k in range(3)]
    results = race.ranking(entries, entry("house", fallen(house)), seeds(0, 10))
    for result in results:
        assert result.comparison.by_collapses and result.words == words and result.p == pytest.approx(min(1.0, 3 * p))
        assert result.why == f"collapses under {measure} motions instead of {house}"


def test_exact_sign():
    """McNemar (1947): 1 against 7 discordant pairs, 2 (1 + 8) / 2^8; the direction is of no influence."""
    assert race.exact_sign(1, 7) == race.exact_sign(7, 1) == pytest.approx(18 / 256)
    assert race.exact_sign(0, 0) == race.exact_sign(2, 2) == 1.0


def test_equal_motions_do_not_decide_the_direction():
    """Equal drifts under 11 of 20 motions; under the others the measure halves the drift."""
    house = entry("house", [1.0] * 20)
    good = entry("good", [1.0] * 11 + [0.5 + 0.01 * k for k in range(9)])
    result, = race.ranking([good], house, seeds(0, 20))
    assert (result.ratio, result.words) == (1.0, "better") and result.p < 0.05


def test_double_fittings_are_twice_as_strong(tmp_path):
    """Also where a rule of joints has a strength of its own."""
    path = tmp_path / "own.yaml"
    path.write_text("extends: storehouse\nname: own\njoints:\n  column_ends: {strength: 20000}\n")
    double, = measures.candidates(path, 0.0, ("fitting",), ("column_ends",))
    data = changed_house(path, double.changes.set)
    assert data["joints"]["column_ends"]["strength"] == 40000 and data["joints"]["column_ends"]["number"] == 4


def test_the_summary_names_what_is_better_or_what_was_tested():
    house, good, none = entry("house", [1.0] * 12), entry("good", LOWER), entry("none", SCATTER)
    text = overview.summary(race.ranking([good, none], house, seeds(0, 12)))
    assert text == "Shown to be better than the house as it is: good (median drift times 0.55)."
    text = overview.summary(race.ranking([none], house, seeds(0, 12)))
    assert text.startswith("No measure is shown to be better")
    assert text.endswith("Tested: none (median drift times 1.02).")


@pytest.mark.parametrize("weak", [0.0, 0.5])
def test_false_discoveries_are_rare(weak):
    """200 rankings of 20 measures without any effect, lognormal scatter of a factor 1.5, collapses beyond a drift: at
    most 5 % find one.

    10 expected at most, 19 at 99.8 %. weak: mean logarithm of the drift over that of a collapse; 0: every second motion
    is a collapse
    """
    random, wrong = np.random.default_rng(5), 0

    def runs(base, scatter, motions):
        return {k: run(math.exp(base[k] + scatter[k] - 3.0 - weak), base[k] + scatter[k] > weak) for k in motions}

    for _ in range(200):
        base = random.normal(0, 0.4, 20)
        scatter = random.normal(0, 0.4, (21, 20))
        house = race.Entry(None, runs(base, scatter[20], range(20)))
        entries = [race.Entry(measures.Candidate(str(k), ""), {}) for k in range(20)]
        racing, before = entries, 0
        for done, count in race.rounds(20, 20):
            racing = race.select(racing, house, count) if before else racing
            for one in racing:
                one.runs |= runs(base, scatter[int(one.candidate.name)], range(before, done))
            tests, before = range(before, done), done
        wrong += any(result.words in ("better", "worse") for result in race.ranking(entries, house, tests))
    assert wrong <= 19


# --- rounds with stubbed runs -----------------------------------------------------------------------------------------


def ranking(folder, monkeypatch, effects, failing=(), strength=math.inf):
    """A Ranking of house B with braces, whose runs are replaced by drifts of 0.01 times an effect; returns it and the
    list of runs made.

    strength: factor on the first motion that lets a house collapse; the k-th motion needs 1 + k / 10 times as much
    """
    made = []

    def run_rows(rows, *_):
        made.extend(row.name for row in rows if row.name not in made)

    def write_runs(rows, _):
        lines = []
        for row in rows:
            number, brace = row.options.seed, next(iter(row.changes.braces), None)
            factor = effects.get(brace, 1.0) * (1 + 0.01 * number)
            failed = brace in failing and number == 2
            fallen = row.options.factor >= strength * (1 + 0.1 * (number - 1))
            lines.append({
                **run(0.01 * factor, fallen), "run": row.name,
                **({"status": "failed", "error": "too large a step"} if failed else {})
            })
        return lines

    monkeypatch.setattr(rounds, "run_rows", run_rows)
    monkeypatch.setattr(rounds, "write_runs", write_runs)
    found = measures.candidates("B", 0.0, ("brace",), ("brace1.EW",))[:12]
    return rounds.Ranking(folder, found, motions.seeds(20), {"house": "B", "snow": 0.0}), made


def test_runs_go_to_the_contenders(tmp_path, monkeypatch):
    """12 measures: 4 motions for all, 16 others for three; a measure with a failed run is named and left out of the
    test.
    """
    names = [candidate.name for candidate in measures.candidates("B", 0.0, ("brace",), ("brace1.EW",))[:12]]
    effects = {name: 0.5 + 0.1 * k for k, name in enumerate(names)}
    lines = []
    race_of, made = ranking(tmp_path, monkeypatch, effects, failing=[names[1]])
    race_of.run(lines.append)
    assert [len(one.runs) for one in race_of.entries] == [20, 3, 20, 20] + [4] * 8 and len(made) == 20 + 4 * 12 + 16 * 3
    assert race_of.tests == [f"seed{k}" for k in range(5, 21)]
    results = race.ranking(race_of.entries, race_of.house, race_of.tests)
    assert results[0].entry.candidate.name == names[0]
    assert results[0].words == "better"
    assert results[0].ratio == pytest.approx(0.5)
    assert results[-1].words == "a run failed: too large a step"
    assert len(lines) == 3
    assert lines[0].startswith("first run: 1 run of ") and "; 115 runs left, about" in lines[0]
    assert "selection: 12 measures under 4 motions" in lines[1]
    assert "runs left, about" in lines[1]
    assert "test: 3 measures" in lines[2]
    page = overview.page("Title", ["About <b>"], results, race_of.house)
    assert page.count("<circle") == sum(len(one.runs) for one in race_of.entries) and "About &lt;b&gt;" in page
    assert overview.table_text(results).splitlines()[1].startswith(f"1,{names[0]},")


@pytest.mark.parametrize("p, text", [(0.0, "&lt; 0.001"), (9.9e-4, "&lt; 0.001"), (0.001, "0.001"), (0.04, "0.040"),
                                     (None, "-")])
def test_a_small_p_is_below_a_limit(p, text):
    """None is printed as 0.000."""
    one = race.Entry(measures.Candidate("one", ""), seeds_of := {k: run(0.01, False) for k in ("seed1", "seed2")})
    house = race.Entry(None, seeds_of)
    result = race.Result(one, race.compare(one, house), p, "better")
    page = overview.page("Title", [], [result], house)
    assert f">{text}</td>" in page and "0.000" not in page


@pytest.mark.parametrize("strength", [0.05, 0.3, 1.0, 3.0])
def test_the_strength_brings_half_of_the_houses_down(tmp_path, monkeypatch, strength):
    """Factors from `strength` to 1.5 times as much let the six pilots collapse: two to four do at the chosen one, of at
    most eight tried.
    """
    lines = []
    race_of, made = ranking(tmp_path, monkeypatch, {}, strength=strength)
    text = race_of.choose_scale(lines.append)
    scale = race_of.motions[0][1]["scale"]
    assert 2 <= sum(scale >= strength * (1 + 0.1 * k) for k in range(6)) <= 4
    assert len(lines) <= 8
    assert len(made) == 6 * len(lines)
    assert {cells["scale"] for _, cells in race_of.motions} == {scale} and f"scaled by {scale:g}" in text
    race_of.run(lambda line: None)
    assert len(race_of.house.runs
               ) == 20 and len(made) < 6 * len(lines) + 20 + 4 * 12 + 16 * 3, "runs of the pilots are not repeated"


@pytest.mark.parametrize("strength, chosen", [(math.inf, rounds.STRONGEST), (0.0, rounds.WEAKEST)])
def test_the_search_for_a_strength_ends(tmp_path, monkeypatch, strength, chosen):
    race_of, made = ranking(tmp_path, monkeypatch, {}, strength=strength)
    race_of.choose_scale(lambda line: None)
    assert race_of.motions[0][1]["scale"] == pytest.approx(chosen) and len(made) == 6 * 5


def test_a_failed_house_ends_the_ranking(tmp_path, monkeypatch):
    race_of, _ = ranking(tmp_path, monkeypatch, {}, failing=[None])
    for phase in (race_of.run, race_of.choose_scale):
        with pytest.raises(RunError, match="the house as it is failed under seed2: too large a step"):
            phase(lambda line: None)


def test_bad_measures_are_found_before_the_first_run(tmp_path):
    """A measure that cannot be built is refused with its place, without a run."""
    wrong = measures.Candidate("wrong", "wrong", HouseChanges(braces=("main.brace1.EW.y0.3-40",)))
    race_of = rounds.Ranking(tmp_path, [wrong], motions.seeds(10), {"house": "B", "snow": 0.0})
    with pytest.raises(RunError, match="^wrong_seed1: "):
        race_of.check()
