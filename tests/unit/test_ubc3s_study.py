# SPDX-License-Identifier: GPL-2.0-or-later
"""Damping and base shear of scripts/validation/ubc3s.py: Rayleigh damping of PB3D, and a free body on the ground."""
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "validation"))

import ubc3s

VELOCITY, SPIN = (0.3, -0.2, 0.1), (0.4, 0.5, -0.6)
"""[m/s; rad/s]"""


def sampler(mass=2.0):
    """Of one free body."""
    body = SimpleNamespace(state=SimpleNamespace(vel=VELOCITY, angVel=SPIN))
    made = object.__new__(ubc3s.Sampler)
    made.free, made.mass = [body], np.array([mass])
    made.last = made._momentum()
    return made, body.state


def test_rayleigh_damping():
    """2 % at 0.30 s, three quarters of it by the masses; a / (2 omega) and b omega / 2."""
    omega = 2 * np.pi / 0.30
    by_mass, by_stiffness = ubc3s.MASS_DAMPING / (2 * omega), ubc3s.DAMPING_TIME * omega / 2
    assert (by_mass, by_stiffness) == (pytest.approx(0.015), pytest.approx(0.005))


def test_dashpots_of_masses():
    """They slow sway and rotation about the vertical alone, as in PB3D, and are in no base shear."""
    made, state = sampler()
    made.damp(3.0)
    left = np.exp(-3.0 * ubc3s.SAMPLE)
    assert state.vel == pytest.approx((left * 0.3, left * -0.2, 0.1))
    assert state.angVel == pytest.approx((0.4, 0.5, left * -0.6))
    assert made.last == pytest.approx(2.0 * np.array(state.vel[:2]))
