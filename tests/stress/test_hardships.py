# SPDX-License-Identifier: GPL-2.0-or-later
"""Steps through the stability limit, spikes and steps, stiff joints, single precision, ten minutes of shaking. The short forms run in
tests/physics/test_stress_short.py."""
import hardships
import limits
import pytest
import yade_timber as yt
from compare import assert_close
from hardships import RESIDUAL, float32_house, rough_record, shaken, single_precision, speed_bound, strong_part
from yade import O
from yade_timber import scene


@pytest.mark.parametrize("build", [limits.hung_block, limits.stack, limits.house, limits.stiff_house])
def test_stable_below_the_predicted_limit(build):
    """Half the predicted step and nine tenths of it keep the energy of a disturbance, with and without dashpots."""
    for share in (0.5, 0.9):
        for damped in (False, True):
            assert limits.is_stable(build, share * limits.settled(build), damped), (share, damped)


@pytest.mark.parametrize("build, share", [(limits.hung_block, 1.1), (limits.stiff_house, 1.2), (limits.house, 10), (limits.stack, 4)])
def test_unstable_above_it(build, share):
    """Joints alone: just above the limit. Where contacts decide, dashpots and loss of contact hold the motion back for a while."""
    assert not limits.is_stable(build, share * limits.settled(build))


@pytest.mark.parametrize("house", ["A", "B", "C"])
def test_spikes_and_steps(house):
    record = rough_record(10.0)
    fastest, left_over = shaken(house, record, 10.0, snow_depth=1.0)
    assert fastest < speed_bound(record, 10.0) and left_over < RESIDUAL


def test_ten_minutes_of_shaking():
    """House C in the strong part of the motion, halved, sixty times: nothing creeps away, no energy appears."""
    record = strong_part(600.0)
    fastest, left_over = shaken("C", record, 600.0, scale=0.5)
    assert fastest < speed_bound(record, 600.0, 0.5) and left_over < RESIDUAL


@pytest.mark.parametrize("house, snow", [("A", 1.0), ("B2", 1.0), ("C2", 1.0)])
def test_single_precision(house, snow):
    assert single_precision(house, snow) == []


def test_single_precision_house_stands():
    """Ten seconds of quiet: the weight on the ground, no break."""
    float32_house("C")
    O.run(round(10.0 / O.dt), True)
    assert scene.find_engine(yt.JointEngine).breaks == []
    assert_close(hardships.drift_of_all(), 0.0, atol=1e-2)
