# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Other houses than the paper's: gable roofs, eaves, pyramids, areas, wings, `extends`; small and large."""
import time
import warnings

import numpy as np
import pytest
from timber_houses.house import HouseError, build_house, changed_house, check_house, load_house

SHED = """\
extends: base
name: shed
structures:
  main: null
  entrance: null
  shed:
    place: {{origin: [0, 0]}}
    grid: {{x: {{module: 1, count: {nx}}}, y: {{module: 1, count: {ny}}}}}
    margin: 0.06
    lines: {lines}
    stack:
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2}}
      - {{layer: beams, height: 0.12, width: 0.12}}
      - {{layer: roof, {roof}}}
    columns: [{{section: 0.12, lines: {walls}}}]
"""
WALLS = "[{{along: y, at: [0, {nx}], from: 0, to: {ny}}}, {{along: x, at: [0, {ny}], from: 0, to: {nx}{cut}}}]"


def house(tmp_path, text, snow=None):
    path = tmp_path / "own.yaml"
    path.write_text(text)
    return build_house(load_house(path), snow)


def shed(tmp_path, roof, nx=2, ny=3, snow=None, lines=None, walls=None):
    """A shed of nx x ny modules of 1 m with a column at every node of its walls."""
    lines = lines or WALLS.format(nx=nx, ny=ny, cut=", cut: true")
    return house(tmp_path,
                 SHED.format(nx=nx, ny=ny, roof=roof, lines=lines, walls=walls or WALLS.format(nx=nx, ny=ny, cut="")),
                 snow)


def top(elements):
    return max(e.solid.bounds[1][2] for e in elements)


def test_a_lean_keeps_all_joints(tmp_path):
    """Boxed eaves, loads, snow; and two structures whose columns stand at different heights."""
    for text in ("extends: tiled_house\nname: own\nsnow: {depth: 1}\n", "extends: l_house\nname: own\n"):
        upright, leaning = (house(tmp_path, text + more).counts()["joints_by_kind"]
                            for more in ("", "plumb: {drift: 0.02, towards: east}\n"))
        assert leaning == upright
        check_house(house(tmp_path, text + "plumb: {drift: 0.02, towards: north}\n"))


def test_a_brace_needs_a_joint_on_the_level_member(tmp_path):
    """A brace of 15 mm touches sill and beam with less than joint_search.min_area; its joint with the column is not
    enough.
    """
    thin = "extends: storehouse\nname: own\nstructures: {store: {braces: {thickness: 0.015}}}\n"
    with pytest.raises(HouseError, match="has no joint at its bottom, where a contact area .*min_area"):
        check_house(house(tmp_path, thin))
    joints = house(tmp_path, thin + "joint_search: {min_area: 2e-4}\n").counts()["joints_by_kind"]
    assert joints["brace_beam"] == 16


def test_joints_between_the_sides_of_columns_are_no_feet(tmp_path):
    """Wings of the L-shaped house: their columns are joined side by side, at half height."""
    joints = [joint for joint in house(tmp_path, "extends: l_house\nname: own\n").joints if joint.kind == "wing_wing"
              and "column" in joint.a]
    assert joints and {joint.end for joint in joints} == {""}


def test_a_rule_may_list_a_pair_twice(tmp_path):
    text = ("extends: storehouse\nname: own\njoints:\n"
            "  x: {between: [[beam, floor], [beam, floor]], type: corner_fitting, kind: q, across: true}\n")
    assert house(tmp_path, text).counts()["joints"] > 0


def test_gable_roof_against_closed_forms(tmp_path):
    """Pitch, eaves, thickness across the slope, volumes of slab and snow; the ridge along the longer side."""
    pitch, eaves, thickness, width, length = 0.5, 0.1, 0.12, 2.12, 3.12
    model = shed(tmp_path, f"type: gable, pitch: {pitch}, eaves: {eaves}, thickness: {thickness}", snow=0.4)
    slabs, snow = model.of_kind("roof"), model.of_kind("snow")
    assert [e.name for e in slabs] == ["shed.roof.west", "shed.roof.east"]
    assert {len(e.solid.faces) for e in slabs} == {6}
    run, along = width / 2 + eaves, length + 2 * eaves
    assert top(slabs) == pytest.approx(2.24 + pitch * run) and top(snow) == pytest.approx(2.24 + pitch * run + 0.4)
    drop = thickness * np.hypot(1, pitch)
    section = run * drop - drop**2 / pitch / 2  # a parallelogram without the triangle below the eave's level
    assert sum(e.volume for e in slabs) == pytest.approx(2 * section * along, rel=1e-9)
    assert sum(e.volume for e in snow) == pytest.approx(2 * run * along * 0.4, rel=1e-9)
    assert model.counts()["joints_by_kind"]["roof_roof"] == 1


def test_ridge_height_and_pitch_are_equivalent(tmp_path):
    one = shed(tmp_path, "type: gable, ridge: x, pitch: 0.5, thickness: 0.12")
    other = shed(tmp_path, f"type: gable, ridge: x, ridge_height: {2.24 + 0.5 * 1.56}, thickness: 0.12")
    for a, b in zip(one.of_kind("roof"), other.of_kind("roof")):
        assert a.name == b.name in ("shed.roof.south", "shed.roof.north")
        assert a.vertices == pytest.approx(b.vertices, abs=1e-9)


@pytest.mark.parametrize("kind", ["gable", "hip"])
def test_boxed_eaves(tmp_path, kind):
    """Parallel slabs have soffits of 0.12 sqrt(1 + 0.16) / 0.4 = 0.323 m, enough for eaves of 0.2 m; wider ones are
    boxed, 0.11 m beyond them.
    """
    slope, thickness, width = np.hypot(1, 0.4), 0.12, {"gable": 2, "hip": 4}[kind]
    for eaves in (0.2, 0.45, 0.9):
        model = shed(tmp_path, f"type: {kind}, pitch: 0.4, eaves: {eaves}, thickness: {thickness}", snow=0.5, nx=width,
                     ny=width + 1)
        assert model.counts()["joints_by_kind"]["roof_beam"] >= 2
        slabs, out = model.of_kind("roof"), eaves + 0.06
        level = np.array([v for e in slabs for v in e.vertices if abs(v[2] - 2.24) < 1e-9])
        soffit = max(0.3231, out + 0.05)
        reach = np.abs(level - np.array([width / 2, (width + 1) / 2, 2.24]))
        if kind == "gable":
            assert np.unique(reach[:,
                                   0].round(3)) == pytest.approx([width / 2 + out - soffit, width / 2 + out], abs=1e-3)
        if eaves > 0.2:
            rafters = np.prod([width + 2 * out, width + 1 + 2 * out]) * slope * thickness
            corners = {"gable": 0, "hip": 2 * (2 * 0.2**2 / 2 * 1 + 0.2**2)
                       }[kind] * slope * thickness  # cut off the hip ends, at 45 degrees in plan
            assert sum(e.mass for e in slabs) == pytest.approx(340 * (rafters - corners), rel=1e-9)


@pytest.mark.parametrize("side, axis, sign", [("west", 0, -1), ("east", 0, 1), ("south", 1, -1), ("north", 1, 1)])
def test_mono_pitch_roof(tmp_path, side, axis, sign):
    """It falls to its side; joints hold it on the plates of both walls across the slope, those of the high wall with a
    fitting for each post.
    """
    model = shed(tmp_path, f"type: mono, falls: {side}, pitch: 0.3, thickness: 0.12", snow=0.5, nx=3, ny=3)
    (slab,), (snow,) = model.of_kind("roof"), model.of_kind("snow")
    assert slab.name == f"shed.roof.{side}" and slab.vertices[:, 2].min() == pytest.approx(2.24)
    assert slab.vertices[:, 2].max() == pytest.approx(2.24 + 0.3 * 3.12)
    assert snow.vertices[:, 2].max() == pytest.approx(2.74 + 0.3 * 3.12)
    held = {joint.points[:, axis].mean(): joint for joint in model.joints if joint.kind == "roof_beam"}
    low, high = [held[place] for place in sorted(held)[::-sign]][::len(held) - 1]
    assert (high.points[:, 2] == pytest.approx(2.24)) and high.kn == pytest.approx(low.kn * (1 + np.ceil(3.12 / 0.91)))


def test_posts_need_a_rule(tmp_path):
    lines, walls = WALLS.format(nx=2, ny=3, cut=", cut: true"), WALLS.format(nx=2, ny=3, cut="")
    text = SHED.format(nx=2, ny=3, roof="type: mono, falls: west, pitch: 0.3, thickness: 0.12", lines=lines,
                       walls=walls)
    with pytest.raises(HouseError, match="stands on posts.*a rule of `joints` between roof and beam"):
        house(tmp_path, text + "joints: {roofs: null}\n")


def test_posts_need_a_plate_above_the_eave(tmp_path):
    one = "[{along: y, at: [0], from: 0, to: 3}]"
    with pytest.raises(HouseError, match="over those of the wall opposite; add beams below both"):
        shed(tmp_path, "type: mono, falls: west, pitch: 0.3, thickness: 0.12", lines=one)


def test_hip_roof_on_a_square_is_a_pyramid(tmp_path):
    model = shed(tmp_path, "type: hip, pitch: 0.5, thickness: 0.12, corner_cut: 0.1", nx=3, ny=3, snow=1.0)
    slabs = model.of_kind("roof")
    assert {len(e.solid.faces) for e in slabs} == {8} and len({round(e.volume, 9) for e in slabs}) == 1
    assert model.counts()["joints_by_kind"]["roof_roof"] == 4  # the hips; there is no ridge


@pytest.mark.parametrize("roof", ["type: flat, thickness: 0.1", "type: gable, pitch: 1.2, thickness: 0.1",
                                  "type: hip, pitch: 0.3, thickness: 0.05, corner_cut: 0.1",
                                  "type: mono, falls: west, pitch: 0.5, thickness: 0.1"])
def test_one_module_is_a_house(tmp_path, roof):
    model = shed(tmp_path, roof, nx=1, ny=1, snow=2.0)
    assert len(model.of_kind("column")) == 4 and check_house(model)["deepest"] < 1e-9


def test_areas_meet_on_the_grid_line(tmp_path):
    """Two roofs over one grid: no margin and no eaves at their common edge; together they cover the whole."""
    halves = [f"type: flat, thickness: 0.1, eaves: 0.2, area: {{x: [0, 2], y: {y}}}" for y in ("[0, 1]", "[1, 3]")]
    roofs = shed(tmp_path, halves[0] + "}\n      - {layer: roof, " + halves[1]).of_kind("roof")
    assert [e.name for e in roofs] == ["shed.roof1", "shed.roof2"]
    assert sum(e.volume for e in roofs) == pytest.approx((2.12 + 0.4) * (3.12 + 0.4) * 0.1)
    assert roofs[0].solid.bounds[1][1] == roofs[1].solid.bounds[0][1] == 1.0


def test_wings_of_the_l_house_are_joined():
    """13 joints between the wings: 2 floors, 2 beams in 2 storeys, and the columns of the double wall; ends flush in
    the south.
    """
    model = build_house(load_house("l_house"), 1.0)
    between = [j for j in model.joints if model.element(j.a).group != model.element(j.b).group]
    assert {j.kind for j in between} == {"wing_wing"}
    assert sorted(model.element(j.a).kind for j in between) == ["beam"] * 2 + ["column"] * 10 + ["floor"]
    lows = {group: min(e.solid.bounds[0][1] for e in model.elements if e.group == group and e.kind == "beam")
            for group in ("main", "side")}
    assert lows["main"] == pytest.approx(lows["side"])
    normals = np.array([j.normal for j in between])
    assert np.abs(normals[:, 0]) == pytest.approx(1)


def test_the_order_of_the_kinds_in_a_joint_rule_does_not_matter(tmp_path):
    text = load_house("storehouse").path.read_text()
    turned = (text + "joints:\n  column_ends: {between: [[sill, beam, floor], column]}\n"
                     "  roofs: {between: [beam, roof]}\n")
    ends = [[{(j.a, j.b), (j.b, j.a), j.end} for j in house(tmp_path, one).joints] for one in (text, turned)]
    assert [frozenset(e) for e in ends[0]] == [frozenset(e) for e in ends[1]]


def test_a_file_extends_a_shipped_house(tmp_path):
    """`extends` by name; null removes an entry; a file in the same folder has priority over a shipped one."""
    model = house(tmp_path, "extends: C2\nname: mine\nstructures: {entrance: null}\ndamage: {regions: []}\n")
    assert {e.group for e in model.elements} == {"", "main"} and not any(j.broken for j in model.joints)
    (tmp_path / "base.yaml").write_text("extends: A\nname: beside\ndescription: the file beside\n")
    assert house(tmp_path, "extends: base.yaml\nname: mine\n").description == "the file beside"


WALL = "{along: x, at: 0, from: 0, to: 1, type: plywood}"


def test_a_key_with_plus_adds_to_an_inherited_list(tmp_path):
    """Through two files, and to a list that is not there; the same with a single changed key."""
    walls = load_house("tiled_house").data["structures"]["main"]["walls"]
    more = f"extends: tiled_house\nname: mine\nstructures: {{main: {{walls+: [{WALL}], braces: {{lines+: []}}}}}}\n"
    (tmp_path / "more.yaml").write_text(more)
    path = tmp_path / "most.yaml"
    path.write_text(more.replace("tiled_house", "more.yaml"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = load_house(path).data["structures"]["main"]["walls"]
        changed = changed_house("tiled_house", [f"structures.main.walls+=[{WALL}]"])["structures"]["main"]["walls"]
    assert found[:len(walls)] == walls and len(found) == len(walls) + 2 and found[-1]["type"] == ["plywood"]
    assert len(changed) == len(walls) + 1 and changed[-1]["type"] == "plywood"


def test_replaced_walls_are_noted(tmp_path):
    """In one line each; lists of numbers, equal and empty lists and shipped houses are not."""
    count = len(load_house("tiled_house").data["structures"]["main"]["walls"])
    text = f"structures: {{main: {{walls: [{WALL}], place: {{origin: [1, 0]}}}}}}"
    (tmp_path / "own.yaml").write_text(f"extends: tiled_house\nname: mine\n{text}\n")
    with pytest.warns(UserWarning) as notes:
        load_house(tmp_path / "own.yaml")
        changed_house("tiled_house", [f"structures.main.walls=[{WALL}]"], where="row 3, column {}".format)
    assert [str(note.message) for note in notes] == [
        f"{at}: structures.main.walls replaces the {count} inherited entries; structures.main.walls+ adds to them"
        for at in ("own.yaml:3", "row 3, column set")]


@pytest.mark.parametrize("text, words", [
    ("structures: {main: {walls+: 3}}", "own.yaml:3: structures.main.walls+: adds to a list, got 3"),
    ("description+: [a]", "own.yaml:3: description+: adds to a list"),
    ("structures: {main: {wals+: []}}", "unknown key 'wals', did you mean 'walls'"),
])
def test_plus_belongs_to_lists(tmp_path, text, words):
    with pytest.raises(HouseError) as caught:
        house(tmp_path, f"extends: tiled_house\nname: mine\n{text}\n")
    assert words in str(caught.value)


def test_lines_that_cross_are_refused_with_the_remedy(tmp_path):
    lines = "[{along: y, at: [0, 2], from: 0, to: 2}, {along: x, at: 0, from: 0, to: 2}]"
    with pytest.raises(HouseError, match="sill .* overlaps sill .*, or give one of the lines cut: true where they"):
        shed(tmp_path, "type: flat, thickness: 0.1", lines=lines)


def test_json_is_yaml(tmp_path):
    assert house(tmp_path, '{"extends": "C", "name": "mine", "snow": {"depth": 0.5}}').snow_depth == 0.5


def test_two_beams_on_one_line_have_different_names(tmp_path):
    lines = "[{along: y, at: [0, 2], from: 0, to: 1}, {along: y, at: [0, 2], from: 2, to: 3}]"
    names = [e.name for e in shed(tmp_path, "type: flat, thickness: 0.1", lines=lines, walls=lines).elements]
    assert len(set(names)) == len(names) and "shed.beam1.NS.x0.2" in names


def test_a_large_house_is_built_in_seconds(tmp_path):
    """20 x 20 modules with a column at every node, each checked for overlaps with its neighbours."""
    everywhere = f"[{{along: y, at: {list(range(21))}, from: 0, to: 20}}]"
    start = time.process_time()
    model = shed(tmp_path, "type: hip, pitch: 0.4, thickness: 0.12", nx=20, ny=20, snow=1.0, lines=everywhere,
                 walls=everywhere)
    assert len(model.of_kind("column")) == 441 and model.counts()["joints_by_kind"]["column_beam"] == 882
    assert time.process_time() - start < 30  # observed: 1 s on a quiet machine
