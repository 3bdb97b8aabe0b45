# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Connections of house files: named rules, number and share of fittings, own strength, torn plates, damping."""
import pytest
from timber_houses.house import build_house, load_house

PLATES = """
joints:
  brace_ends: {share: 0.4}
  brace_sides: {between: [column, brace], share: 0.6}
"""


def built(tmp_path, text, extends="B"):
    path = tmp_path / "house.yaml"
    path.write_text(f"extends: {extends}\nname: mine\n{text}")
    return build_house(load_house(path))


def of_kind(model, kind):
    found = [joint for joint in model.joints if joint.kind == kind]
    assert found
    return found


def test_rules_are_added_changed_and_removed_by_name(tmp_path):
    shipped = build_house(load_house("B")).counts()["joints_by_kind"]
    more = built(
        tmp_path,
        "joints: {slabs: {between: [floor, column], type: corner_fitting, kind: slab_column}, column_ends: {between: "
        "[column, [foundation, beam]]}}"
    ).counts()["joints_by_kind"]
    less = built(tmp_path, "joints: {ridges: null}").counts()["joints_by_kind"]
    renamed = built(tmp_path, "joints: {floors: {kind: slab}}").counts()["joints_by_kind"]
    moved = more.pop("slab_column")
    assert moved > 0 and more == {**shipped, "column_beam": shipped["column_beam"] - moved}
    assert shipped["roof_roof"] > 0 and less == {kind: n for kind, n in shipped.items() if kind != "roof_roof"}
    assert renamed["slab"] == shipped["floor_beam"]


def test_a_plate_on_beam_and_column_shares_its_values(tmp_path):
    model = built(tmp_path, PLATES)
    ends, sides = of_kind(model, "brace_beam"), of_kind(model, "brace_column")
    assert len(ends) == 2 * 16 == len(sides)  # two ends of 16 braces
    assert {(joint.a, joint.end) for joint in ends} == {(joint.a, joint.end) for joint in sides}
    for joints, share in ((ends, 0.4), (sides, 0.6)):
        for joint in joints:
            assert (joint.kn, joint.ks, joint.strength) == pytest.approx((share * 69580, share * 69580, share * 6958))


def test_number_of_fittings_and_own_strength(tmp_path):
    joints = of_kind(built(tmp_path, "joints: {column_ends: {number: 2}}"), "column_beam")
    assert {(joint.kn, joint.strength) for joint in joints} == {(2 * 58800, 2 * 5880)}
    joints = of_kind(built(tmp_path, "joints: {column_ends: {number: 2, strength: 9000}}"), "column_beam")
    assert {(joint.kn, joint.strength) for joint in joints} == {(2 * 58800, 9000)}


@pytest.mark.parametrize("plate, torn", [("whole", 2), ("beam", 0)])
def test_a_torn_plate_loses_its_joints_with_the_column_too(tmp_path, plate, torn):
    """House B1: two brace-beam joints of the east wall are broken."""
    model = built(tmp_path, f"{PLATES}damage: {{plate: {plate}}}", extends="B1")
    broken = [joint for joint in of_kind(model, "brace_column") if joint.broken]
    assert sum(joint.broken for joint in of_kind(model, "brace_beam")) == 2
    assert len(broken) == torn and all("east" in joint.side and joint.storey == 1 for joint in broken)


def test_damping_of_the_law_and_of_a_type(tmp_path):
    model = built(tmp_path, "law: {joint_damping: 0.02}\njoint_types: {bracing_plate: {damping_ratio: 0.1}}")
    ratios = {joint.type: joint.damping_ratio for joint in model.joints}
    assert ratios["bracing_plate"] == 0.1 and set(ratios.values()) == {0.02, 0.1}


def test_values_of_the_slip_law_reach_the_joint(tmp_path):
    slip = "law: slip, friction_share: 0.3, softening_stretch: 0.15, ultimate_stretch: 0.2"
    joint = of_kind(built(tmp_path, f"joint_types: {{corner_fitting: {{{slip}}}}}"), "column_beam")[0]
    assert (joint.law, joint.friction_share, joint.softening_stretch,
            joint.ultimate_stretch) == ("slip", 0.3, 0.15, 0.2)
    assert of_kind(build_house(load_house("B")), "column_beam")[0].law == "brittle"


def test_hold_down(tmp_path):
    """One spring at the axis of the column, with all of the fitting's strength."""
    model = built(tmp_path, "joints: {column_ends: {type: hold_down, number: 2, share: 0.67}}", "tiled_house")
    joints = [joint for joint in model.joints if joint.type == "hold_down"]
    assert joints and all(joint.points.shape == (1, 3) for joint in joints)
    for joint in joints:
        column = model.element(joint.a)
        assert joint.points[0][:2] == pytest.approx(column.solid.centroid[:2], abs=1e-9)
    assert sum(j.strength for j in joints if j.a == joints[0].a and j.end == "bottom") == pytest.approx(26800)
