# SPDX-License-Identifier: GPL-2.0-or-later
"""A bay with sheathing under imposed drifts, against the backbone and the loops by which the Japanese code rates walls.

The storey is moved as a mechanism: columns turn about their feet by the angle theta, everything above them moves along a circle. The wall's
shear is the force between the beams plus the force between the columns times L / h.
"""
import math

import numpy as np
import pytest
import yade.wrapper as yw
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade_timber.scene import engines, queries, scenario

HOUSE = """\
extends: base
name: bay
wall_types:
  tested: {{multiplier: 2.5}}
structures:
  bay:
    place: {{origin: [0, 0]}}
    grid: {{x: {{module: 0.91, count: 1}}, y: {{module: 0.91, count: 1}}}}
    margin: 0.06
    lines: [{{along: y, at: [0, 1], from: 0, to: 1}}, {{along: x, at: [0, 1], from: 0, to: 1, cut: true}}]
    stack:
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: 2.73}}
      - {{layer: beams, height: 0.12, width: 0.12}}
      - {{layer: roof, type: flat, thickness: 0.1}}
    columns: [{{section: 0.12, grid: {{x: [0, 1], y: [0, 1]}}}}]
    walls: [{{along: x, at: 0, from: 0, to: 1, type: tested, opening: {opening}}}]
"""
LENGTH, HEIGHT = 0.91, 2.73
STRENGTH, STIFFNESS, SOFTENING, ULTIMATE = 1.5 * 4900 * LENGTH, 150 * 4900 * LENGTH, 0.05, 0.103
"""Of the bay [N, N per rad, rad, rad]: 1.96 kN/m times 2.5 is allowable."""
YIELD = STRENGTH / STIFFNESS


class Bay:
    """The bay's scene without contacts; `drift` moves it."""

    def __init__(self, tmp_path, opening="none"):
        path = tmp_path / "bay.yaml"
        path.write_text(HOUSE.format(opening=opening))
        self.model = scenario.build(scenario.Scenario("bay", str(path)))
        self.beams, self.columns = (joint for joint in engines.find_engine(yw.JointEngine).joints if joint.kind.startswith("wall"))
        self.joints = yw.JointEngine()
        for joint in (self.beams, self.columns):
            self.joints.append(joint)
        O.engines = [yw.ForceResetter(), self.joints]

    def drift(self, theta):
        """Move the storey to the angle theta [rad] along x; returns the wall's shear [N]."""
        shift = Vector3(math.sin(theta) * HEIGHT, 0, (math.cos(theta) - 1) * HEIGHT)
        turn = Quaternion(Vector3(0, 1, 0), theta)
        for element, body in zip(self.model.elements, O.bodies):
            if element.kind == "column":
                body.state.ori = turn * body.state.refOri
                body.state.pos = body.state.refPos + Vector3(math.sin(theta), 0, math.cos(theta) - 1) * HEIGHT / 2
            elif not element.fixed:
                body.state.pos = body.state.refPos + shift
        O.step()
        return self.beams.forces[0][0] + self.column_force() * LENGTH / HEIGHT

    def column_force(self):
        """Vertical force between the columns; positive: it pulls the western one up. [N]"""
        return self.columns.forces[0][2]

    def path(self, *angles, step=1e-4):
        """[(theta, shear)] along straight paths from one angle to the next."""
        return [(theta, self.drift(theta)) for a, b in zip(angles, angles[1:]) for theta in np.linspace(a, b, max(2, round(abs(b - a) / step)))]


def backbone(theta):
    """Shear of the first loading. [N]"""
    left = 1.0 if theta <= SOFTENING else max(0.0, (ULTIMATE - theta) / (ULTIMATE - SOFTENING))
    return min(STIFFNESS * theta, STRENGTH * left)


def test_shear_follows_the_backbone(tmp_path):
    """To 0.5 %: the mechanism's stretches are theta to within theta^2 / 6 in the columns' half and 1 in 1000 in the beams' at 1/10."""
    bay = Bay(tmp_path)
    rows = bay.path(0, 0.102)
    assert max(abs(shear - backbone(theta)) for theta, shear in rows) < 5e-3 * STRENGTH
    assert abs(bay.drift(1 / 120)) < 0.01 * STRENGTH and not bay.joints.breaks  # the wall has slipped
    bay.path(0, 0.105)
    assert bay.beams.isBroken and bay.columns.isBroken


def test_energy_of_the_first_loading(tmp_path):
    """Area under the backbone to its end: F (d_c + d_u) / 2 less the triangle before yielding."""
    bay = Bay(tmp_path)
    bay.path(0, 0.105)
    area = HEIGHT * (STRENGTH * (SOFTENING + ULTIMATE) / 2 - STRENGTH * YIELD / 2)
    assert queries.energy()["joint_yield"] == pytest.approx(area, rel=5e-3)


def test_code_criteria_of_the_multiplier():
    """A wall of multiplier 2.5 has 4.9 kN/m, by the four criteria of its test: two thirds of the largest load, the load at 1/150,
    ductility 0.2 sqrt(2 mu - 1) times the plateau with mu to the drift at 80 % of the load, and yielding."""
    allowable = 4900 * LENGTH
    at_80 = ULTIMATE - 0.8 * (ULTIMATE - SOFTENING)
    ductility = 0.2 * math.sqrt(2 * at_80 / YIELD - 1) * STRENGTH
    assert [STRENGTH * 2 / 3, backbone(1 / 150), ductility] == pytest.approx([allowable] * 3, rel=0.01)
    assert backbone(YIELD) > allowable


@pytest.mark.parametrize("amplitude", [1 / 60, 1 / 45, 1 / 30])
def test_damping_of_the_loops(tmp_path, amplitude):
    """Second cycle: the friction part alone dissipates, 4 phi F (a - y), which is (2 / pi) phi (1 - y / a) of equivalent damping. Published for
    timber structures with slip: 0.2 (1 - 1 / sqrt(mu)) (Notification 1457 of 2000), mu = a / y; they agree within 0.01."""
    bay = Bay(tmp_path)
    bay.path(0, amplitude, -amplitude, amplitude)
    before = queries.energy()["joint_yield"]
    rows = bay.path(amplitude, -amplitude, amplitude)
    area = HEIGHT * sum((f0 + f1) / 2 * (t1 - t0) for (t0, f0), (t1, f1) in zip(rows, rows[1:]))
    dissipated = queries.energy()["joint_yield"] - before
    assert dissipated == pytest.approx(4 * 0.2 * STRENGTH * (amplitude - YIELD) * HEIGHT, rel=5e-3)
    assert area == pytest.approx(dissipated, rel=1e-2)
    damping = dissipated / (2 * math.pi * STRENGTH * amplitude * HEIGHT)
    assert damping == pytest.approx(0.2 * (1 - math.sqrt(YIELD / amplitude)), abs=0.01)


def test_pull_of_the_columns(tmp_path):
    """Half of H h / L, upwards on the column from which the wall leans away."""
    bay = Bay(tmp_path)
    shear = bay.drift(1 / 150)
    assert abs(bay.column_force()) == pytest.approx(0.5 * shear * HEIGHT / LENGTH, rel=1e-3)
    assert bay.column_force() > 0


@pytest.mark.parametrize("opening, ratio", [("window", 0.4), ("door", 0.2)])
def test_openings(tmp_path, opening, ratio):
    bay = Bay(tmp_path, opening)
    assert bay.drift(1 / 150) == pytest.approx(ratio * STIFFNESS / 150, rel=1e-3)


def test_no_force_across_the_wall(tmp_path):
    """Everything above the columns moves across the wall, and down by 1 cm."""
    bay = Bay(tmp_path)
    for element, body in zip(bay.model.elements, O.bodies):
        if element.kind in ("beam", "roof"):
            body.state.pos = body.state.refPos + Vector3(0, 0.05, -0.01)
    O.step()
    assert bay.beams.forces[0].norm() < 1e-20
