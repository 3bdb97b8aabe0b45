# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads of a house and its weight by storey, against sums by hand."""
import pytest
from timber_houses.house import HouseError, build_house, load_house, weigh
from timber_houses.house.weight import sentence

G = 9.81
HOUSE = """\
extends: base
name: box
structures:
  box:
    place: {origin: [0, 0]}
    grid: {x: {module: 1, count: 4}, y: {module: 1, count: 3}}
    margin: 0.06
    lines: [{along: y, at: [0, 4], from: 0, to: 3}, {along: x, at: [0, 3], from: 0, to: 4, cut: true}]
    stack:
      - {layer: sill, height: 0.12, width: 0.12}
      - {layer: columns, height: 2.5}
      - {layer: beams, height: 0.2, width: 0.12}
      - {layer: floor, thickness: 0.1}
      - {layer: columns, height: 2.4}
      - {layer: beams, height: 0.15, width: 0.12}
      - {layer: roof, type: gable, pitch: 0.5, thickness: 0.12}
    columns: [{section: 0.12, grid: {x: [0, 2, 4], y: [0, 3]}}, {section: 0.12, at: [[4, 1.5]]}]
"""
"""7 columns a storey; the bays are 2 m long (south, north), 3 m (west) and 1.5 m (east)."""
BEAMS = 2 * (4 - 0.12) + 2 * (3 + 0.12)
COLUMN = 340 * 0.12**2


def box(tmp_path, loads=""):
    path = tmp_path / "box.yaml"
    path.write_text(HOUSE + loads)
    return build_house(load_house(path))


def test_weight_without_loads(tmp_path):
    """Volumes by hand: a gable slab is a parallelogram less the triangle below the eave's level."""
    found = weigh(box(tmp_path))
    floor = 340 * 4.12 * 3.12 * 0.1
    drop = 0.12 * 1.25**0.5
    roof = 340 * 2 * (3.12 / 2 * drop - drop**2 / 0.5 / 2) * 4.12
    first, second = 7 * COLUMN * 2.5, 7 * COLUMN * 2.4
    low, high = 340 * BEAMS * 0.12 * 0.2, 340 * BEAMS * 0.12 * 0.15
    storeys = found["storeys"]["box"]
    assert found["floor_area_m2"] == 24 and found["snow_kn"] == 0
    assert found["total_kn"] == pytest.approx((floor + roof + first + second + low + high) * G / 1000, abs=1e-3)
    assert storeys["2"] == {"level_kn": pytest.approx((second / 2 + high + roof) * G / 1000, abs=1e-3),
                            "carried_kn": storeys["2"]["level_kn"]}
    assert storeys["1"]["carried_kn"] == pytest.approx(found["total_kn"] - first / 2 * G / 1000, abs=2e-3)
    assert found["per_floor_area_kn_m2"] == pytest.approx(found["total_kn"] / 24, abs=1e-3)
    assert sentence(found).startswith(f"weighs {found['total_kn']:.0f} kN")


def test_loads_replace_slabs_and_are_added_to_columns(tmp_path):
    """Slabs weigh load times area, timber included; walls weigh load times length and storey height, half on the column
    at either end.
    """
    bare, loaded = box(tmp_path), box(tmp_path, "loads: {roof: 0.9, floor: 1.5, wall: 0.64}\n")
    assert sum(e.mass
               for e in loaded.of_kind("roof")) == pytest.approx(0.9 * 4.12 * 3.12 * 1.25**0.5 * 1000 / G, rel=1e-9)
    assert sum(e.mass for e in loaded.of_kind("floor")) == pytest.approx(1.5 * 4.12 * 3.12 * 1000 / G, rel=1e-9)
    walls = sum(e.mass for e in loaded.of_kind("column")) - sum(e.mass for e in bare.of_kind("column"))
    height = 2.5 + 0.2 + 0.1 + 2.4 + 0.15
    assert walls == pytest.approx(0.64 * (4 + 3) * 2 * height * 1000 / G, rel=1e-9)
    corner, middle = (loaded.element(f"box.column1.x{x}y0").mass - COLUMN * 2.5 for x in (4, 2))
    assert (corner, middle) == pytest.approx([0.64 * length / 2 * 2.8 * 1000 / G for length in (2 + 1.5, 4)], rel=1e-9)
    found = weigh(loaded)
    lower_half = sum(e.mass for e in loaded.of_kind("column") if e.storey == 1) / 2 * G / 1000
    assert found["storeys"]["box"]["1"]["carried_kn"] + lower_half == pytest.approx(found["total_kn"], abs=2e-3)


def test_a_structure_overrides_the_loads_of_the_house(tmp_path):
    path = tmp_path / "tiled.yaml"
    path.write_text(
        "extends: C\nname: tiled\nloads: {roof: 0.9, wall: 0.6}\nstructures: {entrance: {loads: {roof: 0.3, wall: "
        "0}}}\n"
    )
    model, bare = build_house(load_house(path)), build_house(load_house("C"))
    roof, = model.of_kind("roof", group="entrance")
    assert roof.mass == pytest.approx(0.3 * roof.volume / 0.12 * 1000 / G)
    assert [e.mass for e in model.of_kind("column", group="entrance")] == [
        e.mass for e in bare.of_kind("column", group="entrance")
    ]
    assert model.of_kind("floor")[0].mass == bare.of_kind("floor")[0].mass
    assert weigh(model)["total_kn"] > weigh(bare)["total_kn"] + 100


@pytest.mark.parametrize("name, total", [("A", 81.72), ("C", 83.372)])
def test_houses_of_the_paper_keep_their_weight(name, total):
    assert weigh(build_house(load_house(name)))["total_kn"] == total


@pytest.mark.parametrize("loads, words", [
    ("loads: {roof: 90}", ["own.yaml:1", "loads.roof", "[0.05, 10] kN/m2", "90 kg/m2 = 0.8829"]),
    ("loads: {roofs: 0.9}", ["did you mean 'roof'?"]),
    ("loads: {wall: -1}", ["loads.wall", "[0, 10] kN/m2"]),
])
def test_mistakes(tmp_path, loads, words):
    path = tmp_path / "own.yaml"
    path.write_text(loads + "\n" + HOUSE)
    with pytest.raises(HouseError) as caught:
        load_house(path)
    assert [word for word in words if word not in str(caught.value)] == []
