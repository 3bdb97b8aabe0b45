# SPDX-License-Identifier: GPL-2.0-or-later
"""Timber with a bearing strength: impacts of corners and faces against the equation of motion, energy, support."""
import math

import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from cases import DENSITY, hertz_constant, octahedron, turned
from yade_timber.scene.engines import find_engine

O = yw.Omega()
STRENGTH = 6e6
"""[Pa]"""
HALF = 0.3
"""Half diagonal of the octahedron. [m]"""
SIDES = (0.4, 0.3, 0.2)
"""Of the block. [m]"""
PLATE = (2, 1, 0.2)
"""[m]"""


class Impact:
    """Central impact along z on a fixed plate. kind: 'corner' (one point) or 'face' (four)"""

    def __init__(self, kind, bearing=STRENGTH):
        self.kind, self.bearing = kind, bearing
        volume = 4 / 3 * HALF**3 if kind == "corner" else math.prod(SIDES)
        self.mass, self.points = DENSITY * volume, 1 if kind == "corner" else 4
        self.constant = hertz_constant(volume, math.prod(PLATE))
        radius = min(0.1 * HALF * math.sqrt(2), 0.02)  # of octahedron and plate
        self.halves = (radius, radius) if kind == "corner" else (SIDES[0] / 2, SIDES[1] / 2)

    def strength(self, crushed):
        """F_Y of a point, after the documented rule. [N]"""
        a, b = self.halves
        return self.bearing * 4 * (a + crushed) * (b + crushed) / self.points

    def exact(self, speed, ratio):
        """Restitution by the midpoint rule in steps far below the time in which the elastic overlap is passed."""
        def overlap(force):
            return (force / self.constant) ** (2 / 3)

        def force(depth, rate):
            n = max(0.0, depth - crushed)
            dashpot = 2 * ratio * math.sqrt(self.mass * 1.5 * self.constant * math.sqrt(n)) * rate
            return self.points * min(self.strength(crushed), max(0.0, self.constant * n**1.5 + dashpot))

        depth, rate, crushed = 0.0, speed, 0.0
        dt = 1e-2 * overlap(self.strength(0)) / speed
        while rate > 0 or force(depth, rate) > 0:
            half = rate - dt / 2 / self.mass * force(depth, rate)
            rate -= dt / self.mass * force(depth + dt / 2 * rate, half)
            depth += dt * half
            crushed = max(crushed, depth - overlap(self.strength(crushed)))
        return -rate / speed

    def load(self, speed, ratio, step, phase=0.3, order=1, **options):
        """The moving body, which touches a fraction of a step after three; order: -1: the plate comes last."""
        O.reset()
        material = yt.timber(friction=0, bearing=self.bearing)
        plate = yt.box(PLATE, (0, 0, -PLATE[2] / 2), None, material, fixed=True)
        if self.kind == "face":
            height = SIDES[2] / 2
            body = yt.box(SIDES, (0, 0, 0), None, material)
        else:
            body = octahedron(HALF, (0, 0, 0), material=material)
            height = HALF - (math.sqrt(3) - 1) * body.shape.radius
        body.state.pos = (0, 0, height + speed * step * (3 + phase))
        for one in (plate, body)[::order]:
            O.bodies.append(one)
        O.dt, O.engines = step, yt.engines(gravity=(0, 0, 0), damping_ratio=ratio, **options)
        yt.set_velocity(body, (0, 0, -speed))
        return body

    def run(self, speed, ratio, step, **options):
        """(restitution, largest force of a point over its strength, crushing [J], residual over the energy)"""
        body, share, deepest = self.load(speed, ratio, step, **options), 0.0, 0.0
        for _ in range(int(0.1 / step)):
            O.step()
            for point in yt.contacts(0, 1):
                deepest = max(deepest, point["overlap"])
                share = max(share, point["normal_force"] / self.strength(deepest))
            if O.iter > 4 and body.state.vel[2] > 0 and not yt.contacts(0, 1):
                break
        energy = yt.energy()
        return (body.state.vel[2] / speed, share, energy["crushing"],
                abs(yt.energy_residual()) / (self.mass / 2 * speed**2))


@pytest.mark.parametrize("kind", ["corner", "face"])
@pytest.mark.parametrize("ratio", [0.0, 1.0])
def test_restitution_converges(kind, ratio):
    """Crushed at 30 m/s. 0.01: the order of the step. Energies of explicit springs close to the order of the step,
    others to rounding.
    """
    impact = Impact(kind)
    exact = impact.exact(30.0, ratio)
    assert exact < 0.7  # crushed
    for options, step, rest in (({}, 1e-5, 1e-9), ({"sweeps": 0}, 1e-6, 1e-4)):
        found, share, crushing, residual = impact.run(30.0, ratio, step, **options)
        assert found == pytest.approx(exact, abs=0.01), options
        assert share <= 1 + 1e-9 and crushing > 0 and residual < rest, options


def test_a_dent_is_no_uncarried_overlap():
    """The dent is deeper than the share of the radius that the check reports."""
    body, deepest = Impact("corner").load(30.0, 1.0, 1e-4), 0.0
    check = find_engine(yt.OverlapCheck)
    check.interval = 0
    for _ in range(50):
        O.step()
        deepest = max([deepest, *(point["crushed"] for point in yt.contacts(0, 1))])
    assert deepest > check.share * body.shape.radius and check.largest == 0


def test_increment_form_is_elastic():
    """As the paper's: its force may exceed the strength."""
    _, share, crushing, _ = Impact("corner").run(30.0, 1.0, 1e-5, increment=True)
    assert share > 1 and crushing == 0


def test_corners_are_exact_at_any_step():
    """In four phases of a step. 0.015: the first overlap is passed within a step."""
    impact = Impact("corner")
    for speed in (1.0, 10.0):
        exact = impact.exact(speed, 1.0)
        for step in (5e-4, 1e-4):
            for phase in (0.05, 0.3, 0.6, 0.95):
                found, share, _, residual = impact.run(speed, 1.0, step, phase=phase)
                assert found == pytest.approx(exact, abs=0.015), (speed, step, phase)
                assert share <= 1 + 1e-9 and residual < 1e-9


def test_faces_are_never_faster():
    """Than the exact solution, but for 0.02, the softness with which points share an impulse."""
    impact = Impact("face")
    for speed in (3.0, 25.0):
        exact = impact.exact(speed, 1.0)
        for step in (5e-4, 1e-4):
            for phase in (0.05, 0.6):
                found, _, crushing, residual = impact.run(speed, 1.0, step, phase=phase)
                assert found <= exact + 0.02 + 0.02 * exact
                assert residual < 1e-9 and (speed < 25 or crushing > 0)


def test_no_strength_is_the_papers_law():
    """Without dashpots nothing is dissipated but by the step: 1e-2 at 1e-5 s."""
    found, _, crushing, _ = Impact("corner", math.inf).run(10.0, 0.0, 1e-5)
    assert found == pytest.approx(1, abs=1e-2) and crushing == 0


def trace(impact, cut=None, tmp_path=None, **options):
    """Height and velocity of the body in each of 120 steps as hexadecimal numbers; cut: step of saving and loading"""
    body = impact.load(30.0, 1.0, 2e-4, **options)
    index, rows = body.id, []
    for k in range(120):
        if k == cut:
            O.save(str(tmp_path / "scene.bin.gz"))
            O.load(str(tmp_path / "scene.bin.gz"))
        O.step()
        state = O.bodies[index].state
        rows.append((state.pos[2].hex(), state.vel[2].hex(), yt.energy()["crushing"].hex()))
    return rows


def test_saving_and_swapping(tmp_path):
    """Saved while it is crushed: the same bits. Bodies in the other order: to rounding."""
    impact = Impact("face")
    straight = trace(impact)
    assert float.fromhex(straight[-1][2]) > 0
    for cut in (6, 12, 20):
        assert trace(impact, cut, tmp_path) == straight
    swapped = trace(impact, order=-1)
    numbers = [np.array([[float.fromhex(x) for x in row] for row in rows]) for rows in (straight, swapped)]
    assert numbers[1] == pytest.approx(numbers[0], rel=1e-9, abs=1e-9)


def test_weight_on_a_sliding_block():
    """A slab far above the strength of a block that is drawn from under it: the support changes features under a
    crushed contact. Nothing falls through, no energy is created, and the residual is that of the sweeps.
    """
    O.reset()
    timber = yt.timber(friction=0.1, bearing=STRENGTH)
    O.bodies.append(yt.box((4, 4, 0.4), (0, 0, -0.2), None, timber, fixed=True))
    light = O.bodies.append(yt.box((0.3, 0.1, 0.1), (0, 0.05, 0.05), turned((0, 0, 1), 0.02), timber))
    heavy = yt.timber(density=16000, friction=0.1, bearing=STRENGTH)
    O.bodies.append(yt.box((1.5, 1, 1), (0, 0, 0.6), None, heavy))
    O.dt, O.engines = 2e-4, yt.engines()
    yt.set_velocity(O.bodies[light], (2, 0, 0))
    O.run(5000, True)
    forces, energy = find_engine(yw.ContactForces), yt.energy()
    supplied = -energy["gravity"] + energy["imposed_velocity"]
    assert energy["crushing"] > 0
    assert forces.created <= 1e-5 * supplied and abs(yt.energy_residual()) <= 1e-5 * supplied
    # A static dent is 11 mm deep, a suddenly loaded one twice as much, and the block slides out: observed 27 mm
    assert 0.05 - O.bodies[light].state.pos[2] < 0.03
