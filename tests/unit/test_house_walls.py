# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls in house files: bays, openings, values of their springs, mistakes. Their mechanics: tests/physics/test_wall.py.
"""
import numpy as np
import pytest
import yaml
from timber_houses.house.diagnosis import diagnose
from timber_houses.house import HouseError, build_house, changed_house, free_wall_bays, load_house, weigh
from timber_houses.house.nails import nailed_wall


def house(tmp_path, walls, types="{}", base="C", level=None):
    path = tmp_path / "own.yaml"
    path.write_text(
        f"extends: {base}\nname: own\nwall_types: {types}\nstructures:\n  main:\n    walls:\n      - {walls}\n")
    return build_house(load_house(path), wall_level=level)


def sheets(model, kind="wall_beam"):
    return [joint for joint in model.joints if joint.kind == kind]


def test_bays_storeys_and_names(tmp_path):
    """Three bays in two storeys; bays with braces may have a wall, too; members and their joints are those of the bare
    house.
    """
    model, bare = house(tmp_path, "{along: y, at: 8, from: 0, to: 3, type: plywood}"), build_house(load_house("C"))
    assert [joint.name for joint in sheets(model)][:2] == [
        "main.wall1.NS.x8.0-1.plywood.beams", "main.wall1.NS.x8.1-2.plywood.beams"
    ]
    assert len(sheets(model)) == len(sheets(model, "wall_column")) == 6 == model.counts()["walls"]
    assert [e.name for e in model.elements] == [e.name for e in bare.elements]
    assert len(model.joints) == len(bare.joints) + 12
    first, upper = sheets(model)[0], sheets(model)[3]
    assert (first.a, first.b, first.storey, first.side) == ("main.foundation.NS.x8", "main.beam1.NS.x8", 1, {"east"})
    assert (upper.a, upper.b, upper.storey) == ("main.floor1", "main.beam2.NS.x8", 2)
    assert first.normal == pytest.approx([0, 1, 0])
    assert first.points == pytest.approx(np.array([[8 * 0.91, 0.455, 0.30 + 2.73 / 2]]))


@pytest.mark.parametrize("opening, wide, ratio", [("none", False, 1), ("window", False, 0.4), ("window", True, 0.3),
                                                  ("door", False, 0.2), ("door", True, 0.15)])
def test_values_of_the_springs(tmp_path, opening, wide, ratio):
    """Level design: half of 1.5 times and of 150 / rad times the allowable 1.96 kN/m, over the bay's length; stretches
    are drifts times height or length.
    """
    ends, length = ("{along: x, at: 4, from: 4, to: 7",
                    3 * 0.91) if wide else ("{along: x, at: 4, from: 0, to: 1", 0.91)
    ratio = {("window", True): 0.2, ("door", True): 0.1}.get((opening, wide), ratio)  # longer than 2 m
    model = house(tmp_path, ends + f", type: plywood, opening: {opening}, storeys: 1}}", level="design")
    beams, columns = sheets(model)[0], sheets(model, "wall_column")[0]
    strength = 1.5 * 1960 * 2.5 * length * ratio
    assert beams.strength == pytest.approx(strength / 2)
    assert columns.strength == pytest.approx(strength / 2 * 2.73 / length)
    for joint, lever in ((beams, 2.73), (columns, length)):
        assert joint.strength / joint.kn == pytest.approx(lever / 100)
        assert (joint.softening_stretch, joint.ultimate_stretch, joint.ks) == (pytest.approx(
            0.05 * lever), pytest.approx(0.103 * lever), 0)


def drifts_and_shears(joint, length=0.91, height=2.73):
    """Envelope of a beams' half as that of the wall's type. [rad, N/m]"""
    return [(stretch / height, force / length * 2) for stretch, force in joint.envelope]


MEAN = [(1 / 120, 1.4), (1 / 80, 1.8), (1 / 30, 2.8), (0.115, 0.0)]
"""Of the level mean: shear over the allowable one."""


def test_levels_of_a_multiplier(tmp_path):
    """mean is the default; the house file and the caller may ask for design; a type that is stronger early is straight
    up to its peak.
    """
    line, allowable = "{along: x, at: 0, from: 0, to: 1, type: %s, storeys: 1}", 2.5 * 1960
    joint, = sheets(house(tmp_path, line % "plywood"))
    assert np.ravel(drifts_and_shears(joint)) == pytest.approx(np.ravel([(d, r * allowable) for d, r in MEAN]))
    assert joint.kn == pytest.approx(1.4 * 120 * allowable * 0.91 / 2 / 2.73)
    assert joint.strength == pytest.approx(2.8 * allowable * 0.91 / 2)
    own = tmp_path / "design.yaml"
    own.write_text("extends: own.yaml\nlaw: {wall_level: design}\n")
    model = build_house(load_house(own))
    assert model.law["wall_level"] == "design"
    assert np.ravel(drifts_and_shears(sheets(model)[0])) == pytest.approx([0.01, 7350, 0.05, 7350, 0.103, 0])
    assert build_house(load_house(own), wall_level="mean").law["wall_level"] == "mean"
    early = drifts_and_shears(sheets(house(tmp_path, line % "a", "{a: {multiplier: 1, softening_drift: 0.016}}"))[0])
    assert np.ravel(early) == pytest.approx([0.016, 2.8 * 1960, 0.115, 0])
    assert build_house(load_house("C")).law["wall_level"] is None


def test_envelope_of_a_test(tmp_path):
    """Points as they are; beyond the last one, the line from the peak through it, or to ultimate_drift."""
    line = "{along: x, at: 0, from: 0, to: 1, type: a, storeys: 1}"
    points = "[[1/120, 6590], [0.03, 13000], [1/20, 10400]]"
    joint, = sheets(house(tmp_path, line, f"{{a: {{envelope: {points}}}}}"))
    assert np.ravel(drifts_and_shears(joint)) == pytest.approx([1 / 120, 6590, 0.03, 13000, 0.05, 10400, 0.13, 0])
    assert joint.kn == pytest.approx(6590 * 120 * 0.91 / 2 / 2.73)
    assert joint.softening_stretch == pytest.approx(0.03 * 2.73)
    last = drifts_and_shears(sheets(house(tmp_path, line,
                                          f"{{a: {{envelope: {points}, ultimate_drift: 1/15}}}}"))[0])[-1]
    assert last == pytest.approx((1 / 15, 0))
    origin, = sheets(house(tmp_path, line, f"{{a: {{envelope: {points.replace('[[', '[[0, 0], [')}}}}}"))
    assert origin.envelope == joint.envelope
    late, = sheets(house(tmp_path, line, "{a: {envelope: [[0.002, 1000], [0.004, 4000], [0.1, 0]]}}"))  # a gentle start
    assert late.kn == pytest.approx(1.5e6 * 0.91 / 2 / 2.73)


NAILS = ("{k: 4.83e5, Pv: 1130, dv: 2.3e-3, du: 0.017, spacing: 0.075, height: 3.0, "
         "board: {width: 0.91, heights: [1.82, 0.91], thickness: 0.012, shear_modulus: 3.92e8}}")
"""Printed example of the book named in house/nails.py. Not printed there: boards of 3 x 6 and 3 x 3 shaku, nails 10 mm
from their edges, plywood of 12 mm and 392 N/mm2. Its results follow from them."""
SAWS = ("{F0: 8000, FI: 1200, DU: 0.015, S0: 5.0e6, R1: 0.058, R2: -0.05, R3: 1, R4: 0.02, alpha: 0.6, beta: 1.1, "
        "length: 2, height: 2.5}")
"""Set of OpenSees' example; length and height are chosen."""


def test_printed_example_of_nails(tmp_path):
    """H 3.0 m, W 0.91 m: K 1255 kN/rad, My 34.6 and Mu 41.3 kN m, ductility 5.25, Pa 8.37 kN; to 1 %."""
    path = tmp_path / "nails.yaml"
    path.write_text(f"extends: C\nname: nails\nwall_types: {{a: {{nails: {NAILS}}}}}\n")
    wall = nailed_wall(load_house(path).data["wall_types"]["a"]["nails"])
    found = [wall.stiffness, wall.yield_moment, wall.ultimate_moment, wall.ductility, wall.allowable]
    assert found == pytest.approx([1255e3, 34.6e3, 41.3e3, 5.25, 8.37e3], rel=0.01)


def test_nails_of_one_board_against_a_minimum():
    """A board turns by the share q of the drift for which the nails' work is least; nothing else is assumed."""
    nails = {"k": 4e5, "Pv": 900.0, "du": 0.017, "spacing": 0.15, "inner_spacing": 0.2, "height": None,
             "board": {"width": 0.91, "heights": [1.8], "thickness": 1.0, "shear_modulus": 1e20, "edge": 0.02}}
    xs, ys, inner = np.linspace(-0.435, 0.435, 7), np.linspace(-0.88, 0.88, 13), np.linspace(-0.88, 0.88, 10)[1:-1]
    points = [(x, y) for x in (-0.435, 0.435) for y in ys] + [(x, y) for x in xs[1:-1]
                                                              for y in (-0.88, 0.88)] + [(0, y) for y in inner]
    x, y = np.array(points).T
    work = [4e5 * (((1 - q) * y) ** 2 + (q * x) ** 2).sum() for q in np.linspace(0, 1, 100001)]
    best = np.linspace(0, 1, 100001)[np.argmin(work)]
    slips = np.hypot((1 - best) * y, best * x)
    wall = nailed_wall(nails)
    assert wall.stiffness * 1.8 == pytest.approx(min(work), rel=1e-6)
    assert wall.yield_moment == pytest.approx(900 * min(work) / 4e5 / slips.max(), rel=1e-3)
    assert wall.ultimate_moment == pytest.approx(900 * slips.sum(), rel=1e-3)


def test_wall_of_nails(tmp_path):
    """The example's wall in a bay: elastic, plastic up to the nails' failure, then the tail of tested walls."""
    joint, = sheets(
        house(tmp_path, "{along: x, at: 0, from: 0, to: 1, type: a, storeys: 1}", f"{{a: {{nails: {NAILS}}}}}"))
    (start, strength), (first, plastic), (end, nothing) = drifts_and_shears(joint)
    assert (strength, plastic, nothing) == (pytest.approx(41.3e3 / 3.0 / 0.91, rel=0.01), pytest.approx(strength), 0)
    assert (start, first, end) == (pytest.approx(41.3 / 3 / 1255, rel=0.01), pytest.approx(
        5.25 * start, rel=0.01), pytest.approx(2.314 * first, rel=0.01))


def test_own_wall_type(tmp_path):
    types = ("{board: {strength: 11500, stiffness: 8.0e5, friction_share: 0.1, softening_drift: 0.03, "
             "ultimate_drift: 0.06}}")
    joint, = sheets(house(tmp_path, "{along: x, at: 0, from: 0, to: 1, type: board, storeys: 2}", types))
    assert (joint.strength, joint.kn, joint.friction_share) == (pytest.approx(
        11500 * 0.91 / 2), pytest.approx(8e5 * 0.91 / 2 / 2.73), 0.1)


ONE = "{along: x, at: 0, from: 0, to: 1, type: a, storeys: 1}"


def test_cycles_of_a_type(tmp_path):
    """Defaults, own values, and the law slip with a friction share; forces are those of half the bay."""
    part = 0.91 / 2
    joint, = sheets(house(tmp_path, ONE, "{a: {multiplier: 1}}"))
    assert (joint.law, joint.cycles.friction_force) == ("wall", pytest.approx(0.1 * 2.8 * 1960 * part))
    assert (joint.cycles.reload_share, joint.cycles.reload_target) == (0.65, 1.1)
    types = "{a: {multiplier: 1, friction_force: 300, reload_share: 0.5, reload_target: 1}}"
    own, = sheets(house(tmp_path, ONE, types))
    assert (own.cycles.friction_force, own.cycles.reload_share, own.cycles.reload_target) == (
        pytest.approx(300 * part), 0.5, 1.0)
    types = "{a: {envelope: [[0.01, 5000], [0.1, 0]], pinched_share: 0.02, reload_drift: 1e-4, reload_power: 0.3}}"
    sloped, = sheets(house(tmp_path, ONE, types))
    assert (sloped.cycles.pinched_stiffness, sloped.cycles.reload_stiffness) == (
        pytest.approx(0.02 * sloped.kn), pytest.approx(sloped.kn))
    assert (sloped.cycles.reload_stretch, sloped.cycles.reload_power) == (pytest.approx(1e-4 * 2.73), 0.3)
    slip, = sheets(house(tmp_path, ONE, "{a: {multiplier: 1, friction_share: 0.2}}"))
    assert (slip.law, slip.friction_share, slip.cycles) == ("slip", 0.2, None)


def test_published_set(tmp_path):
    """Backbone, slopes and friction of a set, scaled from its wall of 2 m x 2.5 m to half a bay."""
    joint, = sheets(house(tmp_path, ONE, f"{{a: {{saws: {SAWS}}}}}"))
    part, lever = 0.91 / 2 / 2, 2.73 / 2.5
    assert joint.kn == pytest.approx(5e6 * part / lever) and joint.cycles.friction_force == pytest.approx(1200 * part)
    assert joint.cycles.pinched_stiffness == pytest.approx(0.02 * joint.kn)
    assert joint.cycles.reload_stretch == pytest.approx(8 / 5e3 * lever) and joint.cycles.reload_power == 0.6
    d, force = np.array(joint.envelope).T
    d, force = d / lever, force / part
    curve = (8000 + 0.058 * 5e6 * d) * (1 - np.exp(-5e6 * d / 8000))
    assert force[:-1] == pytest.approx(curve[:-1], rel=1e-12) and force[-1] == 0
    assert d[-2] == pytest.approx(0.015) and d[-1] - 0.015 == pytest.approx(curve[-2] / 0.05 / 5e6)


def test_residual_strength(tmp_path):
    """The falling line ends at the residual shear; points below it are left out."""
    points = "[[0.01, 4000], [0.03, 5000], [0.05, 2000], [0.08, 500]]"
    joint, = sheets(house(tmp_path, ONE, f"{{a: {{envelope: {points}, residual_share: 0.3}}}}"))
    assert np.ravel(drifts_and_shears(joint)) == pytest.approx([0.01, 4000, 0.03, 5000, 0.05, 2000, 0.06, 1500])


def test_finishes_are_taken_off(tmp_path):
    """No rule counts them, and one word removes them."""
    line = "{along: x, at: 0, from: 0, to: 3, type: [plywood, siding]}"
    model = house(tmp_path, line)
    assert {joint.sheet.type: joint.sheet.multiplier for joint in sheets(model)} == {"plywood": 2.5, "siding": 0}
    own = tmp_path / "bare.yaml"
    own.write_text("extends: own.yaml\nfinishes: false\n")
    bare = build_house(load_house(own))
    assert {joint.sheet.type for joint in sheets(bare)} == {"plywood"}
    assert diagnose(bare)["wall_quantity_ratio"] == diagnose(model)["wall_quantity_ratio"]


@pytest.mark.parametrize("name, kept", [("storehouse", set()), ("l_house", set()), ("tiled_house", {"plywood"})])
def test_shipped_houses_without_finishes(tmp_path, name, kept):
    path = tmp_path / "bare.yaml"
    path.write_text(f"extends: {name}\nname: bare\nfinishes: false\n")
    with_finishes, without = ({joint.sheet.type for joint in sheets(build_house(load_house(house)))}
                              for house in (name, path))
    assert with_finishes > kept == without


def test_walls_that_cover_a_part_of_the_height(tmp_path):
    """0.6 times the share of the height, of wood lath this share alone; as a bearing wall not counted."""
    lath = [sheets(house(tmp_path, f"{{along: x, at: 4, from: 0, to: 1, type: lath_plaster, storeys: 1{end}}}"))[0]
            for end in ("", ", panel: 0.5")]
    assert lath[1].strength == pytest.approx(0.5 * lath[0].strength)
    line = "{along: x, at: 4, from: 0, to: 1, type: plywood, storeys: 1%s}"
    whole, part = (house(tmp_path, line % end) for end in ("", ", panel: 0.5"))
    assert sheets(part)[0].strength == pytest.approx(0.3 * sheets(whole)[0].strength)
    assert sheets(part)[0].name.endswith("0-1.plywood.panel.beams")
    quantity = [diagnose(model)["structures"]["main"]["storeys"]["1"]["directions"]["ew"]["bearing_m"]
                for model in (part, build_house(load_house("C")))]
    assert quantity[0] == quantity[1]


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
    assert joint.points[0][2] == pytest.approx(0.52 + 2.73 / 2)
    assert joint.points[0][0] == pytest.approx(0.455 + 0.01 * (0.12 + 2.73 / 2), abs=2e-3)


def test_the_tiled_house():
    model = build_house(load_house("tiled_house"))
    assert 2.5 < weigh(model)["per_floor_area_kn_m2"] < 3.0
    assert model.counts()["braces"] == 0 and model.counts()["walls"] == 72
    layers = len(sheets(model))
    assert model.counts()["joints"] == len(model.joints) - 2 * layers
    assert f" joints, {layers} wall sheets, " in repr(model)
    assert "wall" not in build_house(load_house("C")).joints_text


def test_walls_are_added_by_name(tmp_path):
    """In a bay without walls of house C, and in all of them; a second one of the type is refused by the name of its
    bay.
    """
    names = free_wall_bays(load_house("C"), "plywood")
    assert "main.wall1.EW.y0.3-4.plywood" in names and len(names) == len(set(names)) > 80
    path = tmp_path / "walled.yaml"
    path.write_text(yaml.safe_dump(changed_house("C", braces=names), sort_keys=False))
    assert build_house(load_house(path)).counts()["walls"] == len(names)
    assert free_wall_bays(load_house(path), "mud") == []
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


WRONG_WALLS = {
    "no column": ("{along: y, at: 8, from: 0, to: 20, type: plywood}",
                  ["own.yaml:7", "no column at node 20", "0, 1, 2"]),
    "backwards": ("{along: y, at: 8, from: 3, to: 0, type: plywood}", ["'from' must be below 'to'"]),
    "unknown type": ("{along: y, at: 8, from: 0, to: 1, type: plywod}",
                     ["structures.main.walls[1].type", "did you mean 'plywood'?"]),
    "unknown storey": ("{along: y, at: 8, from: 0, to: 1, type: mud, storeys: 3}", ["no storey 3"]),
    "twice": ("{along: y, at: [8, 8], from: 0, to: 1, type: mud}", ["main.wall1.NS.x8.0-1", "type mud already"]),
    "opening": ("{along: y, at: 8, from: 0, to: 1, type: mud, opening: hole}", ["none, window, door"]),
}
WRONG_TYPES = {
    "no strength": ("{a: {stiffness: 1.0e5}}", ["own.yaml:3", "wall_types.a", "give multiplier or strength"]),
    "descending": ("{a: {multiplier: 1, softening_drift: 0.005}}", ["0.01", "must ascend"]),
    "two forms": ("{a: {nails: %s, envelope: [[0.01, 5000], [0.1, 0]]}}" % NAILS,
                  ["own.yaml:3", "give one of envelope, nails, saws"]),
    "friction in kN": ("{a: {multiplier: 1, friction_force: 20000}}",
                       ["wall_types.a.friction_force", "below the largest shear", "N/m"]),
    "two laws": ("{a: {multiplier: 1, friction_share: 0.2, reload_share: 0.5}}",
                 ["wall_types.a.reload_share", "does not go with friction_share"]),
    "half of reloading": ("{a: {multiplier: 1, reload_power: 0.5}}",
                          ["wall_types.a", "reload_drift and reload_power go together"]),
    "reloading twice": ("{a: {multiplier: 1, reload_power: 0.5, reload_drift: 0.001, reload_share: 0.5}}",
                        ["wall_types.a.reload_share", "does not go with reload_power"]),
    "pinched line too steep": ("{a: {envelope: [[0.01, 5000], [0.1, 0]], pinched_share: 0.9}}",
                               ["wall_types.a.pinched_share", "below the largest shear"]),
    "residual of slip": ("{a: {multiplier: 1, friction_share: 0.2, residual_share: 0.3}}",
                         ["wall_types.a.residual_share", "friction_share"]),
    "set in kN": ("{a: {saws: %s}}" % SAWS.replace("8000", "8"), ["wall_types.a.saws.F0", "8 kN = 8000"]),
    "set without a peak": ("{a: {saws: %s}}" % SAWS.replace("DU: 0.015", "DU: 0.0012"),
                           ["wall_types.a.saws", "F0 / S0"]),
    "set with own friction": ("{a: {friction_force: 100, saws: %s}}" % SAWS,
                              ["'friction_force' does not go with saws"]),
    "points descend": ("{a: {envelope: [[0.02, 5000], [0.01, 6000]]}}", ["own.yaml:3", "the drifts must ascend"]),
    "points end at the peak": ("{a: {envelope: [[0.01, 5000], [0.02, 6000]]}}", ["ultimate_drift"]),
    "points with a gap": ("{a: {envelope: [[0.01, 5000], [0.02, 0], [0.03, 100]]}}", ["only the last point"]),
    "shear in kN": ("{a: {envelope: [[0.01, 6.6], [0.1, 0]]}}", ["own.yaml:3", "N per m of wall", "kN"]),
    "no points": ("{a: {envelope: [[0, 0]]}}", ["needs points [drift, shear]"]),
    "shear at rest": ("{a: {envelope: [[0, 500], [0.1, 0]]}}", ["with drifts > 0"]),
    "point of one number": ("{a: {envelope: [0.01, 5000]}}", ["envelope[1]", "a list of two items"]),
    "drift in percent": ("{a: {envelope: [[1.5, 5000], [3, 0]]}}", ["envelope[1][1]", "[0, 0.5] rad"]),
    "drift of a part in percent": ("{a: {multiplier: 2.5, softening_drift: 3.3}}", ["3.3 % = 0.033"]),
    "strength of a wall in kN": ("{a: {strength: 13.3, stiffness: 8.0e5}}", ["[100, 1e+06] N/m", "13.3 kN/m = 13300"]),
    "stiffness of a wall in kN": ("{a: {strength: 13300, stiffness: 800}}", ["800 kN/m per rad = 800000"]),
    "friction force in kN": ("{a: {multiplier: 2.5, friction_force: 1.3}}", ["friction_force", "kN are 1000 N"]),
    "nails in kN/mm": ("{a: {nails: %s}}" % NAILS.replace("4.83e5", "0.483"), ["nails.k", "0.483 kN/mm = 483000"]),
    "nails without slip": ("{a: {nails: %s}}" % NAILS.replace("du: 0.017", "du: 0.002"),
                           ["nails.du", "greater than Pv / k"]),
    "nails in contradiction": ("{a: {nails: %s}}" % NAILS.replace("2.3e-3", "4e-3"), ["nails.dv", "within 10 %"]),
    "strength of nails": ("{a: {strength: 5000, nails: %s}}" % NAILS, ["'strength' does not go with nails"]),
}
"""{name: (wall or `wall_types`, parts of the message)}"""


@pytest.mark.parametrize("wall, types, words", [
    *((wall, "{}", words) for wall, words in WRONG_WALLS.values()),
    *(("{along: y, at: 8, from: 0, to: 1, type: a}", types, words) for types, words in WRONG_TYPES.values())],
                         ids=[*WRONG_WALLS, *WRONG_TYPES])
def test_mistake(tmp_path, wall, types, words):
    with pytest.raises(HouseError) as caught:
        house(tmp_path, wall, types)
    assert [word for word in words if word not in str(caught.value)] == [], caught.value
