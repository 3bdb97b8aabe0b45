# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's claims in short runs: B and C stand under snow, A collapses in strong shaking. The label `paper` has the
complete runs.

The shipped house A stands under snow (claim S1 does not hold); it collapses if no column end is supported
(research/claims/claims.md).
"""
import pytest
import yade.wrapper as yw
import yaml
from timber_research.claims import STILL
from yade import O
from timber_houses.house import changed_house
from timber_houses.motion import default_motion, trim
from timber_houses.run.observer import Observer
from timber_houses.scene import scenario
from yade_timber.scene import engines

START, END = 16.6, 26.0
"""Strong shaking of the default motion. [s]"""


PINNED = ("plumb.drift=1e-3", "structures.main.stack[1].width=0.105", "structures.main.columns[1].section=0.105")
"""Changes of house A: columns as wide as foundation and beams. Without support for flush members the joints alone keep
them upright.
"""


def judged(house, snow=0.0, motion=None, duration=1.0):
    """Judged of the main structure after `duration` [s], or when it has fallen."""
    observed = Observer(scenario.build(scenario.Scenario("short", house, motion, snow_depth=snow)))
    while O.time < duration and observed.judge.main.fall_s is None:
        O.run(250, True)
        observed.read_samples()
    return observed.judge.main


@pytest.mark.parametrize("house", ["B", "C"])
def test_braced_houses_stand_still_under_snow(house):
    found = judged(house, snow=1.0, duration=2.0)
    assert max(found.peak) < STILL and found.fall_s is None
    assert not engines.find_engine(yw.JointEngine).breaks


@pytest.mark.parametrize("supported", [True, False])
def test_house_a_collapses_under_snow_only_without_supported_column_ends(supported, tmp_path):
    """Supported column ends of width b keep a frame of height h upright up to a drift of b/h = 3 to 4 %, for any load.
    """
    house = tmp_path / "pinned.yaml"
    settings = (*PINNED, f"law.flush_supports={str(supported).lower()}")
    house.write_text(yaml.safe_dump(changed_house("A", settings=settings), sort_keys=False))
    found = judged(str(house), snow=1.0, duration=6.0)
    assert (found.fall_s is None) == supported
    if supported:
        assert max(found.peak) < STILL
    else:
        assert found.tilt_direction == "ns"


def test_house_a_tilts_and_collapses_in_strong_shaking():
    found = judged("A", motion=trim(default_motion(), START, END), duration=END - START)
    assert found.fall_s > found.tilt_s > 0  # in a direction that follows from the record
