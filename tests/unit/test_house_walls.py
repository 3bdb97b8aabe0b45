# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls in house files: bays, openings, values of their springs, mistakes. Their mechanics: tests/physics/test_wall.py."""

import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "py"))

from yade_timber.house import HouseError, build_house, changed_house, free_wall_bays, load_house, weigh  # noqa: E402


def house(tmp_path, walls, types="{}", base="C"):
    path = tmp_path / "own.yaml"
    path.write_text(f"extends: {base}\nname: own\nwall_types: {types}\nstructures:\n  main:\n    walls:\n      - {walls}\n")
    return build_house(load_house(path))


def sheets(model, kind="wall_beam"):
    return [joint for joint in model.joints if joint.kind == kind]


def test_bays_storeys_and_names(tmp_path):
    """Three bays in two storeys; bays with braces may have a wall, too; members and their joints are those of the bare house."""
    model, bare = house(tmp_path, "{along: y, at: 8, from: 0, to: 3, type: plywood}"), build_house(load_house("C"))
    assert [joint.name for joint in sheets(model)][:2] == ["main.wall1.NS.x8.0-1.plywood.beams", "main.wall1.NS.x8.1-2.plywood.beams"]
    assert len(sheets(model)) == len(sheets(model, "wall_column")) == 6 == model.counts()["walls"]
    assert [e.name for e in model.elements] == [e.name for e in bare.elements] and len(model.joints) == len(bare.joints) + 12
    first, upper = sheets(model)[0], sheets(model)[3]
    assert (first.a, first.b, first.storey, first.side) == ("main.foundation.NS.x8", "main.beam1.NS.x8", 1, {"east"})
    assert (upper.a, upper.b, upper.storey) == ("main.floor1", "main.beam2.NS.x8", 2)
    assert first.normal == pytest.approx([0, 1, 0]) and first.points == pytest.approx(np.array([[8 * 0.91, 0.455, 0.30 + 2.73 / 2]]))


@pytest.mark.parametrize("opening, wide, ratio", [("none", False, 1), ("window", False, 0.4), ("window", True, 0.3), ("door", False, 0.2), ("door", True, 0.15)])
def test_values_of_the_springs(tmp_path, opening, wide, ratio):
    """Half of 1.5 times and of 150 / rad times the allowable 1.96 kN/m, over the bay's length; stretches are drifts times height or length."""
    ends, length = ("{along: x, at: 4, from: 4, to: 7", 3 * 0.91) if wide else ("{along: x, at: 4, from: 0, to: 1", 0.91)
    ratio = {("window", True): 0.2, ("door", True): 0.1}.get((opening, wide), ratio)  # longer than 2 m
    model = house(tmp_path, ends + f", type: plywood, opening: {opening}, storeys: 1}}")
    beams, columns = sheets(model)[0], sheets(model, "wall_column")[0]
    strength = 1.5 * 1960 * 2.5 * length * ratio
    assert beams.strength == pytest.approx(strength / 2) and columns.strength == pytest.approx(strength / 2 * 2.73 / length)
    for joint, lever in ((beams, 2.73), (columns, length)):
        assert joint.strength / joint.kn == pytest.approx(lever / 100)
        assert (joint.softening_stretch, joint.ultimate_stretch, joint.ks) == (pytest.approx(0.05 * lever), pytest.approx(0.103 * lever), 0)


def test_own_wall_type(tmp_path):
    types = "{board: {strength: 11500, stiffness: 8.0e5, friction_share: 0.1, softening_drift: 0.03, ultimate_drift: 0.06}}"
    joint, = sheets(house(tmp_path, "{along: x, at: 0, from: 0, to: 1, type: board, storeys: 2}", types))
    assert (joint.strength, joint.kn, joint.friction_share) == (pytest.approx(11500 * 0.91 / 2), pytest.approx(8e5 * 0.91 / 2 / 2.73), 0.1)


def test_several_sheets_of_a_bay(tmp_path):
    model = house(tmp_path, "{along: x, at: 0, from: 0, to: 2, type: [plywood, mortar, gypsum], opening: window}")
    assert len(sheets(model)) == 12 and model.counts()["walls"] == 4
    assert sheets(model)[1].name == "main.wall1.EW.y0.0-1.mortar.window.beams"


def test_walls_of_a_leaning_house(tmp_path):
    """A house leaning out of plumb keeps its walls in the middle of their bays."""
    path = tmp_path / "own.yaml"
    path.write_text("extends: tiled_house\nname: own\nplumb: {drift: 0.01, towards: east}\n")
    model = build_house(load_house(path))
    joint = sheets(model)[0]
    assert joint.points[0][2] == pytest.approx(0.52 + 2.73 / 2) and joint.points[0][0] == pytest.approx(0.455 + 0.01 * (0.12 + 2.73 / 2), abs=2e-3)


def test_the_tiled_house():
    model = build_house(load_house("tiled_house"))
    assert 2.5 < weigh(model)["per_floor_area_kn_m2"] < 3.0
    assert model.counts()["braces"] == 0 and model.counts()["walls"] == 64
    layers = len(sheets(model))
    assert model.counts()["joints"] == len(model.joints) - 2 * layers and f" joints, {layers} wall sheets, " in repr(model)
    assert "wall" not in build_house(load_house("C")).joints_text


def test_walls_are_added_by_name(tmp_path):
    """In a bay without walls of house C, and in all of them; a second one of the type is refused by the name of its bay."""
    names = free_wall_bays(load_house("C"), "plywood")
    assert "main.wall1.EW.y0.3-4.plywood" in names and len(names) == len(set(names)) > 80
    path = tmp_path / "walled.yaml"
    path.write_text(yaml.safe_dump(changed_house("C", braces=names), sort_keys=False))
    assert build_house(load_house(path)).counts()["walls"] == len(names) and free_wall_bays(load_house(path), "mud") == []
    path.write_text(yaml.safe_dump(changed_house(path, braces=names[:1]), sort_keys=False))
    with pytest.raises(HouseError, match=f"{names[0].removesuffix('.plywood')} has sheathing of type plywood already"):
        build_house(load_house(path))


@pytest.mark.parametrize("name, words", [
    ("main.wall1.EW.y0.3-4", "a wall like main.wall2.NS.x8.6-7.plywood"),
    ("shed.wall1.EW.y0.3-4.mud", "unknown structure 'shed'"),
])
def test_wrong_names_of_walls(name, words):
    with pytest.raises(HouseError, match=words):
        changed_house("C", braces=[name])


MISTAKES = {
    "no column": ("{along: y, at: 8, from: 0, to: 20, type: plywood}", "{}", ["own.yaml:7", "no column at node 20", "0, 1, 2"]),
    "backwards": ("{along: y, at: 8, from: 3, to: 0, type: plywood}", "{}", ["'from' must be below 'to'"]),
    "unknown type": ("{along: y, at: 8, from: 0, to: 1, type: plywod}", "{}", ["structures.main.walls[1].type", "did you mean 'plywood'?"]),
    "unknown storey": ("{along: y, at: 8, from: 0, to: 1, type: mud, storeys: 3}", "{}", ["no storey 3"]),
    "twice": ("{along: y, at: [8, 8], from: 0, to: 1, type: mud}", "{}", ["main.wall1.NS.x8.0-1", "type mud already"]),
    "no strength": ("{along: y, at: 8, from: 0, to: 1, type: a}", "{a: {stiffness: 1.0e5}}", ["own.yaml:3", "wall_types.a", "give multiplier or strength"]),
    "descending": ("{along: y, at: 8, from: 0, to: 1, type: a}", "{a: {multiplier: 1, softening_drift: 0.005}}", ["0.01", "must ascend"]),
    "opening": ("{along: y, at: 8, from: 0, to: 1, type: mud, opening: hole}", "{}", ["none, window, door"]),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistake(tmp_path, name):
    walls, types, words = MISTAKES[name]
    with pytest.raises(HouseError) as caught:
        house(tmp_path, walls, types)
    assert [word for word in words if word not in str(caught.value)] == [], caught.value
