# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Required wall quantity beside published worked examples and sums by hand, for both rules."""
from math import ceil

import pytest
from test_house_plan import L_WALLS, house_file, write
from timber_houses.house import build_house, diagnose, load_house
from timber_houses.house.wall_quantity import (RULES, Loads, Storeys, carried, required_1981, required_2025,
                                               shear_factors, wall_load)


def test_example_of_the_ministrys_sheet():
    """The input example of the calculation sheet (Howtec, post-and-beam, 2025): two storeys of 3.0 m and 60 m2, ridge
    0.5 m above the eaves, eaves 0.5 m, pitch 0.4, slates with solar panels, siding: 44 and 25 cm/m2. The sheet's house
    stands on 0.5 m of foundation and sill. Repeated in github.com/you0810jmsdf/pascal-editor, kenchiku-spec 6.2."""
    roof = (16.5 + 2 * 0.5) * (6.0 + 2 * 0.5) * (1 + 0.4**2)**0.5 / (16.5 * 6.0)
    storeys = Storeys((60.0, 60.0), (3.0, 3.0), 0.5 / 2 + 3.0 + 3.0 + 0.5)
    assert required_2025(storeys, Loads(740, 600, solar=200, roof_share=roof)) == [44, 25]


def test_example_of_a_storey_below_another():
    """Slates, siding, gypsum boards, panels on half of the roof, insulation, triple glass: in N per m2 of floor
    1000 + 130 + 100 + 1.5 (700 + 200 + 90 + 50) + 610 + 600 = 4000, so 0.2 x 4.0 / 0.0196 = 40.8: 41 cm/m2
    (collaboplaza.com, page 8807). The parts of the walls are those of the sheet at a storey height of 2.8 m."""
    assert wall_load(600, 2.8) == pytest.approx(0.700 + 0.200 + 0.090 + 0.050)
    storeys = Storeys((1.0, 1.0), (2.8, 2.8), 7.0)
    assert carried(storeys, Loads(1000, 600, solar=130))[0] == pytest.approx(4.0)
    assert required_2025(storeys, Loads(1000, 600, solar=130))[0] == 41


def test_a_house_of_one_storey():
    """500 + 100 + (0.4137 x 2.8 x 350 up to 410, insulation 90, windows 50, inner walls 200) / 2 = 975 N/m2."""
    assert required_2025(Storeys((50.0,), (2.8,), 4.0), Loads(500, 350)) == [ceil(0.2 * 0.975 / 0.0196)] == [10]


def test_shear_factors():
    """Ai of a share of 0.25 at T = 0.3 s: 1 + (2 - 0.25) 0.6 / 1.9; the first storey's is 1."""
    assert shear_factors([4.0, 1.0], 10.0) == pytest.approx([1.0, 1 + 1.75 * 0.6 / 1.9])


def test_snow_on_request():
    """1 m of snow, 3 kN/m2, adds 0.35 of it: 0.2 x 1.05 / 0.0196 = 10.7 cm/m2."""
    storeys, bare = Storeys((50.0,), (2.8,), 4.0), 0.2 * 0.975 / 0.0196
    assert required_2025(storeys, Loads(500, 350, snow=3.0)) == [ceil(bare + 0.2 * 1.05 / 0.0196)]


def test_table_until_2025():
    assert [required_1981(roof, 2) for roof in ("light", "heavy", "very_heavy")] == [(29, 15), (33, 21), (33, 21)]
    assert RULES["table_1981"].largest_multiplier == 5 and RULES["weights_2025"].largest_multiplier == 7


def diagnosis(folder, more="", walls=L_WALLS, shape="L"):
    model = build_house(load_house(write(folder, "house", house_file(shape, walls, more))))
    return diagnose(model)


def test_an_l_by_hand(tmp_path):
    """L of 44 m2, both storeys. Flat roof of 0.5 kN/m2: metal; its slabs of 8.12 x 4.06 and 4.12 x 3.06 m have 1.036 m2
    per m2 of floor. Walls of 1.0 + 0.15 kN/m2 are heavier than every kind and count as 1150 N/m2. Heights from feet to
    feet 2.92 m and to the top of the beams 2.82 m; that top lies 6.16 m above the ground, the ridge 0.12 m higher."""
    found = diagnosis(tmp_path)
    main = found["structures"]["main"]
    surface = (8.12 * 4.06 + 4.12 * 3.06) / 44
    roof = (surface * 500 + 100) / 1000
    walls = [(10 * (ceil(0.91 * 45 * h / 99 * 1150 / 10) + ceil(0.91 * 45 * h / 99 * 70 / 10)
                    + ceil(0.09 * 45 * h / 99 * 400 / 10)) + 200 * h / 2.8) / 1000 for h in (2.92, 2.82)]
    w2 = roof + walls[1] / 2
    w1 = roof + walls[1] + 1.21 + walls[0] / 2
    t = 0.03 * (0.3 + 0.12 + 2.7 + 0.12 + 0.1 + 2.7 + 0.12 + 0.06)
    a2 = 1 + ((w1 / w2)**0.5 - w2 / w1) * 2 * t / (1 + 3 * t)
    required = [ceil(0.2 * w1 / 0.0196), ceil(a2 * 0.2 * w2 / 0.0196)]
    assert [main["storeys"][k]["required_cm_m2"] for k in "12"] == required
    assert main["weights"]["1"]["carried_kn"] == pytest.approx(44 * w1, abs=1e-2)
    assert main["kinds"] == {"roof": "metal", "wall": "own"}
    one = main["storeys"]["1"]["directions"]["ew"]
    assert one["required_quantity_m"] == pytest.approx(44 * required[0] / 100, abs=1e-3)
    assert one["wall_quantity_ratio"] == pytest.approx(15 / (44 * required[0] / 100), abs=1e-3)


def test_the_rule_is_named(tmp_path):
    assert "by the rule of 1 April 2025" in diagnosis(tmp_path)["sentence"]
    old = diagnosis(tmp_path, "diagnosis: {rule: table_1981}\n")
    assert old["rule"] == "table of 1981, until 31 March 2025" and old["rule"] in old["sentence"]
    assert [old["structures"]["main"]["storeys"][k]["required_cm_m2"] for k in "12"] == [29, 15]


def test_quasi_bearing_walls_count_up_to_half(tmp_path):
    """Gypsum on panels of 0.9 of the clear height: 0.9 x 0.6 x 0.9 = 0.486; on all 8 + 8 m of two lines of an L."""
    panels = ", {along: x, at: 0, from: 0, to: 8, type: gypsum_lining, panel: 0.9}"
    few = diagnosis(tmp_path, walls=L_WALLS + panels)["structures"]["main"]["storeys"]["1"]["directions"]["ew"]
    assert few["quasi_bearing_m"] == pytest.approx(8 * 0.486, abs=1e-3)
    assert few["wall_quantity_m"] == pytest.approx(15 + 8 * 0.486, abs=1e-3)
    many = ", ".join(f"{{along: x, at: {at}, from: {low}, to: {high}, type: plywood, panel: 1.0}}"
                     for at, low, high in ((0, 0, 8), (4, 4, 8), (7, 0, 4)))
    all_ = diagnosis(tmp_path, walls=many)["structures"]["main"]["storeys"]["1"]["directions"]["ew"]
    assert all_["quasi_bearing_m"] == pytest.approx(16 * 1.5, abs=1e-3)
    assert all_["wall_quantity_m"] == pytest.approx(all_["required_quantity_m"] / 2, abs=1e-3)
    old = diagnosis(tmp_path, "diagnosis: {rule: table_1981}\n", walls=many)["structures"]["main"]["storeys"]["1"]
    assert old["directions"]["ew"]["wall_quantity_m"] == 0


@pytest.mark.parametrize("rule, largest", (("weights_2025", 7), ("table_1981", 5)))
def test_largest_multiplier_of_a_bay(tmp_path, rule, largest):
    """Plywood twice 2.5 (as two types) and mud and mortar 1.0 each: 7.0 together, capped at 5 until 2025."""
    walls = ("{along: x, at: 0, from: 0, to: 1, type: [plywood, mortar, mud, second, third]}")
    text = f"diagnosis: {{rule: {rule}}}\nwall_types: {{second: {{multiplier: 2.5}}, third: {{multiplier: 1.0}}}}\n"
    one = diagnosis(tmp_path, text, walls)["structures"]["main"]["storeys"]["1"]["directions"]["ew"]
    assert one["bearing_m"] == largest


def test_a_quarter_without_an_upper_storey_is_a_house_of_one(tmp_path):
    """Upper storey over the bar of the L only: the north quarter of storey 1 has no storey above it."""
    text = house_file("L", L_WALLS.replace("type", "storeys: 1, type"), "diagnosis: {rule: table_1981}\n")
    first, rest = text.split("    columns:\n")
    rest = rest.replace("        lines:\n", "        storeys: 1\n        lines:\n", 1)
    upper = "      - section: 0.12\n        storeys: 2\n        grid: {x: [0, 2, 4, 6, 8], y: [0, 4]}\n"
    model = build_house(load_house(write(tmp_path, "stepped", f"{first}    columns:\n{upper}{rest}")), check=False)
    one = diagnose(model)["structures"]["main"]["storeys"]["1"]["directions"]["ew"]
    assert one["quarters"] == pytest.approx([5 / (14 * 0.29), 5 / (7 * 0.11)], abs=1e-3)
