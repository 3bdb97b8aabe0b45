# SPDX-License-Identifier: GPL-2.0-or-later
"""What the summary tells about damage: fallen and loose columns, breaks by place, when a lean began, when strong shaking sets in."""
import math
from types import SimpleNamespace

import numpy as np
import pytest
import yade.wrapper as yw
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade_timber.run import recorder
from yade_timber.run import summary as results
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene
from yade_timber.motion import GroundMotion, default_motion, onset


@pytest.fixture(scope="module")
def house():
    """House A with a column on its side, one without joints, and one joint on the west side broken."""
    model = scenario.build(scenario.Scenario("damage", "A"))
    columns = [k for k, element in enumerate(model.elements) if element.kind == "column"]
    lying, loose = columns[0], columns[1]
    O.bodies[lying].state.ori = Quaternion(Vector3.UnitX, math.radians(60)) * O.bodies[lying].state.ori
    joints = scene.find_engine(yw.JointEngine).joints
    west = next(k for k, spec in enumerate(model.joints) if "west" in spec.side and spec.storey == 1 and spec.kind == "column_beam" and spec.group == "main" and lying not in (joints[k].id1, joints[k].id2))
    for k, joint in enumerate(joints):
        if k == west or loose in (joint.id1, joint.id2):
            joint.broken = [1] * len(joint.broken)
    return model


def test_columns(house):
    assert results.count_columns(house) == {"total": 90, "fallen": 1, "loose": 1}


def test_by_place(house):
    """Every place counts what the lists count; nothing is broken by the second storey."""
    broken = results.count_broken(house)
    assert broken["by_place"]["1"]["west"]["column_beam"] >= 1 and set(broken["by_place"]) == set(broken["by_storey"])
    for storey, sides in broken["by_place"].items():
        assert max(side["total"] for side in sides.values()) <= broken["by_storey"][storey] <= sum(side["total"] for side in sides.values())


def monitor(drifts, tilt):
    """Stand-in for a HouseMonitor with samples of storey 1's N-S drift every second."""
    columns = ["time [s]", "drift_ns1 [-]", "drift_ew1 [-]"]
    return SimpleNamespace(columns=lambda: columns, rows=[x for k, d in enumerate(drifts) for x in (float(k), d, 0.0)], tiltTime=tilt, tiltDirection="ns")


def test_leans_from():
    """The last sample with another sign before the tilt; the start when there is none; None without a tilt."""
    assert results.leans_from(monitor([0.0, 0.02, -0.01, 0.03, 0.06, 0.11, 0.3], tilt=5.0)) == 2.0
    assert results.leans_from(monitor([0.0, 0.01, 0.05, 0.11], tilt=3.0)) == 0.0
    assert results.leans_from(monitor([0.0, 0.01], tilt=math.nan)) is None


def test_residual_drift():
    """The mean of the last second, without its sign; the first storey's N-S, then E-W."""
    swaying = monitor([0.3] * 3 + [-0.02, -0.04], tilt=math.nan)
    assert results.residual_drift(swaying) == pytest.approx([0.04, 0.0])
    swaying.rows = [x for k, d in enumerate([0.3, 0.1, -0.02, -0.04]) for x in (0.5 * k, d, -d / 2)]
    assert results.residual_drift(swaying) == pytest.approx([0.03, 0.015])
    assert results.residual_drift(monitor([], tilt=math.nan)) == []


def test_by_storey():
    assert results.by_storey([0.1, 0.2, math.nan, 0.4]) == {"storey1": {"ns": 0.1, "ew": 0.2}, "storey2": {"ns": None, "ew": 0.4}}


def test_motion_as_applied():
    """Summary and frames tell the motion times its scale, each component under its name."""
    motion = GroundMotion(0.01, np.outer(np.sin(np.arange(100)), [1.0, 2.0, 3.0]))  # ew, ns, ud
    shaken = scenario.Scenario("scaled", "A", motion, scale=0.5, dt=5e-4)
    scenario.build(shaken)
    assert results.record_of(shaken)["pga_gal"] == pytest.approx({"ew": 50, "ns": 100, "ud": 150}, rel=1e-3)
    assert np.allclose(recorder.describe_motion().acceleration, 0.5 * motion.acceleration)


def test_onset():
    """A twentieth of the Arias intensity: of a steady motion from 10 s to 20 s, at 10.5 s."""
    shaking = np.where((np.arange(3000) * 0.01 >= 10) & (np.arange(3000) * 0.01 < 20), 1.0, 0.0)
    assert onset(GroundMotion(0.01, np.column_stack([shaking, 0 * shaking, 0 * shaking]))) == pytest.approx(10.5, abs=0.02)
    assert onset(GroundMotion(0.01, np.zeros((100, 3)))) is None
    assert 18.0 < onset(default_motion()) < 19.5
