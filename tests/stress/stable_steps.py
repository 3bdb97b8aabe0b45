# SPDX-License-Identifier: GPL-2.0-or-later
"""Measured stability limits of the time step: slightly disturbed scenes, at time steps below and above the prediction
of `yt.stable_dt`.
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from undamped import undamp
from timber_houses.scene import scenario
from yade_timber.scene import engines

O = yw.Omega()

SETTLING = 2000
"""Steps of SETTLING_DT before the disturbance."""
SETTLING_DT = 2e-5
DISTURBANCE = 1e-6
"""Standard deviation of the initial velocities, small enough for contacts to remain closed [m/s, rad/s]."""
STEPS = 400
GROWTH = 1e3
"""Growth of the kinetic energy that counts as instability; a stable scene exchanges energy between its modes [-]."""
JOINT_FACTOR = 1000.0
"""Factor on the stiffness of the joints in the stiff house [-]."""


def suspended_block(dt):
    """A cube on four springs: joints without contacts."""
    O.reset()
    support = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    cube = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0.3)))
    O.dt, O.engines = dt, yt.engines(gravity=(0, 0, 0))
    yt.connect(support, cube, [(x, y, 0.2) for x in (-0.1, 0.1) for y in (-0.1, 0.1)], strength=1e12)


def stack(dt):
    """Three blocks on each other: contacts without joints."""
    O.reset()
    O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    for k in range(3):
        O.bodies.append(yt.box((0.3, 0.25 - 0.05 * (k % 2), 0.2), (0, 0, 0.1 + 0.2 * k)))
    O.dt, O.engines = dt, yt.engines()


def house(dt):
    """House B under its own weight."""
    scenario.build(scenario.Scenario("limit", "B", dt=dt, options={"skip_rest": 0}))


def stiff_house(dt):
    """House B with the paper's joints JOINT_FACTOR times as stiff and strong; those of floors and roof are unchanged.
    """
    house(dt)
    for joint in engines.find_engine(yw.JointEngine).joints:
        if joint.kind in ("column_beam", "brace_beam"):
            joint.kn, joint.ks, joint.strength = (JOINT_FACTOR * value
                                                  for value in (joint.kn, joint.ks, joint.strength))


def settled(build):
    """Build a scene and run it to rest with a small time step; returns the predicted limit [s]."""
    build(SETTLING_DT)
    for _ in range(SETTLING):
        O.step()
    return yt.stable_dt(1.0)


def disturb(seed=0):
    """Add a small random velocity and spin to every free body."""
    random = np.random.default_rng(seed)
    for body in O.bodies:
        if body.dynamic:
            change = DISTURBANCE * random.normal(size=6)
            yt.set_velocity(body, np.array(body.state.vel) + change[:3], np.array(body.state.angVel) + change[3:])


def is_stable(build, dt, damped=True):
    """Whether the energy of the disturbed scene stays bounded for STEPS steps of dt [s]; damped=False: explicit springs
    without dashpots, whose limit `yt.stable_dt` predicts."""
    settled(build)
    if not damped:
        undamp()
        engines.find_engine(yw.ContactForces).sweeps = 0
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
        mean = np.sqrt(low * high)
        low, high = (mean, high) if is_stable(build, mean, damped) else (low, mean)
    return low
