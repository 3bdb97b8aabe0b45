# SPDX-License-Identifier: GPL-2.0-or-later
"""Joint dashpots in a session: energy, contacts, broken springs, bodies that are erased, fixed and freed, saved scenes,
columns of the history.
"""
import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade_timber.scene.engines import find_engine

DT = 1e-4
CORNERS = [(x, y, 0.0) for x in (-0.05, 0.05) for y in (-0.05, 0.05)]


def column(ratio=0.05, strength=np.inf, **options):
    """A column that rocks on a plate to which it is joined: (column, joint)."""
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    post = O.bodies.append(yt.box((0.105, 0.105, 1.0), (0, 0, 0.5)))
    O.dt, O.engines = DT, yt.engines(**options)
    joint = yt.connect(plate, post, CORNERS, strength=strength, damping_ratio=ratio)
    yt.set_velocity(O.bodies[post], (0.3, 0.1, 0))
    return O.bodies[post], joint


def speed(body):
    return body.state.vel.norm() + body.state.angVel.norm()


def hexadecimal():
    states = [b.state for b in O.bodies if b]
    return [x.hex() for s in states for v in (s.pos, s.vel, s.angMom, [s.ori[k] for k in range(4)]) for x in v]


def dissipated():
    return yt.energy()["joint_dashpot"]


@pytest.mark.parametrize("sweeps", [50, 0])
def test_balance_of_a_rocking_column(sweeps):
    """Input is the kinetic energy at the start. Observed: below 1e-4 of it, from the impacts of the column's edges."""
    post, _ = column(0.3, sweeps=sweeps)
    O.dt = DT if sweeps else 1e-5  # explicit dashpots of contacts are unstable beyond
    O.run(round(0.2 / O.dt), True)
    terms = yt.energy()
    assert terms["joint_dashpot"] > 0.02 * terms["imposed_velocity"] > 0
    assert terms["joint_dashpot"] == find_engine(yw.ContactForces).jointDashpot
    assert abs(yt.energy_residual(terms)) < 1e-3 * terms["imposed_velocity"]


@pytest.mark.parametrize("ratio", [1e-4, 1e-2])
def test_a_weak_dashpot_between_strong_contacts(ratio):
    """Its impulse, far below the solver's tolerance, is that of the velocities that the contacts leave: it never
    returns energy, and dissipates as with a tolerance of 1e-9. Observed: 0.24 % more; 32 % less (ratio 1e-4) if changes
    below the threshold of the sweeps are dropped.
    """
    def dissipated_by(**options):
        O.reset()
        O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
        O.bodies.append(yt.box((0.3, 0.3, 0.3), (0, 0, 0.15)))
        O.bodies.append(yt.box((1, 1, 0.3), (0, 0, 0.45)))
        O.dt, O.engines = 5e-4, yt.engines(**options)
        yt.connect(1, 2, [(x, y, 0.3) for x in (-0.1, 0.1) for y in (-0.1, 0.1)], stiffness=(1e6, 3e5),
                   strength=np.inf, damping_ratio=ratio)
        yt.set_velocity(2, (0.5, 0.2, 0), (0.1, 0.3, 0.5))
        forces, sums = find_engine(yw.ContactForces), [0.0]
        for _ in range(1000):
            O.step()
            sums.append(forces.jointDashpot)
        return np.array(sums)

    sums, exact = dissipated_by(), dissipated_by(tolerance=1e-9)
    assert np.diff(sums).min() >= 0
    assert sums[-1] == pytest.approx(exact[-1], rel=0.005)


def test_without_contacts_the_column_swings_and_comes_to_rest():
    """A member that hangs in one joint: 5 % of critical damping of a mode of 5 /s or more leaves exp(-0.05 * 5 * 40) =
    5e-5 after 40 s.
    """
    post, joint = column(0.05)
    post.state.pos += (0, 0, 0.02)  # no contact; the springs pull it down and it swings about them
    joint.anchors2 = [(x, y, -0.52) for x, y, _ in CORNERS]
    O.bodies[0].state.pos -= (0, 0, 0.5)
    joint.anchors1 = [(x, y, 0.6) for x, y, _ in CORNERS]
    O.dt = 1e-3
    O.run(40000, True)
    assert not yt.contacts(0, 1) and speed(post) < 1e-3


def test_undamped_and_broken_joints_dissipate_nothing():
    column(0)
    O.run(300, True)
    assert dissipated() == 0
    _, joint = column(0.05)
    joint.broken = [1] * 4
    O.run(300, True)
    assert dissipated() == 0
    _, joint = column(0.05)
    find_engine(yw.JointEngine).dead = True
    O.run(300, True)
    assert dissipated() == 0


def test_springs_that_break():
    """Springs break one by one; the balance holds: observed 2e-4 of the energy at the start."""
    post, joint = column(0.3, strength=300.0)
    yt.set_velocity(post, (1.5, 0.3, 0.5))
    O.run(2000, True)
    terms = yt.energy()
    assert 0 < sum(joint.broken) and terms["broken_springs"] > 0 and dissipated() > 0
    assert abs(yt.energy_residual(terms)) < 2e-3 * terms["imposed_velocity"]


def test_erased_body():
    column()
    O.run(10, True)
    O.bodies.erase(1)
    before = dissipated()
    O.run(10, True)
    assert dissipated() == before


def test_fixed_and_freed_body():
    """With both bodies fixed the joint is idle; the freed body is damped as before, whatever was computed meanwhile."""
    post, _ = column()
    O.run(100, True)
    post.dynamic = False
    post.state.vel = post.state.angVel = (0, 0, 0)
    before = dissipated()
    O.run(50, True)
    assert dissipated() == before
    post.dynamic = True
    yt.set_velocity(post, (0.3, 0, 0))
    O.run(100, True)
    assert dissipated() > before and np.isfinite(speed(post))


def test_another_mass_gives_other_dashpots():
    """m, K and the ratio decide: the same relative velocity decays in a step by zeta omega h with the present mass."""
    for mass in (4.0, 1.0):
        post, _ = column(0.1, gravity=(0, 0, 0))
        O.run(3, True)
        post.state.mass = mass
        post.state.pos += (0, 0, 0.05)  # above the plate: no contact
        find_engine(yw.JointEngine).joints[0].anchors2 = [(x, y, -0.55) for x, y, _ in CORNERS]
        yt.set_velocity(post, (0, 0, 1))
        O.step()
        omega = np.sqrt(4 * 58800 / mass)
        change = -2 * 0.1 * omega * DT - omega**2 * 0  # the spring is unstretched in this step
        assert post.state.vel[2] - 1 == pytest.approx(change, rel=0.02)  # second order in zeta omega h = 5e-3


def test_saved_scene_continues_bit_for_bit(tmp_path):
    column()
    O.run(700, True)
    O.save(str(tmp_path / "scene.xml.gz"))
    O.run(700, True)
    expected = hexadecimal(), dissipated().hex()
    O.reset()
    O.load(str(tmp_path / "scene.xml.gz"))
    O.run(700, True)
    assert (hexadecimal(), dissipated().hex()) == expected


def test_history_has_the_energy_of_damped_joints():
    for ratio in (0.0, 0.05):
        monitor = yw.Sampler(bodies=[1], groups=[0])
        column(ratio, monitor=monitor)
        names = monitor.columns()
        O.run(200, True)
        last = dict(zip(names, monitor.rows[-len(names):]))["joint_dashpot [J]"]
        assert last == 0 if ratio == 0 else 0 < last <= dissipated()  # the last sample is up to 0.01 s old


def test_columns_stay_when_damping_changes():
    """Rows of one length: a joint that is damped later adds no column."""
    monitor = yw.Sampler(bodies=[1], groups=[0])
    _, joint = column(0.0, monitor=monitor)
    O.run(200, True)
    names = monitor.columns()
    joint.dampingRatio = 0.05
    O.run(200, True)
    assert monitor.columns() == names and len(monitor.rows) % len(names) == 0 and dissipated() > 0


def pulled(initial):
    """Power of the dashpot of a wall's spring while a heavy block stretches it by 0.1 m/s: [elastic, yielded, turned].
    [W]"""
    O.reset()
    base = O.bodies.append(yt.box((0.5, 0.5, 0.5), (0, 0, 0), fixed=True))
    block = O.bodies.append(yt.box((0.5, 0.5, 0.5), (0, 0, 1.0)))
    O.dt, O.engines = DT, yt.engines(gravity=(0, 0, 0))
    joint = yt.connect(base, block, [(0, 0, 0.5)], normal=(0, 0, 1), stiffness=(1e5, 0), strength=1000.0,
                       slip=yt.SlipLaw(softening_stretch=0.1, ultimate_stretch=0.2, friction_share=1.0))
    joint.dampingTime, joint.initialDamping = 0.01, initial
    O.bodies[block].state.mass = 1e7  # its speed stays
    powers = []
    for speed, skipped in ((0.1, 500), (0.1, 1000), (-0.1, 200)):  # stretches 0.005, 0.015, 0.013 m; yield at 0.01
        yt.set_velocity(O.bodies[block], (0, 0, speed))
        O.run(skipped, True)
        before = dissipated()
        O.run(100, True)
        powers.append((dissipated() - before) / (100 * DT))
    return powers


def test_dashpots_follow_the_tangent_stiffness():
    """tau k v^2 = 10 W while the spring is elastic, none while it flows; with the initial stiffness always. The power
    falls by 2e-4, as the spring slows the block."""
    assert pulled(initial=False) == pytest.approx([10, 0, 10], rel=1e-3, abs=1e-9)
    assert pulled(initial=True) == pytest.approx([10, 10, 10], rel=1e-3)
