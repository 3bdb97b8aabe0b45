# SPDX-License-Identifier: GPL-2.0-or-later
"""Steps through the stability limit, spikes and steps, stiff joints, single precision, ten minutes of shaking. The short forms run in
tests/physics/test_stress_short.py."""
import hardships
import limits
import pytest
import yade_timber as yt
from compare import assert_close
from hardships import expect_sound, float32_house, rough_record, shaken, single_precision, strong_part
from yade import O
from yade_timber.scene import engines as scene
from yade_timber.scene.scenario import MAX_DT


@pytest.mark.parametrize("build", [limits.hung_block, limits.stack, limits.house, limits.stiff_house])
def test_stable_below_the_predicted_limit(build):
    """Half the predicted step and nine tenths of it keep the energy of a disturbance, with and without dashpots."""
    for share in (0.5, 0.9):
        for damped in (False, True):
            assert limits.is_stable(build, share * limits.settled(build), damped), (share, damped)


@pytest.mark.parametrize("build, share, damped", [(limits.hung_block, 1.1, True), (limits.stiff_house, 1.2, True), (limits.stack, 1.1, False), (limits.stack, 6, True), (limits.house, 10, True)])
def test_unstable_above_it(build, share, damped):
    """Just above the limit where no dashpots act; they and loss of contact hold the motion back for a while."""
    assert not limits.is_stable(build, share * limits.settled(build), damped)


@pytest.mark.parametrize("house", ["B2", "C1", "C2"])
def test_the_largest_step(house):
    """Braces under snow, where explicit springs and friction by the elastic force alone created energy: houses are stable at the largest step that scripts take."""
    expect_sound(shaken(house, strong_part(8.0), 8.0, snow_depth=1.0, dt=MAX_DT))


@pytest.mark.parametrize("house", ["A", "B", "C"])
def test_spikes_and_steps(house):
    expect_sound(shaken(house, rough_record(10.0), 10.0, snow_depth=1.0))


def test_ten_minutes_of_shaking():
    """House C in the strong part of the motion, halved, sixty times: nothing creeps away, no energy appears."""
    expect_sound(shaken("C", strong_part(600.0), 600.0, scale=0.5))


@pytest.mark.parametrize("house, snow", [("A", 1.0), ("B2", 1.0), ("C2", 1.0)])
def test_single_precision(house, snow):
    assert single_precision(house, snow) == []


def test_single_precision_house_stands():
    """Ten seconds of quiet: the weight on the ground, no break."""
    float32_house("C")
    O.run(round(10.0 / O.dt), True)
    assert scene.find_engine(yt.JointEngine).breaks == []
    assert_close(hardships.drift_of_all(), 0.0, atol=1e-2)
