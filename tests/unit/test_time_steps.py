# SPDX-License-Identifier: GPL-2.0-or-later
"""Bound of the time step by what a scene needs."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import refused
from yade import O
from yade_timber.plugin import compiled


def stack(side, count, gravity=(0, 0, -9.81)):
    """Cubes on each other and on a plate, slightly beside each other: ids."""
    O.reset()
    O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
    ids = [O.bodies.append(yt.box((side, side, side), (0.05 * side * k, 0, side * (k + 0.5)))) for k in range(count)]
    O.engines = yt.engines(gravity=gravity)
    return ids


def limit(side, gravity=9.81):
    """[s]"""
    return math.sqrt(0.0025 * 0.1 * side / gravity)


@pytest.mark.parametrize("side, gravity", [
    (0.05, 9.81), *(pytest.param(*case, marks=pytest.mark.rare) for case in ((0.2, 9.81), (0.05, 300.0)))])
def test_weight_bounds_the_step(side, gravity):
    for engine in (None, yw.GravityEngine(gravity=(0, 0, -gravity))):
        ids = stack(1, 1, (0, 0, -gravity))
        ids.append(O.bodies.append(yt.box((1, 1, side), (3, 0, 3))))
        if engine:
            O.engines = [engine if isinstance(e, yw.UniformGravity) else e for e in O.engines]
        O.dt = 1.01 * limit(side, gravity)
        refused(f"O.dt = {O.dt:.3g}"[:12], f"body {ids[-1]}", "sinks", "at most")
        O.dt = 0.99 * limit(side, gravity)
        O.step()


def test_largest_step_of_a_stack():
    """At rest it sinks by about one per cent of the radius."""
    side = 0.2
    ids = stack(side, 4)
    O.dt = 0.99 * limit(side)
    O.run(600, True)
    assert max(side * (k + 0.5) - O.bodies[i].state.pos[2] for k, i in enumerate(ids)) < 0.02 * 0.1 * side


def test_default_step_of_thin_boards():
    """A board of 10 mm at 5e-4 s."""
    assert limit(0.01) > 5e-4
    stack(0.01, 1)
    O.dt = 5e-4
    O.step()


def test_step_without_gravity():
    stack(0.2, 2, gravity=(0, 0, 0))
    O.dt = 9e-3
    O.step()
    O.dt = 1.01e-2
    with pytest.raises(RuntimeError, match="at most 0.01 s"):
        O.step()


def test_fast_body_is_named(capfd):
    """Once; a board may pass through another body if it moves by more than half its thickness in a step."""
    bullet = stack(0.04, 3)[-1]
    O.dt = 5e-4
    yt.set_velocity(O.bodies[bullet], (0, 0, 39))
    O.run(300, True)
    assert "in a step" not in capfd.readouterr().err  # 19.5 of 20 mm
    yt.set_velocity(O.bodies[bullet], (0, 0, 41))
    O.run(300, True)
    said = [line for line in capfd.readouterr().err.splitlines() if "in a step" in line]
    assert len(said) == 1 and f"body {bullet} moves by 20." in said[0] and "O.dt = 0.0005 s" in said[0]


def test_created_energy_is_named(capfd):
    """Once. Explicit springs of a joint that yields within a step."""
    O.reset()
    O.bodies.append([yt.box((0.2, 0.2, 0.2), (0, 0, 0), fixed=True), yt.box((0.2, 0.2, 0.2), (0, 0, 0.5))])
    O.dt, O.engines = 2e-4, yt.engines(gravity=(0, 0, 0), sweeps=0)
    yt.connect(0, 1, [(0, 0, 0.25)], (0, 0, 1), (1e6, 1e6), 3000.0, slip=yt.SlipLaw(0.05, 0.1))
    O.run(200, True)
    yt.set_velocity(O.bodies[1], (0, 0, 10))
    O.run(300, True)
    said = [line for line in capfd.readouterr().err.splitlines() if "created" in line]
    assert len(said) == 1 and "of the energy put in: O.dt = 0.0002 s is large for them" in said[0]
    assert compiled.created_energy() > 1e-4 * yt.energy()["imposed_velocity"]
