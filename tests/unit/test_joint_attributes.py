# SPDX-License-Identifier: GPL-2.0-or-later
"""Attributes of a joint in its engine's set: values read are of the last step, values set count in the next one."""
import os
import tempfile

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate
from yade import O
from yade_timber.scene.engines import find_engine


def hung(**options):
    """A column that is joined to a plate and moves away from it: its state and the joint, with a stretch of each
    spring.
    """
    column = column_on_plate(gravity=(0, 0, 0), **options)[1]
    yt.set_velocity(O.bodies[column], (0.01, 0.02, 0.5))
    O.run(20, True)
    return O.bodies[column].state, find_engine(yt.JointEngine).joints[0]


def stretched(joint):
    """Stretches of the springs at the present positions. The next step computes with them. [m]"""
    one, two = (O.bodies[i].state for i in (joint.id1, joint.id2))
    return [two.pos + two.ori * b - one.pos - one.ori * a for a, b in zip(joint.anchors1, joint.anchors2)]


def step_agrees(joint):
    """Makes a step. Whether the joint's stretches are those of its start, to rounding (coordinates of some m)."""
    wanted = stretched(joint)
    O.step()
    return len(joint.stretches) == len(wanted) and all((v - w).norm() < 1e-13 for v, w in zip(joint.stretches, wanted))


def test_read_after_each_step():
    joint = hung()[1]
    for _ in range(3):
        assert step_agrees(joint) and joint.stretches[0].norm() > 1e-4
        assert joint.forces == [joint.kn * s for s in joint.stretches]
        assert [spring["force"] for spring in joint.springs] == joint.forces == joint.dict()["forces"]
        assert joint.load == pytest.approx(max(f.norm() for f in joint.forces) / joint.strength, rel=1e-12)


def test_set_between_steps():
    """Each change counts in the next step; the forces of the last one stay readable."""
    joint = hung()[1]
    forces = joint.forces
    joint.kn = joint.ks = 2 * joint.kn
    assert joint.forces == forces
    O.step()
    assert joint.forces == [joint.kn * s for s in joint.stretches] and joint.forces[0].norm() > 1.5 * forces[0].norm()
    joint.anchors2 = [a + (0, 0, 0.001) for a in joint.anchors2]
    assert step_agrees(joint)
    joint.broken = [0, 1, 0, 0]
    forces = joint.forces
    assert forces[1].norm() == 0 and forces[2].norm() > 0
    O.step()
    assert joint.forces[1].norm() == joint.stretches[1].norm() == 0 and joint.forces[2].norm() > forces[2].norm()
    joint.perJoint = True
    O.step()
    assert joint.forces == [joint.kn / 4 * s for s in joint.stretches]


def test_law_and_body_set_between_steps():
    state, joint = hung()
    joint.updateAttrs(
        {"law": "slip", "strength": 1.0, "softeningStretch": 0.1, "ultimateStretch": 0.2, "frictionShare": 1.0})
    O.run(10, True)
    assert max(f.norm() for f in joint.forces) == pytest.approx(1.0, rel=1e-9) and joint.largestStretches[0] > 0
    joint.updateAttrs({"law": "brittle", "strength": 1e9})
    O.run(2, True)  # in the first step it is still solved with the contacts, as a joint that yields fast
    assert joint.forces == [joint.kn * s for s in joint.stretches]
    other = O.bodies.append(yt.box((0.1, 0.1, 0.1), (5, 0, 0), fixed=True))
    joint.id1 = other
    assert step_agrees(joint) and joint.stretches[0].norm() > 4


def test_envelope_set_between_steps():
    """Points in place of the straight lines; with perJoint each of the four springs has a quarter of their forces. They
    are saved. The joint yields fast: its force is the mean of a step, in which the law falls by less than 2e-3.
    """
    state, joint = hung()
    O.run(10, True)
    stretch = max(s.norm() for s in joint.stretches)
    points = [(stretch / 8, stretch * joint.kn / 16), (stretch / 2, stretch * joint.kn / 8), (10 * stretch, 0)]
    joint.updateAttrs({"law": "slip", "strength": points[1][1], "envelope": points})
    O.step()
    length = joint.stretches[0].norm()
    force = points[1][1] * (points[2][0] - length) / (points[2][0] - points[1][0])
    assert joint.forces[0].norm() == pytest.approx(force, rel=2e-3)
    joint.perJoint = True
    O.step()
    length = joint.largestStretches[0]
    assert joint.forces[0].norm() == pytest.approx(
        points[1][1] / 4 * (points[2][0] - length) / (points[2][0] - points[1][0]), rel=2e-3)
    forces = joint.forces
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yade")
        O.save(path)
        O.load(path)
    joint = find_engine(yt.JointEngine).joints[0]
    assert [tuple(point) for point in joint.envelope] == points and joint.forces == forces


def test_saved_with_the_forces_of_the_last_step():
    joint = hung()[1]
    forces, stretches, load = joint.forces, joint.stretches, joint.load
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yade")
        O.save(path)
        O.load(path)
    joint = find_engine(yt.JointEngine).joints[0]
    assert (joint.forces, joint.stretches, joint.load) == (forces, stretches, load)


def test_joint_that_is_appended_during_a_run():
    joint = hung()[1]
    forces = joint.forces
    other = yw.TimberJoint(id1=joint.id1, id2=joint.id2, anchors1=joint.anchors1[:1], anchors2=joint.anchors2[:1],
                           kn=1e3, ks=1e3, strength=1e9)
    find_engine(yt.JointEngine).append(other)
    assert joint.forces == forces and other.forces[0].norm() == 0
    O.step()
    assert other.stretches == joint.stretches[:1] and other.forces == [1e3 * joint.stretches[0]]


def test_forces_are_read_only():
    joint = hung()[1]
    for name in ("forces", "stretches"):
        with pytest.raises(AttributeError, match="read-only"):
            setattr(joint, name, [])
