# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""House files with common mistakes and hostile content: file, line and member of the message; limits; a small house of
its own.
"""
import os
import time

import pytest
from timber_houses.house import HouseError, build_house, limits, load_house
from timber_houses.house.loader import SHIPPED
from timber_houses.house.parser import parse_table

STOREHOUSE = """\
name: storehouse
materials:
  timber: {law: timber, density: 400, young: 9e9, poisson: 0.4}
  snow: {law: snow, density: 150, stiffness_per_kg: 4e4}
friction:
  - {between: [timber, timber], coefficient: 0.5}
ground: {size: 10, thickness: 1}
structures:
  store:
    place: {origin: [0, 0]}
    grid: {x: {module: 1, count: 2}, y: {positions: [0, 1.5]}}
    margin: 0.1
    lines:
      - {along: x, at: [0, 1], from: 0, to: 2}
      - {along: y, at: [0, 2], from: 0, to: 1, cut: true}
    stack:
      - {layer: sill, height: 0.1, width: 0.1}
      - {layer: columns, height: 2}
      - {layer: beams, height: 0.1, width: 0.1}
      - {layer: roof, type: flat, thickness: 0.1}
    columns:
      - {section: 0.1, grid: {x: [0, 1, 2], y: [0, 1]}}
    braces:
      lines:
        - {along: x, at: 0, runs: [[0, 1]]}
joint_types:
  peg: {kn: 1e5, ks: 1e5, strength: 2000}
joints:
  column_ends: {between: [column, [sill, beam]], type: peg, kind: column_beam}
  brace_ends: {between: [brace, [sill, beam]], type: peg, kind: brace_beam}
  beams: {between: [beam, beam], type: peg, kind: beam_beam}
snow: {depth: 0.5}
"""


def build(tmp_path, text):
    path = tmp_path / "store.yaml"
    path.write_text(text)
    return build_house(load_house(path))


def message(tmp_path, text):
    with pytest.raises(HouseError) as caught:
        build(tmp_path, text)
    assert str(caught.value).isprintable()
    return str(caught.value)


def test_a_small_storehouse(tmp_path):
    counts = build(tmp_path, STOREHOUSE).counts()
    assert counts["by_kind"] == {"ground": 1, "sill": 4, "column": 6, "brace": 1, "beam": 4, "roof": 1, "snow": 1}
    assert counts["joints_by_kind"] == {"column_beam": 12, "brace_beam": 2, "beam_beam": 4}
    assert counts["mass_snow"] == pytest.approx(2.2 * 1.7 * 0.5 * 150)


def test_structures_are_not_jointed_to_each_other(tmp_path):
    """Two stores in contact: no joints between them, though the side faces of their roofs are flush."""
    start, end = STOREHOUSE.index("  store:"), STOREHOUSE.index("joint_types:")
    second = STOREHOUSE[start:end].replace("store:", "annex:").replace("origin: [0, 0]", "beside: store, gap: 0")
    ties = "  ties: {between: [roof, roof], type: peg, kind: roof_roof}\nsnow:"
    model = build(tmp_path, (STOREHOUSE[:end] + second + STOREHOUSE[end:]).replace("snow:", ties, 2).replace(
        ties, "snow:", 1))
    assert model.counts()["joints_by_kind"] == {"column_beam": 24, "brace_beam": 4, "beam_beam": 8}


def test_joint_types_override_the_law(tmp_path):
    text = STOREHOUSE + "law: {per: joint}\n"
    assert {joint.per for joint in build(tmp_path, text).joints} == {"joint"}
    assert {
        joint.per
        for joint in build(tmp_path, text.replace("strength: 2000", "strength: 2000, per: spring")).joints
    } == {"spring"}


# mistake: (old text, new text, line of the new text that the message names, members and values in the message)
MISTAKES = {
    "syntax": ("place: {origin: [0, 0]}", "place: {origin: [0, 0}", 10, []),
    "unknown key": ("section: 0.1", "secton: 0.1", 22, ["columns[1]", "'secton'", "'section'"]),
    "missing key": ("    margin: 0.1\n", "", 10, ["structures.store", "'margin'"]),
    "key given twice": ("    margin: 0.1\n", "    margin: 0.1\n    margin: 0.2\n", 13, ["'margin'", "line 12"]),
    "text for a number": ("margin: 0.1", "margin: wide", 12, ["structures.store.margin", "[0, 2] m", "'wide'"]),
    "out of range": ("density: 400", "density: -400", 3, ["materials.timber.density", "[20, 30000] kg/m3", "-400"]),
    "not a number": ("strength: 2000", "strength: .nan", 27, ["joint_types.peg.strength", "nan"]),
    "not whole": ("count: 2", "count: 2.5", 11, ["grid.x.count", "[1, 200] modules", "2.5"]),
    "unknown layer": ("layer: columns", "layer: column", 18, ["stack[2].layer", "'column'", "'columns'"]),
    "unknown roof": ("type: flat", "type: thatch", 20, ["stack[4].type", "'thatch'", "hip, gable, mono, flat"]),
    "unknown direction": ("along: x, at: 0", "along: z, at: 0", 25, ["braces.lines[1].along", "'z'", "x, y"]),
    "unknown joint type": ("type: peg, kind: column_beam", "type: pegg, kind: column_beam", 29,
                           ["joints.column_ends.type", "'pegg'", "'peg'"]),
    "unknown material": ("{layer: columns, height: 2}", "{layer: columns, height: 2, material: steel}", 18,
                         ["stack[2].material", "'steel'", "timber, snow"]),
    "unknown friction pair": ("between: [timber, timber]", "between: [timber, ice]", 6, ["friction[1]", "'ice'"]),
    "two column forms": ("section: 0.1, grid", "section: 0.1, at: [[0, 0]], grid", 22,
                         ["columns[1]", "at, grid, lines", "at and grid"]),
    "no list": ("runs: [[0, 1]]", "runs: 3", 25, ["lines[1].runs", "got 3"]),
    "wrong length": ("runs: [[0, 1]]", "runs: [[0, 1, 2]]", 25, ["lines[1].runs[1]", "2 items", "3"]),
    "outside the grid": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 3], y: [0, 1]", 22, ["store", "x node 3", "0 to 2"]),
    "line backwards": ("at: [0, 1], from: 0, to: 2", "at: [0, 1], from: 2, to: 0", 14, ["store", "from 2 to 0"]),
    "positions and count": ("positions: [0, 1.5]", "positions: [0, 1.5], count: 2", 11, ["grid.y.count", "no effect"]),
    "positions not rising": ("[0, 1.5]", "[1.5, 0]", 11, ["grid.y.positions"]),
    "second column": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 2, 2], y: [0, 1]", 22, ["store", "x 2, y 0", "storey 1"]),
    "no such storey": ("section: 0.1, grid", "section: 0.1, storeys: 2, grid", 22, ["columns[1]", "storey 2", "[1]"]),
    "brace without a column": ("runs: [[0, 1]]", "runs: [[0, 0.5]]", 25, ["store", "[0, 0.5]", "node 0.5", "0, 1, 2"]),
    "brace over a column": ("runs: [[0, 1]]", "runs: [[0, 2]]", 25, ["store", "[0, 2]", "node 1"]),
    "shift of an origin": ("place: {origin: [0, 0]}", "place: {origin: [0, 0], shift: 3}", 10,
                           ["place.shift", "origin"]),
    "brace on the spot": ("runs: [[0, 1]]", "runs: [[1, 1]]", 25, ["store", "[1, 1]"]),
    "brace off the lines": ("along: x, at: 0, runs", "along: x, at: 0.5, runs", 25, ["store", "node 0.5", "none"]),
    "column on nothing": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 2], y: [0, 0.5, 1]", 22,
                          ["column store.column1.x1y0.5", "x 1.000, y 0.750, z 0.100"]),
    "overlapping lines": ("to: 1, cut: true", "to: 1", 15, ["sill", "100 mm", "x 0.000, y 0.000"]),
    "overlapping braces": ("runs: [[0, 1]]", "runs: [[0, 1], [1, 0]]", 25,
                           ["store.brace1.EW.y0.1-0", "store.brace1.EW.y0.0-1"]),
    "roof not last": ("type: flat, thickness: 0.1}\n",
                      "type: flat, thickness: 0.1}\n      - {layer: floor, thickness: 0.1}\n", 21, ["stack[5]"]),
    "too much damage": ("snow: {depth: 0.5}", "damage: {regions: [{side: east, storey: 1, column_beam: {count: 3}}]}",
                        32, ["damage.regions[1].column_beam", "3 joints", "has 2 whole ones at the bottom"]),
    "damage to nowhere": ("snow: {depth: 0.5}", "damage: {regions: [{structure: barn, side: east, storey: 1}]}", 32,
                          ["damage.regions[1].structure", "'barn'", "store"]),
    "snow too deep": ("depth: 0.5", "depth: 50", 32, ["snow.depth", "[0, 6] m"]),
    "section in mm": ("section: 0.1, grid", "section: 105, grid", 22,
                      ["columns[1].section", "(0.01, 1] m", "105 mm = 0.105"]),
    "height in mm": ("layer: columns, height: 2", "layer: columns, height: 2000", 18,
                     ["stack[2].height", "(0.1, 20] m", "2000 mm = 2 or 2000 cm = 20"]),
    "module in mm": ("module: 1, count: 2", "module: 910, count: 2", 11, ["grid.x.module", "910 mm = 0.91"]),
    "density in g/cm3": ("density: 400", "density: 0.4", 3,
                         ["materials.timber.density", "[20, 30000] kg/m3", "0.4 g/cm3 = 400"]),
    "modulus in GPa": ("young: 9e9", "young: 9", 3,
                       ["materials.timber.young", "[1e+06, 1e+12] Pa", "9 MPa = 9e+06 or 9 GPa = 9e+09"]),
    "stiffness in kN/m": ("kn: 1e5", "kn: 100", 27, ["joint_types.peg.kn", "[10000, 1e+12] N/m", "100 kN/m = 100000"]),
    "strength in kN": ("strength: 2000", "strength: 2", 27, ["joint_types.peg.strength", "2 kN = 2000"]),
    "strength of a fitting in kN": ("strength: 2000", "strength: 11", 27, ["[100, inf] N", "11 kN = 11000"]),
    "stiffness of a fitting in kN/m": ("kn: 1e5", "kn: 1500", 27, ["[10000, 1e+12] N/m", "1500 kN/m = 1.5e+06"]),
    "stretch in mm": ("strength: 2000", "strength: 2000, law: slip, friction_share: 0.2, softening_stretch: 0.1,"
                      " ultimate_stretch: 4", 27, ["[1e-05, 0.5] m", "4 mm = 0.004"]),
    "density of no wood": ("density: 400", "density: 3400", 3, ["materials.timber.density", "at most 1400 kg/m3"]),
    "snow of a hall": ("depth: 0.5", "depth: 10", 32, ["snow.depth", "[0, 6] m", "10 cm = 0.1"]),
    "pitch in sun": ("type: flat, thickness: 0.1", "type: gable, pitch: 4, thickness: 0.1", 20,
                     ["stack[4].pitch", "[0.02, 3] rise over run", "4 sun (tenths) = 0.4"]),
    "pitch and height": ("type: flat, thickness: 0.1", "type: gable, pitch: 0.4, ridge_height: 4, thickness: 0.1", 20,
                         ["stack[4]", "pitch, ridge_height", "pitch and ridge_height"]),
    "no pitch": ("type: flat, thickness: 0.1", "type: gable, thickness: 0.1", 20,
                 ["stack[4]", "pitch, ridge_height", "none"]),
    "snow on no roof": ("type: flat, thickness: 0.1", "type: flat, thickness: 0.1, snow: false", 32, ["snow", "0.5 m"]),
    "two roofs in one place": ("{layer: roof, type: flat, thickness: 0.1}",
                               "{layer: roof, type: flat, thickness: 0.1}\n      - {layer: roof, type: flat, "
                               "thickness: 0.2, snow: false}", 21, ["store.roof2", "store.roof1"]),
    "empty area": ("type: flat, thickness: 0.1", "type: flat, thickness: 0.1, area: {x: [1, 1], y: [0, 1]}", 20,
                   ["store", "x node 1"]),
    "beam in the air": ("  beams: {between: [beam, beam], type: peg, kind: beam_beam}\n", "", 15,
                        ["beam store.beam1.NS.x0.1", "x 0.000, y 0.750, z 2.100", "1 more"]),
    "list of rules": ("  column_ends: {between", "  - {between", 30, ["not valid YAML"]),
    "two rules for a pair": ("snow: {depth: 0.5}", "  posts: {between: [sill, column], type: peg, kind: column_beam}",
                             32,
                             ["joints.posts", "joins column and sill as joints.column_ends", "null"]),
    "kind of a wall": ("kind: brace_beam", "kind: wall_beam", 30,
                       ["joints.brace_ends.kind", "'wall_beam'", "sheathed walls"]),
    "slip key without slip": ("strength: 2000", "strength: 2000, friction_share: 0.2", 27,
                              ["joint_types.peg", "'friction_share'", "law: slip"]),
    "slip without stretches": ("strength: 2000", "strength: 2000, law: slip, friction_share: 0.2", 27,
                               ["joint_types.peg", "'softening_stretch'"]),
    "slip with two stiffnesses": ("ks: 1e5, strength: 2000",
                                  "ks: 2e5, strength: 2000, law: slip, friction_share: 0, softening_stretch: 0.1, "
                                  "ultimate_stretch: 0.2", 27,
                                  ["joint_types.peg.ks", "100000"]),
    "slip stretches descend": ("strength: 2000",
                               "strength: 2000, law: slip, friction_share: 0, softening_stretch: 0.01, "
                               "ultimate_stretch: 0.2", 27,
                               ["joint_types.peg", "0.02 m", "must ascend"]),
    "share above one": ("type: peg, kind: brace_beam", "type: peg, kind: brace_beam, share: 1.5", 30,
                        ["joints.brace_ends.share", "[0.01, 1]", "1.5"]),
    "joints forgotten": ("  brace_ends: {between: [brace, [sill, beam]], type: peg, kind: brace_beam}\n", "", 25,
                         ["brace store.brace1.EW.y0.0-1", "bottom", "22.2 cm2", "sill store.sill.EW.y0",
                          "joint_search.min_area"]),
    "brace without a sill": ("along: x, at: 0, runs", "along: y, at: 1, runs", 25,
                             ["brace store.brace1.NS.x1.0-1", "z 0.100"]),
    "column without a beam": ("height: 0.1, width: 0.1}\n      - {layer: roof",
                              "height: 0.1, width: 0.1, lines: [{along: x, at: 0, from: 0, to: 2}]}\n      - {layer: "
                              "roof", 22, ["column store.column1.x0y1", "z 2.100"]),
    "impossible friction": ("between: [timber, timber], coefficient: 0.5", "between: [timber, snow], coefficient: 0.7",
                            6, ["friction of timber and snow", "0.7", "0.5"]),
    "damage to no side": ("snow: {depth: 0.5}", "damage: {regions: [{side: easst, storey: 1}]}", 32,
                          ["damage.regions[1].side", "'easst'", "'east'"]),
    "no storey": ("      - {layer: columns, height: 2}\n", "", 20, ["structures.store.columns"]),
    "ground too small": ("ground: {size: 10", "ground: {size: 1.5", 7, ["ground.size", "1.5 m", "2.2"]),
    "name with a blank": ("  store:", "  the store:", 9, ["structures", "'the store'"]),
    "beside nothing": ("origin: [0, 0]", "beside: barn", 10, ["structures.store.place", "'barn'"]),
    "decimal comma": ("margin: 0.1", "margin: 0,1", 12, ["structures.store.margin", "0.1"]),
    "decimal comma and a zero": ("height: 2}", "height: 2,05}", 18, ["'2,05'", "2.05"]),
    "decimal comma in braces": ("height: 2}", "height: 2,73}", 18, ["'2,73'", "2.73"]),
    "octal": ("count: 2", "count: 010", 11, ["'010'"]),
    "base 60": ("height: 2}", "height: 1:30}", 18, ["'1:30'"]),
    "integer tag": ("count: 2", "count: !!int two", 11, ["'two'"]),
    "float tag": ("module: 1", "module: !!float one", 11, ["'one'"]),
    "flag tag": ("cut: true", "cut: !!bool so", 15, ["'so'"]),
    "date tag": ("name: storehouse", "name: !!timestamp today", 1, ["!!timestamp"]),
    "set": ("{origin: [0, 0]}", "!!set {origin}", 10, ["!!set"]),
    "integer of 400 digits": ("count: 2", "count: " + "9" * 400, 11, ["400"]),
    "integer of 5000 digits": ("count: 2", "count: " + "9" * 5000, 11, ["5000"]),
    "NUL": ("name: storehouse", "name: store\0house", 1, ["#x0000"]),
    "escaped NUL in a name": ("name: storehouse", "name: \"store\\0house\"", 1, ["name"]),
    "escape byte in a name": ("name: storehouse", "name: \"\\e[31mstore\"", 1, ["name"]),
    "half a character": ("name: storehouse", "name: \"\\ud800\"", 1, ["name"]),
    "beyond Unicode": ("name: storehouse", "name: \"\\UFFFFFFFF\"", 1, []),
    "a very long name": ("name: storehouse", "name: " + "x" * 3000, 1, ["name", "3000", "60"]),
    "a trace of snow": ("depth: 0.5", "depth: 1e-12", 32, ["snow.depth", "[0.001, 6] m", "1e-12"]),
    "positions on top of each other": ("[0, 1.5]", "[0, 1e-9]", 11, ["grid.y.positions", "0.01 m"]),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistake(tmp_path, mistake):
    old, new, line, words = MISTAKES[mistake]
    assert STOREHOUSE.count(old) >= 1
    text = message(tmp_path, STOREHOUSE.replace(old, new, 1))
    assert text.startswith(f"store.yaml:{line}:"), text
    for word in words:
        assert word in text, text


def test_align_mistake(tmp_path):
    start, end = STOREHOUSE.index("  store:"), STOREHOUSE.index("joint_types:")
    annex = STOREHOUSE[start:end].replace("store:",
                                          "annex:").replace("origin: [0, 0]", "beside: store, side: east, align: west")
    assert "structures.annex.place.align: on the east side, align north or south" in message(
        tmp_path, STOREHOUSE[:end] + annex + STOREHOUSE[end:])


def test_hip_roof_mistakes(tmp_path):
    hip = STOREHOUSE.replace("type: flat, thickness: 0.1",
                             "type: hip, thickness: 0.1, ridge_height: 2.0, corner_cut: 0.1")
    assert "the ridge (2 m) must lie above the eaves (2.2 m)" in message(tmp_path, hip)
    assert "corner_cut must be below" in message(tmp_path, hip.replace("2.0, corner_cut: 0.1", "3.0, corner_cut: 0.9"))


NO_HOUSES = {  # text of the file: place and member in the message
    "": "store.yaml:1",
    "- 1\n": "store.yaml:1",
    "extends: nowhere.yaml\n": "store.yaml:1: extends: ",
    "extends: bse\n": "store.yaml:1: extends: ",
    "extends: store.yaml\n": "store.yaml:1: extends: ",
    "extends: 3\n": "store.yaml:1: extends: ",
    "extends: ..\n": "store.yaml:1: extends: ",
    "extends: /dev/zero\n": "store.yaml:1: extends: ",
    'extends: "a\\0b"\n': "store.yaml:1: extends: ",
    f"extends: {'a/' * 3000}\n": "store.yaml:1: extends: ",
    "1: 2\n": "store.yaml:1",
    "%YAML 1." + "9" * 5000 + "\n---\na: 1\n": "store.yaml:",
    "---\n---\n": "store.yaml:2",
}


@pytest.mark.parametrize("text", NO_HOUSES, ids=range(len(NO_HOUSES)))
def test_files_that_are_no_house(tmp_path, text):
    assert message(tmp_path, text).startswith(NO_HOUSES[text])


def refusal(path):
    with pytest.raises(HouseError) as caught:
        load_house(path)
    assert str(caught.value).isprintable()
    return str(caught.value)


def test_paths_that_are_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    for path in ("Z", "", ".", tmp_path, tmp_path / "pipe.yaml", "/dev/zero", "x" * 300, "a/" * 3000, "a\0b", "\udcff"):
        assert "unknown house" in refusal(path)
    (tmp_path / "latin.yaml").write_bytes(b"name: \xff\xfe")
    assert "latin.yaml" in refusal(tmp_path / "latin.yaml")


# --- limits -----------------------------------------------------------------------------------------------------------


def nested(levels):
    return "a: " + "[" * levels + "]" * levels + "\n"


def laughs():
    rows = [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 12)]
    return "\n".join(["a0: &a0 [x]", *rows]) + "\n"


def fine_grid():
    """The storehouse with columns 1 mm apart and without braces."""
    nodes = "x: {}, y: {}".format(*([i / 1000 for i in range(count)] for count in (40, 20)))
    text = STOREHOUSE.replace("{x: [0, 1, 2], y: [0, 1]}", f"{{{nodes}}}")
    return text.replace("at: 0, runs: [[0, 1]]", "at: 0, runs: []")


def with_grid(nodes):
    """The storehouse on a grid of nodes x nodes with a column at each."""
    text = STOREHOUSE.replace("{module: 1, count: 2}, y: {positions: [0, 1.5]}",
                              f"{{module: 1, count: {nodes}}}, y: {{module: 1, count: {nodes}}}").replace(
                                  "size: 10", "size: 900")
    return text.replace("grid: {x: [0, 1, 2], y: [0, 1]}",
                        f"grid: {{x: {list(range(nodes))}, y: {list(range(nodes))}}}")


LIMITS = {  # file: (text, place, limit in the message)
    "billion laughs": (laughs, "store.yaml:1", limits.MAX_NODES),
    "quadratic aliases": (lambda: f"a: &a [{', '.join('x' * 5000)}]\nb: [{', '.join(['*a'] * 5000)}]\n", "store.yaml:",
                          limits.MAX_NODES),
    "an alias of itself": (lambda: "a: &a [*a]\n", "store.yaml:1", limits.MAX_DEPTH),
    "20 MB": (lambda: "a: [" + "1," * 10_000_000 + "]", "store.yaml", limits.MAX_FILE_SIZE / 1e6),
    "100 000 keys": (lambda: "".join(f"k{i}: 1\n" for i in range(30_000)), "store.yaml:10000", limits.MAX_NODES),
    "400 000 digits": (lambda: STOREHOUSE.replace("count: 2", f"count: {'1' * 400_000}"), "store.yaml:11",
                       limits.MAX_NUMBER_LENGTH),
    "200 000 levels": (lambda: nested(200_000), "store.yaml:1", limits.MAX_DEPTH),
    "levels of keys": (lambda: "? " * 100_000, "store.yaml:1", limits.MAX_DEPTH),
    "positions": (lambda: STOREHOUSE.replace("[0, 1.5]", str(list(range(9000)))),
                  "store.yaml:11: structures.store.grid.y.positions", 400),
    "braces": (lambda: STOREHOUSE.replace("at: 0, runs: [[0, 1]]", f"at: {[0] * 300}, runs: {[[0, 1]] * 900}"),
               "store.yaml:25: structures.store", limits.MAX_ELEMENTS),
    "columns on 200 x 200 nodes": (lambda: with_grid(200), "store.yaml:22: structures.store.columns[1]",
                                   limits.MAX_ELEMENTS),
    "columns 1 mm apart": (fine_grid, "store.yaml:22: column", limits.MAX_PAIRS),
    "storeys": (lambda: STOREHOUSE.replace("      - {layer: columns, height: 2}\n",
                                           "      - {layer: columns, height: "
                                           "2}\n" * 21), "store.yaml:38: structures.store.stack[22]", 20),
}


@pytest.mark.parametrize("name", LIMITS)
def test_limits_are_in_the_message(tmp_path, name):
    """In less than 2 s of processor time, as observed; the bound leaves room for a slow machine."""
    text, place, limit = LIMITS[name]
    start = time.process_time()
    said = message(tmp_path, text())
    assert time.process_time() - start < 5
    assert place in said and f"{limit:g}" in said, said


def test_a_chain_of_3000_files(tmp_path):
    for i in range(3000):
        (tmp_path / f"h{i}.yaml").write_text(f"extends: h{i + 1}.yaml\n")
    said = refusal(tmp_path / "h0.yaml")
    assert said.startswith(f"h{limits.MAX_FILES - 1}.yaml:1: extends: ") and str(limits.MAX_FILES) in said


def test_an_error_in_an_extended_file_names_that_file(tmp_path):
    (tmp_path / "paper.yaml").write_text((SHIPPED / "paper.yaml").read_text().replace(
        "margin: 0.075 ", "margin: -1 ", 1))
    text = message(tmp_path, "extends: paper.yaml\nname: mine\n")
    assert text.startswith("paper.yaml:") and "structures.main.margin" in text


def test_snow_depth_argument_is_checked(tmp_path):
    (tmp_path / "store.yaml").write_text(STOREHOUSE)
    for depth in (-1, float("nan")):
        with pytest.raises(HouseError, match="snow depth"):
            build_house(load_house(tmp_path / "store.yaml"), depth)


@pytest.mark.parametrize("text, refused", [("[0, 2,73]", True), ("[0,1, 2]", True), ("[1.5, 0,5]", True),
                                           ("[0,1]", False), ("[0, 1, 2.5]", False), ("[[0,1], [2, 3]]", False),
                                           ("[0,\n 1, 2]", False), ("[a,b, c]", False)])
def test_a_decimal_comma_in_a_list(text, refused):
    if not refused:
        return parse_table(f"a: {text}\n", "own.yaml")
    with pytest.raises(HouseError, match="own.yaml:1: .*decimal point"):
        parse_table(f"a: {text}\n", "own.yaml")
