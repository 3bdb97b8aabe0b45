# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""House files with each of the common mistakes, and the one line each of them gets; and a house that is none of the paper's."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "py"))

from yade_timber.house import HouseError, build_house, load_house  # noqa: E402
from yade_timber.house.loader import SHIPPED  # noqa: E402

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
  - {between: [column, [sill, beam]], type: peg, kind: column_beam}
  - {between: [brace, [sill, beam]], type: peg, kind: brace_beam}
  - {between: [beam, beam], type: peg, kind: beam_beam}
snow: {depth: 0.5}
"""


def build(tmp_path, text):
    path = tmp_path / "store.yaml"
    path.write_text(text)
    return build_house(load_house(path))


def message(tmp_path, text):
    with pytest.raises(HouseError) as caught:
        build(tmp_path, text)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_storehouse_of_ones_own(tmp_path):
    counts = build(tmp_path, STOREHOUSE).counts()
    assert counts["by_kind"] == {"ground": 1, "sill": 4, "column": 6, "brace": 1, "beam": 4, "roof": 1, "snow": 1}
    assert counts["joints_by_kind"] == {"column_beam": 12, "brace_beam": 2, "beam_beam": 4}
    assert counts["mass_snow"] == pytest.approx(2.2 * 1.7 * 0.5 * 150)


def test_structures_are_not_jointed_to_each_other(tmp_path):
    """A second store that touches the first has its own joints only, though the roofs' side faces lie flush."""
    start, end = STOREHOUSE.index("  store:"), STOREHOUSE.index("joint_types:")
    second = STOREHOUSE[start:end].replace("store:", "annex:").replace("origin: [0, 0]", "beside: store, gap: 0")
    ties = "  - {between: [roof, roof], type: peg, kind: roof_roof}\nsnow:"
    model = build(tmp_path, (STOREHOUSE[:end] + second + STOREHOUSE[end:]).replace("snow:", ties, 2).replace(ties, "snow:", 1))
    assert model.counts()["joints_by_kind"] == {"column_beam": 24, "brace_beam": 4, "beam_beam": 8}


def test_joint_reading_is_one_switch_that_a_joint_type_may_override(tmp_path):
    text = STOREHOUSE + "law: {joint_reading: joint}\n"
    assert {joint.per for joint in build(tmp_path, text).joints} == {"joint"}
    assert {joint.per for joint in build(tmp_path, text.replace("strength: 2000", "strength: 2000, per: spring")).joints} == {"spring"}


MISTAKES = {  # what is wrong: (old text, new text, line of the new text that the message names, words of the message)
    "syntax": ("place: {origin: [0, 0]}", "place: {origin: [0, 0}", 10, ["not valid YAML"]),
    "unknown key": ("section: 0.1", "secton: 0.1", 22, ["unknown key 'secton'", "did you mean 'section'?"]),
    "missing key": ("    margin: 0.1\n", "", 10, ["structures.store", "'margin' is missing"]),
    "key given twice": ("    margin: 0.1\n", "    margin: 0.1\n    margin: 0.2\n", 13, ["'margin' is given twice", "line 12"]),
    "text for a number": ("margin: 0.1", "margin: wide", 12, ["expected a number", "m", "'wide'"]),
    "out of range": ("density: 400", "density: -400", 3, ["[20, 30000] kg/m3", "-400"]),
    "not a number": ("strength: 2000", "strength: .nan", 27, ["joint_types.peg.strength", "nan"]),
    "not whole": ("count: 2", "count: 2.5", 11, ["whole number", "2.5"]),
    "unknown layer": ("layer: columns", "layer: column", 18, ["'column' is unknown", "did you mean 'columns'?"]),
    "unknown roof": ("type: flat", "type: onion", 20, ["'onion' is unknown", "hip, gable, flat"]),
    "unknown direction": ("along: x, at: 0", "along: z, at: 0", 25, ["'z' is unknown", "x, y"]),
    "unknown joint type": ("type: peg, kind: column_beam", "type: pegg, kind: column_beam", 29, ["unknown joint type 'pegg'", "did you mean 'peg'?"]),
    "unknown material": ("{layer: columns, height: 2}", "{layer: columns, height: 2, material: steel}", 18, ["unknown material 'steel'"]),
    "unknown friction pair": ("between: [timber, timber]", "between: [timber, ice]", 6, ["unknown material 'ice'"]),
    "two column forms": ("section: 0.1, grid", "section: 0.1, at: [[0, 0]], grid", 22, ["exactly one of at, grid, lines", "at and grid"]),
    "no list": ("runs: [[0, 1]]", "runs: 3", 25, ["expected a list"]),
    "wrong length": ("runs: [[0, 1]]", "runs: [[0, 1, 2]]", 25, ["expected 2 items, got 3"]),
    "outside the grid": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 3], y: [0, 1]", 22, ["x node 3 is outside the grid", "0 to 2"]),
    "line backwards": ("at: [0, 1], from: 0, to: 2", "at: [0, 1], from: 2, to: 0", 14, ["'from' must be below 'to'"]),
    "positions not rising": ("[0, 1.5]", "[1.5, 0]", 11, ["rising order"]),
    "second column": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 2, 2], y: [0, 1]", 22, ["a second column at node x 2, y 0", "remove one"]),
    "no such storey": ("section: 0.1, grid", "section: 0.1, storeys: 2, grid", 22, ["no storey 2"]),
    "brace without a column": ("runs: [[0, 1]]", "runs: [[0, 0.5]]", 25, ["no bay", "no column at node 0.5", "0, 1, 2"]),
    "brace over a column": ("runs: [[0, 1]]", "runs: [[0, 2]]", 25, ["no bay", "a column stands between, at node 1"]),
    "brace on the spot": ("runs: [[0, 1]]", "runs: [[1, 1]]", 25, ["no bay", "same column"]),
    "brace off the lines": ("along: x, at: 0, runs", "along: x, at: 0.5, runs", 25, ["no bay", "columns of this line stand at none"]),
    "column on nothing": ("x: [0, 1, 2], y: [0, 1]", "x: [0, 1, 2], y: [0, 0.5, 1]", 22, ["column store.column1.x1y0.5 stands on nothing", "x 1.000, y 0.750, z 0.100"]),
    "overlapping lines": ("to: 1, cut: true", "to: 1", 15, ["overlaps", "by 100 mm", "x 0.000, y 0.000", "move or shorten"]),
    "overlapping braces": ("runs: [[0, 1]]", "runs: [[0, 1], [1, 0]]", 25, ["store.brace1.EW.y0.1-0 overlaps brace store.brace1.EW.y0.0-1"]),
    "roof not last": ("type: flat, thickness: 0.1}\n", "type: flat, thickness: 0.1}\n      - {layer: floor, thickness: 0.1}\n", 21, ["nothing can stand on a roof"]),
    "too much damage": ("snow: {depth: 0.5}", "damage: {regions: [{side: east, storey: 1, column_beam: {count: 3}}]}", 32, ["3 joints asked for", "has 2 at the bottom"]),
    "damage to nowhere": ("snow: {depth: 0.5}", "damage: {regions: [{structure: barn, side: east, storey: 1}]}", 32, ["unknown structure 'barn'"]),
    "snow too deep": ("depth: 0.5", "depth: 50", 32, ["[0, 20] m"]),
    "section in mm": ("section: 0.1, grid", "section: 105, grid", 22, ["(0.01, 1] m", "got 105; in m: 105 mm = 0.105"]),
    "height in mm": ("layer: columns, height: 2", "layer: columns, height: 2000", 18, ["(0.1, 20] m", "2000 mm = 2 or 2000 cm = 20"]),
    "module in mm": ("module: 1, count: 2", "module: 910, count: 2", 11, ["910 mm = 0.91"]),
    "density in g/cm3": ("density: 400", "density: 0.4", 3, ["[20, 30000] kg/m3", "0.4 g/cm3 = 400"]),
    "modulus in GPa": ("young: 9e9", "young: 9", 3, ["[1e+06, 1e+12] Pa", "9 MPa = 9e+06 or 9 GPa = 9e+09"]),
    "stiffness in kN/m": ("kn: 1e5", "kn: 100", 27, ["[1000, 1e+12] N/m", "100 kN/m = 100000"]),
    "strength in kN": ("strength: 2000", "strength: 2", 27, ["2 kN = 2000"]),
    "pitch in sun": ("type: flat, thickness: 0.1", "type: gable, pitch: 4, thickness: 0.1", 20, ["[0.02, 3] rise over run", "4 sun (tenths) = 0.4"]),
    "pitch and height": ("type: flat, thickness: 0.1", "type: gable, pitch: 0.4, ridge_height: 4, thickness: 0.1", 20, ["exactly one of pitch, ridge_height"]),
    "no pitch": ("type: flat, thickness: 0.1", "type: gable, thickness: 0.1", 20, ["exactly one of pitch, ridge_height; got none"]),
    "eaves too wide": ("type: flat, thickness: 0.1", "type: gable, pitch: 0.5, eaves: 0.3, thickness: 0.1", 20,
                       ["would not reach its wall plates", "0.224 m wide", "0.4 m beyond", "eaves below 0.124 or a thickness above 0.179"]),
    "snow on no roof": ("type: flat, thickness: 0.1", "type: flat, thickness: 0.1, snow: false", 32, ["0.5 m of snow have no roof"]),
    "two roofs in one place": ("{layer: roof, type: flat, thickness: 0.1}", "{layer: roof, type: flat, thickness: 0.1}\n      - {layer: roof, type: flat, thickness: 0.2, snow: false}",
                               21, ["roof store.roof2 overlaps", "store.roof1"]),
    "empty area": ("type: flat, thickness: 0.1", "type: flat, thickness: 0.1, area: {x: [1, 1], y: [0, 1]}", 20, ["an area from x node 1 to itself is empty"]),
    "beam in the air": ("  - {between: [beam, beam], type: peg, kind: beam_beam}\n", "", 15, ["beam store.beam1.NS.x0.1 hangs in the air near x 0.000, y 0.750, z 2.100", "and 1 more"]),
    "joints forgotten": ("  - {between: [brace, [sill, beam]], type: peg, kind: brace_beam}\n", "", 25,
                         ["brace store.brace1.EW.y0.0-1 has no joint at its bottom, where 22.2 cm2 of it touch sill store.sill.EW.y0", "a rule between brace and sill"]),
    "brace without a sill": ("along: x, at: 0, runs", "along: y, at: 1, runs", 25, ["brace store.brace1.NS.x1.0-1 stands on nothing", "z 0.100"]),
    "column without a beam": ("height: 0.1, width: 0.1}\n      - {layer: roof", "height: 0.1, width: 0.1, lines: [{along: x, at: 0, from: 0, to: 2}]}\n      - {layer: roof",
                              22, ["column store.column1.x0y1 carries nothing", "z 2.100"]),
    "impossible friction": ("between: [timber, timber], coefficient: 0.5", "between: [timber, snow], coefficient: 0.7", 6, ["friction of timber and snow is 0.7", "timber's own (0.5)"]),
    "damage to no side": ("snow: {depth: 0.5}", "damage: {regions: [{side: easst, storey: 1}]}", 32, ["'easst' is unknown, did you mean 'east'?"]),
    "no storey": ("      - {layer: columns, height: 2}\n", "", 20, ["structures.store.columns: its stack has no layer of columns"]),
    "ground too small": ("ground: {size: 10", "ground: {size: 1.5", 7, ["ground.size: 1.5 m do not reach below the whole house", "at least 2.2"]),
    "name with a blank": ("  store:", "  the store:", 9, ["structures: 'the store' is no name", "letters, digits, _ and -"]),
    "beside nothing": ("origin: [0, 0]", "beside: barn", 10, ["no structure 'barn' before this one"]),
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
    annex = STOREHOUSE[start:end].replace("store:", "annex:").replace("origin: [0, 0]", "beside: store, side: east, align: west")
    assert "structures.annex.place.align: on the east side, align north or south" in message(tmp_path, STOREHOUSE[:end] + annex + STOREHOUSE[end:])


def test_hip_roof_mistakes(tmp_path):
    hip = STOREHOUSE.replace("type: flat, thickness: 0.1", "type: hip, thickness: 0.1, ridge_height: 2.0, corner_cut: 0.1")
    assert "the ridge (2 m) must lie above the eaves (2.2 m)" in message(tmp_path, hip)
    assert "corner_cut must be below" in message(tmp_path, hip.replace("2.0, corner_cut: 0.1", "3.0, corner_cut: 0.9"))


def test_files_that_are_no_house(tmp_path):
    with pytest.raises(HouseError, match="unknown house 'Z'.*A, B, B1, B2, C, C1, C2"):
        load_house("Z")
    for text, words in (("", "a house file is a table"), ("- 1\n", "a house file is a table"), ("extends: nowhere.yaml\n", "no file 'nowhere.yaml'"), ("extends: bse\n", "no shipped house of that name (base, A, B"),
                        ("extends: store.yaml\n", "extends itself"), ("extends: 3\n", "expected the name of a file"), ("1: 2\n", "must be a word")):
        assert words in message(tmp_path, text)
    (tmp_path / "latin.yaml").write_bytes(b"name: \xff\xfe")
    with pytest.raises(HouseError, match="not UTF-8"):
        load_house(tmp_path / "latin.yaml")


def test_an_error_in_an_extended_file_names_that_file(tmp_path):
    (tmp_path / "base.yaml").write_text((SHIPPED / "base.yaml").read_text().replace("margin: 0.075 ", "margin: -1 ", 1))
    text = message(tmp_path, "extends: base.yaml\nname: mine\n")
    assert text.startswith("base.yaml:") and "structures.main.margin" in text


def test_snow_depth_argument_is_checked(tmp_path):
    (tmp_path / "store.yaml").write_text(STOREHOUSE)
    for depth in (-1, float("nan")):
        with pytest.raises(HouseError, match="snow depth"):
            build_house(load_house(tmp_path / "store.yaml"), depth)
