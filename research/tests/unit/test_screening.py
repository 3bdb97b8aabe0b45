# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The screening: houses of its cells, batch rows, responses, effects of synthetic responses, tables and picture."""

import math

import numpy as np
import pytest
from summaries import sample_summary
import yaml
from timber_research import design
from timber_research.claims import CLAIMS, RUNS
from timber_research.factors import FACTORS, house_entries
from timber_research.screening import cells, picture, report
from timber_research.screening.collect import Results, collect
from timber_research.screening.effects import EMPTY, INTERACTION, MAIN, Effect, effects
from timber_research.screening.responses import COUNT as NUMBER
from timber_research.screening.responses import LOG, RESPONSES, SHARE
from timber_houses.house import build_house, load_house
from timber_houses.run.options import RunOptions

NAMES = [factor.name for factor in FACTORS]
COUNT = len(FACTORS)
MOTIONS = [cells.synthetic(3, 15.0, 29.0), cells.synthetic(0, 15.0, 29.0)]


# --- houses of the cells ----------------------------------------------------------------------------------------------


def described(folder, house, **second):
    """House of a cell with the named factors at the second level."""
    path = folder / f"{house}.yaml"
    path.write_text(yaml.safe_dump(house_entries(house, FACTORS, [1 if second.get(name) else -1 for name in NAMES])))
    return load_house(path)


def built(folder, house, **second):
    return build_house(described(folder, house, **second))


def values(model, kind):
    """{(kn, strength, per)} of the joints of a kind."""
    found = {(joint.kn, joint.strength, joint.per) for joint in model.joints if joint.kind == kind}
    assert len(found) == 1
    return found.pop()


def test_names_are_different():
    assert len(set(NAMES)) == COUNT == 12 and all(len(factor.levels) == 2 for factor in FACTORS)


@pytest.mark.parametrize("house", ["A", "B1", "C2"])
def test_every_factor_changes_the_houses_that_it_should(tmp_path, house):
    """Each factor alone, from the first levels."""
    only = {"braces_c": "C", "inner_columns": "AB"}
    first = described(tmp_path, house).data
    changing = [name for name in NAMES if described(tmp_path, house, **{name: True}).data != first]
    assert changing == [name for name in NAMES if house[0] in only.get(name, "ABC")]


def test_connections(tmp_path):
    first, second = built(tmp_path, "B1"), built(
        tmp_path, "B1", **dict.fromkeys(("brace_sides", "reading", "fittings", "beams", "floors"), True))
    kinds = [set(model.counts()["joints_by_kind"]) for model in (first, second)]
    assert kinds[1] - kinds[0] == {"brace_column", "beam_beam"}
    assert values(first, "column_beam") == (58800, 5880, "spring")
    assert values(second, "column_beam") == (2 * 58800, 2 * 5880, "joint")
    assert values(first, "floor_beam") == values(first, "roof_beam") == (1e7, math.inf, "joint")
    assert values(second, "floor_beam") == values(second, "roof_beam") == (58800, 5880, "joint")


def test_columns_on_the_foundation(tmp_path):
    first, second = built(tmp_path, "C"), built(tmp_path, "C", supports=True)
    assert first.of_kind("sill") and not second.of_kind("sill")
    feet = [{model.element(joint.b).kind for joint in model.joints if joint.end == "bottom" and joint.storey == 1}
            for model in (first, second)]
    assert feet == [{"sill"}, {"foundation"}]
    assert first.counts()["joints_by_kind"] == second.counts()["joints_by_kind"]


def test_two_factors_change_friction(tmp_path):
    own = {a: c for a, b, c in built(tmp_path, "B", friction=True, snow_friction=True).friction}
    assert own == {"timber": 0.3, "roofing": 2.0, "snow": 2.0}


def test_damage(tmp_path):
    first, second = built(tmp_path, "B1",
                          brace_sides=True), built(tmp_path, "B1", brace_sides=True, damaged_end=True, plate=True)
    assert first.counts()["broken_by_kind"] == {"column_beam": 8, "brace_beam": 2}
    assert second.counts()["broken_by_kind"] == {"column_beam": 8, "brace_beam": 2, "brace_column": 2}
    assert [{joint.end for joint in model.joints if joint.broken} for model in (first, second)] == [{"bottom"}, {"top"}]


def test_braces_of_c_lean_the_other_way(tmp_path):
    names = [{element.name
              for element in built(tmp_path, "C", braces_c=turned).of_kind("brace")}
             for turned in (False, True)]
    assert "main.brace1.NS.y0.0-1" not in names[0] and len(names[0]) == len(names[1]) == 44
    turned = {
        f"{head}.{'-'.join(reversed(bay.split('-')))}"
        for head, bay in (name.rsplit(".", 1) for name in names[0])
    }
    assert turned == names[1]


# --- batch ------------------------------------------------------------------------------------------------------------


def test_plan_and_table(tmp_path):
    """Cell by cell; runs without an earthquake once a cell; every row is a run that stops at collapse."""
    planned = cells.plan(MOTIONS, 4e-4)
    assert [entry.cell for entry in planned] == sorted(entry.cell for entry in planned)
    assert len(planned) == 32 * (11 * 2 + 3)
    assert {entry.run
            for entry in planned} == set(RUNS) and {entry.motion
                                                    for entry in planned} == {"seed3", "seed0", None}
    some = [entry for entry in planned if entry.cell == 5]
    cells.write_houses(some, tmp_path)
    options = {(entry.run, entry.motion): entry.row(tmp_path).task(tmp_path).options for entry in some}
    house = str(tmp_path / "houses" / "c05" / "B1.yaml")
    assert options["modelB1_snow", "seed0"] == RunOptions(
        house=house, quake=True, snow=1.0, dt=4e-4, until_collapse=True, seed=0, start=15.0, end=29.0, no_frames=True)
    assert options["modelB_snow", None] == RunOptions(
        house=str(tmp_path / "houses" / "c05" / "B.yaml"), snow=1.0, dt=4e-4, until_collapse=True, no_frames=True)
    assert load_house(house).name == "B1"


def test_unchanged_houses_are_not_written_again(tmp_path):
    planned = cells.plan(MOTIONS, 4e-4)[:1]
    cells.write_houses(planned, tmp_path)
    house = tmp_path / cells.house_file(0, "A")
    before = house.stat().st_mtime_ns
    cells.write_houses(planned, tmp_path)
    assert house.stat().st_mtime_ns == before


# --- responses --------------------------------------------------------------------------------------------------------


def summary(ns=0.02, ew=0.01, lean=0.01, springs=0, collapsed=False, west=(0, 0), lost=0):
    """A Summary with the entries that responses use."""
    places = {side: {"total": sum(west), "column_beam": west[0], "brace_beam": west[1]} for side in ("north", "west")}
    times = {"collapse_time_s": 9.0, "leans_from_s": 5.0, "tilt_time_s": 6.0, "tilt_direction": "ns"
             } if collapsed else {}
    return sample_summary(record={"onset_s": 4.0}, peak_drift={
        "storey1": {"ns": ns, "ew": ew}, "storey2": {"ns": 0.0, "ew": None}
    }, residual_drift={"storey1": {"ns": 0.0, "ew": lean}, "storey2": {"ns": lean / 2, "ew": 0.0}}, joints={
        "total": 100
    }, broken={"springs": springs, "total": springs // 4, "by_place": {"1": places}},
                          columns={"total": 90, "fallen": lost}, collapsed=collapsed, **times)


def response(name, **runs):
    return RESPONSES[name].of({f"model{run}": found for run, found in runs.items()})


def test_responses():
    """Ratios of ten, so that the logarithms are whole numbers; rounding is the only error."""
    wreck = summary(ns=0.3, collapsed=True)
    assert response("falls_B", B_quake=summary()) == 0 and response("falls_B", B_quake=wreck) == 1
    assert response("drift_B", B_quake=summary(ns=0.01, ew=0.001)) == pytest.approx(-2)
    assert response("drift_B", B_quake=wreck) == response("drift_B", B_quake=summary(ns=3.0)) == 0
    assert response("across_B1", B1_quake=summary(ns=0.01, ew=0.1)) == pytest.approx(1)
    assert response("across_B2", B2_quake=summary(ns=0.01, ew=0.1)) == pytest.approx(-1)
    assert response("C1_over_B1", C1_quake=summary(ns=0.02), B1_quake=summary(ns=0.2)) == pytest.approx(-1)
    assert response("column_beam_west_B1", B1_quake=summary(west=(3, 1))) == 3
    assert response("brace_beam_north_B2", B2_quake=summary(west=(3, 1))) == 1
    assert response("snow_damage_C1", C1_snow=summary(springs=99), C1_quake=summary(springs=0)) == pytest.approx(2)
    assert response("snow_damage_C1", C1_snow=wreck,
                    C1_quake=summary(springs=400)) == 0, "a collapse counts as broken in all springs"
    assert response("snow_lean_B2", B2_snow=summary(lean=0.1), B2_quake=summary(lean=0.001)) == pytest.approx(2)
    assert response("snow_lean2_C2", C2_snow=summary(lean=0.2), C2_quake=summary(lean=0.02)) == pytest.approx(1)
    assert response("snow_columns_B1", B1_snow=summary(lost=5), B1_quake=summary(lost=2)) == 3
    assert response("E2", B_quake=summary()) == 1 and response("E2", B_quake=wreck) == 0
    assert math.isnan(response("C1_over_B1", C1_quake=summary()))


def test_number_of_claims():
    runs = {run: summary() for run in RUNS}
    assert RESPONSES["claims"].of(runs) == sum(RESPONSES[name].of(runs) for name in CLAIMS) > 0
    assert math.isnan(RESPONSES["claims"].of({run: summary() for run in RUNS[1:]}))


def test_collect():
    """Missing runs become NaN; cells and motions without results are left out; runs without an earthquake count under
    every motion.
    """
    planned = [
        entry for entry in cells.plan([*MOTIONS, cells.synthetic(9, 15.0, 29.0)], 4e-4) if entry.cell in (2, 3, 4)
    ]
    missing = {(3, "modelB_quake", "seed0")}
    known = [entry.cell < 4 and entry.motion != "seed9" and (entry.cell, entry.run, entry.motion) not in missing
             for entry in planned]
    results = collect(planned, [summary() if is_known else None for is_known in known])
    assert results.cells == [2, 3] and results.motions == ["seed3", "seed0"]
    assert np.isnan(results.values["falls_B"]).tolist() == [[False, False], [False, True]]
    assert np.isnan(results.typical("falls_B")).tolist() == [False, True]
    assert not np.isnan(results.values["S2"]).any()


# --- effects ----------------------------------------------------------------------------------------------------------

LEVELS = design.levels(COUNT)
MAINS = {0: 0.8, 5: -0.3, 11: 0.1}
PAIR, PAIR_EFFECT = (2, 7), 0.4


def synthetic(motions=(0.0,)):
    """(motions, 32) a response with these effects, and a shift for each motion."""
    response = 1 + sum(LEVELS[:, k] * effect / 2
                       for k, effect in MAINS.items()) + LEVELS[:, PAIR[0]] * LEVELS[:, PAIR[1]] * PAIR_EFFECT / 2
    return np.array([response + shift for shift in motions])


def found(response, numbers=range(32), typical=np.median):
    return effects(response, list(numbers), COUNT, typical)


def mains(effects):
    return {effect.factors[0]: effect.value for effect in effects if effect.kind == MAIN}


def test_effects_are_recovered():
    """To rounding: the design is orthogonal."""
    result = found(synthetic((0.0, 0.5, -0.1)))
    assert mains(result) == pytest.approx({k: MAINS.get(k, 0.0) for k in range(COUNT)}, abs=1e-12)
    strings = {effect.factors: effect.value for effect in result if effect.kind == INTERACTION}
    assert {pairs: value
            for pairs, value in strings.items()
            if abs(value) > 1e-12} == {next(pairs for pairs in strings if PAIR in pairs): pytest.approx(PAIR_EFFECT)}
    assert len(result) == 31 and all(abs(effect.value) < 1e-12 for effect in result if effect.kind == EMPTY)
    assert all(effect.error < 1e-12 for effect in result), "a shift of all cells is no effect"
    assert {effect.word
            for effect in result
            if effect.stands_out} == {design.words(COUNT)[k]
                                      for k in MAINS} | {design.times(*(design.words(COUNT)[k] for k in PAIR))}


def test_missing_cells():
    """Some missing cells: least squares, still exact without noise. The first half: main effects, confounded with
    interactions. Few cells: nothing.
    """
    most = [k for k in range(32) if k not in (4, 9)]
    response = synthetic()[:, most]
    response[0, 6] = np.nan
    assert mains(found(response, most)) == pytest.approx({k: MAINS.get(k, 0.0) for k in range(COUNT)}, abs=1e-12)
    half = mains(found(synthetic()[:, :16], range(16)))
    basic = design.runs()[:16]
    alias = {k: PAIR_EFFECT * LEVELS[:16, k] @ (LEVELS[:16, PAIR[0]] * LEVELS[:16, PAIR[1]]) / 16 for k in range(COUNT)}
    assert half == pytest.approx({k: MAINS.get(k, 0.0) + alias[k] for k in range(COUNT)}, abs=1e-12)
    assert len(basic) == 16
    assert found(synthetic()[:, :12], range(12)) == [] and found(synthetic()[:, :0], []) == []


def test_errors_come_from_the_motions():
    """One effect differs between the motions: the error of the mean is s / sqrt(n). The bootstrap with 2000 resamples
    errs by 2 %; allowed 5 %.
    """
    own = np.array([0.1, 0.5, 0.3, 0.9, 0.2])
    result = found(LEVELS[:, 3] * own[:, None] / 2, typical=np.mean)
    errors = {effect.factors: effect.error for effect in result}
    assert errors[(3,)] == pytest.approx(own.std(ddof=1) / math.sqrt(len(own)), rel=0.05)
    assert all(error < 1e-12 for factors, error in errors.items() if factors != (3,))
    alone = next(effect for effect in found(LEVELS[:, 3][None] * 0.5) if effect.factors == (3,))
    assert math.isnan(alone.error) and not alone.stands_out


def test_an_effect_within_chance_does_not_stand_out():
    """The columns without a factor have effects of 0.2: one of 0.3 is within twice that, one of 0.5 is not."""
    empty = sum(design.column(word, design.runs()) for word in design.empty_words(COUNT)) * 0.1
    result = found(np.array([empty + LEVELS[:, 0] * 0.15 + LEVELS[:, 1] * 0.25] * 3))
    assert [effect.factors for effect in result if effect.stands_out] == [(1,)]
    assert all(effect.chance == pytest.approx(0.2) for effect in result)


# --- tables and picture -----------------------------------------------------------------------------------------------


@pytest.fixture
def results():
    random = np.random.default_rng(1)
    shape = synthetic((0.0, 0.1, -0.1))
    return Results(list(range(32)), ["seed3", "seed0", "KOBE"],
                   {name: shape + random.normal(0, 0.01, shape.shape)
                    for name in RESPONSES})


def test_report(results, tmp_path):
    paths = report.write(results, tmp_path)
    assert [path.name for path in paths] == ["screening.csv", "effects.csv", "screening.md"]
    header, *rows = (tmp_path / "screening.csv").read_text().splitlines()
    assert header.split(",")[:3] == ["cell", "motions", NAMES[0]] and len(rows) == 32 and rows[0].startswith("c00,3,")
    text = (tmp_path / "screening.md").read_text()
    assert "32 of 32 cells under 3 motions: seed3, seed0, KOBE." in text and "of both kinds" in text
    assert "not complete" not in text
    line = next(line for line in text.splitlines() if line.startswith("| C / B: largest drift |") and " x " in line)
    assert line.split("|")[2].strip().startswith("**x 6.") and not line.split("|")[3].strip().startswith(
        "**")  # 10**0.8 = 6.31
    aliases = (tmp_path / "effects.csv").read_text()
    assert f"{NAMES[2]} x {NAMES[7]}" in aliases and aliases.count("no factor (bce)") == len(RESPONSES)


@pytest.mark.rare
def test_report_of_half_a_design(results, tmp_path):
    """No column is without a factor: a dash in its place, and no word of a second kind of errors. The picture has rows
    of factors only.
    """
    half = Results(list(range(16)), results.motions, {name: shape[:, :16] for name, shape in results.values.items()})
    report.write(half, tmp_path)
    text = (tmp_path / "screening.md").read_text()
    line = next(line for line in text.splitlines() if line.startswith("| C / B: largest drift |") and " x " in line)
    assert line.endswith(
        "| – |") and "of both kinds" not in text and "16 of 32 cells" in text and "root mean" not in text
    tested = COUNT * len(RESPONSES)
    assert f"of the {tested} effects tested" in text and f"some {0.0455 * tested:.0f} there" in text
    rows = (tmp_path / "effects.csv").read_text().splitlines()[1:]
    assert len(rows) == tested and all(row.split(",")[-2] == "" for row in rows)
    full, part = (picture.draw(made, tmp_path / "effects.png").read_bytes()[16:24] for made in (results, half))
    assert full[:4] == part[:4] and full[4:] > part[4:], "same width [pixels], lower"


def test_report_of_few_cells(results, tmp_path):
    few = Results([0, 1], results.motions, {name: shape[:, :2] for name, shape in results.values.items()})
    report.write(few, tmp_path)
    text = (tmp_path / "screening.md").read_text()
    assert "2 of 32 cells" in text and "not complete" in text and "do not determine" in text
    assert picture.draw(few, tmp_path / "few.png").is_file()


def test_report_of_one_motion(results, tmp_path):
    """No scatter: effects without errors, and no word of tests."""
    one = Results(results.cells, results.motions[:1], {name: shape[:1] for name, shape in results.values.items()})
    report.write(one, tmp_path)
    text = (tmp_path / "screening.md").read_text()
    assert "32 of 32 cells under 1 motion: seed3." in text and "One motion has no scatter" in text
    assert not any(word in text for word in ("Bold", "bootstrap", "tested are"))


@pytest.mark.rare
def test_picture(results, tmp_path):
    assert picture.draw(results, tmp_path / "screening.png").stat().st_size > 50000
    assert set(picture.SHOWN) <= set(RESPONSES)


def test_text_of_values():
    effect = Effect(MAIN, "a", (0,), 0.59, 0.12, math.nan)
    assert [report.effect_text(kind, effect)
            for kind in (LOG, SHARE, NUMBER)] == ["**x 3.89 (1.32)**", "**+59 pp (12)**", "**+0.59 (0.12)**"]
    assert [report.value_text("drift_A", value) for value in (0.0, -1.0, -0.3)] == ["falls", "1/10", "0.50"]
    assert report.value_text("C_over_B", math.log10(2)) == "2"
    assert report.value_text("falls_A", 0.25) == "25 %"
    assert report.value_text("claims", math.nan) == ""
