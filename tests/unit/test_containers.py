# SPDX-License-Identifier: GPL-2.0-or-later
"""None in YADE's lists, which ends the process there; colliders of the user's own; the same joint given twice; the
default time step.
"""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate, is_one_line, refused
from yade import O
from yade_timber.scene.engines import find_engine

yt.guard()


def loop_of(geometry=(), physics=(), law=()):
    return yw.InteractionLoop(list(geometry), list(physics), list(law))


@pytest.mark.parametrize("name, build", [
    ("O.engines[0]", lambda: setattr(O, "engines", [None])),
    ("O.engines[9]", lambda: setattr(O, "engines", [*O.engines, None])),
    ("ParallelEngine", lambda: yw.ParallelEngine([None])),
    ("ParallelEngine", lambda: yw.ParallelEngine([[yw.ForceResetter(), None]])),
    ("ParallelEngine.slaves[0]", lambda: setattr(yw.ParallelEngine(), "slaves", [None])),
    ("ParallelEngine.slaves[0]", lambda: yw.ParallelEngine().updateAttrs({"slaves": [None]})),
    ("InteractionLoop", lambda: loop_of([None])),
    ("InteractionLoop", lambda: loop_of(physics=[None])),
    ("InteractionLoop", lambda: loop_of(law=[None])),
    ("InteractionLoop.callbacks[0]", lambda: setattr(loop_of(), "callbacks", [None])),
    ("IGeomDispatcher", lambda: yw.IGeomDispatcher([None])),
    ("LawDispatcher.functors[0]", lambda: setattr(yw.LawDispatcher(), "functors", [None])),
    ("IPhysDispatcher.functors[0]", lambda: yw.IPhysDispatcher().updateAttrs({"functors": [None]})),
    ("BoundDispatcher", lambda: yw.BoundDispatcher([None])),
    ("InsertionSortCollider", lambda: yw.InsertionSortCollider([None])),
    ("InsertionSortCollider", lambda: yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb(), None])),
    ("O.bodies.append", lambda: O.bodies.append(None)),
    ("O.bodies.append", lambda: O.bodies.append([yt.box((1, 1, 1), (0, 0, 5)), None])),
])
def test_none(name, build):
    column_on_plate()
    count = len(O.bodies)
    with pytest.raises(ValueError) as error:
        build()
    is_one_line(error, name, "None")
    assert len(O.bodies) == count
    O.step()


def with_collider(collider):
    """The column, with this collider in place of the package's."""
    _, column = column_on_plate()
    O.engines = [collider if isinstance(e, yw.CollisionTrigger) else e for e in O.engines]
    return O.bodies[column]


@pytest.mark.parametrize("wrapped", [False, True])
@pytest.mark.parametrize("distance", [0.05, 1e-3, -0.5, 0])
def test_own_collider(distance, wrapped):
    """YADE's margin needs a NewtonIntegrator; without a sphere a negative one, YADE's default, is none."""
    collider = yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb()], verletDist=distance)
    column = with_collider(yw.CollisionTrigger(collider=collider) if wrapped else collider)
    if distance > 0:
        return refused("O.engines", "InsertionSortCollider.verletDist", "must be 0")
    O.run(500, True)
    assert abs(column.state.pos[2] - 0.5) < 1e-4


def test_the_same_joint_connected_twice():
    """Also with the bodies swapped, and slightly moved; a broken one may be replaced, another one added."""
    plate, column = column_on_plate()
    corners = [(x, y, 0) for x in (-0.05, 0.05) for y in (-0.05, 0.05)]
    for bodies in ((plate, column), (column, plate)):
        with pytest.raises(ValueError) as error:
            yt.connect(*bodies, corners)
        is_one_line(error, f"connect: bodies {bodies[0]} and {bodies[1]} have the same joint")
    yt.connect(plate, column, corners, stiffness=(1e4, 1e4))
    yt.connect(plate, column, [(x, y, 0.5) for x, y, _ in corners])
    first = find_engine(yw.JointEngine).joints[0]
    first.broken = [1, 1, 1, 1]
    yt.connect(plate, column, corners)
    O.step()


def test_the_same_joint_in_two_engines():
    column_on_plate()
    engine, other = find_engine(yw.JointEngine), yw.JointEngine(dead=True)
    other.append(engine.joints[0])
    O.engines = [*O.engines[:4], other, *O.engines[4:]]
    engine.joints[0].kn = 1e4
    refused("JointEngine.joints[0]", "another JointEngine")


def test_step_that_was_never_set(tmp_path, capfd):
    """One line for each list of engines and each loaded scene, and when it is set to YADE's default."""

    def said():
        O.run(3, True)
        return capfd.readouterr().err.count("O.dt = 1e-08 s is YADE's default")

    O.reset()
    O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
    O.engines = yt.engines()
    O.save(str(tmp_path / "scene.xml"))
    assert (said(), said()) == (1, 0)
    O.save(str(tmp_path / "later.xml"))
    for name in ("scene", "later"):
        O.load(str(tmp_path / f"{name}.xml"))
        assert (said(), said()) == (1, 0)
    O.dt = 1e-4
    assert said() == 0
    O.dt = 1e-8
    assert (said(), said()) == (1, 0)
    O.reset()
    O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
    O.dt, O.engines = 1e-4, yt.engines()
    assert said() == 0 and math.isclose(O.dt, 1e-4)
