# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/validation/ubc3s.py: Rayleigh damping of PB3D, a free body on the ground, stored drifts."""
import csv
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import ubc3s

ROOT = Path(__file__).resolve().parents[2]
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


def test_stored_drifts_beside_those_of_pb3d(monkeypatch):
    """Storeys 1 and 2: at most 25 % from PB3D's, 15 % in the mean over scales and directions."""
    folder = ROOT / "docs" / "validation"
    monkeypatch.setattr(ubc3s, "REFERENCE", folder / "ubc3s_reference.csv")
    known, off = ubc3s.reference(), []
    for row in csv.DictReader((folder / "ubc3s.csv").read_text().splitlines()):
        key = float(row["scale"]), int(row["storey"]), row["direction"]
        other = known[key][0]
        assert float(row["pb3d_peak_centre_mm"]) == other
        ratio = float(row["peak_centre_mm"]) / other
        assert float(row["ratio"]) == pytest.approx(ratio, abs=0.005 + 0.05 / other)  # both are rounded
        if key[1] < 3:
            off.append(abs(float(row["ratio"]) - 1))
    assert len(off) == 8 and max(off) <= 0.25 and np.mean(off) <= 0.15
