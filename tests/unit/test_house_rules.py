# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""House files at the edges of the rules: ground floors, part roofs, torn braces, leaning columns, names, empty lists.
Needs no YADE.
"""
import numpy as np
import pytest
from timber_houses.house import HouseError, build_house, diagnose, load_house, weigh
from timber_houses.house.weight import sentence

SILL, COLUMNS, BEAMS = ("{layer: sill, height: 0.12, width: 0.12}", "{layer: columns, height: 2.7}",
                        "{layer: beams, height: 0.24, width: 0.12}")
FLOOR, FLAT = "{layer: floor, thickness: 0.1}", "{layer: roof, type: flat, thickness: 0.12, material: roofing}"


@pytest.fixture
def house(tmp_path):
    """Builds house B with changes, a YAML text."""

    def built(changes=""):
        (tmp_path / "own.yaml").write_text(f"extends: B\nname: own\n{changes}")
        return build_house(load_house(tmp_path / "own.yaml"))

    return built


def stack(*layers):
    return "structures:\n  main:\n    stack:\n" + "".join(f"      - {layer}\n" for layer in layers)


def pairs(model):
    return {tuple(sorted((model.element(joint.a).kind, model.element(joint.b).kind))) for joint in model.joints}


def test_a_ground_floor_is_joined_to_its_sill(house):
    model = house(stack(SILL, FLOOR, COLUMNS, BEAMS, FLAT))
    assert ("floor", "sill") in pairs(model)


@pytest.mark.parametrize("end", [3, 5, 8])
def test_posts_of_a_roof_over_a_part_of_the_grid(house, end):
    """They stand below the slab, along its whole high side."""
    area = "" if end == 8 else f", area: {{x: [0, {end}], y: [0, 9]}}"
    roof = f"{{layer: roof, type: mono, pitch: 0.2, falls: south, thickness: 0.12, material: roofing{area}}}"
    model = house(stack(SILL, COLUMNS, BEAMS, roof))
    slab = np.concatenate([e.vertices for e in model.of_kind("roof")])
    posts = np.concatenate([
        joint.points
        for joint in model.joints
        if "roof" in (model.element(joint.a).kind, model.element(joint.b).kind) and np.mean(joint.points, axis=0)[1] > 7
    ])
    assert posts[:, 0].max() <= slab[:, 0].max() + 1e-9 and posts[:, 0].max() > min(slab[:, 0].max(), 0.91 * end) - 0.2
    assert posts[:, 0].min() < 0.2


def test_torn_braces_do_not_count(house):
    whole, torn = (diagnose(house(damage))
                   for damage in ("", "damage: {regions: [{side: south, storey: 1, brace_beam: {count: 2}}]}\n"))
    key = lambda found: found["structures"]["main"]["storeys"]["1"]["directions"]["ew"]["wall_quantity_ratio"]
    assert key(torn) == pytest.approx(key(whole) / 2, abs=6e-4)  # three digits


def test_a_leaning_house_has_the_same_uplift(house):
    plumb, leaning = (diagnose(house(text))["structures"]["main"]["uplift"] for text in ("", "plumb: {drift: 0.005}\n"))
    assert plumb == leaning


def test_the_kind_of_a_rule_does_not_change_the_uplift(house):
    named, own = (diagnose(house(text))["structures"]["main"]["uplift"]
                  for text in ("", "joints: {column_ends: {kind: column_end}}\n"))
    assert named == own


def test_damage_of_two_regions_adds_up(house):
    region = "{side: south, storey: 1, column_beam: {count: 2}}"
    assert sum(joint.broken for joint in house(f"damage: {{regions: [{region}, {region}]}}\n").joints) == 4


def test_an_unrated_main_structure_has_no_index(house):
    """Four storeys: the annex does not speak for it."""
    found = diagnose(house(stack(SILL, *3 * [COLUMNS, BEAMS, FLOOR], COLUMNS, BEAMS, FLAT)))
    assert found["iw"] is None and found["sentence"].startswith("no seismic index")


def test_weight_of_all_structures():
    weights = weigh(build_house(load_house("l_house")))
    total = sum(structure["1"]["carried_kn"] for structure in weights["storeys"].values())
    assert len(weights["storeys"]) == 2 and f"storey 1 {total:.0f} kN" in sentence(weights)


@pytest.mark.parametrize("changes, words", [
    ("damage: {regions: [{side: south, storey: 1}]}", "give column_beam or brace_beam"),
    ("wall_types: {window: {multiplier: 2}}", "wall_types.window: the name of an opening"),
    ("structures: {main: {walls: [{along: x, at: 0, from: 2, to: 4, type: []}]}}",
     "walls[1].type: a list of 0 items"),
    ("structures: {main: {place: {gap: 3}}}", "place.gap: belongs to 'beside'"),
    ("structures: {main: {place: {align: north}}}", "place.align: belongs to 'beside'"),
])
def test_entries_without_effect_are_refused(house, changes, words):
    with pytest.raises(HouseError) as refusal:
        house(changes + "\n")
    assert words in str(refusal.value)


@pytest.mark.parametrize("strength, refused", [("21000", False), ("200000", True), (".inf", True)])
def test_strength_of_a_rule_for_yielding_joints(tmp_path, strength, refused):
    (tmp_path /
     "own.yaml").write_text(f"extends: storehouse\nname: own\njoints: {{column_ends: {{strength: {strength}}}}}\n")
    if refused:
        with pytest.raises(HouseError, match="joints.column_ends.strength: must be below"):
            load_house(tmp_path / "own.yaml")
    else:
        load_house(tmp_path / "own.yaml")


def ends(model):
    """{(column, end): its joints}"""
    joints = {}
    for joint in model.joints:
        if joint.end and model.element(joint.a).kind == "column":
            joints.setdefault((joint.a, joint.end), []).append(joint)
    return joints


def test_an_end_on_two_members_has_its_fittings_once(tmp_path):
    """Columns of 15 cm at corners of beams 12 cm wide touch the beam that ends there as well: 1.5 cm x 12 cm."""
    text = load_house("storehouse").path.read_text()
    path = tmp_path / "own.yaml"
    path.write_text(text.replace("section: 0.12 ", "section: 0.15 ", 1).replace("name: storehouse", "name: own"))
    single, double = ends(build_house(load_house("storehouse"))), ends(build_house(load_house(path)))
    assert {len(joints) for joints in single.values()} == {1} and max(map(len, double.values())) == 2
    strength, stiffness = single["store.column1.x0y0", "top"][0].strength, single["store.column1.x0y0", "top"][0].kn
    for joints in double.values():
        assert sum(joint.strength for joint in joints) == pytest.approx(strength)
        assert sum(joint.kn for joint in joints) == pytest.approx(stiffness)
        assert [joint.strength / strength for joint in joints] == pytest.approx(
            [joint.area / sum(other.area for other in joints) for joint in joints])


def test_a_rule_between_structures_that_do_not_touch_is_refused(tmp_path):
    (tmp_path / "own.yaml").write_text(
        "extends: A\nname: own\njoints:\n"
        "  tie: {between: [column, column], type: corner_fitting, kind: tie, across: true}\n")
    with pytest.raises(HouseError, match="own.yaml:4: joints.tie: 'across: true' joins no two structures"):
        build_house(load_house(tmp_path / "own.yaml"))
