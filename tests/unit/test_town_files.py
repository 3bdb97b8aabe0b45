# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Town files: places, delays, rotation, misuse. Needs no YADE."""
from types import SimpleNamespace

import numpy as np
import pytest
from summaries import sample_summary
from test_house_plan import house_file
from timber_houses.house import HouseError, build_house, load_house, load_town
from timber_houses.house.town import Lot, check_places, parts
from timber_houses.motion import GroundMotion
from timber_houses.motion.processing import in_axes
from timber_houses.recording.events import Event, SnowFallen, StructureFallen, Tilt
from timber_houses.recording.town import summary as town_summary
from timber_houses.recording.town import town_side

GOOD = """name: harbour
wave: {velocity: 500, direction: 90}
lots:
  west: {house: A, x: -100, y: 3}
  east: {house: own.yaml, x: 150, y: 0, rotation: 90, snow: 0.5}
"""


@pytest.fixture
def town(tmp_path):
    """Writes a town file beside own.yaml and returns its path."""
    (tmp_path / "own.yaml").write_text("extends: B\nname: own\n")

    def write(text):
        path = tmp_path / "town.yaml"
        path.write_text(text)
        return path

    return write


def test_lots_in_the_order_of_the_file(town):
    found = load_town(town(GOOD))
    west, east = found.lots
    assert (found.name, west.name, east.name) == ("harbour", "west", "east")
    assert (west.x, west.y, west.rotation, west.snow) == (-100, 3, 0, None)
    assert (east.rotation, east.snow) == (90, 0.5)
    assert load_house(east.house).name == "own"


def test_delay_is_distance_along_the_direction_over_velocity(town):
    assert load_town(town(GOOD)).delays() == [0, pytest.approx(250 / 500)]
    north = GOOD.replace("direction: 90", "direction: 0")
    assert load_town(town(north)).delays() == [pytest.approx(3 / 500), 0]
    west = GOOD.replace("direction: 90", "direction: 270")
    assert load_town(town(west)).delays() == [pytest.approx(250 / 500), pytest.approx(0, abs=1e-12)]


def test_without_a_wave_all_houses_shake_at_once(town):
    assert load_town(town(GOOD.replace("wave: {velocity: 500, direction: 90}\n", ""))).delays() == [0, 0]


@pytest.mark.parametrize("rotation, side, direction", [(0, "west", "ns"), (90, "south", "ew"), (180, "east", "ns"),
                                                       (270, "north", "ew"), (30, "west", "ns"), (60, "south", "ew")])
def test_events_of_a_turned_lot_are_in_the_directions_of_the_town(rotation, side, direction):
    """Sides and directions of the town that are nearest to those of the house."""
    events = [Event(1.0, Tilt("ns")), Event(2.0, SnowFallen("", "west", "roof")), Event(3.0, StructureFallen("shed"))]
    axes = Lot("", "A", 0, 0, rotation).axes
    tilt, snow, fall = town_summary("x", {"lot": (sample_summary(events=events), axes, None)}, None).events
    assert (tilt.facts.direction, snow.facts.side, fall.facts.structure) == (direction, side, "shed")
    assert town_side("west+inside", axes) == f"{side}+inside"


def test_motion_in_the_axes_of_a_turned_house():
    """A house turned by 90 degrees counter-clockwise: its x axis points north, so the town's north component acts along
    x.
    """
    motion = GroundMotion(0.01, [[1.0, 2.0, 3.0]] * 4)
    assert in_axes(motion, Lot("", "A", 0, 0, 0).axes) is motion
    for rotation, expected in ((90, (2, -1, 3)), (180, (-1, -2, 3)), (-90, (-2, 1, 3)), (360, (1, 2, 3)), (-270, (2, -1,
                                                                                                                  3))):
        assert in_axes(motion,
                       Lot("", "A", 0, 0,
                           rotation).axes).acceleration.tolist() == [list(expected)] * 4  # exact for right angles
    turned = in_axes(motion, Lot("", "A", 0, 0, 30).axes).acceleration
    assert np.linalg.norm(turned[0]) == pytest.approx(np.sqrt(14))


def test_the_middle_of_the_plan_is_at_the_place():
    model = build_house(load_house("l_house"))
    for rotation in (0, 90, 37):
        lot = Lot("", "l_house", 5, -7, rotation)
        points = np.concatenate([e.vertices for e in model.elements if e.kind != "ground"])
        middle = (points.min(0) + points.max(0))[:2] / 2
        assert (lot.axes @ [*middle, 0] + lot.origin(model))[:2] == pytest.approx([5, -7], abs=1e-5)  # plan.ROUNDING
        placed, drawn = points @ lot.axes.T + lot.origin(model), np.concatenate(lot.outlines(model))
        assert placed[:, :2].min(0) == pytest.approx(drawn.min(0), abs=1e-5)
        assert placed[:, :2].max(0) == pytest.approx(drawn.max(0), abs=1e-5)


def test_a_house_in_the_corner_of_an_l(tmp_path):
    """L of 8 x 7 m, roof projecting by 0.06 m: its parts leave free the corner from (4.06, 4.06) to (8.06, 7.06), where
    a post of 1 m stands, but not 10 cm nearer to the middle. The middle of the plan, (4, 3.5), is at x, y."""
    (tmp_path / "l.yaml").write_text(house_file("L"))
    model = build_house(load_house(tmp_path / "l.yaml"))
    largest = sorted(np.ptp(part, axis=0).prod() for part in parts(model))[-2:]
    assert largest == pytest.approx([4.12 * 3.06, 8.12 * 4.06])
    corner, lot = square(1.0), Lot("a", "l.yaml", 0, 0)
    check_places([(lot, model), (Lot("b", "post", 0.06 + 0.5 + 0.01, 0.56 + 0.5 + 0.01), corner)])
    for x, y in ((0.47, 1.07), (0.57, 0.97)):
        with pytest.raises(HouseError, match="overlaps that of lot a"):
            check_places([(lot, model), (Lot("b", "post", x, y), corner)])


def square(side):
    """A HouseModel's stand-in, one box."""
    corners = np.array([(x, y, z) for x in (0, side) for y in (0, side) for z in (0, 1)], float)
    return SimpleNamespace(elements=[SimpleNamespace(kind="column", vertices=corners)])


def test_overlapping_houses_are_refused(town):
    model = build_house(load_house("A"))

    def place(x, rotation=0):
        return Lot("b", "A", x, 0, rotation, where="town.yaml:3: town.lots.b.house"), model

    first = (Lot("a", "A", 0, 0), model)
    width = np.ptp(np.concatenate(first[0].outlines(model))[:, 0])
    check_places([first, place(width + 0.01)])
    with pytest.raises(HouseError, match="^town.yaml:3: town.lots.b: the house overlaps that of lot a"):
        check_places([first, place(width - 0.01)])
    with pytest.raises(HouseError, match="overlaps"):
        check_places([first, place(width + 0.01, rotation=45)])


@pytest.mark.parametrize("old, new, message", [
    ("velocity: 500", "velocity: 5",
     r"town.yaml:2: town.wave.velocity: must be a number in \[50, 20000\] m/s, got 5$"),
    ("direction: 90", "direction: north",
     r"town.yaml:2: town.wave.direction: expected a number in \[0, 360\] degrees, got 'north'$"),
    (", direction: 90", "", r"town.yaml:2: town.wave: key 'direction' is missing$"),
    ("x: -100", "x: 1e6",
     r"town.yaml:4: town.lots.west.x: must be a number in \[-20000, 20000\] m, got 1000000.0; in m: "),
    ("house: A", "house: Z", r"town.yaml:4: town.lots.west.house: unknown house 'Z': .*known: A, B"),
    ("house: A, ", "", r"town.yaml:4: town.lots.west: key 'house' is missing$"),
    ("rotation: 90", "turn: 90", r"town.yaml:5: town.lots.east: unknown key 'turn'"),
    ("snow: 0.5", "snow: 1e-9", r"town.yaml:5: town.lots.east.snow: must be 0 or in \[0.001, 6\] m, got 1e-09$"),
    ("  west:", "  ../west:", r"town.yaml:4: town.lots: '../west' is not a valid name"),
    ("  east:", "  west:", r"town.yaml:5: key 'west' is given twice \(first in line 4\); remove one$"),
    ("lots:", "houses:", r"town.yaml:3: town: unknown key 'houses', known: name, wave, lots$"),
])
def test_misuse_is_one_line_with_file_and_line(town, old, new, message):
    with pytest.raises(HouseError, match=message) as problem:
        load_town(town(GOOD.replace(old, new)))
    assert "\n" not in str(problem.value)


def test_no_lots_and_no_file(town, tmp_path):
    with pytest.raises(HouseError, match="town.lots: a town needs at least one lot"):
        load_town(town("lots: {}\n"))
    with pytest.raises(HouseError, match="no such regular file; give a town file"):
        load_town(tmp_path / "none.yaml")
    with pytest.raises(HouseError, match="1001 entries; at most 1000"):
        load_town(town("lots:\n" + "".join(f"  h{k}: {{house: A, x: {20 * k % 19000}, y: 0}}\n" for k in range(1001))))


MAP = """{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"name": "west", "house": "A", "owner": "x"},
  "geometry": {"type": "Point", "coordinates": [138.999, 37.3]}},
 {"type": "Feature", "properties": {"name": "east", "house": "B", "rotation": 90, "snow": null},
  "geometry": {"type": "Polygon", "coordinates": [[[139.0009, 37.2999], [139.0011, 37.2999], [139.0011, 37.3001],
                                                   [139.0009, 37.3001], [139.0009, 37.2999]]]}}]}"""
TABLE = "\ufefflot,house,x [m],y [m],rotation [degrees],snow\nwest,A,-88.6,0,,\neast,own.yaml,88.6,0.5,90,0.3\n\n"


def test_lots_of_a_table(tmp_path):
    """Alone, and beside a town file with a wave. Empty cells have the defaults."""
    (tmp_path / "own.yaml").write_text("extends: B\nname: own\n")
    (tmp_path / "harbour.csv").write_text(TABLE, encoding="utf-8")
    (tmp_path / "town.yaml").write_text("wave: {velocity: 500, direction: 90}\nlots: harbour.csv\n")
    alone, waved = load_town(tmp_path / "harbour.csv"), load_town(tmp_path / "town.yaml")
    assert (alone.name, [lot.name for lot in alone.lots]) == ("harbour", ["west", "east"])
    west, east = alone.lots
    assert (west.x, west.rotation, west.snow) == (-88.6, 0, None)
    assert (east.y, east.rotation, east.snow) == (0.5, 90, 0.3)
    assert waved.lots == alone.lots and waved.delays() == [0, pytest.approx(177.2 / 500)]


def test_lots_of_a_map(tmp_path):
    """0.002 degrees of longitude at 37.3 degrees north are 177.3 m on WGS 84 (111.32 km cos 37.3 for a degree on the
    sphere through the equator: 177.1 m); other properties are ignored.
    """
    (tmp_path / "harbour.geojson").write_text(MAP)
    west, east = load_town(tmp_path / "harbour.geojson").lots
    assert east.x - west.x == pytest.approx(177.3, abs=0.1) and west.x == pytest.approx(-east.x)
    assert (west.y, east.y) == pytest.approx((0, 0), abs=1e-3) and (east.rotation, east.snow) == (90, None)


@pytest.mark.parametrize("name, content, message", [
    ("a.csv", "lot,house,x\n", "^a.csv:1: no column y"),
    ("a.csv", "lot,house,x,y\nw,A,0,0\nw,A,30,0\n", "^a.csv:3: lot w: the name stands at a.csv:2 already"),
    ("a.csv", "lot,house,x,y\nw,A,0,0\nv,A,far,0\n", "^a.csv:3: town.lots.v.x: "),
    ("a.csv", "lot,house,x,y,colour\nw,A,0,0,red\n", "^a.csv:2: town.lots.w: unknown key 'colour'"),
    ("a.csv", "", "^a.csv:1: no column lot"),
    ("a.geojson", "{}", "^a.geojson: no GeoJSON of points"),
    ("a.geojson", MAP.replace("138.999", "9" * 400), "^a.geojson: a number of 400 characters"),
    ("a.geojson", MAP.replace('"house": "A"', f'"house": "A", "snow": {"9" * 400}'), "^a.geojson: a number of 400"),
    ("a.csv", f"lot,house,x,y\na,{'A' * 140_000},0,0", "^a.csv:2: field larger than field limit"),
    ("a.geojson", "[" * 9000, "^a.geojson: no GeoJSON of points"),
    ("a.geojson", MAP.replace("138.999", "51234.5"), "^a.geojson: coordinates must be longitude"),
    ("a.geojson", MAP.replace('"house": "A"', '"house": 7'), "^a.geojson: feature 1: town.lots.west.house"),
    ("a.yaml", "lots: none.csv\n", "^a.yaml:1: town.lots: no file 'none.csv' beside it"),
])
def test_wrong_files_of_lots(tmp_path, name, content, message):
    (tmp_path / name).write_text(content)
    with pytest.raises(HouseError, match=message):
        load_town(tmp_path / name)
