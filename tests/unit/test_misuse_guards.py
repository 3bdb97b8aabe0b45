# SPDX-License-Identifier: GPL-2.0-or-later
"""Guards before each step: engines by their role, the time step, parts of bodies and engines replaced by any door,
absurd values.
"""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate, is_one_line, refused
from yade import O
from yade.minieigenHP import Vector3
from yade_timber.scene.engines import find_engine

yt.guard()

raw_update = yt.scene.attributes._update_attributes
"""YADE's own updateAttrs: a door that no rule in Python watches."""


# --- engines ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("foreign, words", [
    (lambda: yw.NewtonIntegrator(damping=0), ["NewtonIntegrator", "second time"]),
    (lambda: yw.ParallelEngine([yw.NewtonIntegrator()]), ["NewtonIntegrator", "second time"]),
    (lambda: yw.ParallelEngine([[yw.ParallelEngine([yw.NewtonIntegrator()])]]), ["NewtonIntegrator", "second time"]),
    (yw.GlobalStiffnessTimeStepper, ["GlobalStiffnessTimeStepper", "O.dt"]),
    (lambda: yw.ParallelEngine([yw.GlobalStiffnessTimeStepper()]), ["GlobalStiffnessTimeStepper", "O.dt"]),
    (lambda: yw.ParallelEngine([yw.SymplecticIntegrator()]), ["SymplecticIntegrator", "ParallelEngine"]),
])
def test_foreign_engine(foreign, words):
    """Wherever it stands."""
    column_on_plate()
    chain = list(O.engines)
    for place in (1, 2, len(chain) - 1, len(chain)):
        O.engines = [*chain[:place], foreign(), *chain[place:]]
        refused("O.engines", *words)
    dead = foreign()
    dead.dead = True
    O.engines = [*chain, dead]
    O.step()


def test_slave_added_later():
    column_on_plate()
    parallel = yw.ParallelEngine([yw.PyRunner(command="1", iterPeriod=1)])
    O.engines = [*O.engines, parallel]
    O.step()
    parallel.slaves = [yw.NewtonIntegrator()]
    refused("NewtonIntegrator")


@pytest.mark.parametrize("name", ["geomDispatcher", "physDispatcher", "lawDispatcher"])
def test_loop_without_dispatcher(name):
    column_on_plate()
    raw_update(find_engine(yw.ContactLoop).loop, {name: None})
    refused("O.engines", name)


@pytest.mark.parametrize("name", ["geomDispatcher", "physDispatcher", "lawDispatcher"])
def test_loop_emptied_in_a_run(name):
    column_on_plate()
    getattr(find_engine(yw.ContactLoop).loop, name).functors = []
    refused("InteractionLoop")


def test_inner_engines_replaced():
    column_on_plate()
    find_engine(yw.ContactLoop).loop = yw.InteractionLoop()
    refused("InteractionLoop")
    for value in (None, yw.NewtonIntegrator()):
        column_on_plate()
        find_engine(yw.ContactLoop).loop = value
        refused("ContactLoop.loop")
        column_on_plate()
        find_engine(yw.CollisionTrigger).collider = value
        refused("CollisionTrigger.collider")
    column_on_plate()
    raw_update(find_engine(yw.CollisionTrigger).collider, {"boundDispatcher": None})
    refused("boundDispatcher")


# --- time step --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dt", [0.02, 20.0])
def test_step_of_contacts(dt):
    column_on_plate()
    O.dt = dt
    refused("O.dt", "at most")
    O.dt = 1e-3
    O.step()


def test_step_of_stiff_joints():
    O.reset()
    links = [O.bodies.append(yt.box((0.09, 0.09, 0.09), (0, 0, 0.09 * k), fixed=k == 0)) for k in range(3)]
    O.dt, O.engines = 5e-4, yt.engines()
    for pair in zip(links, links[1:]):
        yt.connect(*pair, [(0, 0, 0.09 * links.index(pair[0]) + 0.045)], stiffness=(1e9, 1e9), strength=math.inf)
    refused("O.dt", "joints", "at most")
    O.dt = 1e-5
    O.step()


# --- bodies -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name, value, words", [
    ("shape", yw.Sphere(radius=0.1), ["Sphere"]),
    ("material", None, ["material None"]),
    ("state", None, ["no state"]),
    ("state", yw.State(), ["state.mass = 0"]),
    ("id", 7, ["id is 7"]),
    ("flags", 7, ["flags"]),
])
def test_part_replaced_by_a_hidden_door(name, value, words):
    _, column = column_on_plate()
    raw_update(O.bodies[column], {name: value})
    refused(*words)


def test_vertices_of_a_standing_body():
    _, column = column_on_plate()
    shape = O.bodies[column].shape
    longer = [1.5 * v for v in shape.vertices]
    with pytest.raises(ValueError, match=f"the shape of body {column} in the scene"):
        shape.updateAttrs({"vertices": longer})
    O.step()
    raw_update(shape, {"vertices": longer})
    refused(f"body {column}", "another shape")


def test_other_part_by_a_hidden_door():
    """Allowed parts act: contacts are those of the new shape."""
    plate, column = column_on_plate()
    raw_update(O.bodies[column], {"shape": yt.box((0.2, 0.2, 1.0), (0, 0, 0)).shape})
    O.run(5, True)
    assert max(abs(c["position"][0]) for c in yt.contacts(plate, column)) > 0.06


@pytest.mark.parametrize("inertia", [(-1, -1, -1), (0, 1, 1), (math.nan, 1, 1)])
def test_inertia(inertia):
    _, column = column_on_plate()
    raw_update(O.bodies[column].state, {"inertia": Vector3(*inertia)})
    refused(f"body {column}", "state.inertia")


def test_bodies_cleared():
    column_on_plate()
    O.bodies.clear()
    O.engines = [e for e in O.engines if not isinstance(e, yw.JointEngine)]
    O.step()
    O.bodies.append([
        yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True),
        yt.box((0.1, 0.1, 0.1), (0, 0, 0.05)),
        yt.box((0.1, 0.1, 0.1), (0, 0, 1))
    ])
    O.run(200, True)
    assert abs(O.bodies[1].state.pos[2] - 0.05) < 1e-4 and O.bodies[2].state.pos[2] < 0.999


def test_bodies_cleared_and_replaced():
    """The joint's bodies are gone: another list has their ids."""
    column_on_plate()
    O.bodies.clear()
    try:
        O.step()
    except RuntimeError as error:
        assert "JointEngine.joints[0]" in str(error)
    O.bodies.append([yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True), yt.box((0.1, 0.1, 0.1), (0, 0, 0.05))])
    O.step()


def test_angular_velocity_changed_in_a_run():
    """By each door."""
    O.reset()
    body = O.bodies.append(yt.box((0.3, 0.3, 0.1), (0, 0, 2)))
    O.dt, O.engines = 2e-4, yt.engines()
    state = O.bodies[body].state
    doors = (lambda v: raw_update(state, {"angVel": v}), lambda v: state.updateAttrs({"angVel": v}),
             lambda v: setattr(state, "angVel", v))
    for speed, door in zip((5, -2, 0), doors):
        door(Vector3(0, 0, speed))
        O.run(10, True)
        assert O.bodies[body].state.angVel[2] == pytest.approx(speed, abs=1e-12)


# --- values -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("make, words", [
    (lambda: yt.timber(young=8), ["TimberMat.young = 8", "1e5"]),
    (lambda: yt.timber(density=1e-9), ["TimberMat.density"]),
    (lambda: yt.timber(friction=1e9), ["TimberMat.friction"]),
    (lambda: yt.snow(density=1e-9), ["SnowMat.density"]),
    (lambda: yt.snow(stiffness_per_kg=1e-3), ["SnowMat.stiffnessPerMass"]),
    (lambda: yt.snow(stiffness_per_kg=1e12), ["SnowMat.stiffnessPerMass"]),
])
def test_absurd_material(make, words):
    with pytest.raises(ValueError) as error:
        make()
    is_one_line(error, *words)


def test_joint_points_far_from_both_bodies():
    plate, column = column_on_plate()
    for point in ((0, 0, 6), (8, 0, 0)):
        with pytest.raises(ValueError) as error:
            yt.connect(plate, column, [(0, 0, 0), point])
        is_one_line(error, "connect: points", "from both")
    yt.connect(plate, column, [(0, 0, -2)])  # in reach of the plate


BAD = {
    float: math.inf, Vector3: Vector3(math.nan, 0, 0),
    yw.State().ori.__class__: yw.State().ori.__class__(math.nan, 0, 0, 0)
}
"""Type of an attribute -> a value that is not finite."""


def parts_of_a_scene():
    """Objects of each kind that a scene consists of, after some steps."""
    _, column = column_on_plate()
    body, contact = O.bodies[column], next(iter(O.interactions))
    loop, collider = find_engine(yw.ContactLoop).loop, find_engine(yw.CollisionTrigger).collider
    dispatchers = (loop.geomDispatcher, loop.physDispatcher, loop.lawDispatcher, collider.boundDispatcher)
    yield from (*O.engines, loop, collider, *(functor for dispatcher in dispatchers for functor in dispatcher.functors))
    yield from (find_engine(yw.JointEngine).joints[0], body.state, body.shape, body.material, body.bound, contact,
                contact.geom, contact.phys)


def test_values_that_are_not_finite():
    """Refused by each door; the process goes on, and the value stays. What a class itself leaves infinite (no strength
    limit) may be so.
    """
    count = 0
    for part in parts_of_a_scene():
        for name in dir(type(part)):
            attribute = getattr(type(part), name)
            if not isinstance(attribute, property) or not attribute.fset:
                continue
            before, default = getattr(part, name), getattr(type(part)(), name)
            if type(before) not in BAD or repr(default) in ("inf", "nan"):
                continue
            for door in (lambda value: setattr(part, name, value), lambda value: part.updateAttrs({name: value}),
                         lambda value: type(part)(**{name: value})):
                with pytest.raises((ValueError, AttributeError)) as error:
                    door(BAD[type(before)])
                is_one_line(error,
                            "" if "nan" in repr(type(part)().dict()) else name)  # a required attribute is missing first
                assert repr(getattr(part, name)) == repr(before)
                count += 1
    O.run(20, True)
    assert count > 100
