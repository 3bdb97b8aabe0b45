# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies that fall on a plate at the default step: points, edges, faces and the foot of a column, in every phase of the
step.

The restitution of one point with Hertz's spring and a critical dashpot is 0.1196 (docs/theory.md). Points of a face
share the impulse with a softness of 0.02: up to 0.02 more. Several dashpots of a face dissipate more, so that faces may
leave slower.
"""
import itertools

import numpy as np
import pytest
import yade_timber as yt
from cases import turned
from yade import O
from yade.minieigenHP import Vector3

STEP = 5e-4
"""Default step of scripts. [s]"""
POINT, SOFTNESS = 0.1196, 0.02
QUARTER = np.pi / 4
CORNER = float(np.arctan(np.sqrt(2)))
"""Angle by which a cube is turned about a diagonal of its face to stand on a corner. [rad]"""
SHAPES = {
    "cube on its face": ((0.2, 0.2, 0.2), None),
    "cube on an edge": ((0.2, 0.2, 0.2), turned((1, 0, 0), QUARTER)),
    "cube on a corner": ((0.2, 0.2, 0.2), turned((1, -1, 0), CORNER)),
    "column on its foot": ((0.105, 0.105, 2.73), None),
    "beam on its side": ((3.64, 0.105, 0.12), None),
    "brace on its side": ((1.8, 0.045, 0.09), None),
}


def corners(body):
    """Corners of the core, body frame: those of the box, moved inwards by the radius. [m]"""
    half = [max(vertex[axis] for vertex in body.shape.vertices) - body.shape.radius for axis in range(3)]
    return [Vector3(*(np.array(signs) * half)) for signs in itertools.product((-1, 1), repeat=3)]


SPEEDS = (0.1, 0.3, 1.0, 3.0, 10.0)
"""[m/s]"""
PHASES = np.arange(8) / 8 + 0.01
"""Part of a step by which the gap exceeds three steps' way. [-]"""


def bounce(extents, orientation, speed, phase, step=STEP, ratio=1.0):
    """(restitution, energy after over energy before, least dissipation of a step over it, unconverged steps) of a fall
    without gravity.
    """
    O.reset()
    O.bodies.append(yt.box((6, 6, 0.4), (0, 0, -0.2), fixed=True))
    body = yt.box(extents, (0, 0, 0), orientation)
    lowest = min((body.state.ori * vertex)[2] for vertex in corners(body)) - body.shape.radius
    body.state.pos = (0, 0, -lowest + speed * step * (3 + phase))
    O.bodies.append(body)
    O.dt, O.engines = step, yt.engines(gravity=(0, 0, 0), damping_ratio=ratio)
    yt.set_velocity(body, (0, 0, -speed))
    forces = next(engine for engine in O.engines if isinstance(engine, yt.ContactForces))
    before, terms, least = body.state.mass * speed**2 / 2, np.zeros(3), 0.0
    for _ in range(400):
        O.step()
        now = np.array([forces.dashpotNormal, forces.dashpotShear, forces.friction])
        least, terms = min(least, (now - terms).min()), now
        if O.iter > 4 and body.state.vel[2] > 0 and not yt.contacts(0, 1):
            break
    return body.state.vel[2] / speed, yt.energy()["kinetic"] / before, least / before, forces.unconverged


@pytest.mark.parametrize("shape", SHAPES)
def test_never_faster_than_one_point(shape):
    results = np.array([bounce(*SHAPES[shape], speed, phase) for speed in SPEEDS for phase in PHASES])
    restitution, energy, least, unconverged = results.T
    print(
        f"\n{shape}: restitution {restitution.min():.3f} to {restitution.max():.3f}, sweeps without convergence "
        f"{unconverged.sum():.0f}"
    )
    assert restitution.max() <= POINT + SOFTNESS
    assert restitution.min() >= -1e-3  # it leaves, or stays
    assert energy.max() <= (POINT + SOFTNESS) ** 2 * 1.01  # rotations included; of rounding of the shapes
    assert least.min() >= -1e-9
    assert unconverged.sum() == 0


def test_one_point_has_the_exact_restitution():
    restitution = [bounce(*SHAPES["cube on a corner"], speed, phase)[0] for speed in SPEEDS for phase in PHASES]
    assert restitution == pytest.approx([POINT] * len(restitution),
                                        abs=2e-3)  # of the closed form's digits and the rounding of the corner


@pytest.mark.parametrize("ratio", [0.1165, 0.3])
def test_faces_with_light_damping_rebound_to_the_closed_form(ratio):
    """A cube that falls on its face from 20 heights: the four points have four times the response of one, so that the
    ratio in the closed form is ratio (4 x 1.2)^1/2. The points share the impulse with the softness.
    """
    damping = ratio * np.sqrt(4 * 1.2)
    exact = np.exp(-2 * damping * np.arccos(damping) / np.sqrt(1 - damping**2))
    speeds = np.sqrt(2 * 9.81 * np.geomspace(0.02, 1.0, 20))
    phases = np.resize(PHASES, len(speeds))
    restitution = np.array([bounce((0.3, 0.3, 0.3), None, *at, ratio=ratio)[0] for at in zip(speeds, phases)])
    print(f"\nratio {ratio}: exact {exact:.4f}, mean {restitution.mean():.4f}, highest {restitution.max():.4f}")
    assert restitution.mean() == pytest.approx(exact, abs=SOFTNESS)
    assert restitution.max() <= exact + SOFTNESS


@pytest.mark.parametrize("size", [0.005, 0.02, 0.1])
def test_no_step_lets_a_cube_gain_energy(size):
    """Cubes that turn, at steps in which they move by up to their size. The energy after the impact is at most that
    before; 1e-6: the sweeps' tolerance.
    """
    for step in (1e-4, 5e-4, 2e-3, 5e-3):
        for speed in (0.05, 1.0, 4.0):
            if speed * step > size:
                continue
            for orientation in (None, turned((1, 0.3, 0), 0.2), turned((1, 1, 0.5), 0.7)):
                for phase in (0.01, 0.51):
                    _, energy, least, _ = bounce((size, size, size), orientation, speed, phase, step)
                    assert energy <= 1 + 1e-6 and least >= -1e-9, (step, speed, phase)
