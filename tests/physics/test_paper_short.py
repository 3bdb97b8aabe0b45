# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's claims in short runs: B and C stand under snow, A collapses in strong shaking. The label `paper` has the complete runs.

The shipped house A stands under snow (claim S1 does not hold); it collapses if no column end is supported (docs/claims/claims.md).
"""
import math

import pytest
import yade.wrapper as yw
from yade import O
from yade_timber.motion import default_motion, trim
from yade_timber.scene import engines, scenario
from yade_timber.study.claims import STILL

START, END = 16.6, 26.0
"""Strong shaking of the default motion. [s]"""


PINNED = """
extends: A
name: pinned
law: {flush_supports: false}
plumb: {drift: 1e-3}
structures:
  main:
    stack:
      - {layer: foundation, height: 0.30, width: 0.105}
      - {layer: columns, height: 2.73}
      - {layer: beams, height: 0.12, width: 0.105}
      - {layer: floor, thickness: 0.20}
      - {layer: columns, height: 2.73}
      - {layer: beams, height: 0.12, width: 0.105}
      - {layer: roof, type: hip, ridge_height: 7.5, thickness: 0.12, corner_cut: 0.20, material: roofing}
    columns:
      - {section: 0.105, grid: {x: [0, 4, 8], y: [0, 4, 9]}}
      - section: 0.105
        lines:
          - {along: y, at: [0, 8], from: 0, to: 9}
          - {along: x, at: [0, 9], from: 0, to: 8}
      - {section: 0.105, at: [[4, 1], [4, 3], [4, 5], [4, 7], [4, 8], [1, 4], [7, 4]]}
"""
"""House A with columns as wide as foundation and beams and no support for flush members: the joints alone keep the columns upright."""


def monitored(house, snow=0.0, motion=None, duration=1.0, until=lambda monitor: False):
    """HouseMonitor after `duration` [s], or when `until` becomes true."""
    scenario.build(scenario.Scenario("short", house, motion, snow_depth=snow, options={"track_energy": False}))
    monitor = engines.find_engine(yw.HouseMonitor)
    while O.time < duration and not until(monitor):
        O.run(250, True)
    return monitor


@pytest.mark.parametrize("house", ["B", "C"])
def test_braced_houses_stand_still_under_snow(house):
    monitor = monitored(house, snow=1.0, duration=2.0)
    assert max(monitor.peak) < STILL and math.isnan(monitor.collapseTime)
    assert not engines.find_engine(yw.JointEngine).breaks


@pytest.mark.parametrize("supported", [True, False])
def test_house_a_collapses_under_snow_only_without_supported_column_ends(supported, tmp_path):
    """Supported column ends of width b keep a frame of height h upright up to a drift of b/h = 3 to 4 %, for any load."""
    house = tmp_path / "pinned.yaml"
    house.write_text(PINNED if not supported else PINNED.replace("flush_supports: false", "flush_supports: true"))
    monitor = monitored(str(house), snow=1.0, duration=6.0, until=lambda m: m.collapseTime >= 0)
    assert (monitor.collapseTime >= 0) != supported
    if supported:
        assert max(monitor.peak) < STILL
    else:
        assert monitor.tiltDirection == "ns"


def test_house_a_tilts_and_collapses_in_strong_shaking():
    monitor = monitored("A", motion=trim(default_motion(), START, END), duration=END - START, until=lambda m: m.collapseTime >= 0)
    assert monitor.collapseTime > monitor.tiltTime > 0  # in a direction that follows from the record
