# SPDX-License-Identifier: GPL-2.0-or-later
"""The promises of docs/mechanics.md that no row of its table shows."""
import pytest
import yade.wrapper as yw
import yade_timber as yt
from mechanics import joints, loads
from mechanics.programs import timber

O = yw.Omega()
G = 9.81


def block_on_pier():
    """A block that has rested for 5 s on a pier, a fixed body. Returns the ids."""
    O.reset()
    pier, block = yt.box((0.5, 0.5, 1), (0, 0, -0.5), fixed=True), yt.box((0.3,) * 3, (0, 0, 0.15))
    ids = O.bodies.append([pier, block])
    O.dt, O.engines = 5e-4, yt.engines()
    for _ in range(10000):
        O.step()
    return ids


def test_nothing_sleeps():
    """After 5 s of rest a block whose support is taken away falls freely from the next step on."""
    pier, block = block_on_pier()
    before = O.bodies[block].state.pos[2]
    O.bodies.erase(pier)
    for _ in range(200):
        O.step()
    assert before - O.bodies[block].state.pos[2] == pytest.approx(G * 0.1**2 / 2, rel=0.01)  # 1 of 200 steps


def test_nothing_is_braked():
    """A free body keeps its velocity to the last bit, however slow it is."""
    O.reset()
    O.dt, O.engines = 5e-4, yt.engines(gravity=(0, 0, 0))
    block = O.bodies.append(yt.box((0.3,) * 3, (0, 0, 0)))
    yt.set_velocity(block, (1e-6, 0, 3.0))
    for _ in range(5000):
        O.step()
    assert tuple(O.bodies[block].state.vel) == (1e-6, 0, 3.0)


@pytest.mark.parametrize("dt", timber.program().steps)
def test_strength_of_a_joint_is_a_force(dt):
    """A strength per step would take 1000 N times the step and more from the hammer; the energy to break is 5 mJ."""
    (scene,) = joints.struck(timber.RADIUS)
    assert joints.taken_impulse(timber.run(scene, dt)) <= 0.01


@pytest.mark.parametrize("scenes, bound", [(loads.both_orders, 0.2), (loads.with_removed, 0.0)])
def test_order_and_removed_bodies_do_not_matter(scenes, bound):
    """Six cubes that are struck [mm]: twice what the solver's tolerance makes of another order; the same bits else."""
    assert loads.difference(*(timber.run(scene, 5e-4) for scene in scenes(timber.RADIUS))) <= bound


def test_reported_forces_add_up():
    """Three blocks in a stack: each pair carries what lies above it, and the floor all of it."""
    O.reset()
    O.dt, O.engines = 5e-4, yt.engines()
    ids = [O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))]
    ids += [O.bodies.append(yt.box((0.4 - 0.1 * k, 0.4, 0.2), (0, 0, 0.1 + 0.2 * k))) for k in range(3)]
    for _ in range(4000):
        O.step()
    weights = [O.bodies[body].state.mass * G for body in ids[1:]]
    for k, (lower, upper) in enumerate(zip(ids, ids[1:])):
        carried = sum(point["normal_force"] for point in yt.contacts(lower, upper))
        assert carried == pytest.approx(sum(weights[k:]), rel=1e-6)
    assert O.forces.f(ids[0])[2] == pytest.approx(-sum(weights), rel=1e-6)
