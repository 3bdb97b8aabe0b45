# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames from CAD: BTLx files -> parts, cuts, parts that fit, house files."""
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest
from btlx_sample import X, Y, Z, btlx, end_cut, part, portal, processing, project, side
from timber_houses.house import HouseError, build_house, load_house
from timber_houses.house.btlx.cuts import half_spaces, side_frame
from timber_houses.house.btlx.reader import read_project

ROOT = Path(__file__).resolve().parents[2]
SIZE = (2000, 140, 80)
SIDE_BY_SIDE = [(number, end) for number in (1, 2, 3, 4) for end in (-1, 1)]


def house(tmp_path, text, name="frame.btlx"):
    """(HouseModel, its notes) of the text of a BTLx file."""
    path = tmp_path / name
    path.write_text(text)
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        model = build_house(load_house(path))
    return model, [str(note.message) for note in notes]


def planes(*steps):
    """Half-spaces of the processings of a part of SIZE, a list for each; in m."""
    (only,) = read_project(btlx(project(part(1, SIZE, [((0, 0, 0), X, Y)], steps))).encode(), "f").parts
    return [half_spaces(step, only.size) for step in only.processings]


def joints(model):
    """{two names of members: type} of a model's joints."""
    return {frozenset(name.removeprefix("frame.") for name in (j.a, j.b)): j.type for j in model.joints}


# --- geometry of processings ------------------------------------------------------------------------------------------


def test_reference_sides():
    """z points out of the box; side 2 begins where side 3 ends across, as around the part; 5 and 6 are its ends."""
    size = np.array(SIZE) / 1000
    for number in range(1, 7):
        origin, axes = side_frame(number, tuple(size))
        assert np.linalg.det(axes) == pytest.approx(1) and ((origin == 0) | (origin == size)).all()
        assert axes[2] @ (size / 2 - origin) == pytest.approx(-abs(size @ axes[2]) / 2)
    for number in (1, 2, 3, 4):
        origin, (_, y, _) = side_frame(number, tuple(size))
        assert np.allclose(origin + abs(size @ y) * y, side_frame((number - 2) % 4 + 1, tuple(size))[0])
        assert np.allclose(1000 * origin, side(number, SIZE)[0]) and np.allclose(y, side(number, SIZE)[2])


@pytest.mark.parametrize("number, end", SIDE_BY_SIDE)
@pytest.mark.parametrize("kind", ["JackRafterCut", "Tenon"])
def test_a_cut_across(number, end, kind):
    """The plane from which the parameters were made comes back, on each side, at either end, for oblique cuts."""
    rng = np.random.default_rng(number)
    for _ in range(20):
        normal = rng.normal(size=3)
        normal *= end * np.sign(normal[0]) / np.linalg.norm(normal)
        point = rng.uniform(0, SIZE)
        (((found, offset),),) = planes(end_cut(normal, point, SIZE, number, kind))
        assert np.allclose(found, normal, atol=1e-7)  # parameters have 6 digits
        assert offset == pytest.approx(normal @ point / 1000, abs=1e-7)


def test_start_of_a_cut_in_width_and_depth():
    (((normal, offset),),) = planes(processing("JackRafterCut", 4, Orientation="end", StartX=1900, StartY=30,
                                               StartDepth=20, Angle=90, Inclination=45))
    assert np.allclose(normal, (X - Z) / np.sqrt(2)) and offset == pytest.approx((1.9 - (0.08 - 0.02)) / np.sqrt(2))


@pytest.mark.parametrize("inclination, kept", [(45, (100, 70)), (-45, (10, 70))])
def test_a_longitudinal_cut(inclination, kept):
    """Side 4 is the top of the part: with a positive inclination the edge at y = 0 goes. kept: y, z [mm] inside"""
    values = dict(StartX=0, StartY=60, Inclination=inclination)
    (((normal, offset),), *limited) = planes(
        processing("LongitudinalCut", 4, **values),
        *(processing("LongitudinalCut", 4, **values, **{name: "yes"})
          for name in ("StartLimited", "EndLimited", "DepthLimited")))
    assert normal @ [1, *np.array(kept) / 1000] < offset < normal @ [1, (110 - kept[0]) / 1000, 0.07]
    assert normal @ [0, 0.06, 0.08] == pytest.approx(offset) and limited == [[], [], []]


def test_a_double_cut():
    """Convex, a point of 90 degrees at the end; with the angles exchanged a notch, which is no half-space."""
    values = dict(Orientation="end", StartX=1900, StartY=70, Inclination1=90, Inclination2=90)
    (convex, notch) = planes(processing("DoubleCut", 4, Angle1=135, Angle2=45, **values),
                             processing("DoubleCut", 4, Angle1=45, Angle2=135, **values))
    assert np.allclose(sorted(normal[1] for normal, _ in convex), [-np.sqrt(0.5), np.sqrt(0.5)]) and notch == []
    for normal, offset in convex:
        assert normal[0] > 0 and normal @ [1.9, 0.07, 0] == pytest.approx(offset)


@pytest.mark.parametrize("tool, corners", [("right", [(0, 0), (1900, 0), (1900, 80), (100, 80), (0, 0)]),
                                           ("left", [(0, 0), (100, 80), (1900, 80), (1900, 0), (0, 0)])])
def test_an_outline(tool, corners):
    """Of a sheet; positive inclinations widen it with depth on the right of the contour, narrow it on the left."""
    def contour(tool, depth=140, inclination=0.0, sink="no"):
        (x, y), *ends = corners
        lines = "".join(f'<Line Inclination="{inclination}"><EndPoint X="{a}" Y="{b}" Z="0"/></Line>' for a, b in ends)
        return (f'<FreeContour Process="yes" ReferencePlaneID="1" ToolPosition="{tool}" CounterSink="{sink}"><Contour'
                f' Depth="{depth}" DepthBounded="yes"><StartPoint X="{x}" Y="{y}" Z="0"/>{lines}</Contour>'
                '</FreeContour>')

    other = {"left": "right", "right": "left"}[tool]
    cut, tilted, shallow, hole, sunk = planes(contour(tool), contour(tool, inclination=30), contour(tool, depth=100),
                                              contour(other), contour(tool, sink="yes"))
    assert [shallow, hole, sunk] == [[], [], []]
    inside = np.array([0.5, 0.07, 0.04])
    assert len(cut) == 4 and all(normal @ inside < offset for normal, offset in cut)
    (normal, offset), = [plane for plane in cut if abs(plane[0][0]) > 0.1 and plane[0][0] < 0]
    assert normal @ [0.1, 0, 0.08] == pytest.approx(offset) == pytest.approx(0)
    assert all(normal @ -Y == pytest.approx({"right": -0.5, "left": 0.5}[tool]) for normal, _ in tilted)


# --- parts that fit ---------------------------------------------------------------------------------------------------


def test_a_portal(tmp_path):
    """Tenons end at their shoulders, the brace fits; joints are of the processings that mark them."""
    model, notes = house(tmp_path, portal())
    assert {e.name: e.kind for e in model.elements if e.group} == {
        "frame.sill-1": "sill", "frame.post-2": "column", "frame.post-3": "column", "frame.beam-4": "beam",
        "frame.brace-5": "brace"}
    assert np.allclose(model.element("frame.post-2").solid.bounds, [[0, 0, 0.12], [0.12, 0.12, 2.52]])
    assert joints(model) == {frozenset(pair): how for *pair, how in (
        ("sill-1", "post-2", "tenon"), ("sill-1", "post-3", "tenon"), ("beam-4", "post-2", "tenon"),
        ("beam-4", "post-3", "tenon"), ("brace-5", "post-2", "butt"), ("brace-5", "beam-4", "butt"))}
    assert [e.name for e in model.elements if e.fixed] == ["ground", "frame.sill-1"]
    assert notes == [f"frame.btlx: {line}" for line in model.description.split("; ")]
    assert "4 Mortise without volume, 4 of them mark joints" in model.description


@pytest.mark.parametrize("seed", range(8))
def test_a_turned_and_rounded_portal(tmp_path, seed):
    """Places to 1e-3 mm and directions to 1e-3, far from the origin: the same joints, no overlap, no loose end."""
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    if seed % 2:  # about the vertical axis
        angle = rng.uniform(0, 2 * np.pi)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], Z])
    path = tmp_path / "turned.btlx"
    path.write_text(portal(turn, rng.uniform(-1e7, 1e7, 3), 3))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        description = load_house(path)
    assert len(description.data["frame"]["joints"]) == 6
    if seed % 2:
        assert len(build_house(description).joints) == 6
    else:  # nothing is level: what has the lowest point is fixed
        assert sum(member["fixed"] for member in description.data["frame"]["members"].values()) == 1


def beams(*steps, height=0):
    """Two beams of 3 m that cross at their middles, on blocks, the second one `height` mm above the first."""
    size, blocks = (3000, 100, 100), ((0, 1450), (2900, 1450), (1450, 0), (1450, 2900))
    return btlx(project(part(1, size, [((0, 1450, 100), X, Y)], steps),
                        part(2, size, [((1450, 3000, 100 + height), -Y, X)]),
                        part(3, (100, 100, 100), [((x, y, 0), X, Y) for x, y in blocks])))


def test_parts_that_cross_are_divided(tmp_path):
    """Half a lap of two beams of one section: either would lose half its volume."""
    model, notes = house(tmp_path, beams(processing("Lap", 4, Orientation="start", StartX=1450, StartY=0, Angle=90,
                                                    Length=100, Width=100, Depth=50)))
    names = sorted(e.name for e in model.elements if e.kind == "beam")
    assert names == ["frame.part-1-1", "frame.part-1-2", "frame.part-2"] or names == [
        "frame.part-1", "frame.part-2-1", "frame.part-2-2"]
    assert sum(e.volume for e in model.of_kind("beam")) == pytest.approx(2 * 0.03 - 0.001)
    crossing = [j.type for j in model.joints if "part-3" not in j.name]
    assert sorted(crossing) == ["butt", "lap"] and any("divided where others pass: part" in note for note in notes)


def test_a_notch_is_cut_off(tmp_path):
    """The upper beam sits 20 mm deep in the lower one: one of them loses 20 % of its height, no joint is lost."""
    model, notes = house(tmp_path, beams(height=80))
    assert sum(e.volume for e in model.of_kind("beam")) == pytest.approx(2 * 0.03 - 0.006, rel=1e-3)
    assert joints(model)[frozenset(("part-1", "part-2"))] == "butt" and "at most 20 % of a part" in str(notes)


def test_a_plate_keeps_its_ends_and_a_rafter_its_eaves(tmp_path):
    """A tie is halved over the end of a plate that lies on a post; a rafter of 40 degrees sits in a notch on the plate.
    The tie loses 140 mm of 2 m, the plate the notch along its length."""
    along, up = np.array([0, np.cos(0.7), np.sin(0.7)]), np.array([0, -np.sin(0.7), np.cos(0.7)])
    size, post, start = (2000, 140, 140), (1000, 140, 140), np.array([1000, 40, 1140]) - 600 * along
    model, _ = house(tmp_path, btlx(project(
        part(1, size, [((0, 0, 1000), X, Y)], designation="plate"),
        part(2, post, [((140, 0, 0), Z, Y), ((2000, 0, 0), Z, Y)], designation="post"),
        part(3, size, [((140, 0, 1070), Y, -X)], designation="tie"),
        part(4, (1800, 180, 80), [(start, along, up)], designation="rafter"))))
    volumes = {e.name.removeprefix("frame."): e.volume / (0.0392 if e.kind == "beam" else 0.02592)
               for e in model.of_kind("beam", "rafter")}
    notch = 0.04 * (0.04 * np.tan(0.7)) / 2 / 0.14**2  # [-] of the section: 40 mm of its top
    assert volumes == pytest.approx({"plate-1": 1 - notch, "tie-3": 1 - 0.07, "rafter-4": 1.0}, abs=2e-3)
    assert {frozenset(pair) for pair in (("plate-1", "post-2"), ("plate-1", "tie-3"), ("plate-1", "rafter-4"))} <= {
        *joints(model)}


@pytest.mark.parametrize("depth", [5, 60, 120])
def test_a_housed_end_is_cut_off_at_the_face(tmp_path, depth):
    """An end that enters a post, up to half a lap through all of it."""
    post, rail = (2000, 120, 120), (1000 + depth, 100, 50)
    model, _ = house(tmp_path, btlx(project(part(1, post, [((120, 0, 0), Z, Y)]), part(2, post, [((1240, 0, 0), Z, Y)]),
                                            part(3, rail, [((120 - depth, 10, 1900), X, Y)]))))
    assert np.allclose(model.element("frame.part-3").solid.bounds[:, 0], [0.12, 1.12])
    assert np.ptp(model.element("frame.part-1").solid.bounds[:, 0]) == pytest.approx(0.12)


@pytest.mark.parametrize("clearance, is_joined", [(2, True), (8, True), (12, False)])
def test_ends_with_clearance(tmp_path, clearance, is_joined):
    """Half of it at each end of a rail: up to 1.5 mm it gets the joint of faces, up to 5 mm that of the frame rules."""
    post, rail = (2000, 120, 120), (1000 - clearance, 100, 50)
    text = btlx(project(part(1, post, [((120, 0, 0), Z, Y)]), part(2, post, [((1240, 0, 0), Z, Y)]),
                        part(3, rail, [((120 + clearance / 2, 10, 1900), X, Y)]),
                        part(4, (1240, 120, 100), [((0, 0, 2000), X, Y)])))
    path = tmp_path / "rail.btlx"
    path.write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = build_house(load_house(path), check=False)
    types = [j.type for j in model.joints if "part-3" in j.name]
    assert types == (2 * ["butt" if clearance < 3 else "corner_fitting"] if is_joined else [])


# --- files ------------------------------------------------------------------------------------------------------------


def test_places_and_what_is_left_out(tmp_path):
    """Raw parts are not counted; a part with two places is two; of three pieces without their third place a note; of a
    second project another one; processings that are not done do not count."""
    sill, post = (2000, 100, 100), (1000, 100, 100)
    raw = '<Rawparts><Rawpart Length="9000" Height="9" Width="9" Count="1"><Parts/></Rawpart></Rawparts>'
    parts = [part(1, sill, [((0, 0, 0), X, Y)]),
             part(2, post, [((100, 0, 100), Z, Y), ((2000, 0, 100), Z, Y)], count=3, steps=[
                 end_cut(X, np.array([500.0, 0, 0]), post).replace('Process="yes"', 'Process="no"')]),
             part(3, sill, [((0, 0, 1100), X, Y)])]
    text = btlx(project(*parts).replace("<Parts>", raw + "<Parts>", 1), project(part(1, sill, [((9, 9, 9), X, Y)])))
    model, notes = house(tmp_path, text)
    assert sorted(e.name.removeprefix("frame.part-") for e in model.elements if e.group) == ["1", "2", "2-copy2", "3"]
    assert model.element("frame.part-2").volume == pytest.approx(0.01) and len(model.joints) == 4
    assert "frame.btlx: left out: part without a place, 1" in notes
    assert "frame.btlx: left out: project after the first one, 1" in notes


def test_columns_on_the_lowest_level_get_pads(tmp_path):
    model, notes = house(tmp_path, btlx(project(
        part(1, (1000, 100, 100), [((x, 0, 500), Z, Y) for x in (100, 2000)], designation="Pfosten"),
        part(2, (2000, 100, 100), [((0, 0, 1500), X, Y)]))))
    assert [e.name for e in model.of_kind("foundation")] == ["frame.pad-Pfosten-1", "frame.pad-Pfosten-1-copy2"]
    assert model.element("frame.Pfosten-1").solid.bounds[0][2] == pytest.approx(0.1) and len(model.joints) == 4
    assert "supported, and fixed: 2 members" in notes[-1]


def test_the_house_file_of_a_btlx_file_is_the_same_house(tmp_path):
    turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], Z])
    model, _ = house(tmp_path, portal(turn, (123.4, 5.6, 7.8), 3))
    script = ROOT / "scripts" / "show" / "show_house.py"
    done = subprocess.run(["/usr/bin/python3", script, tmp_path / "frame.btlx", "--yaml", tmp_path / "frame.yaml"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "note: frame.btlx: project 'portal': 5 parts" in done.stderr
    again = build_house(load_house(tmp_path / "frame.yaml"))
    assert all(np.array_equal(a.vertices, b.vertices) for a, b in zip(model.elements, again.elements, strict=True))
    assert joints(again) == joints(model) and again.description == model.description


def test_a_house_file_may_extend_a_btlx_file(tmp_path):
    house(tmp_path, portal())
    own = tmp_path / "own.yaml"
    own.write_text("extends: frame.btlx\nname: own\njoint_types: {tenon: {strength: 9000}}\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = build_house(load_house(own))
    assert {round(j.strength) for j in model.joints if j.type == "tenon"} == {9000} and model.name == "own"


SMALL = btlx(project(part(7, (2000, 100, 100), [((0, 0, 0), X, Y)], [processing("JackRafterCut", 1, StartX=1.0)])))
ENTITY = '<!DOCTYPE BTLx [<!ENTITY e SYSTEM "file:///etc/hostname">]>\n'
ENTITIES = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10 if i else "x" * 10}">' for i in range(9))
BOMB = f"<!DOCTYPE BTLx [{ENTITIES}]>\n"


def broken(old, new):
    assert old in SMALL
    return SMALL.replace(old, new)


@pytest.mark.parametrize("text, message", [
    ("", "frame.btlx:1: not valid XML"),
    (SMALL[:300], "frame.btlx:6: not valid XML"),
    ("<html><body/></html>", "frame.btlx:1: no BTLx project with a part that has a place"),
    (btlx(project()), "frame.btlx:1: no BTLx project"),
    (broken("<BTLx", ENTITY + "<BTLx"), "frame.btlx:1: a document type (DOCTYPE) is not read; remove it"),
    (broken("<BTLx", BOMB + "<BTLx").replace('Designation=""', 'Designation="&e8;"'), "frame.btlx:"),
    (broken('Designation=""', 'Designation="&e;"'), "frame.btlx:1: not valid XML"),
    (broken('Length="2000"', 'Length="2.0"').replace('Height="100"', 'Height="0.1"'), "part '7': Height 0.1 mm, not"),
    (broken('Length="2000"', 'Length="nan"'), "frame.btlx:5: part '7'.Length: 'nan' is not a number"),
    (broken(' Length="2000"', ""), "part '7'.Length: None is not a number"),
    (broken('X="1.000000"', 'X="0.500000"'), "are not unit vectors at a right angle"),
    (broken("<YVector", "<Vector"), "a place (Position) without YVector"),
    (broken('ReferencePlaneID="1"', 'ReferencePlaneID="side"'), "ReferencePlaneID: 'side' is not a number"),
    (broken("<StartX>1.0", "<StartX>1e9"), "frame.btlx:9: JackRafterCut.StartX"),
    (broken("<StartX>1.0", "<Orientation>start</Orientation><StartX>2500.0"), "part part-7: its cuts leave nothing"),
    (btlx(project(*[part(i, (2000, 100, 100), [((0, 0, 0), X, Y)]) for i in (1, 2)])), "lies largely within part"),
    (btlx(project(*[part(i, (2000, 99, 99), [((0, 200 * i, 0), X, Y)]) for i in range(1001)])), "more than 1000 parts"),
])
def test_refusals(tmp_path, text, message):
    """One line that begins with file and line; nothing of other files comes in."""
    with pytest.raises(HouseError) as refusal:
        house(tmp_path, text)
    line = str(refusal.value)
    assert message in line and line.startswith("frame.btlx:") and line.isprintable()


def test_another_encoding_and_namespace(tmp_path):
    text = portal().replace("https://www.design2machine.com", "http://www.design2machine.com").replace(
        'version="1.0"', 'version="1.0" encoding="utf-16"')
    (tmp_path / "frame.btlx").write_bytes(text.encode("utf-16"))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert len(build_house(load_house(tmp_path / "frame.btlx")).joints) == 6
