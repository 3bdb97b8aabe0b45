# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plans of any shape in one structure: area, outer walls, their weight, quarters, corners; wings of two structures."""
from functools import cache
from pathlib import Path

import pytest
from timber_houses.base.gravity import weight_of
from timber_houses.house import build_house, diagnose, load_house, weigh

GRID = "    grid: {{x: {{module: 1.0, count: {0}}}, y: {{module: 1.0, count: {1}}}}}\n"
SHAPES = {
    # name: (grid, areas of floor and roof, outline, storeys)
    "L": ((8, 7), ["x: [0, 8], y: [0, 4]", "x: [0, 4], y: [4, 7]"],
          [(0, 0), (8, 0), (8, 4), (4, 4), (4, 7), (0, 7)]),
    "T": ((9, 6), ["x: [0, 9], y: [3, 6]", "x: [3, 6], y: [0, 3]"],
          [(3, 0), (6, 0), (6, 3), (9, 3), (9, 6), (0, 6), (0, 3), (3, 3)]),
    "U": ((9, 6), ["x: [0, 9], y: [0, 2]", "x: [0, 3], y: [2, 6]", "x: [6, 9], y: [2, 6]"],
          [(0, 0), (9, 0), (9, 6), (6, 6), (6, 2), (3, 2), (3, 6), (0, 6)]),
}
AREAS = {"L": 44.0, "T": 36.0, "U": 42.0}
"""By hand. [m2]"""


def edges(outline):
    """[(along, at, from, to)] of a polygon with edges along x and y."""
    for (x0, y0), (x1, y1) in zip(outline, [*outline[1:], outline[0]]):
        yield ("x", y0, *sorted((x0, x1))) if y0 == y1 else ("y", x0, *sorted((y0, y1)))


def house_file(shape, walls="", more=""):
    (nx, ny), areas, outline = SHAPES[shape]
    lines = [f"{{along: {a}, at: {at}, from: {low}, to: {high}, cut: {str(a == 'x').lower()}}}"
             for a, at, low, high in edges(outline)]
    slabs = ", ".join(f"{{{area}}}" for area in areas)
    roofs = "".join(f"      - {{layer: roof, type: flat, thickness: 0.12, material: roofing, area: {{{area}}}}}\n"
                    for area in areas)
    lines = "".join(f"      - {line}\n" for line in lines)
    return f"""
extends: plated
name: {shape}
loads: {{roof: 0.5, floor: 1.0, wall: 1.0}}
{more}structures:
  main:
    place: {{origin: [0, 0]}}
{GRID.format(nx, ny)}    margin: 0.06
    lines:
{lines}    stack:
      - {{layer: foundation, height: 0.3, width: 0.12}}
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2.7}}
      - {{layer: beams, height: 0.12, width: 0.12}}
      - {{layer: floor, thickness: 0.10, areas: [{slabs}]}}
      - {{layer: columns, height: 2.7}}
      - {{layer: beams, height: 0.12, width: 0.12}}
{roofs}    columns:
      - section: 0.12
        lines:
{"".join(f"          - {{along: {a}, at: {at}, from: {low}, to: {high}}}" + chr(10)
         for a, at, low, high in edges(outline))}    walls: [{walls}]
"""


@cache
def built(folder, shape, walls="", more=""):
    path = Path(folder) / f"{shape}.yaml"
    path.write_text(house_file(shape, walls, more))
    return build_house(load_house(path))


@pytest.fixture(params=SHAPES)
def shape(request):
    return request.param


def test_area_is_that_of_the_slabs(shape, tmp_path):
    model = built(tmp_path, shape)
    assert [model.plans["main"][storey].area for storey in (1, 2)] == pytest.approx([AREAS[shape]] * 2, rel=1e-9)
    assert weigh(model)["floor_area_m2"] == pytest.approx(2 * AREAS[shape], abs=1e-3)


def test_every_outer_wall_weighs(shape, tmp_path):
    """1 kN/m2 times the perimeter times the heights from feet to feet 2.92 m and from feet to roof 2.82 m."""
    loaded = built(tmp_path, shape)
    bare = build_house(load_house(write(tmp_path, "bare", house_file(shape).replace("wall: 1.0", "wall: 0"))))
    perimeter = sum(high - low for _, _, low, high in edges(SHAPES[shape][2]))
    added = weigh(loaded)["total_kn"] - weigh(bare)["total_kn"]
    assert added == pytest.approx(perimeter * (2.92 + 2.82), abs=2e-3)


def test_every_outer_wall_belongs_to_one_side(shape, tmp_path):
    """By which broken joints are counted."""
    (_, _, outline), names = SHAPES[shape], {"x": {"north", "south"}, "y": {"east", "west"}}
    walls = ", ".join(f"{{along: {a}, at: {at}, from: {low}, to: {high}, type: plywood}}"
                      for a, at, low, high in edges(outline))
    sides = [joint.side for joint in built(tmp_path, shape, walls).joints if joint.kind == "wall_column"]
    assert len(sides) == 2 * sum(high - low for _, _, low, high in edges(outline))
    assert all(len(side) == 1 and side <= names["x"] | names["y"] for side in sides)
    for side in ("east", "north"):
        across = "y" if side == "east" else "x"
        lengths = [high - low for along, _, low, high in edges(outline) if along == across]
        assert sum(side in found for found in sides) == sum(lengths)  # half of the walls, two storeys


def test_corners_project(shape, tmp_path):
    """A re-entrant corner is none by the N-value method."""
    plan, outline = built(tmp_path, shape).plans["main"][1], SHAPES[shape][2]
    turns = [(b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
             for a, b, c in zip([outline[-1], *outline], outline, [*outline[1:], outline[0]])]
    assert [plan.is_corner(*corner) for corner in outline] == [turn > 0 for turn in turns]


def write(folder, name, text):
    path = Path(folder) / f"{name}.yaml"
    path.write_text(text)
    return path


L_WALLS = ("{along: x, at: 0, from: 0, to: 2, type: plywood}, {along: x, at: 4, from: 4, to: 6, type: plywood},"
           " {along: x, at: 7, from: 1, to: 3, type: plywood}")


def test_quarters_of_an_l_by_hand(tmp_path):
    """North quarter of the E-W walls: y 5.25 to 7 of the arm 4 m wide, 7 m2; south: y 0 to 1.75, 8 m wide, 14 m2.

    Plywood of 2.5 m/m: 5 m on y = 0, 5 m on y = 4, in neither quarter, 5 m on y = 7.
    """
    found = diagnose(built(tmp_path, "L", L_WALLS))["structures"]["main"]["storeys"]["1"]
    one = found["directions"]["ew"]
    coefficient = one["required_quantity_m"] / 44
    assert found["floor_area_m2"] == 44 and one["wall_quantity_m"] == 15
    assert one["quarters"] == pytest.approx([5 / (14 * coefficient), 5 / (7 * coefficient)], abs=2e-3)


def test_a_leaning_l_has_the_same_plan(tmp_path):
    upright, leaning = (diagnose(built(tmp_path, "L", L_WALLS, more))["structures"]["main"]["storeys"]["1"]
                        for more in ("", "plumb: {drift: 0.005}\n"))
    assert leaning["directions"]["ew"]["quarters"] == upright["directions"]["ew"]["quarters"]


def test_upper_storey_that_is_smaller(tmp_path):
    """Upper storey over the bar of the L only: its outer wall along y = 4 stands over the middle of the floor."""
    text = house_file("L").replace("        lines:\n", "        storeys: 1\n        lines:\n", 1)
    first, rest = text.split("    columns:\n")
    upper = "      - section: 0.12\n        storeys: 2\n        lines:\n" + "".join(
        f"          - {{along: {a}, at: {at}, from: {low}, to: {high}}}\n"
        for a, at, low, high in edges([(0, 0), (8, 0), (8, 4), (0, 4)]))
    model = build_house(load_house(write(tmp_path, "stepped", f"{first}    columns:\n{upper}{rest}")), check=False)
    assert [model.plans["main"][storey].area for storey in (1, 2)] == pytest.approx([44, 32])
    assert model.plans["main"][2].sides("x", 4.0, 1.0, 2.0) == {"north"}
    assert model.plans["main"][1].sides("x", 4.0, 1.0, 2.0) == set()


def test_common_wall_of_two_wings_weighs_once():
    """The shipped house of two wings: the side wing's west wall, 3.64 m, lies against the main wing."""
    model = build_house(load_house("l_house"))
    bare = {name: sum(e.volume * 340 for e in model.of_kind("column", group=name)) for name in ("main", "side")}
    hung = {name: sum(e.mass for e in model.of_kind("column", group=name)) - mass for name, mass in bare.items()}
    height = (2.73 + 0.12 + 0.20) + (2.73 + 0.12)
    assert weight_of(hung["main"]) == pytest.approx(0.26 * 2 * (8.19 + 3.64) * height, rel=1e-6)
    assert weight_of(hung["side"]) == pytest.approx(0.26 * (2 * 4.55 + 3.64) * height, rel=1e-6)
