# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 4: joints of four springs: frequencies, failure, energy. Without contact and gravity.

Stretch of a spring: u = end on body 2 - end on body 1; force on body 1: kn u_n + ks u_s. With values per joint, each of
the n springs has 1/n of the stiffness.
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from cases import DENSITY, O, spin, steps
from rows import Registry, Row, series, worst
from scipy.linalg import eigh
from yade.minieigenHP import Vector3

case = Registry()
STIFFNESS, STRENGTH = 58800.0, 5880.0
"""Column-beam joint: K_pn = K_ps [N/m] and P_max [N] (paper, section 3.2)."""
STRETCH = STRENGTH / STIFFNESS
"""Stretch of a spring at failure. [m]"""
BEAM, COLUMN, SPACE = np.array((1.0, 0.2, 0.15)), np.array((0.12, 0.15, 0.9)), 0.05
"""Extents of the two bodies, and gap between the beam and the column above it. [m]"""
CORNERS = np.array([(x, y, 0.0) for x in (-0.06, 0.06) for y in (-0.075, 0.075)])
"""Positions of the springs relative to the centre of the joint. [m]"""
STIFFNESS_SHARE = {"spring": 1.0, "joint": 1 / len(CORNERS)}
"""Share of the stiffness in each spring, for values per spring and per joint. [-]"""


def joined(dt, stiffness=(STIFFNESS, STIFFNESS), strength=STRENGTH, per="spring", points=CORNERS, density=DENSITY,
           fixed=False, slip=None):
    """A column above a beam, and the joint between them."""
    beam = yt.box(BEAM, (0, 0, -(BEAM[2] + SPACE) / 2), fixed=fixed)
    column = yt.box(COLUMN, (0, 0, (COLUMN[2] + SPACE) / 2), None, yt.timber(density=density))
    O.reset()
    O.bodies.append([beam, column])
    O.dt, O.engines = dt, [yw.ForceResetter(), yw.JointEngine(), yw.SymplecticIntegrator()]
    return beam, column, yt.connect(0, 1, points, (0, 0, 1), stiffness, strength, per, slip=slip)


def cross_matrix(p):
    return np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]])


def linear_modes(stiffness, share):
    """Angular frequencies [rad/s] and modes of the two free bodies, coordinates (u, phi) of the beam and (u, phi) of
    the column:
    M x'' = -K x.
    """
    mass, rigidity = np.zeros((12, 12)), np.zeros((12, 12))
    centres = np.array([(0, 0, -(BEAM[2] + SPACE) / 2), (0, 0, (COLUMN[2] + SPACE) / 2)])
    for k, edges in enumerate((BEAM, COLUMN)):
        m = DENSITY * edges.prod()
        mass[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] = np.diag(np.r_[m, m, m, m * ((edges**2).sum() - edges**2) / 12])
    spring = share * np.diag((stiffness[1], stiffness[1], stiffness[0]))
    for p in CORNERS:
        stretch = np.hstack([-np.eye(3), cross_matrix(p - centres[0]), np.eye(3), -cross_matrix(p - centres[1])])
        rigidity += stretch.T @ spring @ stretch
    squares, modes = eigh(rigidity, mass)
    return np.sqrt(squares[6:]), modes[:, 6:], mass


def mode_frequency(mode, mass, guess, dt, **options):
    """Angular frequency of a mode from the zero crossings of its modal velocity over five periods. [rad/s]"""
    beam, column, _ = joined(dt, **options)
    mode = 1e-4 * mode  # amplitude about 1e-6 m: linear rotations
    for body, part in ((beam, mode[:6]), (column, mode[6:])):
        body.state.vel = Vector3(*part[:3])
        spin(body, part[3:])
    weights = mass @ mode

    def probe():
        return weights @ np.concatenate([np.array(v) for b in (beam, column) for v in (b.state.vel, b.state.angVel)])

    speed = steps(int(5.5 * 2 * np.pi / guess / dt), probe)
    before = np.flatnonzero(speed[1:] * speed[:-1] < 0)
    crossings = before + speed[before] / (speed[before] - speed[before + 1])
    return np.pi * (len(crossings) - 1) / ((crossings[-1] - crossings[0]) * dt)


@case
def frequencies():
    """All six modes (shear with rocking in two directions, torsion, axial; 22 to 500 rad/s) with values per spring and
    per joint, and with unequal stiffnesses.

    Leapfrog increases a frequency by (w dt)^2 / 24: by 1.04e-4 at 1e-4 s and 500 rad/s, as observed.
    """
    dt, rows = 1e-4, []
    for per, ks in (("spring", 1.0), ("joint", 1.0), ("spring", 0.5)):
        stiffness = (STIFFNESS, ks * STIFFNESS)
        rates, modes, mass = linear_modes(stiffness, STIFFNESS_SHARE[per])
        pairs = [(w, mode_frequency(modes[:, k], mass, w, dt, stiffness=stiffness, per=per))
                 for k, w in enumerate(rates)]
        rows.append(worst("4", f"joint, per {per}, ks = {ks:g} kn: worst of 6 modes [rad/s]", pairs, 1.2e-4, dt=dt,
                          note="leapfrog, (w dt)^2 / 24"))
    return rows


@case
def highest_frequency_converges():
    """Second order, (w dt)^2 / 24."""
    rates, modes, mass = linear_modes((STIFFNESS, STIFFNESS), 1.0)
    dts = (4e-4, 2e-4, 1e-4)
    got = [mode_frequency(modes[:, -1], mass, rates[-1], dt) for dt in dts]
    return series("4", "joint, highest mode [rad/s]", rates[-1], got, dts, 1.2e-4, 1.9, note="leapfrog, (w dt)^2 / 24")


def decay(dt, mode, mass, rate, ratio):
    """Damping ratio of a mode from its logarithmic decrement over about ten periods; rate: angular frequency [rad/s].
    Free bodies.
    """
    damped = rate * np.sqrt(1 - ratio**2)
    periods = 10 if ratio < 0.1 else 2
    beam, column, _ = joined(dt)
    O.engines = yt.engines(gravity=(0, 0, 0), joints=list(O.engines[1].joints))
    O.engines[-3].joints[0].dampingRatio = ratio
    mode = 1e-4 * mode
    for body, part in ((beam, mode[:6]), (column, mode[6:])):
        body.state.vel = Vector3(*part[:3])
        spin(body, part[3:])

    def probe():
        velocity = np.hstack([np.hstack([b.state.vel, b.state.angVel]) for b in (beam, column)])
        return [O.time - dt / 2, velocity @ mass @ mode]

    times, values = steps(round((periods + 1) * 2 * np.pi / damped / dt), probe).T
    # the modal velocity of a damped mode that starts at its equilibrium; phase and amplitude by least squares
    basis = np.exp(-ratio * rate * times)[:, None] * np.column_stack([np.cos(damped * times), np.sin(damped * times)])
    early, late = (np.hypot(*np.linalg.lstsq(basis[part], values[part], rcond=None)[0])
                   for part in np.array_split(np.arange(len(times)), 2))
    return ratio - np.log(late / early) / (rate * (times[len(times) // 2:].mean() - times[: len(times) // 2].mean()))


@case
def damping_ratio_of_each_mode():
    """A column on a beam, both free: all six vibration modes decay with the damping ratio of the joint.

    The step multiplies a mode by sqrt((1 - x) / (1 + x)), x = zeta w dt, in place of exp(-x): an error of x^2 / 3. The
    frequency's error of (w dt)^2 / 24, as a phase that the decrement is free of to first order.
    """
    dt, rows = 1e-4, []
    rates, modes, mass = linear_modes((STIFFNESS, STIFFNESS), 1.0)
    for ratio in (0.02, 0.05, 0.3):
        pairs = [(ratio, decay(dt, modes[:, k], mass, w, ratio)) for k, w in enumerate(rates)]
        rows.append(worst("4", f"joint with a damping ratio of {ratio:g}: worst of 6 modes [-]", pairs, 2e-3, dt=dt,
                          note="leapfrog and trapezoidal dashpot"))
    return rows


HEAVY = 1e12
"""Density of a column whose velocity the springs do not change. [kg/m3]"""
PULLS = {"tension": (0, 0, 1), "compression": (0, 0, -1), "shear": (0.6, 0.8, 0)}


def break_joint(cause, per, dt=1e-4, speed=0.1):
    """The column moves away from the fixed beam at `speed` [m/s] until the joint breaks: (stretch [m], force of the
    joint [N], energy released [J], causes).
    """
    _, column, joint = joined(dt, per=per, density=HEAVY, fixed=True)
    start, column.state.vel = column.state.pos, speed * Vector3(*PULLS[cause])
    while not joint.isBroken:
        stretch = (column.state.pos - start).norm()
        O.step()
    engine = O.engines[1]
    return stretch, sum(b.force for b in engine.breaks), engine.released, [b.cause for b in engine.breaks]


@case
def breaks_at_the_strength():
    """Tension, compression and shear to P_max. With values per spring each of the four breaks at P_max and 10 cm and
    releases P_max^2 / 2K; with values per joint their sum does.

    A spring breaks in the first step in which its force exceeds P_max: the stretch is too large by at most one step
    (1e-5 m of 0.1 m), the relative error of the energy is twice as large.
    """
    rows = []
    for per, count in (("spring", 4), ("joint", 1)):
        for cause in PULLS:
            stretch, force, released, causes = break_joint(cause, per)
            assert causes == [cause] * 4, causes
            name = f"{cause} to failure, per {per}"
            rows.append(Row("4", f"{name}: stretch [m]", STRETCH, stretch, bound=1.01e-4, dt=1e-4,
                            note="displacement in one step"))
            rows.append(Row("4", f"{name}: force of the joint [N]", count * STRENGTH, force, bound=1.01e-4, dt=1e-4,
                            note="displacement in one step"))
            rows.append(Row("4", f"{name}: energy released [J]", count * STRENGTH**2 / (2 * STIFFNESS), released,
                            bound=2.03e-4, dt=1e-4, note="displacement in one step"))
    return rows


@case
def broken_joints_stay_broken():
    """After the break the column moves back through the joint to the other side: no force, no energy, no second break.
    """
    _, column, joint = joined(1e-3, density=HEAVY, fixed=True)
    column.state.vel = Vector3(0, 0, 0.1)
    while not joint.isBroken:
        O.step()
    column.state.vel = Vector3(0, 0, -0.1)
    engine = O.engines[1]
    values = steps(4000, lambda: (O.forces.f(1).norm(), O.forces.t(1).norm(), engine.elastic, len(engine.breaks)))
    assert column.state.pos[2] < 0.3, "the column has not passed the joint"
    rows = [Row("4", f"broken joint: largest {what}", 0.0, value, bound=0.0, dt=1e-3, note="exact") for what,
            value in zip(("force [N]", "torque [N m]", "energy [J]"), values.max(0))]
    return rows + [Row("4", "broken joint: breaks in the log [-]", 4, values[-1, 3], bound=0.0, dt=1e-3, note="exact")]


OFF_AXIS = np.array([(x, y, (COLUMN[2] + SPACE) / 2) for y in (0.08, 0.2) for x in (-0.06, 0.06)])
"""Positions of springs in the plane of the column's centre, beside it. [m]"""


def tilts_at_failure(per, dt=1e-4, rate=0.1):
    """The column rotates about x through its centre at `rate` [rad/s]: tilts at which springs of a tenth of P_max
    break. [rad]
    """
    column = joined(dt, strength=STRENGTH / 10, per=per, points=OFF_AXIS, density=HEAVY, fixed=True)[1]
    spin(column, (rate, 0, 0))
    engine = O.engines[1]
    while len(engine.breaks) < len(OFF_AXIS):
        O.step()
    return [b.time * rate for b in engine.breaks]


@case
def springs_break_one_by_one():
    """In a tilting column the far springs break first: the stretch of a spring at y is 2 y sin(tilt/2). With values per
    joint all break when the sum of the four forces reaches P_max.

    The tilt is too large by at most one step, 1e-5 rad of 0.05 to 0.13 rad.
    """
    near, far = (2 * np.arcsin(STRETCH / 10 / (2 * y)) for y in (0.08, 0.2))
    together = 2 * np.arcsin(STRETCH / 10 / (0.08 + 0.2))
    rows = []
    for per, expected in {"spring": [far, far, near, near], "joint": [together] * 4}.items():
        rows.append(
            worst(
                "4",
                f"tilting column, per {per}: tilt at failure, worst of 4 [rad]",
                zip(expected, tilts_at_failure(per)),
                2.1e-4,
                dt=1e-4,
                note="displacement in one step",
            )
        )
    return rows


def swing(dt, count, ks=1.0):
    """Two free bodies in rotation with an unbroken joint for `count` steps: relative changes in 1000 samples of energy
    (band about its mean; mean of the last minus mean of the first tenth), linear and angular momentum.
    """
    beam, column, joint = joined(dt, stiffness=(STIFFNESS, ks * STIFFNESS))
    for body, velocity, omega in ((beam, (0.3, -0.2, -0.4), (0.5, 0.2, 1.0)), (column, (-0.1, 0.3, 0.6), (1.0, -1.5,
                                                                                                          -2.0))):
        body.state.vel = Vector3(*velocity)
        spin(body, omega)

    def probe():
        angular = sum((b.state.angMom + b.state.mass * b.state.pos.cross(b.state.vel) for b in (beam, column)),
                      Vector3.Zero)
        linear = sum((b.state.mass * b.state.vel for b in (beam, column)), Vector3.Zero)
        return [yt.energy_residual(), *linear, *angular]

    O.step()
    first = np.array(probe())
    change = steps(count, probe, every=count // 1000) - first
    assert not any(joint.broken)
    balance = change[:, 0] / first[0]
    parts = {"linear momentum": slice(1, 4), "angular momentum": slice(4, 7)}
    found = {name: np.linalg.norm(change[:, part], axis=1).max() / np.linalg.norm(first[part]) for name,
             part in parts.items()}
    return {
        "energy band": np.abs(balance - balance.mean()).max(),
        "energy drift": balance[-100:].mean() - balance[:100].mean(),
        **found,
    }


@case
def a_million_steps_unbroken():
    """Free beam and column, stretches up to 4 mm, 1e6 steps: the energy oscillates in a band of width (w dt)^2 without
    drift; momenta are constant to rounding.

    Observed: band 3.7e-6, drift 1.6e-7 (remainder of the band in means of 100 samples), momenta 1e-13 and 1e-12.
    """
    got, dt = swing(1e-4, 1000000), 1e-4
    bounds = {"energy band": 1e-5, "energy drift": 1e-6, "linear momentum": 1e-11, "angular momentum": 1e-11}
    return [Row("4", f"unbroken joint, 1e6 steps: {what} [-]", 0.0, got[what], bound=bound, dt=dt,
                note="leapfrog; rounding of momenta") for what, bound in bounds.items()]


@case
def energy_band_converges():
    """Second order, for equal and unequal stiffnesses. The angular momentum is constant with unequal stiffnesses as
    well, whose force is not parallel to the spring.
    """
    rows, dts = [], (2e-4, 1e-4, 5e-5)
    for ks in (1.0, 0.5):
        runs = [swing(dt, int(10 / dt), ks) for dt in dts]
        rows += series(
            "4",
            f"unbroken joint, ks = {ks:g} kn, 10 s: energy band [-]",
            0.0,
            [r["energy band"] for r in runs],
            dts,
            2e-6,
            1.8,
            note="leapfrog",
        )
        change = max(r["angular momentum"] for r in runs)
        rows.append(Row("4", f"unbroken joint, ks = {ks:g} kn, 10 s: angular momentum [-]", 0.0, change, bound=1e-11,
                        note="rounding"))
    return rows
