# SPDX-License-Identifier: GPL-2.0-or-later
"""Natural modes, storey shears, pull and uplift against closed forms. Contact-free scenes unless stated."""
import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from scipy import linalg
from timber_houses.motion import GroundMotion
from timber_houses.recording.record import Motion
from timber_houses.recording.quantities import storeys
from timber_houses.recording.history import Samples
from timber_houses.scene import modes, scenario
from timber_houses.scene.modes import SLOWEST, natural_modes

O = yw.Omega()
KN, KS = 58800.0, 40000.0
"""Stiffness of each spring. [N/m]"""
SIDE, HEIGHT, SPAN, SLAB = 0.12, 2.7, 6.0, 0.3
"""Side and height of the columns, distance between them, thickness of the slab. [m]"""
G = 9.81


def corners(x, y, z):
    """Spring points at the corners of a column's end. [m]"""
    return [(x + sx * SIDE / 2, y + sy * SIDE / 2, z) for sx in (-1, 1) for sy in (-1, 1)]


def frame(stiffness=(KN, KS), density=0.01):
    """A slab on four columns on a fixed base, joined by springs alone. density: of the columns [kg/m3]"""
    O.reset()
    base = O.bodies.append(yt.box((SPAN + 1, SPAN + 1, 0.2), (0, 0, -0.1), fixed=True))
    slab = O.bodies.append(yt.box((SPAN + 1, SPAN + 1, SLAB), (0, 0, HEIGHT + SLAB / 2)))
    O.engines, O.dt = yt.engines(gravity=(0, 0, 0)), 1e-4
    for x in (-SPAN / 2, SPAN / 2):
        for y in (-SPAN / 2, SPAN / 2):
            column = O.bodies.append(yt.box((SIDE, SIDE, HEIGHT), (x, y, HEIGHT / 2), None, yt.timber(density=density)))
            yt.connect(base, column, corners(x, y, 0), (0, 0, 1), stiffness, 1e9)
            yt.connect(column, slab, corners(x, y, HEIGHT), (0, 0, 1), stiffness, 1e9)
    return slab


def test_period_of_a_one_mass_frame():
    """Each column is a rigid bar with a rotation spring kn a^2 at both ends and two shear springs 4 ks in series: 1 / k
    = h^2 / (2 kn a^2) + 1 / (2 ks).

    The slab's rocking on the columns' axial springs changes omega^2 by some 1e-4; the columns have 1e-6 of the mass.
    """
    slab = frame()
    mass, stiffness = O.bodies[slab].state.mass, 4 / (HEIGHT**2 / (2 * KN * SIDE**2) + 1 / (2 * KS))
    sway = [mode for mode in natural_modes() if max(mode.mass[:2]) > 0.5 * mass][:2]
    assert [mode.period for mode in sway] == pytest.approx([2 * np.pi * np.sqrt(mass / stiffness)] * 2, rel=5e-4)
    assert sum(mode.mass for mode in natural_modes(0.0))[:2] == pytest.approx(
        [mass, mass], rel=1e-3
    )  # of all modes: the whole mass


def test_free_motions_are_no_modes():
    """A heavy block in the air, and one on a single spring point, about which it turns freely.

    The frame's modes are those without them, but for the shares of the mass; the second block vibrates on its point.
    """
    frame()
    expected = [mode.period for mode in natural_modes(0.0)]
    O.bodies.append(yt.box((1, 1, 1), (20, 0, 5)))
    hung = O.bodies.append(yt.box((1, 1, 1), (0, 20, 5)))
    yt.connect(0, hung, [(0, 20, 5.5)], (0, 0, 1), (KN, KN), 1e9)
    periods = [mode.period for mode in natural_modes(0.0)]
    assert max(periods) < SLOWEST and min(period for period in periods if period > 0) > 0
    of_frame = [period for period in periods if min(abs(period / own - 1) for own in expected) < 1e-6]
    assert of_frame == pytest.approx(expected, rel=1e-6) and len(periods) == len(expected) + 3


def test_modes_are_those_of_a_dense_solver(monkeypatch):
    """Of house C at rest under its weight, with contacts: all that the search finds. Observed: 2e-12."""
    scenario.build(scenario.Scenario("C", "C", duration=0.1))
    O.run(200, True)
    found = [mode.omega2 for mode in natural_modes(0.0)]
    monkeypatch.setattr(modes, "_vibrations", lambda K, M: linalg.eigh(K.toarray(), M.toarray()))
    dense = [mode.omega2 for mode in natural_modes(0.0)]
    assert len(found) >= modes.SEARCHED and found == pytest.approx(dense[:len(found)], rel=1e-9)


def test_equal_modes_have_one_set_of_shapes():
    """The two sways of a square frame are along the axes and the same in every call; ARPACK alone gives others in each.
    """
    frame()
    one, other = ([(mode.omega2, mode.shape.tolist()) for mode in natural_modes()] for _ in range(2))
    assert one == other
    one = natural_modes()
    assert one[0].omega2 == one[1].omega2
    assert np.array([mode.mass[:2] / max(mode.mass) for mode in one[:2]]) == pytest.approx(np.eye(2), abs=1e-9)


def pendulum(mass_density):
    """A tall block on four springs at its foot, compressed by its weight; forces are those of this state. Returns
    (block's body, height of its centre).
    """
    O.reset()
    base = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.3, 0.3, HEIGHT), (0, 0, HEIGHT / 2), None, yt.timber(density=mass_density)))
    O.engines, O.dt = [yw.ForceResetter(), yw.JointEngine()], 1e-4
    yt.connect(base, block, corners(0, 0, 0), (0, 0, 1), (KN, KS), 1e9)
    body = O.bodies[block]
    body.state.pos -= type(body.state.pos)(0, 0, body.state.mass * G / (4 * KN))
    O.step()
    return body, body.state.pos[2]


@pytest.mark.parametrize("density", [20.0, 340.0])
def test_weight_softens_and_overturns(density):
    """Sway u and rotation phi of the block's centre at height h: K = [[4 ks, -4 ks h], [-4 ks h, 4 ks h^2 + kn a^2 - W
    h]], here solved by hand.

    The heavier block overturns: W h > kn a^2. Tolerance: its omega^2 is a small difference, in which errors of 1e-4
    count tenfold.
    """
    body, h = pendulum(density)
    m, inertia = body.state.mass, body.state.inertia[0]
    shear, turn = 4 * KS, KN * SIDE**2 - m * G * h
    a, b, c = m * inertia, -(m * (shear * h**2 + turn) + inertia * shear), shear * turn
    expected = (-b - np.sqrt(b**2 - 4 * a * c)) / (2 * a)
    first = natural_modes()[0]
    assert first.omega2 == pytest.approx(expected, rel=2e-3)
    assert (first.period == np.inf) == (density > 100) == (expected < 0)


def test_shear_is_the_force_of_the_columns():
    """Shear from momenta = minus the forces of contacts and joints in the cut, in every step of a shaken frame with
    contacts.

    The acceleration of the ground is constant, so that its mean over a step is its value; the remaining difference is
    rounding.
    """
    O.reset()
    base = O.bodies.append(yt.box((3, 3, 0.2), (0, 0, -0.1), fixed=True))
    columns = [O.bodies.append(yt.box((SIDE, SIDE, 1.0), (x, y, 0.5))) for x in (-1, 1) for y in (-1, 1)]
    slab = O.bodies.append(yt.box((2.5, 2.5, 0.1), (0, 0, 1.05)))
    motion = GroundMotion(0.01, np.tile([1.5, -0.7, 0.3], (100, 1)))
    monitor = yw.Sampler(bodies=[*columns, slab], groups=[1] * 4 + [2], interval=0.0)
    O.engines, O.dt = yt.engines(ground_motion=motion, monitor=monitor), 1e-4
    joints = [(yt.connect(a, b, corners(O.bodies[c].state.pos[0], O.bodies[c].state.pos[1], z), (0, 0, 1)), a == base)
              for c in columns for a, b, z in ((base, c, 0), (c, slab, 1.0))]
    forces = []
    for _ in range(400):
        O.step()
        forces.append([cut_force(base, columns, slab, joints, at_base) for at_base in (True, False)])
    masses = [0, sum(O.bodies[c].state.mass for c in columns), O.bodies[slab].state.mass]
    table = storeys(
        Samples(monitor.columns(), monitor.rows).momenta(slice(None)), masses,
        Motion(0.01, 0.0, np.array(motion.acceleration), np.zeros((100, 3))))
    for k, names in enumerate((("base_shear_ew", "base_shear_ns"), ("shear_ew1", "shear_ns1"))):
        found = -np.array([table.column(name) for name in names]).T
        scale = np.abs(found).max()
        assert scale > 20 and np.abs(found - np.array(forces)[1:, k]).max() < 1e-6 * scale


def cut_force(base, columns, slab, joints, at_base):
    """(2,) horizontal force on what lies above the columns' feet, or above their heads. [N]"""
    total = np.zeros(3)
    for column in columns:
        for point in yt.contacts(base, column) if at_base else yt.contacts(column, slab):
            total += point["normal_force"] * np.array(point["normal"]) + np.array(point["shear_force"])
    total -= sum(np.array(f) for joint, foot in joints if foot == at_base
                 for f in joint.forces)  # forces on body 1, below
    return total[:2]


def test_uplift_and_pull_under_a_static_push():
    """A column on a base, pushed by gravity aslant, rocks onto an edge and is held by the springs of its foot.

    Moments about the edge, d from the springs: m gx h - m g b = theta (sum k d^2 - m g h - m gx b). The contact point
    lies the rounding radius (10 % of the side) within the face. Opening and pull follow from theta; the small rotation
    (0.02) leaves errors below 1 %.
    """
    push, b, h = 2.0, 0.4 * SIDE, HEIGHT / 2
    O.reset()
    hard = yt.timber(young=1e14)  # without indentation
    base = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), None, hard, fixed=True))
    column = O.bodies.append(yt.box((SIDE, SIDE, HEIGHT), (0, 0, HEIGHT / 2), None, hard))
    monitor = yw.Sampler(jointInterval=0.0)
    O.engines, O.dt = yt.engines(gravity=(push, 0, -G), monitor=monitor), 1e-4
    yt.connect(base, column, corners(0, 0, 0), (0, 0, 1), (KN, KN), 1e9, damping_ratio=0.7)
    O.run(60000, True)
    mass = O.bodies[column].state.mass
    assert np.linalg.norm(O.bodies[column].state.vel) < 1e-6  # at rest
    monitor.opening = monitor.pull = [0.0]
    O.step()
    arms = np.repeat([b - SIDE / 2, b + SIDE / 2], 2)
    theta = mass * (push * h - G * b) / (KN * (arms**2).sum() - mass * (G * h + push * b))
    assert monitor.opening[0] == pytest.approx(theta * b, rel=0.01)
    assert monitor.pull[0] == pytest.approx(KN * theta * arms.sum(), rel=0.01)


def test_joint_peaks_are_kept():
    """Peaks stay when the load goes: tension and shear of a joint, and its load over the strength."""
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, 0), fixed=True), yt.box((1, 1, 1), (0, 0, 1.5))])
    monitor = yw.Sampler(jointInterval=0.0)
    O.engines, O.dt = yt.engines(gravity=(0, 0, 0), monitor=monitor), 1e-6
    yt.connect(0, 1, [(0, 0, 1)] * 4, (0, 0, 1), (KN, KS), 1e4)
    state = O.bodies[1].state
    for shift in ((0, 0, 0.01), (0.02, 0, -0.005), (0, 0, 0)):
        state.pos = type(state.pos)(shift[0], shift[1], 1.5 + shift[2])
        yt.set_velocity(O.bodies[1], (0, 0, 0))
        O.step()
    assert [monitor.pull[0], monitor.shear[0], monitor.opening[0]] == pytest.approx(
        [4 * KN * 0.01, 4 * KS * 0.02, 0.01], rel=1e-3)
    assert monitor.load[0] == pytest.approx(np.hypot(KS * 0.02, KN * 0.005) / 1e4, rel=1e-3)
