# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces on fixed bodies as YADE's functions read them, and permanent forces."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O, utils
from yade.minieigenHP import Vector3
from yade_timber.plugin import compiled

UP = (0, 0, 1)
G = 9.81


def weight(*ids):
    return G * sum(O.bodies[k].state.mass for k in ids)


def plate(**options):
    O.reset()
    ground = O.bodies.append(yt.box((2, 2, 0.2), (0.1, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.2, 0.2, 0.2), (-0.4, 0.2, 0.1)))
    post = O.bodies.append(yt.box((0.12, 0.12, 1), (0.5, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines(**options)
    return ground, block, post


def corners(x):
    return [(x + a, b, 0) for a in (-0.05, 0.05) for b in (-0.05, 0.05)]


@pytest.mark.parametrize("joint", [None, {}, {"damping_ratio": 0.5}, {"stiffness": (1e9, 1e9), "strength": math.inf}])
@pytest.mark.parametrize("dt, options", [(1e-4, {}), (1e-5, {"sweeps": 0}), (1e-4, {"skip_rest": 100})])
def test_force_and_torque_on_a_plate(joint, dt, options):
    """The weight on it, and its moment about the plate's centre."""
    ground, block, post = plate(**options)
    O.dt = dt
    if joint is not None:
        yt.connect(ground, post, corners(0.5), **joint)
    O.run(round({"skip_rest": 2.5, "sweeps": 0.3}.get(next(iter(options), ""), 0.5) / dt), True)
    loads = [(O.bodies[k].state.pos - O.bodies[ground].state.pos, Vector3(0, 0, -weight(k))) for k in (block, post)]
    total = weight(block, post)
    assert (O.forces.f(ground) + Vector3(0, 0, total)).norm() < 1e-5 * total  # rest of the settling
    assert utils.sumForces([ground], UP) == pytest.approx(-total, rel=1e-5)
    assert (O.forces.t(ground) - sum((arm.cross(f) for arm, f in loads), Vector3.Zero)).norm() < 1e-5 * total
    assert O.forces.f(block).norm() < 1e-5 * total
    assert utils.unbalancedForce() < 1e-3


def test_forces_of_a_pair():
    """Their parts along and across the normal are those of its points, on a slope."""
    O.reset()
    ground = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0.1)))
    O.dt, O.engines = 1e-4, yt.engines(gravity=(3, 0, -9))
    O.run(3000, True)
    mass, phys = O.bodies[block].state.mass, O.interactions[ground, block].phys
    assert (phys.normalForce - Vector3(0, 0, 9 * mass)).norm() < 1e-5 * mass
    assert (phys.shearForce - Vector3(-3 * mass, 0, 0)).norm() < 1e-5 * mass
    points = yt.contacts(ground, block)
    assert sum(p["normal_force"] for p in points) == pytest.approx(phys.normalForce[2], rel=1e-12)
    O.bodies[block].state.pos += Vector3(0, 0, 2e-3)
    O.step()
    assert phys.normalForce.norm() == phys.shearForce.norm() == O.forces.f(ground).norm() == 0


def test_a_body_that_is_fixed_in_the_run():
    """It bears what is put on it."""
    ground, block, _ = plate()
    O.run(2000, True)
    O.bodies[block].dynamic = False
    O.run(2, True)
    before = O.forces.f(block)[2], O.forces.f(ground)[2]
    top = O.bodies.append(yt.box((0.2, 0.2, 0.2), (-0.4, 0.2, 0.3)))
    O.run(3000, True)
    assert before[0] - O.forces.f(block)[2] == pytest.approx(weight(top), rel=1e-5)
    assert O.forces.f(ground)[2] == pytest.approx(before[1], rel=1e-9)


def test_load_cell_under_many_islands():
    """Sum and bits do not depend on the number of threads."""
    found = []
    for threads in (1, 2):
        compiled.set_thread_count(threads)
        O.reset()
        cell = O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
        ids = [O.bodies.append(yt.box((0.1, 0.1, 0.1), (0.3 * i - 1, 0.3 * j - 1, 0.0501 + 1e-3 * i)))
               for i in range(6) for j in range(6)]
        O.dt, O.engines = 2e-4, yt.engines()
        forces = []
        for _ in range(60):
            O.run(5, True)
            forces += [*O.forces.f(cell), *O.forces.t(cell)]
        found.append([x.hex() for x in forces])
        O.run(2000, True)
        assert O.forces.f(cell)[2] == pytest.approx(-weight(*ids), rel=1e-5)
    assert found[0] == found[1]


@pytest.mark.parametrize("push", [lambda ground: O.forces.setPermF(ground, (0, 0, 500)), None])
def test_forces_on_a_moving_plate_do_no_work(push):
    """Neither a permanent force nor YADE's gravity, which acts on fixed bodies, too."""
    ground, block, post = plate()
    if push:
        push(ground)
    else:
        O.engines = [yw.GravityEngine(gravity=(0, 0, -G)) if isinstance(e, yw.UniformGravity) else e for e in O.engines]
    yt.set_velocity(O.bodies[ground], (0, 0, 0.05))
    O.run(5000, True)
    raised = weight(block, post) * 0.05 * O.time
    assert yt.energy()["imposed_velocity"] == pytest.approx(raised, rel=0.02)  # and the impact of the start
    assert abs(yt.energy_residual()) < 1e-6 * raised


# --- permanent forces -------------------------------------------------------------------------------------------------


def pushed(steps):
    """A block in the air, pushed and turned."""
    O.reset()
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    gone = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.5, 0, 0.5)))
    block = O.bodies.append(yt.box((0.2, 0.3, 0.2), (0, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines()
    O.forces.setPermF(gone, (9, 9, 9))
    O.forces.setPermF(block, (3, 0, 5))
    O.forces.setPermT(block, (0, 0.1, 0))
    O.bodies.erase(gone)
    if steps:
        O.run(steps, True)
    return block


@pytest.mark.parametrize("steps", [0, 1, 200])
def test_permanent_forces_are_saved(steps, tmp_path):
    """To the last bit, also if they were set before the first step, and saved again before the next one."""
    block = pushed(400)
    expected = [x.hex() for x in (*O.bodies[block].state.pos, *O.bodies[block].state.ori)]
    block = pushed(steps)
    for _ in range(2):
        O.save(str(tmp_path / "scene.xml"), quiet=True)
        O.reset()
        O.load(str(tmp_path / "scene.xml"), quiet=True)
    O.run(400 - steps, True)
    assert [x.hex() for x in (*O.bodies[block].state.pos, *O.bodies[block].state.ori)] == expected
    assert tuple(O.forces.permF(block)) == (3, 0, 5)


def test_permanent_forces_set_after_loading(tmp_path):
    """They replace those of the file."""
    block = pushed(20)
    O.save(str(tmp_path / "scene.xml"), quiet=True)
    O.load(str(tmp_path / "scene.xml"), quiet=True)
    O.forces.setPermF(block, (0, 1, 0))
    O.run(5, True)
    assert tuple(O.forces.permF(block)) == (0, 1, 0) and tuple(O.forces.permT(block)) == (0, 0, 0)
