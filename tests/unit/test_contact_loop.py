# SPDX-License-Identifier: GPL-2.0-or-later
"""ContactLoop skips pairs that cannot be in contact; the results are those of YADE's InteractionLoop."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines


def unwrap():
    """Replace the ContactLoop by its InteractionLoop."""
    O.engines = [e.loop if isinstance(e, yw.ContactLoop) else e for e in O.engines]


def poses():
    return [(tuple(b.state.pos), tuple(b.state.ori)) for b in O.bodies if b]


def box(height, fixed=False):
    return O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, height), fixed=fixed))


def start(dt=2e-4):
    O.engines = yt.engines()
    O.dt = dt


@pytest.mark.parametrize("begin", [0.0, pytest.param(18.5, marks=pytest.mark.rare)])
def test_bitwise_equal_to_interaction_loop(begin):
    """House C1 under snow, during settlement and in strong shaking."""

    def run(wrapped):
        scenario.build(scenario.Scenario("loop", "C1", default_motion(), 1.0, options={"skip_rest": 0}))
        engines.find_engine(yw.GroundMotionEngine).start = -begin
        if not wrapped:
            unwrap()
        O.run(1500, True)
        return poses(), yt.energy()

    expected, found = run(False), run(True)
    assert found == expected
    assert engines.find_engine(yw.ContactLoop).runs < O.iter / 4  # it runs with the collider


def test_bodies_moved_by_hand_or_erased():
    """A distant body is placed on another, which is then erased."""
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


def test_bounding_boxes_of_fast_bodies():
    """A block flies half a metre at 40 m/s, 1 cm per step, against a wall. The contact is detected, and the rebound is
    not faster.
    """
    O.reset()
    O.bodies.append(yt.box((0.1, 2, 2), (0, 0, 0), fixed=True))
    flying = O.bodies.append(yt.box((0.2, 0.1, 0.1), (0.65, 0, 0)))
    yt.set_velocity(O.bodies[flying], (-40, 0, 0))
    start(2.5e-4)
    touched, state = 0, O.bodies[flying].state
    trigger = engines.find_engine(yw.CollisionTrigger)
    O.run(45, True)
    assert not yt.contacts(0, flying) and trigger.runs <= 6  # one per maxMarginRatio * margin = 0.1 m
    for _ in range(40):
        O.step()
        touched += bool(yt.contacts(0, flying))
        assert state.vel.norm() < 40.1 and state.pos[0] > 0.1  # gravity adds 0.2 m/s
    assert touched and state.vel[0] > 0


def test_bounding_boxes_of_rotating_bodies():
    """The ends of a rotating bar move 5 mm per step, the margin of a slow body."""
    O.reset()
    bar = O.bodies.append(yt.box((2, 0.1, 0.1), (0, 0, 0)))
    yt.set_velocity(O.bodies[bar], (0, 0, 0), (0, 20, 0))
    start(2.5e-4)
    O.run(45, True)
    assert engines.find_engine(yw.CollisionTrigger).runs <= 4


def test_other_shapes():
    """Two small spheres, whose boxes have no margin, collide beside a box on the ground: same result as with YADE's
    engines alone.
    """

    def run(wrapped):
        O.reset()
        O.materials.append(yw.FrictMat(young=1e7, density=1000))
        box(0.1, fixed=True)
        box(0.3)
        for x, speed in ((2, 1), (2.025, -1)):
            ball = yw.Body(shape=yw.Sphere(radius=0.01), material=O.materials[0])
            ball.mask = 2  # a group of its own: no functor is needed for spheres and boxes
            ball.state.mass, ball.state.inertia = 4.2e-3, Vector3(1.7e-7, 1.7e-7, 1.7e-7)
            ball.state.pos, ball.state.vel = Vector3(x, 0, 0), Vector3(speed, 0, 0)
            O.bodies.append(ball)
        start(1e-5)
        bounds = engines.find_engine(yw.CollisionTrigger).collider.boundDispatcher
        bounds.functors = [*bounds.functors, yw.Bo1_Sphere_Aabb()]
        loop = engines.find_engine(yw.ContactLoop).loop
        loop.geomDispatcher.functors = [*loop.geomDispatcher.functors, yw.Ig2_Sphere_Sphere_ScGeom()]
        loop.physDispatcher.functors = [*loop.physDispatcher.functors, yw.Ip2_FrictMat_FrictMat_FrictPhys()]
        loop.lawDispatcher.functors = [*loop.lawDispatcher.functors, yw.Law2_ScGeom_FrictPhys_CundallStrack()]
        if not wrapped:
            unwrap()
            O.engines = [e.collider if isinstance(e, yw.CollisionTrigger) else e for e in O.engines]
        O.run(1000, True)
        return poses()

    expected = run(False)
    assert run(True) == expected
    assert expected[2][0][0] < 2  # the spheres collided
    assert O.bodies[2].state.vel[0] == pytest.approx(-1, rel=1e-2)


def test_patterns_and_shapes_that_change():
    """The cache of a pair at rest is reset for other patterns and other shapes."""

    def points(vertex_edge):
        loop = engines.find_engine(yw.ContactLoop).loop
        loop.geomDispatcher.functors[0].vertexEdge = vertex_edge
        O.step()
        return len(yt.contacts(0, upper))

    O.reset()
    box(0.1, fixed=True)  # both have a radius of 2 cm
    turn = Quaternion()
    turn.setFromTwoVectors(Vector3(-1, -1, -1).normalized(), Vector3(0, 0, -1))
    corner = Vector3(
        0.19, 0, 0.18 + math.sqrt(0.0399**2 - 0.01**2))  # of the core: 1 cm beyond the core's edge below, 0.1 mm deep
    upper = O.bodies.append(yt.box((0.4, 0.3, 0.2), corner - turn * Vector3(-0.18, -0.13, -0.08), orientation=turn))
    start()
    O.engines = [e for e in O.engines if not isinstance(e, yw.UniformGravity)]
    counts = [points(vertex_edge) for vertex_edge in (False, True, False, True)]
    assert counts == [0, 1, 0, 1]
    corners = [Vector3(*v) for v in ((-0.2, -0.15, -0.1), (0.2, -0.15, -0.1), (0, 0.15, -0.1), (0, 0, 0.1))]
    O.bodies[upper].shape = yw.RoundedPolyhedron(vertices=corners)
    O.run(5, True)  # the features in contact no longer exist


def test_without_a_collider():
    O.reset()
    box(0.1)
    O.engines = [yw.ForceResetter(), yw.CollisionTrigger()]
    with pytest.raises(Exception, match="a Collider is required"):
        O.step()


def test_without_an_interaction_loop():
    O.reset()
    box(0.1)
    O.engines = [yw.ForceResetter(), yw.ContactLoop()]
    with pytest.raises(Exception, match="an InteractionLoop is required"):
        O.step()


@pytest.mark.parametrize("radius", [-1e-3, math.nan, math.inf, 0.3])
def test_refused_radius_keeps_the_geometry(radius):
    """0.3 m leaves no core. Mass properties and faces stay those of the last valid attributes."""
    shape = yt.box((0.4, 0.3, 0.2), (0, 0, 0)).shape
    before = shape.massProperties(), shape.faces()
    with pytest.raises(ValueError, match=r"RoundedPolyhedron.radius = |leaves no core"):
        shape.radius = radius
    assert (shape.massProperties(), shape.faces()) == before


def test_hull_with_too_many_vertices():
    points = [Vector3(math.cos(0.1 * k) * math.sin(0.37 * k), math.sin(0.1 * k) * math.sin(0.37 * k),
                      math.cos(0.37 * k)) for k in range(2000)]
    with pytest.raises(ValueError, match="at most 64 vertices, got 2000"):
        yt.polyhedron(points)
