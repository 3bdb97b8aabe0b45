# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 4 of the accuracy page. Quantities and bounds: joint_cases.py."""
import math

import pytest
import yade_timber as yt
from joint_cases import case
from rows import check
from yade import O


@pytest.mark.parametrize("function", case.functions, ids=lambda f: f.__name__)
def test(function):
    check(function())


@pytest.mark.parametrize("broken", [0, 1, 2])
def test_dashpots_along_one_line_add_up(broken):
    """A block on three axial springs at one place, of which the first ones are broken: the closed form of a damped
    oscillator. Observed: up to 5e-4 of the amplitude at omega h = 0.01; with the dashpot of one spring of three alone
    0.24.
    """
    mass, k, tau, speed = 200.0, 3e4, 5e-3, 0.01
    O.reset()
    fixed = O.bodies.append(yt.box((0.4, 0.4, 0.4), (0, 0, 0), fixed=True))
    block = O.bodies.append(yt.box((0.4, 0.4, 0.4), (1, 0, 0), material=yt.timber(density=mass / 0.4**3)))
    O.engines, O.dt = yt.engines(gravity=(0, 0, 0)), 5e-4
    joints = [yt.connect(fixed, block, [(0.5, 0, 0)], (1, 0, 0), (k, 0.0), 1e6 * (1 + j)) for j in range(3)]
    for joint in joints:
        joint.dampingTime = tau
    for joint in joints[:broken]:
        joint.broken = [1]
    O.bodies[block].state.vel = (speed, 0, 0)
    omega = math.sqrt((3 - broken) * k / mass)
    ratio = tau * omega / 2
    damped = omega * math.sqrt(1 - ratio**2)
    worst = 0.0
    for _ in range(1000):
        O.step()
        time = O.iter * O.dt
        moved = speed / damped * math.exp(-ratio * omega * time) * math.sin(damped * time)
        worst = max(worst, abs(O.bodies[block].state.pos[0] - 1 - moved))
    assert worst < 2e-3 * speed / omega
