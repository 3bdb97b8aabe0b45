# SPDX-License-Identifier: GPL-2.0-or-later
"""A bay with one wall under imposed drifts, quasi-static, as in a test with pinned feet. Needs YADE.

The storey is moved as a mechanism: columns turn about their feet by the angle theta, everything above them moves along
a circle. The wall's shear is the force between the beams plus the force between the columns times L / h.
"""
import math
from pathlib import Path

import numpy as np
import yade.wrapper as yw
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from timber_houses.scene import scenario
from yade_timber.scene import engines

HOUSE = """\
extends: base
name: bay
wall_types:
  tested: {type}
structures:
  bay:
    place: {{origin: [0, 0]}}
    grid: {{x: {{module: {length}, count: 1}}, y: {{module: 0.91, count: 1}}}}
    margin: 0.06
    lines: [{{along: y, at: [0, 1], from: 0, to: 1}}, {{along: x, at: [0, 1], from: 0, to: 1, cut: true}}]
    stack:
      - {{layer: sill, height: 0.12, width: 0.12}}
      - {{layer: columns, height: {height}}}
      - {{layer: beams, height: 0.12, width: 0.12}}
      - {{layer: roof, type: flat, thickness: 0.1}}
    columns: [{{section: 0.12, grid: {{x: [0, 1], y: [0, 1]}}}}]
    walls: [{{along: x, at: 0, from: 0, to: 1, type: tested, opening: {opening}}}]
"""
DRIFTS = tuple(1 / n for n in (450, 300, 200, 150, 100, 75, 50, 30, 15))
"""Amplitudes of the usual test. [rad]"""
CYCLES = 3
"""At each amplitude."""
STEP = 2e-4
"""Of the imposed drift. [rad]"""


class Rack:
    """The bay's scene without contacts; `drift` moves it. folder: of its house file; type: wall type in YAML; level: of
    rated walls.
    """

    def __init__(self, folder, type, length=0.91, height=2.73, opening="none", level=None):
        path = Path(folder) / "bay.yaml"
        path.write_text(HOUSE.format(type=type, length=length, height=height, opening=opening))
        self.length, self.height = length, height
        self.model = scenario.build(scenario.Scenario("bay", str(path), wall_level=level))
        self.beams, self.columns = (joint for joint in engines.find_engine(yw.JointEngine).joints
                                    if joint.kind.startswith("wall"))
        self.joints = yw.JointEngine()
        for joint in (self.beams, self.columns):
            self.joints.append(joint)
        O.engines = [yw.ForceResetter(), self.joints]

    def drift(self, theta):
        """Move the storey to the angle theta [rad] along x; returns the wall's shear [N]."""
        shift = Vector3(math.sin(theta) * self.height, 0, (math.cos(theta) - 1) * self.height)
        turn = Quaternion(Vector3(0, 1, 0), theta)
        for element, body in zip(self.model.elements, O.bodies):
            if element.kind == "column":
                body.state.ori = turn * body.state.refOri
                body.state.pos = body.state.refPos + Vector3(math.sin(theta), 0, math.cos(theta) - 1) * self.height / 2
            elif not element.fixed:
                body.state.pos = body.state.refPos + shift
        O.step()
        return self.beams.forces[0][0] + self.column_force() * self.length / self.height

    def column_force(self):
        """Vertical force between the columns; positive: it pulls the western one up. [N]"""
        return self.columns.forces[0][2]

    def path(self, *angles, step=1e-4):
        """[(theta, shear)] along straight paths from one angle to the next."""
        return [(theta, self.drift(theta)) for a, b in zip(angles, angles[1:])
                for theta in np.linspace(a, b, max(2, round(abs(b - a) / step)))]

    def test(self, drifts=DRIFTS, cycles=CYCLES, step=STEP):
        """[(theta, shear)] of the usual test: cycles of growing amplitude, then a push until the wall breaks."""
        turns = [sign * drift for drift in drifts for _ in range(cycles) for sign in (1, -1)]
        rows = self.path(0.0, *turns, 0.0, step=step)
        while not self.beams.isBroken and rows[-1][0] < 1:
            rows.append((rows[-1][0] + step, self.drift(rows[-1][0] + step)))
        return rows


def envelope(rows):
    """(n, 2) largest shear so far on the positive side at each drift that had not been reached before. rows: [(theta,
    shear)]
    """
    points, reached = [(0.0, 0.0)], 0.0
    for theta, shear in rows:
        if theta > reached:
            points.append((theta, shear))
            reached = theta
    return np.array(points)
