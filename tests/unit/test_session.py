# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes to a scene during a session: bodies erased, added, released or moved, scenes saved and loaded, queries at any
time.
"""
from functools import partial

import column_sample
import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from compare import assert_close
from yade import O
from timber_houses.motion import GroundMotion
from yade_timber.scene.engines import find_engine, gravity_now


column_on_plate = partial(column_sample.column_on_plate, steps=2000)


def carried(plate, column):
    """Normal force between two bodies. [N]"""
    return sum(c["normal_force"] for c in yt.contacts(plate, column))


@pytest.mark.parametrize("number", [0, 1])
def test_a_body_of_a_joint_taken_out(number):
    pair = column_on_plate()
    O.bodies.erase(pair[number])
    assert yt.stable_dt() == np.inf and (number == 0 or yt.energy()["kinetic"] == 0)
    O.run(100, True)
    engine = find_engine(yt.JointEngine)
    joint = engine.joints[0]
    assert joint.isBroken and joint.load == 0 and all(spring["stretch"] == 0 for spring in joint.springs)
    assert yt.stable_dt() == np.inf and not engine.breaks


def test_joint_of_a_body_that_never_was():
    column_on_plate()
    alone = yt.stable_dt()
    find_engine(yt.JointEngine).append(
        yt.TimberJoint(id1=0, id2=77, anchors1=[(0, 0, 0)], anchors2=[(0, 0, 0)], kn=1, ks=1, strength=1))
    assert yt.stable_dt() == pytest.approx(alone, rel=1e-6)
    with pytest.raises(RuntimeError, match="joints.1.: id1 = 0, id2 = 77: they must be ids of two bodies"):
        O.step()


def test_snow_put_on_later():
    plate, column = column_on_plate(joined=False)
    O.bodies.append(yt.box((0.5, 0.5, 0.5), (0, 0, 1.25), material=yt.snow()))
    O.run(5000, True)
    weight = 9.81 * sum(O.bodies[k].state.mass for k in (column, column + 1))
    assert_close(carried(plate, column), weight, rtol=1e-2)  # the snow still oscillates on its springs


def test_fixed_body_released():
    O.reset()
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0.11), fixed=True))
    O.dt, O.engines = 1e-4, yt.engines()
    O.run(100, True)
    O.bodies[block].dynamic = True
    O.run(10000, True)
    assert_close(O.bodies[block].state.pos[2], 0.1, atol=1e-4)  # it fell 1 cm and lies on the plate


@pytest.mark.parametrize("steps", [10, 40])
def test_loaded_body_released(steps):
    """A fixed body under a heavy one, released before or after the update of its contacts' effective masses, stays at
    rest.
    """
    O.reset()
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.1, 0.1, 0.1), (0, 0, 0.05), fixed=True))
    O.bodies.append(yt.box((1, 1, 1), (0, 0, 0.6)))
    O.dt, O.engines = 4e-5, yt.engines()
    O.run(steps, True)
    O.bodies[block].dynamic = True
    for _ in range(200):
        O.step()
        # [m/s] its own contacts close by x = 63 micrometres: sqrt(g x) = 0.025; with the effective masses of the fixed
        # body 1.8
        assert max(b.state.vel.norm() for b in O.bodies) < 0.05


@pytest.mark.parametrize("fixed_first", [True, False])
def test_mass_of_a_pair_follows_its_bodies(fixed_first):
    """The equivalent mass (Eq. 43) of a body that is fixed or released later: 0.34 kg under 340 kg. Dashpots depend on
    it.
    """
    O.reset()
    light = O.bodies.append(yt.box((0.1, 0.1, 0.1), (0, 0, 0.05), fixed=fixed_first))
    heavy = O.bodies.append(yt.box((1, 1, 1), (0, 0, 0.6)))
    O.dt, O.engines = 1e-5, yt.engines(gravity=(0, 0, 0))
    O.bodies[heavy].state.pos -= (0, 0, 1e-6)
    masses = {True: 340.0, False: 0.34 * 340 / 340.34}
    for fixed in (fixed_first, not fixed_first):
        O.bodies[light].dynamic = not fixed
        O.run(2, True)
        assert O.interactions[light, heavy].phys.mass == pytest.approx(masses[fixed], rel=1e-9)


def test_fixed_bodies_move_with_their_velocities():
    """A table rotates by 1 rad in 1 s and carries a block; a body that is fixed stops, and does not spin when it is
    released.
    """
    O.reset()
    table = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.2, 0.2, 0.1), (0.3, 0, 0.05)))
    O.dt, O.engines = 2e-4, yt.engines()
    O.run(500, True)
    yt.set_velocity(O.bodies[table], (0, 0, 0), (0, 0, 1))
    O.run(5000, True)
    turned = O.bodies[table].state.ori.toAngleAxis()
    assert turned[0] == pytest.approx(1, abs=1e-6) and turned[1][2] == pytest.approx(1)
    x, y, _ = O.bodies[block].state.pos
    assert np.arctan2(y, x) == pytest.approx(1, abs=0.05)
    O.bodies[block].dynamic = False
    O.step()
    O.bodies[block].dynamic = True
    yt.set_velocity(O.bodies[table], (0, 0, 0))
    O.step()
    assert O.bodies[block].state.angVel.norm() < 1e-2


def test_numbers_that_would_end_the_process():
    for refused in (lambda: yw.HealthCheck(every=0), lambda: yw.RestSkipper(stride=0),
                    lambda: yw.RoundedPolyhedron().massProperties()):
        with pytest.raises((ValueError, RuntimeError)):
            refused()
    column_on_plate()
    O.engines = [*O.engines, yw.Sampler(bodies=[1, 1000000], groups=[0, 1], members=[1000000])]
    O.run(200, True)  # a body that is not there marks no level


def test_a_joint_that_was_changed_by_hand():
    """Anchors of unequal number are refused; springs broken by hand have no force."""
    column_on_plate()
    joint = find_engine(yt.JointEngine).joints[0]
    assert joint.load > 0
    joint.broken = [1] * 4
    assert joint.load == 0 and all(spring["stretch"] == 0 for spring in joint.springs)
    with pytest.raises(ValueError):
        joint.anchors1 = joint.anchors1[:1]
    assert len(joint.anchors1) == len(joint.anchors2) == 4
    O.run(10, True)
    assert joint.isBroken
    with pytest.raises(ValueError):
        find_engine(yt.JointEngine).append(yw.TimberJoint(id1=0, id2=1, anchors1=[(0, 0, 0)]))


def test_ids_that_are_none():
    """YADE would read beyond its list."""
    plate, column = column_on_plate()
    for ids in ((0, -1), (0, 99), ("a", 1), (1.5, 0)):
        with pytest.raises(ValueError, match="there is no body"):
            yt.contacts(*ids)
    O.bodies.erase(column)
    assert yt.contacts(plate, column) == []
    with pytest.raises(ValueError, match="taken out"):
        yt.connect(plate, column, [(0, 0, 0)])


def test_gravity_of_either_engine():
    """Also in the energies of a free fall."""
    column_on_plate()
    assert gravity_now()[2] == -9.81
    O.engines = [yw.GravityEngine(gravity=(0, 0, -5)) if isinstance(e, yw.UniformGravity) else e for e in O.engines]
    assert gravity_now()[2] == -5
    for own in (True, False):
        O.reset()
        O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
        chain = yt.engines(gravity=(0, 0, -3 if own else 0))
        O.dt, O.engines = 1e-3, chain if own else [*chain[:-2], yw.GravityEngine(gravity=(0, 0, -5)), *chain[-2:]]
        O.run(100, True)
        assert abs(yt.energy_residual()) < 1e-9 * yt.energy()["kinetic"]
    O.engines = yt.engines(gravity=(0, 0, 0))
    assert gravity_now().norm() == 0


def test_velocities_imposed_in_mid_run():
    """Under gravity and ground motion they are input, to rounding; twice; the scene keeps it when it is saved. Setting
    the attribute itself is not booked.
    """
    O.reset()
    body = O.bodies[O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))]
    O.dt, O.engines = 1e-3, yt.engines(ground_motion=GroundMotion(0.1, np.full((9, 3), 2.0)))
    for velocity in ((3, 2, 1), (0, 0, -4)):
        O.run(50, True)
        yt.set_velocity(body, velocity, (0, 2, 0))
    O.run(50, True)
    O.saveTmp()
    O.loadTmp()
    terms = yt.energy()
    assert abs(yt.energy_residual(terms)) < 1e-9 * terms["kinetic"] and terms["imposed_velocity"] > 1e3
    O.bodies[0].state.vel *= 2
    assert abs(yt.energy_residual()) > 0.1 * terms["kinetic"]


def test_refused_shapes_leave_others_alone():
    """NaN cannot be ordered: a shape with NaN must not be taken for another element's."""
    nan = float("nan")
    kept = yt.box((1, 2, 3), (0, 0, 0), radius=0.04)
    for place in ((nan, 0, 0), (nan, nan, nan)):
        with pytest.raises((ValueError, RuntimeError)):
            yt.box((1, 2, 3), place, radius=0.04)
    assert_close([yt.box(size, (0, 0, 0), radius=0.04).state.mass for size in ((1, 2, 3), (5, 5, 5))],
                 [340 * 6, 340 * 125], rtol=1e-12)
    assert_close(kept.state.mass, 340 * 6, rtol=1e-12)


def test_equal_elements_have_equal_numbers():
    """Elements share their geometry, also those of different houses of a street."""
    for size in ((0.105, 0.105, 2.73), (0.12, 0.12, 2.73), (0.105, 7.28, 0.12)):
        shapes = [yt.box(size, (12 * k + 0.91, 0.455, 1.785)).shape for k in range(10)]
        assert len({(shape.radius, *(x for v in shape.vertices for x in v)) for shape in shapes}) == 1


def test_engines_called_again_keep_the_joints():
    _, column = column_on_plate()
    O.engines = yt.engines(gravity=(0, 0, -5))
    assert len(find_engine(yt.JointEngine).joints) == 1


def test_body_moved_by_hand_finds_its_contacts():
    plate, column = column_on_plate(joined=False)
    other = O.bodies.append(yt.box((0.2, 0.2, 0.2), (10, 0, 5)))
    O.run(10, True)
    O.bodies[other].state.pos = O.bodies[other].state.pos.__class__(0.8, 0, 0.101)
    yt.set_velocity(O.bodies[other], (0, 0, 0))
    O.run(5000, True)
    assert O.bodies[other].state.vel.norm() < 1e-3  # [m/s] at rest on the plate
    assert_close(carried(plate, other), 9.81 * O.bodies[other].state.mass, rtol=1e-2)


def test_loaded_scene_answers_before_a_step(tmp_path):
    plate, column = column_on_plate()
    before = carried(plate, column), yt.stable_dt()
    O.save(str(tmp_path / "scene.yade"))
    O.load(str(tmp_path / "scene.yade"))
    assert_close((carried(plate, column), yt.stable_dt()), before, rtol=1e-12)  # rounding of another order of sums
    yt.energy()


def test_stable_dt_of_one_block_is_the_closed_form():
    """Horizontal motion and rocking of a column of length L on four springs at half-distance a, K_s across and K_n
    along.
    """
    plate, column = column_on_plate(joined=False)
    state, point = O.bodies[column].state, yt.contacts(plate, column)[0]
    kn = 1.5 * point["normal_force"] / point["overlap"]  # Hertz: K = 3/2 F / n
    ks = kn / 2.8  # nu = 0.4
    half, a, inertia = state.pos[2], abs(point["position"][0]), state.inertia[0]
    stiffness = 4 * np.array([[ks, ks * half], [ks * half, ks * half**2 + kn * a**2]])
    highest = max(np.linalg.eigvals(np.diag([1 / state.mass, 1 / inertia]) @ stiffness))
    assert_close(yt.stable_dt(1.0), 2 / np.sqrt(max(highest, 4 * kn / state.mass)),
                 rtol=1e-3)  # stop of the power iteration


def test_springs_along_the_normal_only():
    """ks = 0 on a fixed block: along the normal u = v / w sin(w t) with w = sqrt(k / m), across it uniform motion, in
    100 steps of w dt = 0.01.

    Leapfrog from rest of the spring has the phase (w dt / 2): 5e-3 of the amplitude; allowed 1e-2. Across it no force
    acts: rounding.
    """
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, 0), fixed=True), yt.box((1, 1, 1), (0, 0, 2))])
    O.engines = [yw.ForceResetter(), yw.JointEngine(), yw.SymplecticIntegrator()]
    state = O.bodies[1].state
    joint = yt.connect(0, 1, [tuple(state.pos)], (0, 0, 1), stiffness=(1e4 * state.mass, 0), strength=np.inf,
                       damping_ratio=0.0)
    state.vel, O.dt = (0.3, 0, 0.2), 1e-4
    O.run(100, True)
    assert_close(state.pos[0], 0.3 * O.time, rtol=1e-12)
    assert_close(state.pos[2] - 2, 0.2 / 100 * np.sin(100 * O.time), rtol=1e-2)
    assert joint.springs[0]["force"][0] == 0 and not joint.isBroken
    yt.connect(0, 1, [tuple(state.pos)], (0, 0, 1), stiffness=(1e5, 0), slip=yt.SlipLaw(0.2, 0.3))


@pytest.mark.parametrize("call, words", [
    (lambda: yt.box((1, 1, 1), (0, 0, 0), material=yt.TimberJoint()), "timber() or snow()"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), material=yw.ElementMat()), "timber() or snow()"),
    (lambda: yt.connect(0, 0, [(0, 0, 0)]), "itself"),
    (lambda: yt.connect(0, 7, [(0, 0, 0)]), "no body 7"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], slip={"friction_share": 0.3}), "a SlipLaw"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], slip=yt.SlipLaw(0.09, 0.3)), "> strength / kn with"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], slip=yt.SlipLaw(0.2, 0.2)), "> softeningStretch"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], slip=yt.SlipLaw(0.2, 0.3, 1.5)), "in [0, 1]"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], slip=yt.SlipLaw(0.2, np.nan)), "ultimate_stretch"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], strength=np.inf, slip=yt.SlipLaw(0.2, 0.3)), "softeningStretch"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], stiffness=(1e5, 2e5), slip=yt.SlipLaw(0.2, 0.3)), "equal to kn, or 0"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], stiffness=(1e5, np.inf)), "connect: stiffness"),
    (lambda: yt.TimberJoint(anchors1=[(0, 0, 0)], anchors2=[(0, 0, 0)], kn=1, ks=1), "strength"),
    (lambda: yt.TimberJoint(anchors1=[(0, 0, 0)], anchors2=[(0, 0, 0)], kn=1, ks=1, strength=1, broken=[0, 0]),
     "broken"),
])
def test_wrong_calls_say_what_is_wrong(call, words):
    column_on_plate()
    with pytest.raises((TypeError, ValueError, RuntimeError)) as refusal:
        call()
    assert words in str(refusal.value)


def test_partly_blocked_body_stops_the_run():
    _, column = column_on_plate()
    O.bodies[column].state.blockedDOFs = "x"
    with pytest.raises(RuntimeError, match="body 1.*degrees of freedom"):
        for _ in range(101):  # one period of the health check
            O.step()
