# SPDX-License-Identifier: GPL-2.0-or-later
"""ContactLoop leaves pairs alone that cannot touch; everything else is as with YADE's InteractionLoop."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene
from yade_timber.motion import default_motion


def unwrap():
    """Put the InteractionLoop in its ContactLoop's place."""
    O.engines = [e.loop if isinstance(e, yw.ContactLoop) else e for e in O.engines]


def places():
    return [(tuple(b.state.pos), tuple(b.state.ori)) for b in O.bodies if b]


def box(height, fixed=False):
    return O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, height), fixed=fixed))


def start(dt=2e-4):
    O.engines = yt.engines()
    O.dt = dt


@pytest.mark.parametrize("begin", [0.0, 18.5])
def test_same_to_the_last_bit(begin):
    """House C1 under snow, settling and in strong shaking."""

    def run(wrapped):
        scenario.build(scenario.Scenario("loop", "C1", default_motion(), 1.0, options={"skip_rest": 0}))
        scene.find_engine(yw.GroundMotionEngine).start = -begin
        if not wrapped:
            unwrap()
        O.run(1500, True)
        return places(), yt.energy()

    expected, found = run(False), run(True)
    assert found == expected
    assert scene.find_engine(yw.ContactLoop).runs < O.iter / 4  # the collider's runs


def test_a_held_body_that_is_released():
    """Two held bodies are no pair; once one is released, it rests on the other."""
    O.reset()
    box(0.1, fixed=True)
    upper = box(0.3, fixed=True)
    start()
    O.run(10, True)
    O.bodies[upper].state.blockedDOFs = ""
    O.run(500, True)
    assert O.bodies[upper].state.pos[2] == pytest.approx(0.3, abs=1e-5)
    assert len(yt.contacts(0, upper)) == 4


def test_bodies_put_elsewhere_or_taken_out():
    """A body that hung beyond reach is put onto another; then that one is taken out."""
    O.reset()
    box(0.1, fixed=True)
    upper = box(0.4)
    start()
    O.engines = [e for e in O.engines if not isinstance(e, yw.UniformGravity)]
    O.run(5, True)
    assert not yt.contacts(0, upper)
    O.bodies[upper].state.pos = Vector3(0, 0, 0.3 - 1e-5)
    O.step()
    assert len(yt.contacts(0, upper)) == 4
    O.bodies.erase(0)
    O.run(5, True)
    speed = O.bodies[upper].state.vel[2]
    O.run(5, True)
    assert O.bodies[upper].state.vel[2] == speed > 0


def test_boxes_of_fast_bodies_last_for_some_steps():
    """A block flies half a metre at 40 m/s, 1 cm a step, against a wall: it is expected there and comes back no faster."""
    O.reset()
    O.bodies.append(yt.box((0.1, 2, 2), (0, 0, 0), fixed=True))
    flying = O.bodies.append(yt.box((0.2, 0.1, 0.1), (0.65, 0, 0)))
    yt.set_velocity(O.bodies[flying], (-40, 0, 0))
    start(2.5e-4)
    touched, state = 0, O.bodies[flying].state
    trigger = scene.find_engine(yw.CollisionTrigger)
    O.run(45, True)
    assert not yt.contacts(0, flying) and trigger.runs <= 6  # one in boxWidest * margin = 0.1 m
    for _ in range(40):
        O.step()
        touched += bool(yt.contacts(0, flying))
        assert state.vel.norm() < 40.1 and state.pos[0] > 0.1  # it falls by 0.2 m/s meanwhile
    assert touched and state.vel[0] > 0


def test_boxes_of_spinning_bodies_last_for_some_steps():
    """Ends of a bar that spins on the spot go 5 mm a step, as far as a slow body's box reaches."""
    O.reset()
    bar = O.bodies.append(yt.box((2, 0.1, 0.1), (0, 0, 0)))
    yt.set_velocity(O.bodies[bar], (0, 0, 0), (0, 20, 0))
    start(2.5e-4)
    O.run(45, True)
    assert scene.find_engine(yw.CollisionTrigger).runs <= 4


def test_pairs_that_were_reset_by_hand():
    O.reset()
    box(0.1, fixed=True)
    upper = box(0.3 - 1e-6)
    start()
    O.run(5, True)
    O.interactions.erase(0, upper)
    assert not yt.contacts(0, upper)
    O.step()
    assert len(yt.contacts(0, upper)) == 4


def test_other_shapes_are_left_to_yade():
    """Small spheres, whose boxes have no margin, fly at each other beside a box on the ground: as with YADE's collider and InteractionLoop alone."""

    def run(wrapped):
        O.reset()
        O.materials.append(yw.FrictMat(young=1e7, density=1000))
        box(0.1, fixed=True)
        box(0.3)
        for x, speed in ((2, 1), (2.025, -1)):
            ball = yw.Body(shape=yw.Sphere(radius=0.01), material=O.materials[0])
            ball.mask = 2  # of another group than the boxes: no functor has to exist for them
            ball.state.mass, ball.state.inertia = 4.2e-3, Vector3(1.7e-7, 1.7e-7, 1.7e-7)
            ball.state.pos, ball.state.vel = Vector3(x, 0, 0), Vector3(speed, 0, 0)
            O.bodies.append(ball)
        start(1e-5)
        bounds = scene.find_engine(yw.CollisionTrigger).collider.boundDispatcher
        bounds.functors = [*bounds.functors, yw.Bo1_Sphere_Aabb()]
        loop = scene.find_engine(yw.ContactLoop).loop
        loop.geomDispatcher.functors = [*loop.geomDispatcher.functors, yw.Ig2_Sphere_Sphere_ScGeom()]
        loop.physDispatcher.functors = [*loop.physDispatcher.functors, yw.Ip2_FrictMat_FrictMat_FrictPhys()]
        loop.lawDispatcher.functors = [*loop.lawDispatcher.functors, yw.Law2_ScGeom_FrictPhys_CundallStrack()]
        if not wrapped:
            unwrap()
            O.engines = [e.collider if isinstance(e, yw.CollisionTrigger) else e for e in O.engines]
        O.run(1000, True)
        return places()

    expected = run(False)
    assert run(True) == expected
    assert expected[2][0][0] < 2  # the spheres met and flew apart
    assert O.bodies[2].state.vel[0] == pytest.approx(-1, rel=1e-2)


def test_a_body_in_the_place_of_one_that_is_gone():
    """The scene is still, and the new body has the old one's id."""
    O.reset()
    box(0.1, fixed=True)
    upper = box(0.3)
    start()
    O.run(200, True)
    O.bodies.erase(upper)
    O.run(200, True)
    O.bodies.insertAtId(yt.box((0.4, 0.3, 0.2), (0, 0, 0.3), name="new"), upper)
    O.run(500, True)
    assert O.bodies[upper].shape.name == "new" and O.bodies[upper].state.pos[2] == pytest.approx(0.3, abs=1e-5)


def test_a_trigger_that_is_switched_off():
    """What is known of the bodies' motion then grows old: pairs are looked at in each step."""
    O.reset()
    box(0.1, fixed=True)
    upper = box(0.301)  # it falls by 1 mm
    start()
    O.step()
    scene.find_engine(yw.CollisionTrigger).dead = True
    O.run(500, True)
    assert O.bodies[upper].state.pos[2] == pytest.approx(0.3, abs=1e-5)


def test_patterns_and_shapes_that_change():
    """What is kept of a pair at rest is not taken for that of other patterns or other shapes."""

    def points(vertex_edge):
        loop = scene.find_engine(yw.ContactLoop).loop
        loop.geomDispatcher.functors[0].vertexEdge = vertex_edge
        O.step()
        return len(yt.contacts(0, upper))

    O.reset()
    box(0.1, fixed=True)  # both have a radius of 2 cm
    turn = Quaternion()
    turn.setFromTwoVectors(Vector3(-1, -1, -1).normalized(), Vector3(0, 0, -1))
    corner = Vector3(0.19, 0, 0.18 + math.sqrt(0.0399**2 - 0.01**2))  # of the core: 1 cm beyond the core's edge below, 0.1 mm deep
    upper = O.bodies.append(yt.box((0.4, 0.3, 0.2), corner - turn * Vector3(-0.18, -0.13, -0.08), orientation=turn))
    start()
    O.engines = [e for e in O.engines if not isinstance(e, yw.UniformGravity)]
    counts = [points(vertex_edge) for vertex_edge in (False, True, False, True)]
    assert counts == [0, 1, 0, 1]
    O.bodies[upper].shape.vertices = [Vector3(*v) for v in ((-0.2, -0.15, -0.1), (0.2, -0.15, -0.1), (0, 0.15, -0.1), (0, 0, 0.1))]
    O.run(5, True)  # the features that met do not exist any more


def test_without_a_collider():
    O.reset()
    box(0.1)
    O.engines = [yw.ForceResetter(), yw.CollisionTrigger()]
    with pytest.raises(Exception, match="needs a collider"):
        O.step()


def test_without_an_interaction_loop():
    O.reset()
    box(0.1)
    O.engines = [yw.ForceResetter(), yw.ContactLoop()]
    with pytest.raises(Exception, match="needs an InteractionLoop"):
        O.step()
