# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that are erased, appended again or given another pose between two steps: the others go on as before, and only
what was placed deep in another body is refused.
"""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade_timber.scene.engines import find_engine

yt.guard()

SIDE = 0.2


def cube(x=0.0, z=SIDE / 2, **more):
    return O.bodies.append(yt.box((SIDE, SIDE, SIDE), (x, 0, z), **more))


def plate():
    O.reset()
    return O.bodies.append(yt.box((12, 4, 0.2), (0, 0, -0.1), fixed=True))


def start(dt=2e-4, steps=0, **options):
    O.dt, O.engines = dt, yt.engines(**options)
    if steps:
        O.run(steps, True)


def reload(tmp_path):
    O.save(str(tmp_path / "scene.xml"), quiet=True)
    O.load(str(tmp_path / "scene.xml"), quiet=True)


def as_hex(bodies):
    states = [O.bodies[k].state for k in bodies]
    return [x.hex() for s in states for vector in (s.pos, s.ori, s.vel, s.angVel) for x in vector]


# --- far away ---------------------------------------------------------------------------------------------------------


def on_a_slope(erase, tmp_path=None, joined=False):
    """Bits of four shaken blocks after bodies far away were erased. erase: step -> numbers of them"""
    plate()
    others = [O.bodies.append(yt.box((SIDE, SIDE, SIDE), (20 + k, 0, 0.5), fixed=True)) for k in range(3)]
    blocks = [cube(k - 2) for k in range(4)]
    shaking = yw.GroundMotionEngine(step=0.05, acceleration=[(2 * math.sin(k), 0, 0) for k in range(9)])
    start(gravity=(2.5, 0, -9.5), ground_motion=shaking)
    if joined:
        yt.connect(others[0], others[1], [(20.1, 0, 0.5)])
    for step in (0, 300, 600):
        for k in erase.get(step, ()):
            assert O.bodies.erase(others[k])
        if tmp_path and step in erase:
            reload(tmp_path)
        O.run(300, True)
    return as_hex(blocks)


@pytest.mark.parametrize("erase", [{0: (0,)}, {300: (0,)}, {300: (1,), 600: (0, 2)}, {0: (2, 0), 300: (1,)}])
def test_bodies_far_away(erase, tmp_path):
    """To the last bit as if they were still there, also after saving."""
    untouched = on_a_slope({})
    assert on_a_slope(erase) == untouched
    assert on_a_slope(erase, tmp_path) == untouched
    assert on_a_slope(erase, joined=True) == untouched


def test_contacts_of_the_others_are_kept():
    plate()
    far = cube(5, 2, fixed=True)
    block = cube()
    start(steps=500)
    contact = O.interactions[0, block]
    made = contact.iterMadeReal
    O.bodies.erase(far)
    O.run(5, True)
    assert O.interactions[0, block].iterMadeReal == made and find_engine(yw.ContactForces).placed == 0


# --- in contact -------------------------------------------------------------------------------------------------------


def test_the_gate_of_a_pile():
    """Blocks fall on each other and on the ground at several speeds."""
    plate()
    gate = O.bodies.append(yt.box((0.1, 1, 1), (0.4, 0, 0.5), fixed=True))
    blocks = [cube(x, SIDE * (k + 0.55)) for k in range(4) for x in (-0.1, 0.1)]
    start(dt=5e-4, steps=1000, gravity=(3, 0, -9.3), vertex_edge=True)
    O.bodies.erase(gate)
    O.run(2000, True)
    assert all(O.bodies[k].state.pos[2] > 0.09 for k in blocks)


@pytest.mark.parametrize("saved", [False, True])
def test_the_middle_of_a_column(saved, tmp_path):
    """The upper block falls freely and lands. One with another shape takes the place of the erased one."""
    plate()
    ids = [cube(0, SIDE * (k + 0.5)) for k in range(3)]
    start(dt=5e-4, steps=200)
    O.bodies.erase(ids[1])
    if saved:
        reload(tmp_path)
    O.run(200, True)
    assert O.bodies[ids[2]].state.pos[2] == pytest.approx(2.5 * SIDE - 9.81 * 0.1**2 / 2, rel=1e-3)
    O.run(600, True)
    assert O.bodies[ids[2]].state.pos[2] == pytest.approx(1.5 * SIDE, abs=1.5e-3)  # 2 m/s times the step
    assert O.bodies.insertAtId(yt.box((0.3, 0.2, SIDE), (1, 0, SIDE / 2)), ids[1]) == ids[1]
    if saved:
        reload(tmp_path)
    O.run(400, True)
    assert len(yt.contacts(0, ids[1])) == 4 and O.bodies[ids[1]].state.pos[2] == pytest.approx(SIDE / 2, abs=1e-4)


@pytest.mark.parametrize("saved", [False, True])
def test_joints_of_an_erased_body(saved, tmp_path):
    """Another body that gets the id is not joined, and its own joints hold."""
    plate()
    low, high = cube(), cube(0, 1.5 * SIDE)
    start()
    yt.connect(low, high, [(0, 0, SIDE)], strength=math.inf)
    O.run(10, True)
    O.bodies.erase(high)
    assert find_engine(yw.JointEngine).joints[0].isBroken
    O.bodies.insertAtId(yt.box((SIDE, SIDE, SIDE), (1, 0, SIDE / 2)), high)
    yt.connect(0, high, [(1, 0, 0)])
    if saved:
        reload(tmp_path)
    O.run(100, True)
    assert [joint.isBroken for joint in find_engine(yw.JointEngine).joints] == [True, False]
    assert O.bodies[high].state.vel.norm() < 1e-3


def test_the_support_of_a_body_at_rest():
    """No step of the fall is skipped."""
    plate()
    stand, block = cube(fixed=True), cube(0, 1.5 * SIDE)
    start(dt=1e-4, steps=40000, skip_rest=200)
    assert find_engine(yw.RestSkipper).skipped > 1
    O.bodies.erase(stand)
    O.run(1000, True)
    assert O.bodies[block].state.pos[2] == pytest.approx(1.5 * SIDE - 9.81 * 0.1**2 / 2, rel=1e-3)


# --- placed -----------------------------------------------------------------------------------------------------------


def refused(steps=1):
    with pytest.raises(RuntimeError, match="were placed with an overlap of 5"):
        for _ in range(steps):
            O.step()


@pytest.mark.parametrize("velocity", [(0, 0, 0), (1, 0, 0), (0, 0, -1), (0, 0, 1)])
@pytest.mark.parametrize("when", ["start", "appended", "posed", "posed near", "freed", "shaped", "group"])
@pytest.mark.parametrize("saved", [False, True])
def test_placed_deep(when, velocity, saved, tmp_path):
    """Whatever its velocity, and if the scene was saved before the next step."""
    plate()
    cube(3)
    deep = (0, 0, SIDE / 2 - 5e-3)
    if when == "appended":
        start(steps=20)
        block = O.bodies[cube(0, deep[2])]
    elif when in ("freed", "group"):
        block = O.bodies[cube(0, deep[2], fixed=when == "freed")]
        block.mask = 2 if when == "group" else 1
        start(steps=20, gravity=(0, 0, 0))
        block.mask, block.dynamic = 1, True
    elif when == "shaped":
        block = O.bodies[cube(0, SIDE / 2)]
        start(steps=20)
        block.shape = yt.box((SIDE, SIDE, SIDE + 1e-2), (0, 0, 0)).shape
    else:
        block = O.bodies[cube(0, {"start": deep[2], "posed": 1.0, "posed near": SIDE / 2 + 1e-3}[when])]
        start(steps=20 * (when != "start"))
        block.state.pos = deep
    yt.set_velocity(block, velocity)
    if saved:
        number = block.id
        reload(tmp_path)
        assert tuple(O.bodies[number].state.vel) == velocity
    refused()


@pytest.mark.parametrize("change", ["none", "saved", "engines", "other appended"])
def test_deep_in_motion(change, tmp_path):
    """A block that falls with 6 m/s is 3 mm deep in the plate after a step. Not refused, whatever is done before that
    step.
    """
    plate()
    height = SIDE / 2 + 1e-4
    block = cube(0, height)
    start(dt=5e-4, gravity=(0, 0, 0))
    yt.set_velocity(O.bodies[block], (0, 0, -6))
    O.bodies[block].state.pos = (0, 0, height + 6 * 10 * O.dt)
    O.run(11, True)
    assert not yt.contacts(0, block)
    if change == "saved":
        reload(tmp_path)
    elif change == "engines":
        O.engines = yt.engines(gravity=(0, 0, 0))
    elif change == "other appended":
        cube(3)
    O.step()
    points = yt.contacts(0, block)
    assert len(points) == 4 and points[0]["overlap"] > 1e-3
    O.run(100, True)
    assert O.bodies[block].state.vel[2] > -1e-3 and find_engine(yw.ContactForces).placed == 0


def test_contact_erased_by_hand():
    """It begins with the force of its overlap, as one of bodies that are placed."""
    plate()
    block = cube()
    start(steps=2000)
    height = O.bodies[block].state.pos[2]
    O.interactions.erase(0, block)
    O.run(500, True)
    assert O.bodies[block].state.pos[2] == pytest.approx(height, abs=1e-8)
