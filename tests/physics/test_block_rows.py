# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of falling blocks: scripts/validation/block_rows.py against the theory of rigid blocks, block by block."""
import numpy as np
import pytest
from block_rows import FIRST_VELOCITY, HEIGHT, LAST, NUMBER, THICKNESS, measured_touch_times
from row_of_blocks import Row, touch_times, wave_speed

PUBLISHED = {0.0149: 1.415, 0.016: 1.380, 0.02235: 1.255, 0.0298: 1.177}
"""Speed at the end of a row of 40 blocks by another solution of van Leeuwen's model [m/s], for the pitch [m]."""


def row(pitch, number):
    return Row(HEIGHT, THICKNESS, pitch, number, FIRST_VELOCITY)


@pytest.mark.parametrize("pitch", PUBLISHED)
def test_theory_agrees_with_another_solution(pitch):
    """To 0.1 %: the other speeds have four digits."""
    assert wave_speed(pitch, touch_times(row(pitch, NUMBER)), LAST) == pytest.approx(PUBLISHED[pitch], rel=1e-3)


def test_the_speed_at_the_end_does_not_depend_on_the_push():
    rows = [Row(HEIGHT, THICKNESS, 0.0298, NUMBER, velocity) for velocity in (4.0, 10.0)]
    slow, fast = map(touch_times, rows)
    assert wave_speed(0.0298, slow, LAST) == pytest.approx(wave_speed(0.0298, fast, LAST), rel=1e-4)


def test_theory_of_one_block_is_that_of_a_pendulum():
    """The time to the touch, from the equation of motion instead of the energy."""
    single = row(0.0298, 1)
    angle, velocity, step, time = 0.0, single.first_velocity, 1e-6, 0.0
    while angle < single.touch_angle:
        torque = single.height * np.sin(angle) - single.thickness * np.cos(angle)
        velocity += step * single.gravity / (2 * single.inertia) * torque
        angle += step * velocity
        time += step
    assert touch_times(single)[0] == pytest.approx(time, rel=1e-4)


def test_theory_stops_where_the_push_is_too_small():
    with pytest.raises(ValueError, match="come to rest"):
        touch_times(Row(HEIGHT, THICKNESS, 0.0149, 4, 0.5))


@pytest.mark.parametrize("pitch", [0.0149, 0.0298])
def test_blocks_fall_as_in_theory(pitch):
    """Every touch within 1 % of its time: hinges yield and edges are rounded by 0.1 mm of 7.5 mm; observed 0.2 %."""
    blocks = row(pitch, 14)
    np.testing.assert_allclose(measured_touch_times(blocks, dt=2e-5), touch_times(blocks), rtol=0.01)
