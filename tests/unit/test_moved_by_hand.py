# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies in contact or joined that are given another pose: springs follow, deep overlaps are refused."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade.minieigenHP import Quaternion, Vector3

SIDE = 0.2
CORNERS = [(x, y) for x in (-0.05, 0.05) for y in (-0.05, 0.05)]


def cube(z, x=0.0, **more):
    return O.bodies.append(yt.box((SIDE, SIDE, SIDE), (x, 0, z), **more))


def start(**options):
    O.dt, O.engines = 5e-4, yt.engines(**options)


def cube_at_rest():
    O.reset()
    plate = O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
    body = cube(SIDE / 2)
    start()
    O.run(500, True)
    return plate, body


def height(body):
    """Of the lower face above the plate [m]."""
    return O.bodies[body].state.pos[2] - SIDE / 2


def test_a_body_pushed_into_another_one_by_a_small_way_comes_back():
    """The springs have the energy of the way; the work of the hand against the weight is in no account."""
    _, body = cube_at_rest()
    rest, before, way = height(body), yt.energy_residual(), 1e-4
    O.bodies[body].state.pos -= Vector3(0, 0, way)
    O.run(2000, True)
    work = O.bodies[body].state.mass * 9.81 * way
    assert height(body) == pytest.approx(rest, abs=1e-6)
    assert yt.energy_residual() - before == pytest.approx(-work, rel=1e-2)


@pytest.mark.parametrize("moved", [0, 1])
@pytest.mark.parametrize("way", [2e-3, 5e-2])
def test_a_body_put_into_another_one_is_refused(moved, way):
    bodies = cube_at_rest()
    O.bodies[bodies[moved]].state.pos += Vector3(0, 0, way if moved == 0 else -way)
    with pytest.raises(RuntimeError, match="bodies 0 and 1 were placed with an overlap of"):
        O.run(10, True)


def test_a_body_turned_into_another_one_is_refused():
    _, body = cube_at_rest()
    O.bodies[body].state.ori = Quaternion(Vector3.UnitX, 0.1)
    with pytest.raises(RuntimeError, match="placed with an overlap"):
        O.run(10, True)


def test_a_piston_moved_by_hand_pushes():
    """By 2 mm in steps of 1e-6 m. The cube keeps its friction on the plate, which is less than the springs bear."""
    _, body = cube_at_rest()
    piston = cube(SIDE / 2 + 0.01, -SIDE, fixed=True)
    O.run(10, True)
    for _ in range(2000):
        O.bodies[piston].state.pos += Vector3(1e-6, 0, 0)
        O.step()
    assert 1.8e-3 < O.bodies[body].state.pos[0] < 2.3e-3  # the last push goes on for a while


@pytest.mark.parametrize("place", ["ContactLoop", "ContactForces"])
def test_a_floor_raised_by_an_engine_lifts_what_stands_on_it(place):
    """By 40 mm in steps of 0.1 mm, before one of the engines of a step."""
    plate, body = cube_at_rest()
    chain = list(O.engines)
    names = [type(engine).__name__ for engine in chain]
    chain.insert(names.index(place), yw.StepDisplacer(ids=[plate], mov=(0, 0, 1e-4)))
    O.engines = chain
    O.run(400, True)
    assert height(body) > 0.04 - 1e-3
    assert height(body) < 0.04 + 0.2 * 0.2  # thrown up by 0.2 m/s for 0.2 s at most


def hanging(k, **options):
    """A cube under a fixed one, on four springs of k [N/m]."""
    O.reset()
    top, body = cube(1, fixed=True), cube(1 - 1.05 * SIDE)
    start(**options)
    joint = yt.connect(top, body, [(x, y, 0.895) for x, y in CORNERS], stiffness=(k, k), strength=math.inf,
                       damping_ratio=0.05)
    return top, body, joint


@pytest.mark.parametrize("k, steps", [(1e5, 1000), (1e7, 1000), (1e5, 1), (1e7, 1), (1e9, 1)])
def test_a_joint_follows_a_support_moved_by_hand(k, steps):
    """Springs of 1e4 N/m hold the cube from below: both joints carry the same force."""
    top, body, joint = hanging(k, gravity=(0, 0, 0))
    way = 1e-3
    low = cube(1 - 2.1 * SIDE, fixed=True)
    soft = yt.connect(body, low, [(x, y, 0.685) for x, y in CORNERS], stiffness=(1e4, 1e4), strength=math.inf,
                      damping_ratio=0.05)
    O.run(10, True)
    before = O.bodies[body].state.pos[2]
    for _ in range(steps):
        O.bodies[top].state.pos += Vector3(0, 0, way / steps)
        O.step()
    O.run(8000, True)
    assert O.bodies[body].state.pos[2] - before == pytest.approx(way * k / (k + 1e4), rel=1e-3)
    forces = [sum(spring["force"][2] for spring in one.springs) for one in (joint, soft)]
    assert forces[0] == pytest.approx(forces[1], rel=1e-3)


@pytest.mark.parametrize("k", [1e5, 1e7])
def test_a_joint_made_stiffer_under_load(k):
    _, body, joint = hanging(k)
    O.run(4000, True)
    joint.kn, joint.ks = 10 * k, 10 * k
    O.run(8000, True)
    weight = O.bodies[body].state.mass * 9.81
    assert 1 - 1.05 * SIDE - O.bodies[body].state.pos[2] == pytest.approx(weight / (40 * k), rel=1e-2)
    assert sum(spring["force"][2] for spring in joint.springs) == pytest.approx(-weight, rel=1e-2)


@pytest.mark.parametrize("k, ratio", [(1e8, 0), (1e7, 0), (1e8, 0.05), (1e6, 0.05)])
@pytest.mark.parametrize("fixed", [True, False])
def test_a_body_that_slides_along_its_springs_keeps_its_energy(k, ratio, fixed):
    """By 1 m, on springs that act along the normal alone."""
    O.reset()
    rail, body = cube(0, fixed=fixed), cube(0.21)
    start(gravity=(0, 0, 0))
    yt.connect(rail, body, [(x, y, 0.105) for x, y in CORNERS], normal=(0, 0, 1), stiffness=(k, 0), strength=math.inf,
               damping_ratio=ratio)
    yt.set_velocity(O.bodies[body], (0.5, 0, 0))
    before = yt.energy()["kinetic"]
    O.run(4000, True)
    now = yt.energy()
    assert now["kinetic"] + now["elastic_joints"] == pytest.approx(before, rel=1e-3 if ratio else 1e-9)
    assert abs(yt.energy_residual()) < 1e-9 * before


@pytest.mark.parametrize("k, ratio", [(1e5, 0.3), (1e9, 0.02)])
def test_the_fixed_body_of_a_joint_is_freed_and_the_free_one_fixed(k, ratio):
    """As in a scene that begins so."""

    def energies(before):
        O.reset()
        ids = [O.bodies.append(yt.box((0.25, 0.5, 0.25), (x, 0, 0), fixed=x == 0)) for x in (0, 0.25)]
        O.bodies[ids[1]].mask = 2  # the bodies touch
        O.dt, O.engines = 2e-4, yt.engines(gravity=(0, 0, 0))
        yt.connect(*ids, [(0.125, y, z) for y in (-0.125, 0.125) for z in (-0.125, 0.125)], stiffness=(k, k),
                   strength=math.inf, damping_ratio=ratio)
        for _ in range(before):
            O.step()
        for body, blocked in zip(ids, ("", "xyzXYZ")):
            O.bodies[body].state.blockedDOFs = blocked
        yt.set_velocity(O.bodies[ids[0]], (0.1, 0.2, 0), (0, 0, 0.5))
        found = []
        for _ in range(20):
            O.run(5, True)
            now = yt.energy()
            found.append(now["kinetic"] + now["elastic_joints"])
        return found

    assert energies(20) == pytest.approx(energies(0), rel=1e-9)
