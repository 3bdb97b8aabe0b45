# SPDX-License-Identifier: GPL-2.0-or-later
"""Short forms of the stress tests (tests/stress, label `stress`): each kind of hardship once."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "stress"))

import hardships  # noqa: E402
import limits  # noqa: E402
import pytest  # noqa: E402
from hardships import single_precision  # noqa: E402
from random_pairs import expect_sound, impacts  # noqa: E402
from yade import O  # noqa: E402
from yade_timber.scene.scenario import MAX_DT  # noqa: E402


def test_random_impacts():
    found = impacts(150, seed=2, batch=25)
    expect_sound(found)
    assert sum(o.met for o in found) > 70


@pytest.mark.parametrize("build", [limits.hung_block, limits.stack])
def test_stable_below_the_predicted_limit(build):
    assert limits.is_stable(build, 0.9 * limits.settled(build), damped=False)


def test_above_it_the_run_is_stopped():
    """Joints: the limit is sharp, and the health check says what to do."""
    predicted = limits.settled(limits.hung_block)
    limits.disturb()
    O.dt = 1.2 * predicted
    with pytest.raises(RuntimeError, match="time step .* is probably too large"):
        for _ in range(1000):
            O.step()


def test_the_largest_step():
    """Two seconds in which explicit springs, and friction by the elastic force alone, made braces under snow chatter."""
    hardships.expect_sound(hardships.shaken("C2", hardships.strong_part(2.0), 2.0, snow_depth=1.0, dt=MAX_DT))


def test_spikes_and_steps():
    hardships.expect_sound(hardships.shaken("B", hardships.rough_record(0.3), 0.3))


def test_single_precision():
    assert single_precision("C", 1.0) == []
