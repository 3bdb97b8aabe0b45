# SPDX-License-Identifier: GPL-2.0-or-later
"""The entry `law` of a house file decides the engines."""
import math

import pytest
import yade.wrapper as yw
from yade import O
from timber_houses.base.gravity import GRAVITY
from timber_houses.house import description
from timber_houses.house.errors import HouseError
from timber_houses.run.identity import identity, made_from
from timber_houses.run.options import RunOptions
from timber_houses.scene import scenario
from yade_timber.scene import engines


def built(tmp_path, law):
    """(contact functor, contact law, contact points after a step) of the storehouse with these entries of `law`."""
    path = tmp_path / "house.yaml"
    path.write_text(f"extends: storehouse\nname: mine\nlaw: {law}\n")
    scenario.build(scenario.Scenario("law", str(path)))
    loop = engines.find_engine(yw.ContactLoop).loop
    O.step()
    points = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    return loop.geomDispatcher.functors[0], loop.lawDispatcher.functors[0], points, identity(
        made_from(RunOptions(house=str(path))))


def test_default_friction():
    """A house file is read without YADE, so the default stands there and in the class."""
    assert description.FRICTION == yw.TimberMat().friction == yw.SnowMat().friction


def test_defaults(tmp_path):
    geometry, law, _, _ = built(tmp_path, "{}")
    assert (geometry.flushSupports, geometry.vertexEdge, law.increment) == (True, True, False)


def test_the_houses_of_the_paper_keep_its_contacts():
    for model, extra in (("A", False), ("C2", False), ("storehouse", True)):
        scenario.build(scenario.Scenario("law", model))
        assert engines.find_engine(yw.ContactLoop).loop.geomDispatcher.functors[0].vertexEdge == extra


@pytest.mark.parametrize("entry, attribute", [("flush_supports: false", "flushSupports"),
                                              ("vertex_edge_contacts: false", "vertexEdge")])
def test_contact_patterns(tmp_path, entry, attribute):
    """The identity differs, so a checkpoint of one variant is refused by a run of the other."""
    plain, _, _, one = built(tmp_path, "{}")
    other, _, _, two = built(tmp_path, f"{{{entry}}}")
    assert getattr(other, attribute) is not getattr(plain, attribute)
    assert {key for key in one if one[key] != two[key]} == {"content of files"}


def test_flush_members_have_fewer_supports_without_them(tmp_path):
    """With vertex-edge contacts the edges of the borders take the place of the faces."""
    few, all_of_them = "{flush_supports: false, vertex_edge_contacts: false}", "{vertex_edge_contacts: false}"
    assert built(tmp_path, few)[2] < built(tmp_path, all_of_them)[2]


def test_increment_form(tmp_path):
    assert built(tmp_path, "{hertz: increment}")[1].increment


@pytest.mark.parametrize("entry, strength", [("{}", 6e6), ("{bearing: false}", math.inf), ("{bearing: 8.0e6}", 8e6)])
def test_bearing_strength(tmp_path, entry, strength):
    """Of all timber; no house yields at rest."""
    built(tmp_path, entry)
    timber = {body.material.bearing for body in O.bodies if isinstance(body.material, yw.TimberMat)}
    assert timber == {strength}
    O.run(200, True)
    assert engines.find_engine(yw.ContactForces).crushing == 0


@pytest.mark.parametrize("entry", ["true", "0", "yes please", "7.8"])
def test_bearing_strength_that_is_none(tmp_path, entry):
    with pytest.raises(HouseError, match="bearing: .*(or false|Pa)"):
        built(tmp_path, f"{{bearing: {entry}}}")


def test_loads_are_mass_of_the_bodies(tmp_path):
    """Mass and inertia of each body are those of its element; gravity is the one that turns loads into mass."""
    path = tmp_path / "house.yaml"
    path.write_text("extends: storehouse\nname: mine\nloads: {roof: 0.9, wall: 0.6}\n")
    assert engines.GRAVITY == (0, 0, -GRAVITY)
    model = scenario.build(scenario.Scenario("loads", str(path)))
    heavy = [(body.state.mass, body.state.inertia) for body in O.bodies]
    assert [mass for mass, _ in heavy] == pytest.approx([e.mass for e in model.elements], rel=1e-12)
    scenario.build(scenario.Scenario("bare", "storehouse"))
    for body, (mass, inertia) in zip(O.bodies, heavy):
        assert list(inertia) == pytest.approx([mass / body.state.mass * i for i in body.state.inertia], rel=1e-9)
