# SPDX-License-Identifier: GPL-2.0-or-later
"""Short forms of the stress tests (tests/stress, label `stress`)."""
import extreme_runs
import pytest
import stable_steps
from extreme_runs import single_precision
from random_pairs import expect_sound, impacts
import yade.wrapper as yw
from yade import O
from timber_houses.base.time_step import MAX_DT
from yade_timber.scene.engines import find_engine


def test_random_impacts():
    found = impacts(150, seed=2, batch=25)
    expect_sound(found)
    assert sum(o.touched for o in found) > 70


@pytest.mark.parametrize("build", [stable_steps.suspended_block, stable_steps.stack])
def test_stable_below_the_predicted_limit(build):
    assert stable_steps.is_stable(build, 0.9 * stable_steps.settled(build), damped=False)


def test_the_health_check_stops_runs_above_the_limit():
    """For explicit joints the limit is sharp; the message names the time step."""
    predicted = stable_steps.settled(stable_steps.suspended_block)
    find_engine(yw.ContactForces).sweeps = 0
    stable_steps.disturb()
    O.dt = 1.2 * predicted
    with pytest.raises(RuntimeError, match="time step"):
        for _ in range(1000):
            O.step()


def test_largest_time_step():
    """Two seconds of shaking of braces under snow, the most sensitive case."""
    extreme_runs.expect_sound(extreme_runs.shaken("C2", extreme_runs.strong_part(2.0), 2.0, snow_depth=1.0, dt=MAX_DT))


def test_spikes_and_steps():
    extreme_runs.expect_sound(extreme_runs.shaken("B", extreme_runs.rough_record(0.3), 0.3, dt=MAX_DT / 2))


def test_single_precision():
    assert single_precision("C", 1.0) == []
