# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage in a house of the scene: fallen and loose columns, broken joints by place, events, the motion as applied."""
import math

import numpy as np
import pytest
import yade.wrapper as yw
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from timber_houses.motion import GroundMotion, default_motion, onset
from timber_houses.recording.events import Collapse, ColumnsLost, Tilt
from timber_houses.recording.summary_parts import Columns
from timber_houses.run import observer
from timber_houses.run.progress import Bar, Status
from timber_houses.run.plan import record
from timber_houses.scene import scenario
from yade_timber.scene import engines


@pytest.fixture(scope="module")
def house():
    """Observer of house A with a column on its side, one without joints, and one joint on the west side broken."""
    model = scenario.build(scenario.Scenario("damage", "A"))
    columns = [k for k, element in enumerate(model.elements) if element.kind == "column"]
    lying, loose = columns[0], columns[1]
    O.bodies[lying].state.ori = Quaternion(Vector3.UnitX, math.radians(60)) * O.bodies[lying].state.ori
    joints = engines.find_engine(yw.JointEngine).joints
    west = next(k for k, spec in enumerate(model.joints) if "west" in spec.side and spec.storey == 1
                and spec.kind == "column_beam" and spec.group == "main" and lying not in (joints[k].id1, joints[k].id2))
    for k, joint in enumerate(joints):
        if k == west or loose in (joint.id1, joint.id2):
            joint.broken = [1] * len(joint.broken)
    return observer.Observer(model)


def test_columns(house):
    assert house.survey.count_columns(house.state()) == Columns(90, 1, 1)


def test_by_place(house):
    """Totals, sides and storeys agree; nothing is broken in the second storey."""
    broken = house.survey.count_broken(house.state(), springs=0)
    assert broken.by_place["1"]["west"].column_beam >= 1 and set(broken.by_place) == set(broken.by_storey)
    for storey, sides in broken.by_place.items():
        totals = [side.total for side in sides.values()]
        assert max(totals) <= broken.by_storey[storey] <= sum(totals)
    assert broken.total == sum(broken.by_storey.values())
    assert house.survey.count_joints().total == len(house.model.joints)


def test_broken_joints_agree_with_the_engine(house):
    found = house.survey.count_broken(house.state(), springs=0)
    assert found.total == sum(joint.isBroken for joint in engines.find_engine(yw.JointEngine).joints)
    assert found.partly_broken == 0


def test_lost_columns_are_an_event(house):
    house.observe(O.time)
    assert [event.facts for event in house.log.sorted()] == [ColumnsLost(2, 90)]


def test_events_are_printed_once(house, capsys):
    """A line for each event of the log, unless the run is quiet; events known from a checkpoint are not repeated."""
    house.log.add(0.5, Tilt("ns"))
    with Bar("A", 30.0, 0.0, False, Status(house)) as shown, Bar("A", 30.0, 0.0, True, Status(house)) as quiet:
        house.log.add(1.25, Collapse())
        for progress in (shown, shown, quiet):
            progress.advance(1.25)
    lines = [line for line in capsys.readouterr().err.replace("\r", "\n").splitlines() if " s  " in line]
    assert lines == ["   1.25 s  collapse: a floor has come down by half a storey"]


def test_motion_as_applied():
    """Summary and frames give the motion times its scale, each component under its name."""
    motion = GroundMotion(0.01, np.outer(np.sin(np.arange(100)), [1.0, 2.0, 3.0]))  # ew, ns, ud
    shaken = scenario.Scenario("scaled", "A", motion, scale=0.5, dt=5e-4)
    scenario.build(shaken)
    assert record(motion, shaken.scale, shaken.dt).pga_gal == pytest.approx({"ew": 50, "ns": 100, "ud": 150}, rel=1e-3)
    assert np.allclose(observer.describe_motion().acceleration, 0.5 * motion.acceleration)


def test_onset():
    """5 % of the Arias intensity: of a steady motion from 10 s to 20 s, at 10.5 s."""
    shaking = np.where((np.arange(3000) * 0.01 >= 10) & (np.arange(3000) * 0.01 < 20), 1.0, 0.0)
    assert onset(GroundMotion(0.01, np.column_stack([shaking, 0 * shaking, 0 * shaking]))) == pytest.approx(
        10.5, abs=0.02)
    assert onset(GroundMotion(0.01, np.zeros((100, 3)))) is None
    assert 18.0 < onset(default_motion()) < 19.5
