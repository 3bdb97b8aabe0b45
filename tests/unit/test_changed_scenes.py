# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that are changed between two steps: energies, joints, contacts and checks remain right."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade_timber.scene.engines import find_engine

SIDE = 0.2


def corners(z, x=0.0):
    return [(x + a, b, z) for a in (-0.1, 0.1) for b in (-0.1, 0.1)]


def cube(z, x=0.0, **more):
    return O.bodies.append(yt.box((SIDE, SIDE, SIDE), (x, 0, z), **more))


def plate():
    O.reset()
    return O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))


def start(dt=1e-4, steps=1, **options):
    O.dt, O.engines = dt, yt.engines(**options)
    O.run(steps, True)


# --- joints -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 1, 0)])
def test_a_changed_normal_of_a_stiff_joint(normal):
    """Its modes are computed again: with those of the first normal the bodies' velocities grow without limit."""
    O.reset()
    one, other = cube(0, fixed=True), cube(0, 0.5)
    points = [(0.25, y, z) for y in (-0.1, 0.1) for z in (-0.1, 0.1)]
    O.dt, O.engines = 2e-4, yt.engines(gravity=(0, 0, 0))
    joint = yt.connect(one, other, points, normal=(1, 0, 0), stiffness=(1.5e9, 1e4), strength=math.inf,
                       damping_ratio=0.02)
    O.run(1, True)
    joint.normal = normal
    yt.set_velocity(O.bodies[other], (0, 0.01, 0.1))
    before = yt.energy()["kinetic"]
    O.run(1000, True)
    assert yt.energy()["kinetic"] < before and abs(yt.energy_residual()) < 1e-4 * before  # 3e-5: the modes turn


@pytest.mark.parametrize("late", [False, True])
@pytest.mark.parametrize("stiffness", [1e7, 1.5e9])
def test_an_imposed_velocity_does_not_overload_a_stiff_joint(late, stiffness):
    """h omega = 0.8 and 9. late: the bodies move before they are joined."""
    O.reset()
    one, other = cube(0, fixed=True), cube(0.5)
    O.dt, O.engines = 2e-4, yt.engines(gravity=(0, 0, 0))

    def connected():
        return yt.connect(one, other, corners(0.25), normal=(0, 0, 1), stiffness=(stiffness, stiffness),
                          strength=math.inf)

    joint = None if late else connected()
    O.run(1, True)
    yt.set_velocity(O.bodies[other], (0, 0, 0.1))
    joint = joint or connected()
    omega = math.sqrt(4 * stiffness / O.bodies[other].state.mass)
    exact, largest = 0.1 * omega * O.bodies[other].state.mass, 0
    for _ in range(100):
        O.step()
        largest = max(largest, sum(spring["force"].norm() for spring in joint.springs))
    # The force is the mean of a step. A stiff joint takes up the velocity in its first one: m v / h times y / (4 + y),
    # y = (h omega)^2. It keeps the energy share 1 / (1 + y / 4); the mean force the amplitude m v omega / (1 + y / 4)
    phase = O.dt * omega
    expected = exact / (1 + phase**2 / 4) * max(1, phase / 4)
    assert 0.95 * expected < largest < 1.1 * exact


def test_a_joint_too_stiff_for_the_step_in_mid_run():
    """Added, or made stiffer: refused before a step is computed with it."""
    plate()
    low, high = cube(0.1), cube(0.3)
    O.dt, O.engines = 5e-4, yt.engines()
    first = yt.connect(low, high, corners(0.2))
    O.run(10, True)
    stiff = yt.connect(low, high, corners(0.2), stiffness=(1e13, 1e13), strength=math.inf)
    with pytest.raises(RuntimeError, match="O.dt = 0.0005 s: too large"):
        O.run(1, True)
    stiff.broken = [1, 1, 1, 1]
    O.run(10, True)
    first.kn = first.ks = 1e14
    with pytest.raises(RuntimeError, match="O.dt = 0.0005 s: too large"):
        O.run(1, True)


def test_an_error_of_the_first_step_is_never_lost():
    """YADE's O.run(n, True) drops the error of a loop that has ended before it looks: one in fifty to a hundred."""
    plate()
    cube(0.1)
    start(steps=5)
    for _ in range(200):
        O.dt = math.inf
        with pytest.raises(RuntimeError, match="must be finite"):
            O.run(1, True)


# --- energies ---------------------------------------------------------------------------------------------------------


def plate_that_moves():
    """A plate under a cube, which it accelerates by friction: its id."""
    ground = plate()
    cube(0.1 - 1e-5)
    start(steps=1000)
    yt.set_velocity(O.bodies[ground], (0.5, 0, 0))
    O.run(3000, True)
    return ground


def test_a_fixed_body_that_moves_does_work():
    plate_that_moves()
    terms = yt.energy()
    assert terms["imposed_velocity"] > 0.9 * (terms["friction"] + terms["kinetic"]) > 0.1
    assert abs(yt.energy_residual()) < 1e-9 * terms["imposed_velocity"]  # rounding


def test_a_fixed_body_that_is_stopped_keeps_its_work():
    """Each velocity that is set afterwards books its own energy only."""
    ground = plate_that_moves()
    work = yt.energy()["imposed_velocity"]
    for _ in range(2):
        yt.set_velocity(O.bodies[ground], (0, 0, 0))
        assert yt.energy()["imposed_velocity"] == pytest.approx(work, rel=1e-9)
    O.run(3000, True)
    assert abs(yt.energy_residual()) < 1e-9 * work


@pytest.mark.parametrize("ratio", [0, 0.05])
@pytest.mark.parametrize("dt, options", [(1e-4, {}), (1e-5, {"sweeps": 0})])
def test_work_through_joints(dt, options, ratio):
    """A column that is joined to a plate, which is shaken by a prescribed velocity."""
    ground = plate()
    column = O.bodies.append(yt.box((0.12, 0.12, 1), (0, 0, 0.5)))
    O.dt, O.engines = dt, yt.engines(**options)
    points = [(x, y, 0) for x in (-0.06, 0.06) for y in (-0.06, 0.06)]
    yt.connect(ground, column, points, strength=math.inf, damping_ratio=ratio)
    for _ in range(2000):
        O.bodies[ground].state.vel = (0.3 * math.sin(12 * O.time), 0, 0)
        O.step()
    work = yt.energy()["imposed_velocity"]
    assert work > 5e-3 and (yt.energy()["joint_dashpot"] > 0) == (ratio > 0)
    assert abs(yt.energy_residual()) < 1e-4 * work  # 4e-5: velocities change between the steps


def test_energies_of_engines_that_are_switched_off():
    plate()
    cube(0.1 - 1e-5)
    shaking = yw.GroundMotionEngine(step=0.01, acceleration=[(6 * math.sin(0.1 * k), 0, 0) for k in range(30)])
    start(steps=4000, ground_motion=shaking)
    work = yt.energy()["ground_motion"]
    shaking.dead = True
    O.run(10, True)
    assert work > 0.1 and yt.energy()["ground_motion"] == pytest.approx(work, rel=1e-9)
    assert abs(yt.energy_residual()) < 1e-9 * work  # rounding
    O.engines = O.engines + [yw.GroundMotionEngine(step=0.01, acceleration=[(0, 0, 0)] * 3)]
    assert yt.energy()["ground_motion"] == 0, "that of the engine that acts"


def test_a_changed_step_leaves_the_work_of_the_ground_motion():
    plate()
    cube(5)
    start(dt=5e-4, steps=1000, gravity=(0, 0, 0), ground_motion=yw.GroundMotionEngine(
        step=0.01, acceleration=[(6, 0, 0)] * 300))
    work = yt.energy()["ground_motion"]
    O.dt = 1e-5
    assert yt.energy()["ground_motion"] == work
    O.run(1, True)
    assert abs(yt.energy_residual()) < 1e-9 * work


@pytest.mark.parametrize("gravity, material", [(-9.81, None), (-900, "snow")])
def test_time_set_back(gravity, material):
    """`O.resetTime` makes no contact new."""
    plate()
    cube(0.1 - 1e-5 * (material is None), **({"material": yt.snow(density=900)} if material else {}))
    start(steps=3000, gravity=(0, 0, gravity))
    before = yt.energy_residual()
    O.resetTime()
    O.run(3, True)
    assert yt.energy_residual() == pytest.approx(before, abs=1e-9)  # of 2e-5 J in the contact, counted twice


# --- engines ----------------------------------------------------------------------------------------------------------


def test_a_fixed_body_that_rotates_is_not_at_rest():
    plate()
    cube(0.1 - 1e-6)
    table = O.bodies.append(yt.box((0.5, 0.5, 0.2), (5, 0, 0), fixed=True))
    O.dt, O.engines = 1e-4, yt.engines(skip_rest=200)
    yt.set_velocity(O.bodies[table], (0, 0, 0), (0, 0, 1))
    O.run(20000, True)
    assert find_engine(yw.RestSkipper).skipped == 0
    assert O.bodies[table].state.ori.toAxisAngle()[1] == pytest.approx(2, rel=1e-3)


@pytest.mark.parametrize("dt, interval", [(3e-4, 0.01), (3e-4, 1e-3), (1.7e-4, 0.01), (5e-4, 0.002)])
def test_samples_at_multiples_of_the_interval(dt, interval):
    plate()
    cube(0.1)
    monitor = yw.Sampler(interval=interval)
    start(dt=dt, steps=round(0.3 / dt) + 1, monitor=monitor)
    times = monitor.rows[:: len(monitor.columns())]
    assert all(abs(time - k * interval) <= dt / 2 * (1 + 1e-9) for k, time in enumerate(times))
    assert len(times) > 0.3 / interval - 1
