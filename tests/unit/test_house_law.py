# SPDX-License-Identifier: GPL-2.0-or-later
"""What a house file says about the laws arrives in the engines."""
import pytest
import yade.wrapper as yw
from yade import O
from yade_timber.run import checkpoint
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene


def built(tmp_path, law):
    """(contact functor, contact law, contact points after a step) of the storehouse with these entries of `law`."""
    path = tmp_path / "house.yaml"
    path.write_text(f"extends: storehouse\nname: mine\nlaw: {law}\n")
    built = scenario.Scenario("law", str(path))
    model = scenario.build(built)
    loop = scene.find_engine(yw.ContactLoop).loop
    O.step()
    points = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    return loop.geomDispatcher.functors[0], loop.lawDispatcher.functors[0], points, checkpoint.identity(built, model, "")


def test_defaults(tmp_path):
    geometry, law, _, _ = built(tmp_path, "{}")
    assert (geometry.flushSupports, geometry.vertexEdge, law.increment) == (True, False, False)


@pytest.mark.parametrize("entry, attribute", [("flush_supports: false", "flushSupports"), ("vertex_edge_contacts: true", "vertexEdge")])
def test_contact_patterns(tmp_path, entry, attribute):
    """A checkpoint of one reading is refused by a run with the other."""
    plain, _, _, identity = built(tmp_path, "{}")
    other, _, _, other_identity = built(tmp_path, f"{{{entry}}}")
    assert getattr(other, attribute) is not getattr(plain, attribute)
    assert {key for key in identity if identity[key] != other_identity[key]} == {"law"}


def test_flush_members_have_fewer_supports_without_them(tmp_path):
    assert built(tmp_path, "{flush_supports: false}")[2] < built(tmp_path, "{}")[2]


def test_increment_form(tmp_path):
    assert built(tmp_path, "{hertz: increment}")[1].increment
