# SPDX-License-Identifier: GPL-2.0-or-later
"""A bay with sheathing under imposed drifts, against the backbone and the loops by which the Japanese code rates walls.

The storey is moved as a mechanism: columns turn about their feet by the angle theta, everything above them moves along
a circle. The wall's shear is the force between the beams plus the force between the columns times L / h.
"""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade_timber.scene import queries
from rack import Rack

LENGTH, HEIGHT = 0.91, 2.73
STRENGTH, STIFFNESS, SOFTENING, ULTIMATE = 1.5 * 4900 * LENGTH, 150 * 4900 * LENGTH, 0.05, 0.103
"""Of the bay at the level design [N, N per rad, rad, rad]: 1.96 kN/m times 2.5 is allowable."""
YIELD = STRENGTH / STIFFNESS
MEAN = [(1 / 120, 1.4), (1 / 80, 1.8), (1 / 30, 2.8), (0.115, 0.0)]
"""The level mean: shear over the allowable one."""


def bay_of(folder, wall="{multiplier: 2.5}", **options):
    """The bay with a wall of multiplier 2.5."""
    return Rack(folder, wall, **{"level": "design", **options})


def backbone(theta):
    """Shear of the first loading. [N]"""
    left = 1.0 if theta <= SOFTENING else max(0.0, (ULTIMATE - theta) / (ULTIMATE - SOFTENING))
    return min(STIFFNESS * theta, STRENGTH * left)


def test_shear_follows_the_backbone(tmp_path):
    """To 0.5 %: the mechanism's stretches are theta to within theta^2 / 6 in the columns' half and 1 in 1000 in the
    beams' at 1/10.
    """
    bay = bay_of(tmp_path)
    rows = bay.path(0, 0.102)
    assert max(abs(shear - backbone(theta)) for theta, shear in rows) < 5e-3 * STRENGTH
    # The wall has slipped: what is left is the friction force, as little as the strength at the end of the path
    assert abs(bay.drift(1 / 120)) < 0.03 * STRENGTH and not bay.joints.breaks
    bay.path(0, 0.105)
    assert bay.beams.isBroken and bay.columns.isBroken


@pytest.mark.parametrize("wall, points", [
    ("{multiplier: 2.5, reload_target: 1}", [(drift, 4900 * ratio) for drift, ratio in MEAN]),
    ("{reload_target: 1, envelope: [[1/450, 2200], [1/300, 3600], [1/120, 6590], [1/75, 9100], [1/30, 13300], "
     "[1/20, 10600], [1/15, 9000]]}",
     [(1 / 450, 2200), (1 / 300, 3600), (1 / 120, 6590), (1 / 75, 9100), (1 / 30, 13300), (1 / 20, 10600),
      (1 / 15, 9000)]),
])
def test_points_of_an_envelope(tmp_path, wall, points):
    """To 1 %, first in one push, then as the first cycle of each drift; the third cycle returns to them, because walls
    reload to the largest drift so far.
    """
    for cycles in (0, 3):
        bay = Rack(tmp_path, wall)
        for drift, shear in points:
            if shear:
                turns = [sign * drift for _ in range(cycles) for sign in (1, -1)] + [drift]
                assert bay.path(0.0, turns[0], step=5e-4)[-1][1] == pytest.approx(shear * LENGTH, rel=0.01)
                assert bay.path(*turns, 0.0, step=5e-4)
                assert bay.path(0.0, drift, step=5e-4)[-1][1] == pytest.approx(shear * LENGTH, rel=0.01)


def test_energy_of_the_first_loading(tmp_path):
    """Area under the backbone to its end: F (d_c + d_u) / 2 less the triangle before yielding."""
    bay = bay_of(tmp_path)
    bay.path(0, 0.105)
    area = HEIGHT * (STRENGTH * (SOFTENING + ULTIMATE) / 2 - STRENGTH * YIELD / 2)
    assert queries.energy()["joint_yield"] == pytest.approx(area, rel=5e-3)


def test_code_criteria_of_the_multiplier():
    """A wall of multiplier 2.5 has 4.9 kN/m, by the four criteria of its test: two thirds of the largest load, the load
    at 1/150, ductility 0.2 sqrt(2 mu - 1) times the plateau with mu to the drift at 80 % of the load, and yielding."""
    allowable = 4900 * LENGTH
    at_80 = ULTIMATE - 0.8 * (ULTIMATE - SOFTENING)
    ductility = 0.2 * math.sqrt(2 * at_80 / YIELD - 1) * STRENGTH
    assert [STRENGTH * 2 / 3, backbone(1 / 150), ductility] == pytest.approx([allowable] * 3, rel=0.01)
    assert backbone(YIELD) > allowable


def largest_shear_of_cycles(bay, drift):
    """In each of three cycles. [N]"""
    shears = []
    for _ in range(3):
        shears.append(bay.path(0.0, drift, step=5e-4)[-1][1])
        bay.path(drift, -drift, 0.0, step=5e-4)
    return shears


@pytest.mark.parametrize("drift", [1 / 100, 1 / 50, 1 / 30])
def test_loss_by_cycles(tmp_path, drift):
    """Reloading begins at 0.65 of the slack and aims at 1.1 times the largest drift; tests lose 5 to 15 %. To 1 %, as
    the envelope."""
    bay = bay_of(tmp_path, level="mean")
    allowable = 4900 * LENGTH
    envelope = lambda theta: allowable * float(np.interp(theta, *np.transpose([(0, 0), *MEAN])))
    friction, first = 0.28 * allowable, envelope(drift)
    stiffness = 1.4 * 120 * allowable
    start = max(friction / stiffness, 0.65 * (drift - (first - friction) / stiffness))
    slope = (envelope(1.1 * drift) - friction) / (1.1 * drift - start)
    later = friction + slope * (drift - start)
    assert largest_shear_of_cycles(bay, drift) == pytest.approx([first, later, later], rel=0.01)
    assert 0.84 < later / first < 0.97
    unloaded = stiffness * drift - later  # on the way back from the other side
    assert bay.drift(0.0) == pytest.approx(min(friction, unloaded), rel=0.01)


@pytest.mark.parametrize("amplitude", [1 / 60, 1 / 30])
def test_area_of_the_loops(tmp_path, amplitude):
    """Third cycle: the area between the lines of the law, in closed form (theory, walls)."""
    bay = bay_of(tmp_path, "{multiplier: 2.5, reload_target: 1, friction_force: 1000}")
    bay.path(0, amplitude, -amplitude, amplitude)
    before = queries.energy()["joint_yield"]
    bay.path(amplitude, -amplitude, amplitude)
    friction, back = 1000 * LENGTH, (STRENGTH + 1000 * LENGTH) / STIFFNESS
    start = 0.65 * (amplitude - (STRENGTH - friction) / STIFFNESS)
    half = (back * (friction - STRENGTH) / 2 + friction * (start + amplitude - back)
            + (amplitude - start) * (friction + STRENGTH) / 2)
    assert queries.energy()["joint_yield"] - before == pytest.approx(2 * half * HEIGHT, rel=5e-3)


def test_history_is_saved(tmp_path):
    """A saved and loaded wall goes on as the one that was not: the same force and the same history, to the last bit."""
    bay = bay_of(tmp_path)
    bay.path(0, 1 / 40, -1 / 60, 0, step=5e-4)
    O.save(str(tmp_path / "wall.yade"))
    ahead = bay.path(0, 1 / 50, step=5e-4), bay.beams.cycles
    O.load(str(tmp_path / "wall.yade"))
    bay.joints = O.engines[1]
    bay.beams, bay.columns = bay.joints.joints
    assert (bay.path(0, 1 / 50, step=5e-4), bay.beams.cycles) == ahead
    assert bay.beams.cycles[0]["largest"][0] == pytest.approx(HEIGHT / 40, rel=1e-3)


def test_residual_strength(tmp_path):
    """Mortar keeps 30 % of its largest shear at any drift, in both directions."""
    bay = bay_of(tmp_path, "{envelope: [[0.015, 9000], [0.054, 2700]], residual_share: 0.3, reload_target: 1}")
    for drift in (0.08, -0.1, 0.09):
        assert bay.path(0.0, drift, step=5e-4)[-1][1] == pytest.approx(np.sign(drift) * 2700 * LENGTH, rel=0.01)
    assert not bay.joints.breaks


@pytest.mark.parametrize("amplitude", [1 / 60, 1 / 45, 1 / 30])
def test_damping_of_the_loops(tmp_path, amplitude):
    """Law slip, second cycle: the friction part alone dissipates, 4 phi F (a - y), which is (2 / pi) phi (1 - y / a) of
    equivalent damping. Published for timber structures with slip: 0.2 (1 - 1 / sqrt(mu)) (Notification 1457 of 2000),
    mu = a / y; they agree within 0.01."""
    bay = bay_of(tmp_path, "{multiplier: 2.5, friction_share: 0.2}")
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
    bay = bay_of(tmp_path)
    shear = bay.drift(1 / 150)
    assert abs(bay.column_force()) == pytest.approx(0.5 * shear * HEIGHT / LENGTH, rel=1e-3)
    assert bay.column_force() > 0


@pytest.mark.parametrize("opening, ratio", [("window", 0.4), ("door", 0.2)])
def test_openings(tmp_path, opening, ratio):
    bay = bay_of(tmp_path, opening=opening)
    assert bay.drift(1 / 150) == pytest.approx(ratio * STIFFNESS / 150, rel=1e-3)


def test_no_force_across_the_wall(tmp_path):
    """Everything above the columns moves across the wall, and down by 1 cm."""
    bay = bay_of(tmp_path)
    for element, body in zip(bay.model.elements, O.bodies):
        if element.kind in ("beam", "roof"):
            body.state.pos = body.state.refPos + Vector3(0, 0.05, -0.01)
    O.step()
    assert bay.beams.forces[0].norm() < 1e-20
