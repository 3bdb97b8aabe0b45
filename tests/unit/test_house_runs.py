# SPDX-License-Identifier: GPL-2.0-or-later
"""Own houses in YADE: the worked examples stand still; snow stays or slides as friction says; small and pyramidal roofs
hold.
"""
import math
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
import yade_timber as yt
from btlx_sample import portal
from yade import O
from timber_houses.base.time_step import MAX_DT
from timber_houses.run.checkpoint import Progress
from timber_houses.run.observer import Observer, cause_of
from timber_houses.scene import scenario
from yade_timber.scene import engines
from timber_houses.house import HouseError
from timber_houses.motion import GroundMotion
from timber_houses.house.loader import SHIPPED
from timber_houses.text import english


def rare(*values):
    return pytest.param(*values, marks=pytest.mark.rare)


STOREHOUSE = (SHIPPED / "storehouse.yaml").read_text()
ROOF = "type: gable, ridge: y, pitch: 0.45, eaves: 0.30, thickness: 0.20, material: tiles"


def stand(house, seconds, snow=0.0, dt=2e-4):
    """Build a house in YADE and let it stand under its weight; returns its Observer."""
    model = scenario.build(scenario.Scenario("stand", str(house), snow_depth=snow, dt=dt))
    O.run(round(seconds / O.dt), True)
    observed = Observer(model)
    observed.read_samples()
    return observed


def broken():
    return sum(any(joint.broken) for joint in engines.find_engine(yt.JointEngine).joints)


@pytest.mark.parametrize("house, snow", [("storehouse", 0.0), ("storehouse", 1.0), ("l_house", 0.0)])
def test_the_examples_stand_still(house, snow):
    """A stand of 3 s: largest drift 2e-8 (storehouse), 5e-5 (l_house)."""
    observed = stand(house, 0.4, snow)
    assert sum(map(len, observed.fresh)) > 30
    assert max(observed.judge.main.peak) < 1e-3 and broken() == 0
    assert yt.energy()["kinetic"] < 1.0


def test_a_frame_from_cad_stands_still(tmp_path):
    """A braced portal of 3 m: largest drift 7e-6."""
    path = tmp_path / "portal.btlx"
    path.write_text(portal())
    observed = stand(path, 0.4)
    assert sum(map(len, observed.fresh)) > 30
    assert max(observed.judge.main.peak) < 1e-4 and broken() == 0
    assert yt.energy()["kinetic"] < 1e-2


@pytest.mark.parametrize("pitch", [0.35, 0.9])
def test_snow_slides_where_the_roof_is_steeper_than_friction(tmp_path, pitch):
    """Friction 0.5: at a pitch of 0.9 snow runs down with g (sin - 0.5 cos); both clods start from rest."""
    path = tmp_path / "steep.yaml"
    path.write_text(STOREHOUSE.replace(ROOF, f"type: gable, pitch: {pitch}, thickness: 0.2, material: tiles"))
    seconds = 0.2
    stand(path, seconds, snow=0.5)
    angle = math.atan(pitch)
    slide = max(0.0, 9.81 / 2 * seconds**2 * (math.sin(angle) - 0.5 * math.cos(angle)))
    clods = [b for b in O.bodies if b.shape.kind == "snow"]
    assert len(clods) == 2
    for clod in clods:  # the first overlap of snow and roof takes 1 mm; the frame gives by 2 mm
        assert (clod.state.pos - clod.state.refPos).norm() == pytest.approx(slide, abs=4e-3)


@pytest.mark.parametrize("grid", ["x: {module: 0.91, count: 1}, y: {module: 0.91, count: 1}",
                                  "x: {module: 0.91, count: 3}, y: {module: 0.91, count: 3}"])
def test_one_module_and_a_pyramid_stand(tmp_path, grid):
    last = int(grid[-2])
    start, end = STOREHOUSE.index("    grid:"), len(STOREHOUSE)
    text = STOREHOUSE[:start] + f"""    grid: {{{grid}}}
    margin: 0.06
    lines: [{{along: y, at: [0, {last}], from: 0, to: {last}}}, {{along: x, at: [0, {last}], from: 0, to: {last},
             cut: true}}]
    stack:
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2.4}}
      - {{layer: beams, height: 0.12, width: 0.12}}
      - {{layer: roof, type: hip, pitch: 0.4, thickness: 0.12, corner_cut: 0.1, material: tiles}}
    columns:
      - section: 0.12
        lines: [{{along: y, at: [0, {last}], from: 0, to: {last}}}, {{along: x, at: [0, {last}], from: 0, to: {last}}}]
    braces: {{lines: [{{along: y, at: [0, {last}], runs: [[0, 1]]}}, {{along: x, at: [0, {last}], runs: [[1, 0]]}}]}}
""" + STOREHOUSE[end:]
    path = tmp_path / "small.yaml"
    path.write_text(text)
    observed = stand(path, 0.3, snow=1.0, dt=5e-5)
    assert max(observed.judge.main.peak) < 2e-3 and broken() == 0
    if last == 1:
        path.write_text(text + "joint_types: {roof_plate: {kn: 4e10, ks: 4e10}}\n")
        with pytest.raises(
                HouseError,
                match="a time step of 0.0002 s is too large for the joints between the lightest members: take at most"):
            stand(path, 0.0)


@pytest.mark.parametrize("house", ["A", "B", "C", "B1", "B2", "C1", "C2"])
def test_the_papers_houses_take_the_largest_step(house):
    """Their stiffest joints leave two per cent: `check_step` does not refuse what the command line allows."""
    scenario.build(scenario.Scenario("step", house, dt=MAX_DT))
    assert O.dt == MAX_DT < yt.stable_dt(1.0)


def test_each_storey_has_its_height(tmp_path):
    path = tmp_path / "low.yaml"
    path.write_text(
        (SHIPPED /
         "l_house.yaml").read_text().replace("{layer: columns, height: 2.73}", "{layer: columns, height: 2.4}", 1)
    )
    model = scenario.build(scenario.Scenario("heights", str(path)))
    assert [level.height for level in Observer(model).main_levels] == pytest.approx([2.4, 2.73])
    assert model.storey_levels["side"][2][0] == pytest.approx(0.42 + 2.4 + 0.32)


def test_a_roof_right_on_the_columns_marks_the_upper_level(tmp_path):
    """No beams under the roof of a house that has a floor: the roof alone marks the level of the upper storey."""
    base = yaml.safe_load((SHIPPED / "paper.yaml").read_text())
    stack = [*base["structures"]["main"]["stack"][:6], {"layer": "roof", "type": "flat",
                                                        "thickness": 0.12}]  # without the upper beams
    rules = {"column_roofs": {"between": ["column", "roof"], "type": "corner_fitting", "kind": "column_roof"}}
    path = tmp_path / "bare.yaml"
    path.write_text(
        yaml.safe_dump({"extends": "A", "structures": {"main": {"stack": stack}, "entrance": None}, "joints": rules}))
    model = scenario.build(scenario.Scenario("bare", str(path)))
    assert {level for _, level in scenario.level_marks(model, "main")} == {1, 2}


def sampled(model):
    """Observer of the scene, with a sample of its present state."""
    sampler = engines.find_engine(yt.Sampler)
    sampler.interval = 0.0
    sampler()
    return Observer(model)


@pytest.mark.parametrize("structure", ["main", "entrance"])
def test_a_level_without_bodies_is_refused(structure):
    model = scenario.build(scenario.Scenario("levels", "A"))
    observed = Observer(model)
    observed.observe(0.0)
    for mark in next(level for level in observed.survey.levels if level.structure == structure).marks:
        O.bodies.erase(mark)
    with pytest.raises(RuntimeError, match=f"{structure}: all bodies at the top of storey 1 are erased"):
        observed.observe(0.0)


def structures(model):
    """(fallen, leaning) structures of the scene as it is now."""
    observed = sampled(model)
    observed.read_samples()
    found = observed.survey.by_structure(observed.state(), observed.judge.structures)
    return [name for name, facts in found.items()
            if facts.collapsed], [name for name, facts in found.items() if facts.leans]


def move_entrance_roof(*shift):
    """Move the roof of house A's entrance with the beams under it, which are its only level. [m]"""
    for b in O.bodies:
        if b.shape.name.startswith(("entrance.roof", "entrance.beam")):
            b.state.pos += shift


def test_fallen_structures_are_named():
    """An entrance that falls alone."""
    model = scenario.build(scenario.Scenario("fallen", "A"))
    assert structures(model) == ([], [])
    move_entrance_roof(0, 0, -1.4)
    assert structures(model) == (["entrance"], [])


def test_leaning_structures_are_named():
    model = scenario.build(scenario.Scenario("leaning", "A"))
    move_entrance_roof(0.2, 0, 0)
    assert structures(model) == ([], [])
    move_entrance_roof(0.2, 0, 0)
    assert structures(model) == ([], ["entrance"])


WIDE = """
extends: plated
name: wide
loads: {{roof: {load}, wall: 0.75}}
structures:
  main:
    place: {{origin: [0, 0]}}
    grid: {{x: {{module: 0.91, count: {nx}}}, y: {{module: 0.91, count: {ny}}}}}
    margin: 0.06
    lines: [{{along: y, at: [0, {nx}], from: 0, to: {ny}}}, {{along: x, at: [0, {ny}], from: 0, to: {nx}, cut: true}}]
    stack:
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2.7}}
      - {{layer: beams, height: 0.24, width: 0.12}}
      - {{layer: roof, {roof}, thickness: 0.12, material: roofing}}
    columns:
      - section: 0.12
        lines: [{{along: y, at: [0, {nx}], from: 0, to: {ny}}}, {{along: x, at: [0, {ny}], from: 0, to: {nx}}}]
    braces:
      lines:
        - {{along: y, at: [0, {nx}], runs: [[0, 1], [{ny}, {ny} - 1]]}}
        - {{along: x, at: [0, {ny}], runs: [[0, 1], [{nx}, {nx} - 1]]}}
"""
"""One storey of nx by ny modules without inner walls."""


@pytest.mark.parametrize("nx, ny, roof, load, snow", [
    (7, 8, "type: gable, pitch: 0.45, eaves: 0.75", 0.85, 0.5),
    rare(7, 8, "type: gable, pitch: 0.1, eaves: 0.6", 0.85, 0.0),
    rare(4, 6, "type: gable, pitch: 1.2", 0.85, 0.0),
    rare(8, 7, "type: gable, pitch: 0.3, ridge: y, eaves: 0.9", 1.5, 0.0),
    (10, 12, "type: gable, pitch: 0.4, eaves: 0.6", 0.85, 1.0),
    rare(2, 3, "type: gable, pitch: 0.5, eaves: 0.3", 0.2, 2.0),
    (7, 8, "type: hip, pitch: 0.45, eaves: 0.75", 0.85, 0.5),
    rare(10, 14, "type: hip, pitch: 0.25, eaves: 0.6", 0.85, 0.0),
    (7, 8, "type: mono, falls: west, pitch: 0.2, eaves: 0.6", 0.85, 0.5),
    rare(10, 4, "type: mono, falls: south, pitch: 0.4", 0.85, 1.0),
    rare(4, 6, "type: mono, falls: north, pitch: 0.05, eaves: 0.3", 1.5, 0.0),
    rare(10, 10, "type: mono, falls: east, pitch: 0.3, eaves: 0.9", 0.85, 0.0),
])
def test_walls_feel_the_weight_of_a_roof_and_no_thrust(tmp_path, nx, ny, roof, load, snow):
    """Wall plates move by 0.65 mm and joints have 0.29 of their strength at most under gables, 1.2 mm and 0.50 under
    the wide hip roof.

    Mono-pitch roofs, which are not symmetric, sway by a drift of 1.4e-4 at most; their plates move by 0.22 mm, their
    joints have 0.05 of their strength.
    Without tie beams three of the gables break joints, and their plates move by more than 0.2 m.
    """
    path = tmp_path / "wide.yaml"
    path.write_text(
        WIDE.format(nx=nx, ny=ny, roof=roof, load=load).replace(f"{nx} - 1", str(nx - 1)).replace(
            f"{ny} - 1", str(ny - 1)))
    observed = stand(path, 0.5, snow, dt=3e-4)
    apart = max(abs(b.state.pos[k] - b.state.refPos[k]) for b in O.bodies if b.shape.kind == "beam" for k in (0, 1))
    load = max(engines.find_engine(yt.Sampler).load)
    most, strongest, sway = {"gable": (8e-4, 0.35, 1e-6), "hip": (1.3e-3, 0.55, 1e-6), "mono": (
        3e-4, 0.06, 2e-4)}[roof.split(",")[0][6:]]
    assert broken() == 0 and max(observed.judge.main.peak) < sway and apart < most and load < strongest


def test_damage_before_the_shaking_is_an_event():
    """The ground shakes from 0.5 s on; the entrance leans by 1/14 before. A house without that damage, and damage that
    comes later, have no event. A run that ends before the shaking has it at its end.
    """
    shaking = np.zeros((100, 3))
    shaking[50:, 0] = 1.0
    cases = ((0.0, 0.5, False, 0), (0.2, 0.3, False, 0), (0.2, 0.48, False, 1), (0.2, 0.6, False, 0),
             (0.2, 0.3, True, 1), (0.2, 0.6, True, 0))
    for lean, time, last, events in cases:
        model = scenario.build(scenario.Scenario("weight", "A", GroundMotion(0.01, shaking)))
        move_entrance_roof(lean, 0, 0)
        observed = sampled(model)
        observed.observe(time, last)
        texts = [english.event(event) for event in observed.log.events if event.kind == "own_weight"]
        assert texts == ["damaged before the shaking, by its own weight: entrance: peak drift 1/14"] * events


def test_peaks_of_joints_end_with_the_fall():
    """Of a house that collapses they are those of the last frame before a storey drift of 1/10, of one that stands
    those of the whole run.
    """
    observed = stand("A", 0.02)
    main = observed.judge.main
    observed.observe(O.time)
    before = observed.joint_peaks()
    assert observed.fall() is None and len(before) == len(observed.model.joints)
    main.tilt_s, main.tilt_direction = O.time, "ns"
    O.run(20, True)
    observed.observe(O.time)
    later = observed.joint_peaks()
    assert later != before, "the house stands: all peaks count"
    main.fall_s = O.time
    observed.observe(O.time)
    assert observed.joint_peaks() == before and observed.fall() == main.tilt_s
    resumed = Observer(observed.model, Progress(0.0, 0, **observed.progress()))
    assert resumed.joint_peaks() == before


def test_the_cause_of_a_wall_is_shear():
    """Tension and compression of its springs are directions of its drift."""
    model = scenario.Scenario("walls", "tiled_house").build_model()
    kinds = [joint.kind.startswith("wall") for joint in model.joints]
    for wall, cause in ((True, "shear"), (False, "compression")):
        assert cause_of(SimpleNamespace(joint=kinds.index(wall), cause="compression"), model) == cause
