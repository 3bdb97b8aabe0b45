# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's claims in short: B and C stand under snow, A alone falls when it is shaken strongly. The whole runs have the label paper."""
import math

import pytest
import yade.wrapper as yw
from yade import O
from yade_timber import scenario, scene
from yade_timber.claims import STILL
from yade_timber.motion import default_motion, trim

DT = 2e-4  # [s] the largest admissible one: nothing is compared closely here
START, END = 16.6, 26.0  # [s] of the default motion: strong shaking


def monitored(house, snow=0.0, motion=None, duration=1.0, until=lambda monitor: False):
    """HouseMonitor after `duration` [s], or once `until` holds."""
    scenario.build(scenario.Scenario("short", house, motion, snow_depth=snow, dt=DT, options={"track_energy": False}))
    monitor = scene.find_engine(yw.HouseMonitor)
    while O.time < duration and not until(monitor):
        O.run(250, True)
    return monitor


@pytest.mark.parametrize("house", ["B", "C"])
def test_braced_houses_stand_still_under_snow(house):
    monitor = monitored(house, snow=1.0, duration=2.0)
    assert max(monitor.peak) < STILL and math.isnan(monitor.collapseTime)
    assert not scene.find_engine(yw.JointEngine).breaks


def test_house_a_tilts_and_falls_when_shaken():
    monitor = monitored("A", motion=trim(default_motion(), START, END), duration=END - START, until=lambda m: m.collapseTime >= 0)
    assert monitor.collapseTime > monitor.tiltTime > 0 and monitor.tiltDirection == "ns"
