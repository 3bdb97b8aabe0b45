# SPDX-License-Identifier: GPL-2.0-or-later
"""Time steps around the stability limit, spikes and steps, stiff joints, single precision, ten minutes of shaking.
Short forms:
tests/physics/test_stress_short.py."""
import extreme_runs
import pytest
import stable_steps
import yade_timber as yt
from compare import assert_close
from extreme_runs import expect_sound, float32_house, rough_record, shaken, single_precision, strong_part
from yade import O
from timber_houses.base.time_step import MAX_DT
from yade_timber.scene import engines


@pytest.mark.parametrize(
    "build", [stable_steps.suspended_block, stable_steps.stack, stable_steps.house, stable_steps.stiff_house])
def test_stable_below_the_predicted_limit(build):
    """Half and nine tenths of the predicted time step are stable, with and without dashpots."""
    for share in (0.5, 0.9):
        for damped in (False, True):
            assert stable_steps.is_stable(build, share * stable_steps.settled(build), damped), (share, damped)


@pytest.mark.parametrize("build, share, damped", [(stable_steps.suspended_block, 1.1, False),
                                                  (stable_steps.stack, 1.1, False), (stable_steps.stack, 6, True),
                                                  (stable_steps.house, 16, True), (stable_steps.stiff_house, 8, True)])
def test_unstable_above_the_predicted_limit(build, share, damped):
    """Slightly above the limit of explicit springs. Implicit contacts and joints are stable above it: suspended_block
    at 20 times the prediction, house at 8, stack at 4, stiff_house at 5."""
    assert not stable_steps.is_stable(build, share * stable_steps.settled(build), damped)


@pytest.mark.parametrize("house", ["B2", "C1", "C2"])
def test_largest_time_step(house):
    """Houses with braces under snow are stable at the largest time step that scripts accept."""
    expect_sound(shaken(house, strong_part(8.0), 8.0, snow_depth=1.0, dt=MAX_DT))


@pytest.mark.parametrize("house", ["A", "B", "C"])
def test_spikes_and_steps(house):
    expect_sound(shaken(house, rough_record(10.0), 10.0, snow_depth=1.0))


def test_ten_minutes_of_shaking():
    """House C in sixty repetitions of the strong part of the motion, at half its amplitude: no creep, no energy gain.
    """
    expect_sound(shaken("C", strong_part(600.0), 600.0, scale=0.5))


@pytest.mark.parametrize("house, snow", [("A", 1.0), ("B2", 1.0), ("C2", 1.0)])
def test_single_precision(house, snow):
    assert single_precision(house, snow) == []


def test_single_precision_house_stands():
    """Ten seconds at rest: no break."""
    float32_house("C")
    O.run(round(10.0 / O.dt), True)
    assert engines.find_engine(yt.JointEngine).breaks == []
    assert_close(extreme_runs.largest_displacement(), 0.0, atol=1e-2)
