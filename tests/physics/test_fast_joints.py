# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints that open fast, of every law: the balance of energy closes whether a step resolves them or not."""
from dataclasses import replace

import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade_timber.house.model import WallCycles
from yade_timber.run.summary import CREATED, created_energy
from yade_timber.scene.engines import find_engine
from yade_timber.scene.joints import add_joint_engine, checked_springs, make_joint

O = yw.Omega()
DT, MASS = 2e-4, 1.4
"""[s], [kg]"""
POINTS = [(0.1, y, 5 + z) for y in (-0.04, 0.04) for z in (-0.04, 0.04)]
"""Of four springs between two cubes. [m]"""


def law(name, k, strength):
    """Changes of a JointSpec with springs of this stiffness [N/m] and strength [N]."""
    limit = strength / k
    slip = {"law": "slip", "softening_stretch": 2 * limit, "ultimate_stretch": 8 * limit, "envelope": ()}
    backbone = ((0.4 * limit, 0.4 * strength), (3 * limit, strength), (9 * limit, 0.2 * strength), (11 * limit, 0))
    cycles = WallCycles(0.1 * strength, 1.1, 0.65)
    return {"brittle": {},
            "slip": slip | {"friction_share": 0.0}, "slip and friction": slip | {"friction_share": 0.3},
            "wall": {"law": "wall", "ks": 0.0, "envelope": backbone, "cycles": cycles}}[name]


LAWS = ("brittle", "slip", "slip and friction", "wall")


def pulled(name, phase, speed, share, ratio):
    """A free cube on a joint of a fixed one leaves with that speed [m/s]. phase: omega h of its four springs; share:
    of the amplitude of elastic springs, their elastic limit. Energy put in. [J]
    """
    O.reset()
    fixed = O.bodies.append(yt.box((0.1,) * 3, (0, 0, 5), fixed=True))
    free = O.bodies.append(yt.box((0.1,) * 3, (0.2, 0, 5), material=yt.timber(density=1000 * MASS)))
    O.dt, O.engines = DT, yt.engines(gravity=(0, 0, 0))
    omega = phase / DT
    k = MASS * omega**2 / 4
    springs = checked_springs(POINTS, (1, 0, 0), (k, k), share * k * speed / omega, "spring", "", "", ratio)
    springs = replace(springs, **law(name, k, springs.strength))
    (find_engine(yw.JointEngine) or add_joint_engine()).append(make_joint(fixed, free, springs))
    O.step()
    yt.set_velocity(free, speed * np.array([0.9, 0.4, -0.2]), (0.3, 2, -1))
    return yt.energy()["imposed_velocity"]


@pytest.mark.parametrize("name", LAWS)
def test_the_balance_closes(name):
    """1e-4 of the energy put in. Explicit springs of the law slip missed 4e-3 at the kinks of their backbone. Stretches
    stay small beside the cubes: leapfrog steps of large ones that turn them have errors of up to 1e-3, of brittle
    springs too.
    """
    for phase in (0.03, 0.13, 0.4, 0.9, 3.0):
        for share, speed in ((0.1, 0.5), (0.5, 4.9)):
            energy = pulled(name, phase, speed, share, 0)
            worst = 0.0
            for _ in range(12):
                O.run(max(1, round(1.2 / phase)), True)
                worst = max(worst, abs(yt.energy_residual()))
            case = f"omega h {phase}, {speed} m/s, limit {share}: {worst / energy:.1e}, {created_energy() / energy:.1e}"
            assert worst <= CREATED * energy and created_energy() <= CREATED * energy, case
