# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""`frame` in house files: ends, sections, cuts, copies, plates, storeys, joints by rules, gaps and names, loads,
damage; messages with file, line, member and remedy.
"""
import re
import warnings

import numpy as np
import pytest
from timber_houses.base.gravity import weight_of
from timber_houses.house import HouseError, build_house, changed_house, diagnose, load_house, weigh
from timber_houses.house.check import warn_of_missing_joints

PORTAL = """\
extends: frame
name: portal
frame:
  members:
    sill: {from: [0, -0.2, 0.1], to: [0, 4.2, 0.1], section: [0.2, 0.2], kind: sill, fixed: true,
           repeat: {mirror: x, at: 2}}
    post: {from: [0, 0, 0.2], to: [0, 0, 3], section: [0.2, 0.2], kind: column,
           repeat: &all [{mirror: x, at: 2}, {by: [0, 4, 0]}]}
    beam: {from: [-0.2, 0, 3.1], to: [4.2, 0, 3.1], section: [0.2, 0.2], repeat: {by: [0, 4, 0]}}
    knee: {from: {of: post, at: 2}, to: {of: beam, at: 1.2}, section: [0.1, 0.1], kind: brace, repeat: *all}
  plates:
    roof: {corners: [[-0.3, -0.3, 3.2], [4.3, -0.3, 3.2], [4.3, 4.3, 3.2], [-0.3, 4.3, 3.2]], thickness: 0.1,
           kind: roof, material: roofing}
"""


def built(tmp_path, text=PORTAL, more="", **options):
    """HouseModel of a frame. more: further lines of the file"""
    path = tmp_path / "own.yaml"
    path.write_text(text + more)
    return build_house(load_house(path), **options)


def with_member(line):
    return PORTAL.replace("  plates:", f"    {line}\n  plates:")


RAFTERS = with_member("rafter: {from: [-0.2, 0, 3.2], to: [2, 0, 4.3], section: [0.2, 0.2], kind: rafter, cuts: [{by:"
                      " beam}, {x: 2}], repeat: *all}").partition("  plates:")[0]


def bounds(model, name):
    return model.element(f"frame.{name}").solid.bounds


def test_members_and_their_copies(tmp_path):
    model = built(tmp_path)
    assert model.counts()["by_kind"] == {"ground": 1, "sill": 2, "column": 4, "beam": 2, "brace": 4, "roof": 1}
    assert bounds(model, "post.4") == pytest.approx(np.array([[3.9, 3.9, 0.2], [4.1, 4.1, 3.0]]))
    assert model.element("frame.post.1").section == (0.2, 0.2) and model.element("frame.sill.1").fixed
    assert model.counts()["joints_by_kind"] == {"column_beam": 8, "brace_column": 4, "brace_beam": 4, "roof_beam": 2}


def test_an_end_at_a_member_is_cut_by_its_face(tmp_path):
    """The brace runs from (0.1, 2.2) on the post to the beam's underside at z = 3, about the line of its axis."""
    low, high = bounds(built(tmp_path), "knee.1")
    assert (low[0], high[2]) == pytest.approx((0.1, 3.0)) and low[2] > 2.1
    assert built(tmp_path).element("frame.knee.1").axis == pytest.approx(np.array([[0, 0, 2.2], [1, 0, 3.1]]))


@pytest.mark.parametrize("member, low, high", [
    ("{from: [0, 0, 5], to: [2, 0, 5], section: [0.1, 0.3]}", [0, -0.05, 4.85], [2, 0.05, 5.15]),
    ("{from: [0, 0, 5], to: [2, 0, 5], section: [0.1, 0.3], roll: 90}", [0, -0.15, 4.95], [2, 0.15, 5.05]),
    ("{from: [0, 0, 5], to: [0, 0, 6], section: [0.1, 0.3]}", [-0.05, -0.15, 5], [0.05, 0.15, 6]),
    ("{from: [0, 0, 5], to: [0, 0, 6], section: [0.1, 0.3], cuts: [{x: 0.02}, {z: 5.8}]}", [-0.05, -0.15, 5],
     [0.02, 0.15, 5.8]),
    ("{from: [0, 0, 5], to: [2, 0, 5], section: [0.1, 0.1], cuts: [{point: [1, 0, 5], normal: [-1, 0, 0]}]}",
     [1, -0.05, 4.95], [2, 0.05, 5.05]),
    ("{from: [0, 0, 5], to: [2, 0, 5], profile: [[0, 0], [0.2, 0], [0, 0.3]]}", [0, 0, 5], [2, 0.2, 5.3]),
    ("{from: [0, 0, 5], to: {of: post.4, end: to, at: 1, offset: [0, -4, 3], flush: false}, section: [0.1, 0.1]}",
     [0, -0.05, 4.95], [4, 0.05, 5.05]),
    ("{from: [5, 1, 5], to: [6, 1, 5], section: [0.2, 0.2], repeat: {turn: 90, about: [5, 1]}}", [5, 0.9, 4.9],
     [6, 1.1, 5.1]),
])
def test_solids(tmp_path, member, low, high):
    model = built(tmp_path, with_member(f"free: {member}"), check=False)
    name = "free.1" if "repeat" in member else "free"
    assert bounds(model, name) == pytest.approx(np.array([low, high]), abs=1e-9)
    if "turn" in member:
        assert bounds(model, "free.2") == pytest.approx(np.array([[4.9, 1, 4.9], [5.1, 2, 5.1]]), abs=1e-9)


def test_cuts_at_a_ridge_replace_the_square_end(tmp_path):
    """Two rafters that meet at x = 2 share the whole vertical face, 0.2 / cos(slope) high."""
    model = built(tmp_path, RAFTERS)
    (joint,) = (j for j in model.joints if {j.a, j.b} == {"frame.rafter.1", "frame.rafter.2"})
    assert joint.area == pytest.approx(0.2 * 0.2 * np.hypot(1, 0.5)) and joint.kind == "rafter_joint"
    assert bounds(model, "rafter.1")[0][2] == pytest.approx(3.2)


def test_a_plate_over_two_members(tmp_path):
    """Its edges are vertical, its thickness normal to the slope."""
    model = built(tmp_path, RAFTERS + "  plates:\n    roof: {over: [rafter, rafter.3], overhang: 0.5, thickness: 0.1,"
                  " kind: roof, material: roofing, repeat: {mirror: x, at: 2}}\n", snow_depth=0.5)
    low, high = bounds(model, "roof.1")
    assert (low[1], high[0], high[1]) == pytest.approx((-0.6, 2.0, 4.6))
    assert high[2] == pytest.approx(4.3 + 0.2 * np.hypot(1, 0.5))  # half of the rafter, thickness: 0.1 each
    assert {"roof_roof", "roof_beam"} <= set(model.counts()["joints_by_kind"])
    snow = model.element("frame.snow.roof.1")
    assert snow.volume == pytest.approx(0.5 * (high - low)[0] * 5.2) and snow.solid.bounds[1][2] == pytest.approx(
        high[2] + 0.5)


def test_storeys_from_horizontal_plates_or_columns_or_given(tmp_path):
    assert built(tmp_path).storey_levels == {"frame": {1: (0.2, 3.2)}}
    bare = PORTAL.partition("  plates:")[0]
    model = built(tmp_path, bare)
    assert model.storey_levels == {"frame": {1: (0.2, 3.0)}} and model.element("frame.beam.1").storey == 1
    assert built(tmp_path, bare, "  storeys: [[0.2, 2.9]]\n").storey_levels == {"frame": {1: (0.2, 2.9)}}
    with pytest.raises(HouseError, match=r"own.yaml:11: frame.storeys: no beam, rafter, floor or roof near .* 2 \("):
        built(tmp_path, bare, "  storeys: [[0.2, 3], [3.2, 6]]\n")
    with pytest.raises(HouseError, match=r"own.yaml:11: frame.storeys: give the feet and heads of storeys from below"):
        built(tmp_path, bare, "  storeys: [[3, 0.2]]\n")


def test_sides_plans_loads_and_damage(tmp_path):
    """The roof of 4.6 m x 4.6 m weighs its load, walls of 4 m and 2.8 m hang on the posts; a broken foot."""
    model = built(tmp_path, more="loads: {roof: 1, wall: 0.5}\ndamage: {regions: [{side: west, storey: 1,"
                  " column_beam: {count: 1, end: top}}]}\n")
    assert model.plans["frame"][1].area == pytest.approx(16.0) and weigh(model)["floor_area_m2"] == pytest.approx(16.0)
    assert weight_of(model.element("frame.roof").mass) == pytest.approx(4.6**2)
    bare = built(tmp_path).element("frame.post.1").mass
    assert weight_of(model.element("frame.post.1").mass - bare) == pytest.approx(0.5 * 4 * 3.0)
    assert model.element("frame.post.3").side == {"west", "north"}
    (broken,) = (joint for joint in model.joints if joint.broken)
    assert broken.a in ("frame.post.1", "frame.post.3") and broken.end == "top"
    assert diagnose(model)["structures"]["frame"]["uplift"]["columns"] == 4


def test_a_frame_beside_a_grid(tmp_path):
    """Storey drifts are those of the grid; both lean; names of the frame's copies are free."""
    model = built(tmp_path, PORTAL.replace("extends: frame", "extends: storehouse"),
                  "structures: {store: {place: {origin: [20, 0]}}}\nplumb: {drift: 0.01, towards: east}\n", check=False)
    assert list(model.storey_levels) == ["store", "frame"] and list(model.grids) == ["store"]
    assert bounds(model, "roof")[1][0] == pytest.approx(4.3 + 0.01 * (3.3 - 0.2))


def test_joints_by_gap_and_by_name(tmp_path):
    """Braces whose ends are 4 mm short have joints with a gap, all or the named ones; their springs lie in the gap."""
    short = PORTAL.replace("to: {of: beam, at: 1.2}", "to: [0.9, 0, 3.0], cuts: [{z: 2.996}]")
    with pytest.raises(HouseError, match=r"own.yaml:10: brace frame.knee.1 ends at nothing at .*; let it end at a mem"):
        built(tmp_path, short)
    with pytest.raises(HouseError, match=r"frame.joints: knee and beam have no common face; they are 4 mm apart"):
        built(tmp_path, short, "  joints: [{between: [knee, beam], type: bracing_plate}]\n")
    by_rule = built(tmp_path, short, "joint_search: {gap: 0.005}\n")
    by_name = built(tmp_path, short, "  joints: [{between: [knee, beam], type: hold_down, number: 2, gap: 0.005}]\n")
    for model, kind, count in ((by_rule, "bracing_plate", 4), (by_name, "hold_down", 1)):
        joints = [joint for joint in model.joints if joint.kind == "brace_beam"]
        assert len(joints) == 4 and {joint.type for joint in joints} == {kind}
        assert {len(joint.points) for joint in joints} == {count}
        assert np.concatenate([joint.points for joint in joints])[:, 2] == pytest.approx(2.998)
    one = built(tmp_path, more="  joints: [{between: [knee.2, beam], type: hold_down, number: 2}]\n")
    (joint,) = (joint for joint in one.joints if joint.type == "hold_down")
    assert joint.a == "frame.knee.2" and joint.strength == 40000 and joint.end == "top"


@pytest.mark.parametrize("old, new, message", [
    ("to: [0, 0, 3], section", "to: [0, 0, 3000], section",
     r"own.yaml:7: frame.members.post.to\[3\]: must be a number in \[-500, 500\] m, got 3000; in m: 3000 mm = 3"),
    ("section: [0.1, 0.1], kind: brace", "section: [100, 100], kind: brace", r"own.yaml:10: .*100 mm = 0.1"),
    ("{of: post, at: 2}", "{of: pst, at: 2}", r"own.yaml:10: .*knee.from.of: no member 'pst', did you mean"),
    ("{of: post, at: 2}", "{of: post.5, at: 2}", r"knee.from.of: no member 'post.5'; post has 4 copies"),
    ("{of: post, at: 2}", "{of: knee, at: 2}", r"own.yaml:10: frame.members.knee.from.of: knee refers back to knee"),
    ("{of: post, at: 2}", "{of: roof, at: 2}", r"'roof' is a plate; name a member"),
    ("{of: post, at: 2}", "{of: beam, at: 1}", r"knee.from: the other end lies within or behind 'beam'; move"),
    ("{of: beam, at: 1.2}", "{of: beam, at: 9.5}",
     r"own.yaml:10: frame.members.knee.to.at: 9.5 lies beyond the end of beam \(4.4 m\); give a place on its axis"),
    ("{of: beam, at: 1.2}", "{of: beam, at: -1}", r"own.yaml:10: .*knee.to.at: -1 lies beyond the end of beam"),
    ("to: {of: beam, at: 1.2}", "to: [0.9, 0, 3.1]",
     r"own.yaml:10: brace frame.knee.1 overlaps beam frame.beam.1 \(own.yaml:9\) by .* mm near .*; end one at the"),
    ("from: [0, 0, 0.2]", "from: [0, 0, 0.3]", r"own.yaml:7: column frame.post.1 stands on nothing at x 0.000"),
    ("3.2], [4.3, -0.3, 3.2]", "3.2], [4.3, -0.3, 3.4]", r"own.yaml:12: frame.plates.roof.corners: do not span a"),
    ("kind: roof, material", "kind: rof, material", r"own.yaml:13: frame.plates.roof.kind: 'rof' is unknown"),
    ("to: [0, 0, 3], section", "to: [0, 0, 0.2], section", r"own.yaml:7: frame.members.post.to: lies at its other end"),
    ("fixed: true", "fixed: true, cuts: [{normal: [0, 0, 1]}]", r"sill.cuts\[1\]: a cut by a plane needs 'point'"),
    ("fixed: true", "fixed: true, cuts: [{point: [0, 0, 0.3], normal: [0, 0, -1]}]",
     r"own.yaml:5: frame.members.sill: no volume is left"),
    ("fixed: true", "fixed: true, material: oak", r"own.yaml:5: frame.members.sill.material: unknown material 'oak'"),
    ("{mirror: x, at: 2}}\n", "{mirror: x, about: [2, 0]}}\n", r"own.yaml:6: .*sill.repeat.about: does not belong to"),
    ("roof, material", "roof, overhang: 1, material", r"own.yaml:13: frame.plates.roof.overhang: belongs to 'over'"),
    ("    roof: {", "    beam: {", r"own.yaml:12: frame.plates.beam: a member has this name; choose another one"),
])
def test_mistakes(tmp_path, old, new, message):
    assert old in PORTAL
    with pytest.raises(HouseError, match=message):
        built(tmp_path, PORTAL.replace(old, new))


@pytest.mark.parametrize("line, message", [
    ("girt: {from: [1, 2, 2], to: [3, 2, 2], section: [0.1, 0.1]}", r"own.yaml:11: beam frame.girt is unsupported"),
    ("girt: {from: [0.104, 0, 2], to: [1, 0, 2], section: [0.1, 0.1]}", r"own.yaml:11: beam frame.girt is unsupported"
     r" near .*; column frame.post.1 \(.*own.yaml:7\) is 4 mm from it: move them together or give joint_search.gap"),
    ("star: {from: [1, 2, 2], to: [3, 2, 2], profile: [[0, 0], [1, 0], [0.1, 0.1], [0, 1]]}",
     r"own.yaml:11: frame.members.star.profile: is not a convex polygon"),
])
def test_single_members_that_are_refused(tmp_path, line, message):
    with pytest.raises(HouseError, match=message):
        built(tmp_path, with_member(line))


def test_a_file_without_structure_and_frame(tmp_path):
    with pytest.raises(HouseError, match="a house needs at least one structure, or a frame with members"):
        built(tmp_path, "extends: base\nname: none\n")


def test_changed_keys(tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text(PORTAL)
    data = changed_house(path, ["frame.members.post.section=[0.3, 0.3]", "frame.plates.roof.thickness=0.2"])
    assert data["frame"]["members"]["post"]["section"] == [0.3, 0.3]


def test_inherited_rules_and_types_change_by_name(tmp_path):
    model = built(tmp_path, more="joints: {column_ends: {number: 3}}\n"
                  "joint_types: {corner_fitting: {damping_ratio: 0.05}}\n")
    joints = [joint for joint in model.joints if joint.kind == "column_beam"]
    usual = next(joint for joint in built(tmp_path).joints if joint.kind == "column_beam")
    assert joints[0].strength == pytest.approx(1.5 * usual.strength)
    assert {joint.damping_ratio for joint in joints} == {0.05} != {usual.damping_ratio}


@pytest.mark.parametrize("old, new, message", [
    ("from: [-0.2, 0, 3.1], to: [4.2, 0, 3.1]", "from: [-0.2, 0, 3.11], to: [4.2, 0, 3.11]",
     r"frame.post.1 \(.*own.yaml:7\) and frame.beam.1 \(.*:9\), gap of 10 mm: move them together"),
    ("sill, fixed: true,\n           repeat: {mirror: x, at: 2}}", "foundation, fixed: true,"
     " repeat: {mirror: x, at: 2}}\n    across: {from: [-0.5, 2, 0.25], to: [5, 2, 0.25], section: [0.1, 0.1]}", None),
    ("    sill:", "    base: {from: [0, -0.2, -0.1], to: [0, 4.2, -0.1], section: [0.4, 0.2], kind: foundation, fixed:"
     " true}\n    lath: {from: [0.17, -0.2, 0.03], to: [0.17, 4.2, 0.03], section: [0.06, 0.06]}\n    sill:",
     r"frame.base .* and frame.lath .*, touching, no rule of 'joints' for foundation and beam"),
])
def test_missing_joints_are_told(tmp_path, old, new, message):
    assert old in PORTAL
    text = PORTAL.replace(old, new)
    model = built(tmp_path, text, check=False)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        warn_of_missing_joints(model, load_house(tmp_path / "own.yaml").data)
    assert len(caught) == (message is not None)
    if message:
        assert re.search(message, str(caught[0].message))


@pytest.mark.parametrize("name", ["barn", "bell_tower", "footbridge"])
def test_shipped_frames(name):
    """Without a warning of missing joints."""
    warnings.simplefilter("error")
    assert build_house(load_house(name)).counts()["joints"] > 50
