# SPDX-License-Identifier: GPL-2.0-or-later
"""RestSkipper skips rest, computes motion, and leaves the result of later shaking unchanged."""
import numpy as np
import pytest
import yade_timber as yt
from yade import O
from timber_houses.motion import GroundMotion
from timber_houses.scene import scenario
from yade_timber.scene.engines import find_engine

STRIDE = 250
PULSE = 5.0  # [s] start of the shaking


def block_on_plate(skip_rest, amplitude=3.0):
    """A block that rests on a plate, and half a second of shaking from PULSE on, hard enough to make it slide (m/s2).
    """
    O.reset()
    time = np.arange(0, 6.5, 0.01)
    shaking = np.where(time > PULSE, amplitude * np.sin(2 * np.pi * (time - PULSE)), 0) * (time < PULSE + 0.5)
    motion = GroundMotion(0.01, np.column_stack([shaking, 0 * time, 0 * time]), "pulse")
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), material=yt.timber(friction=0.2), fixed=True))
    block = O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0.1), material=yt.timber(friction=0.2)))
    O.engines = yt.engines(ground_motion=motion, skip_rest=skip_rest)
    O.dt = 2e-4
    return O.bodies[block]


def run_to(time):
    """Steps that were computed."""
    steps = 0
    while O.time < time - O.dt / 2:
        O.step()
        steps += 1
    return steps


def test_rest_is_skipped_and_the_result_stays():
    block = block_on_plate(0)
    every_step = run_to(6.5)
    expected = block.state.pos
    block = block_on_plate(STRIDE)
    computed = run_to(6.5)
    skipped = find_engine(yt.RestSkipper).skipped
    assert abs(expected[0]) > 0.01  # [m] it slid
    assert (block.state.pos - expected).norm() < 1e-6  # [m] less rest is left for the settling
    assert skipped > 1.5 and computed == every_step - round(skipped / O.dt)
    assert O.time == pytest.approx(6.5) and O.iter == round(6.5 / O.dt)


def test_slow_growth_is_no_rest():
    """A free block under a gravity of 1e-4 m/s2 stays below the limit of speed for ten seconds and is never skipped."""
    O.reset()
    block = O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(1e-4, 0, 0), skip_rest=STRIDE)
    O.dt = 2e-4
    run_to(6.0)
    assert O.bodies[block].state.vel[0] == pytest.approx(6e-4, rel=1e-3)
    assert find_engine(yt.RestSkipper).skipped == 0


def test_growing_displacements_are_no_rest():
    """Gravity of 2e-6 m/s2: for three seconds speed and displacement are below the limits of rest, but the displacement
    grows.
    """
    O.reset()
    O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(2e-6, 0, 0), skip_rest=STRIDE)
    O.dt = 2e-4
    skipper = find_engine(yt.RestSkipper)
    run_to(3.0)
    assert O.bodies[0].state.pos[0] < skipper.displacement and O.bodies[0].state.vel[0] < skipper.speed
    assert skipper.skipped == 0


def test_shorter_rest_time_and_new_body():
    """Both in the middle of an observation."""
    block_on_plate(STRIDE, amplitude=0.0)
    run_to(0.7)
    skipper = find_engine(yt.RestSkipper)
    skipper.restTime = 0.2
    run_to(1.0)
    assert skipper.skipped > 0
    O.bodies.append(yt.box((0.1, 0.1, 0.1), (0, 0, 3), fixed=True))
    skipped = skipper.skipped
    run_to(1.1)
    assert skipper.skipped == skipped  # the observation started again


def test_a_scene_saved_in_the_middle_of_an_observation(tmp_path):
    def skipped(saved):
        block_on_plate(STRIDE, amplitude=0.0)
        run_to(1.2)
        if saved:
            O.save(str(tmp_path / "scene.xml"))
            O.load(str(tmp_path / "scene.xml"))
        run_to(3.0)
        return find_engine(yt.RestSkipper).skipped

    assert skipped(True) == skipped(False) > 0


def test_vibration_on_the_spot_is_rest():
    """A body that creeps by 1 um a second and vibrates: below the limit of speed, but faster in the second half."""
    O.reset()
    O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(0, 0, 0), skip_rest=STRIDE)
    O.dt = 2e-4
    direction = 1
    while O.time < 3.0:
        O.bodies[0].state.vel = (1e-6 + direction * (1e-5 if O.time < 1.0 else 4e-4), 0, 0)
        direction = -direction
        O.step()
    assert find_engine(yt.RestSkipper).skipped > 1.0


def test_a_house_under_snow_comes_to_rest():
    """With the default time step, in spite of the residuals of the contact solver."""
    scenario.build(scenario.Scenario("rest", "B", snow_depth=1.0))
    run_to(4.0)
    assert find_engine(yt.RestSkipper).skipped > 1.2  # [s] of the four; restTime is 1.5


def test_the_last_step_is_not_skipped_over():
    block_on_plate(STRIDE, amplitude=0.0)
    find_engine(yt.RestSkipper).last = round(6.01 / O.dt)
    run_to(6.01)
    assert O.iter == round(6.01 / O.dt)


def test_a_run_of_some_steps_ends():
    """YADE stops at just the step that O.run(n) asks for, or never."""
    block_on_plate(STRIDE, amplitude=0.0)
    run_to(5.0)
    assert find_engine(yt.RestSkipper).skipped > 0
    step = O.iter
    for steps in (1, STRIDE - 1, STRIDE, 7 * STRIDE + 3):
        step += steps
        O.run(steps, True)
        assert O.iter == step


def test_a_time_to_stop_at_is_not_skipped_over():
    block_on_plate(STRIDE, amplitude=0.0)
    run_to(5.0)
    O.stopAtTime = 6.01
    O.run(-1, True)
    assert O.time == pytest.approx(6.01, abs=2 * O.dt)
