# SPDX-License-Identifier: GPL-2.0-or-later
"""Measured limits of the time step: scenes disturbed a little, at steps below and above the limit that `yt.stable_dt` predicts."""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from undamped import undamp
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene

O = yw.Omega()

SETTLING = 2000
"""Steps of SETTLING_DT before the disturbance."""
SETTLING_DT = 2e-5
NUDGE = 1e-6
"""Size of the disturbance, small enough for contacts to stay closed [m/s, rad/s]."""
STEPS = 400
GROWTH = 1e3
"""Kinetic energy over that of the disturbance that counts as unstable: a stable scene only passes energy on between its modes [-]."""
JOINT_FACTOR = 1000.0
"""How much stiffer the joints of the stiff house are [-]."""


def hung_block(dt):
    """A cube on four springs: joints alone."""
    O.reset()
    held = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    cube = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0.3)))
    O.dt, O.engines = dt, yt.engines(gravity=(0, 0, 0))
    yt.connect(held, cube, [(x, y, 0.2) for x in (-0.1, 0.1) for y in (-0.1, 0.1)], strength=1e12)


def stack(dt):
    """Three blocks on each other: contacts alone."""
    O.reset()
    O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    for k in range(3):
        O.bodies.append(yt.box((0.3, 0.25 - 0.05 * (k % 2), 0.2), (0, 0, 0.1 + 0.2 * k)))
    O.dt, O.engines = dt, yt.engines()


def house(dt):
    """House B under its own weight."""
    scenario.build(scenario.Scenario("limit", "B", dt=dt, options={"skip_rest": 0}))


def stiff_house(dt):
    """House B with the paper's joints JOINT_FACTOR times as stiff and as strong; those of floors and roof are stiff already."""
    house(dt)
    for joint in scene.find_engine(yw.JointEngine).joints:
        if joint.kind in ("column_beam", "brace_beam"):
            joint.kn, joint.ks, joint.strength = (JOINT_FACTOR * value for value in (joint.kn, joint.ks, joint.strength))


def settled(build):
    """Build a scene and let it come to rest at a small step; returns the predicted limit [s]."""
    build(SETTLING_DT)
    for _ in range(SETTLING):
        O.step()
    return yt.stable_dt(1.0)


def disturb(seed=0):
    """Add a small random velocity and spin to every free body."""
    random = np.random.default_rng(seed)
    for body in O.bodies:
        if body.dynamic:
            nudge = NUDGE * random.normal(size=6)
            yt.set_velocity(body, np.array(body.state.vel) + nudge[:3], np.array(body.state.angVel) + nudge[3:])


def is_stable(build, dt, damped=True):
    """Whether the settled, disturbed scene keeps the energy of the disturbance for STEPS steps of dt [s]; not damped: explicit springs
    without dashpots, which is what `yt.stable_dt` is about."""
    settled(build)
    if not damped:
        undamp()
        scene.find_engine(yw.ContactForces).sweeps = 0
    disturb()
    before = yt.energy()["kinetic"]
    O.dt = dt
    try:
        for _ in range(STEPS):
            O.step()
    except RuntimeError:  # the health check
        return False
    return yt.energy()["kinetic"] <= GROWTH * before


def measured_limit(build, low, high, tolerance=0.02, damped=True):
    """Largest stable step between a stable `low` and an unstable `high` by bisection, to a relative tolerance [s]."""
    while high > (1 + tolerance) * low:
        middle = np.sqrt(low * high)
        low, high = (middle, high) if is_stable(build, middle, damped) else (low, middle)
    return low
