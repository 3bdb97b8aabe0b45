# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Variants of a house: changed keys, added braces, a factor on the strength of joints; free bays."""
import pytest
import yaml
from timber_houses.house import HouseError, build_house, changed_house, free_bays, load_house


def where(column):
    return f"runs.txt:3, column {column}"


def built(folder, **changes):
    """(tables, HouseModel) of house B with changes, written to a file and loaded again."""
    data = changed_house("B", where=where, **changes)
    path = folder / "house.yaml"
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    return data, build_house(load_house(path), check=False)


def test_unchanged_is_the_same_house(tmp_path):
    _, model = built(tmp_path)
    assert model.counts() == build_house(load_house("B"), check=False).counts()


def test_keys_and_list_items(tmp_path):
    settings = ["materials.timber.density=400", "plumb.drift=1e-3", "structures.main.stack[2].height=2.5",
                "structures.main.lines[1].at=[0, 4, 8]"]
    data, model = built(tmp_path, settings=settings)
    assert model.materials["timber"]["density"] == 400 and data["structures"]["main"]["lines"][0]["at"] == [0, 4, 8]
    assert data["plumb"]["drift"] == 1e-3 and data["structures"]["main"]["stack"][1]["height"] == 2.5


def test_added_braces_have_joints_with_beams_and_columns(tmp_path):
    before = build_house(load_house("B"), check=False)
    names = ["main.brace1.EW.y0.3-4", "main.brace2.NS.x8.6-5"]
    _, model = built(tmp_path, braces=names)
    assert {e.name for e in model.elements} - {e.name for e in before.elements} == set(names)
    assert len(model.joints) == len(before.joints) + 8


def test_names_with_a_hyphen(tmp_path):
    path = tmp_path / "west.yaml"
    path.write_text(load_house("storehouse").path.read_text().replace("  store:", "  west-wing:"))
    house = load_house(path)
    bay = free_bays(house)[0]
    assert bay.startswith("west-wing.brace")
    assert changed_house(path, ["structures.west-wing.margin=0.07"], [bay])["structures"]["west-wing"]["margin"] == 0.07


def test_strength_scales_every_joint_type_but_the_unbreakable(tmp_path):
    before, (_, model) = build_house(load_house("B"), check=False), built(tmp_path, strength=0.5)
    assert [j.strength for j in model.joints] == [0.5 * j.strength for j in before.joints]
    assert any(j.strength == float("inf") for j in model.joints)


@pytest.mark.parametrize("changes, said", [
    ({"settings": ["materials.timber.densty=400"]}, "column set: materials.timber: unknown key 'densty'"),
    ({"settings": ["materials.timber.density=-1"]
      }, "column set: materials.timber.density: must be a number in [20, 30000] kg/m3, got -1"),
    ({"settings": ["materials.timber.density"]}, "column set: 'materials.timber.density': write key=value"),
    ({"settings": ["friction[40].coefficient=1"]
      }, "column set: friction[40].coefficient: there is no item [40]; the list has "),
    ({"settings": ["name.first=x"]}, "column set: name.first: there is no table or list at 'first'"),
    ({"settings": ["snow.depth=[1"]}, "column set: '[1'"),
    ({"settings": ["a b=1"]}, "column set: 'a b'"),
    ({"braces": ["brace1.EW.y0.3-4"]}, "column braces: 'brace1.EW.y0.3-4': "),
    ({"braces": ["shed.brace1.EW.y0.3-4"]}, "column braces: shed.brace1.EW.y0.3-4: unknown structure 'shed'"),
    ({"settings": ["joint_types.corner_fitting.strength=abc"]
      }, "column set: joint_types.corner_fitting.strength: expected a number in [100, inf] N, got 'abc'"),
    ({"settings": ["joint_types.new.kn=1e5"]}, "column set: joint_types.new"),
    ({"settings": ["joint_types=5"]}, "column set: joint_types"),
    ({"settings": ["structures=5"], "braces": ["main.brace1.EW.y0.3-4"]}, "column set: structures"),
    ({"strength": 0.0}, "column strength: 0: "),
    ({"strength": float("inf")}, "column strength: inf: "),
    ({"strength": 1e300}, "column strength: 1e+300: "),
    ({"settings": ["a." * 5000 + "b=1"]}, "column set: 'a.a."),
    ({"settings": [f"friction[{'9' * 5000}].coefficient=1"]}, "column set: 'friction[999"),
    ({"settings": ["snow.depth=" + "[" * 5000]}, "column set: "),
    ({"settings": ["snow.depth=!!int x"]}, "column set: "),
    ({"braces": ["main.brace1.EW.y1.2.3.4.5-6"]}, "column braces: 'main.brace1.EW.y1.2.3.4.5-6'"),
    ({"braces": ["main.brace1.EW.y" + "1." * 5000]}, "column braces: 'main.brace1.EW.y1.1."),
])
def test_refusals_name_row_and_column(changes, said):
    with pytest.raises(HouseError) as caught:
        changed_house("B", where=where, **changes)
    assert str(caught.value).startswith("runs.txt:3, ") and said in str(caught.value) and "\n" not in str(caught.value)


def test_free_bays_of_house_b():
    """Free bays: 7 of 9 and 6 of 8 in walls with two braces, 7 and 4 on the inner lines, 37 a storey; all 4 of the
    entrance.
    """
    bays = free_bays(load_house("B"))
    assert len(bays) == len(set(bays)) == 2 * 37 + 4
    walls = {
        wall: sum(f"main.brace1.{wall}." in name for name in bays)
        for wall in ("NS.x0", "NS.x4", "NS.x8", "EW.y0", "EW.y4", "EW.y9")
    }
    assert walls == {"NS.x0": 7, "NS.x4": 7, "NS.x8": 7, "EW.y0": 6, "EW.y4": 4, "EW.y9": 6}
    assert "main.brace1.NS.x0.0-1" not in bays and "main.brace1.NS.x0.1-2" in bays


def test_free_bays_between_half_nodes(tmp_path):
    """Columns at nodes 0, 0.5, 1.5, 2 of two walls: a bay that begins at a fraction is read back as itself, not as a
    bay on the line 2.1.
    """
    lines = [{"along": "y", "at": [0, 2], "from": 0, "to": 2},
             {"along": "x", "at": [0, 2], "from": 0, "to": 2, "cut": True}]
    stack = [{"layer": "sill", "height": 0.12, "width": 0.12}, {"layer": "columns", "height": 2.2},
             {"layer": "beams", "height": 0.12, "width": 0.12}, {"layer": "roof", "type": "flat", "thickness": 0.1}]
    axis = {"module": 1.82, "count": 2}
    shed = {"place": {"origin": [0, 0]}, "grid": {"x": axis, "y": axis}, "margin": 0.06, "lines": lines, "stack": stack,
            "columns": [{"section": 0.12, "grid": {"x": [0, 2], "y": [0, 0.5, 1.5, 2]}}]}
    path, braced = tmp_path / "shed.yaml", tmp_path / "braced.yaml"
    path.write_text(yaml.safe_dump({"extends": "base", "name": "shed", "structures": {"shed": shed}}))
    names = free_bays(load_house(path))
    assert len(names) == 8
    assert {"shed.brace1.NS.x2.0-0.5", "shed.brace1.NS.x2.0.0.5-1.5", "shed.brace1.EW.y2.0-2"} <= set(names)
    braced.write_text(yaml.safe_dump(changed_house(path, braces=names), sort_keys=False))
    assert build_house(load_house(braced)).counts()["braces"] == 8 and free_bays(load_house(braced)) == []


def test_a_brace_in_a_free_bay_fits(tmp_path):
    """No overlap and joints at both ends, in the bays nearest to B's own braces and in one of two modules on an inner
    line.
    """
    names = ["main.brace1.NS.x0.1-2", "main.brace1.NS.x4.1-3", "main.brace2.EW.y9.7-6"]
    assert set(names) <= set(free_bays(load_house("B")))
    path = tmp_path / "house.yaml"
    path.write_text(yaml.safe_dump(changed_house("B", braces=names), sort_keys=False))
    build_house(load_house(path))
