# SPDX-License-Identifier: GPL-2.0-or-later
"""Rest is skipped, motion is not, and what follows is the same."""
import numpy as np
import pytest
import yade_timber as yt
from yade import O
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene
from yade_timber.motion import GroundMotion

GRAIN = 250
PULSE = 5.0  # [s] start of the shaking


def block_on_plate(skip_rest, amplitude=3.0):
    """A block that rests on a plate, and half a second of shaking from PULSE on, hard enough to make it slide (m/s2)."""
    O.reset()
    time = np.arange(0, 6.5, 0.01)
    shaking = np.where(time > PULSE, amplitude * np.sin(2 * np.pi * (time - PULSE)), 0) * (time < PULSE + 0.5)
    motion = GroundMotion(0.01, np.column_stack([shaking, 0 * time, 0 * time]), "pulse")
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), material=yt.timber(friction=0.2), fixed=True))
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
    block = block_on_plate(GRAIN)
    computed = run_to(6.5)
    skipped = scene.find_engine(yt.RestSkipper).skipped
    assert abs(expected[0]) > 0.01  # [m] it slid
    assert (block.state.pos - expected).norm() < 1e-6  # [m] less rest is left for the settling
    assert skipped > 1.5 and computed == every_step - round(skipped / O.dt)
    assert O.time == pytest.approx(6.5) and O.iter == round(6.5 / O.dt)


def test_slow_growth_is_no_rest():
    """A free block that gravity of 1e-4 m/s2 moves stays below the speed of rest for ten seconds, and is never skipped."""
    O.reset()
    block = O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(1e-4, 0, 0), skip_rest=GRAIN)
    O.dt = 2e-4
    run_to(6.0)
    assert O.bodies[block].state.vel[0] == pytest.approx(6e-4, rel=1e-3)
    assert scene.find_engine(yt.RestSkipper).skipped == 0


def test_growing_ways_are_no_rest():
    """Gravity of 2e-6 m/s2: for three seconds slower and shorter on the way than rest allows, but on the move."""
    O.reset()
    O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(2e-6, 0, 0), skip_rest=GRAIN)
    O.dt = 2e-4
    skipper = scene.find_engine(yt.RestSkipper)
    run_to(3.0)
    assert O.bodies[0].state.pos[0] < skipper.way and O.bodies[0].state.vel[0] < skipper.speed
    assert skipper.skipped == 0


def test_a_hold_that_is_shortened():
    """In the middle of a watch, and with a body more."""
    block_on_plate(GRAIN, amplitude=0.0)
    run_to(0.7)
    skipper = scene.find_engine(yt.RestSkipper)
    skipper.hold = 0.2
    run_to(1.0)
    assert skipper.skipped > 0
    O.bodies.append(yt.box((0.1, 0.1, 0.1), (0, 0, 3), fixed=True))
    skipped = skipper.skipped
    run_to(1.1)
    assert skipper.skipped == skipped  # the watch began anew


def test_a_scene_saved_in_the_middle_of_a_watch(tmp_path):
    def skipped(saved):
        block_on_plate(GRAIN, amplitude=0.0)
        run_to(1.2)
        if saved:
            O.save(str(tmp_path / "scene.xml"))
            O.load(str(tmp_path / "scene.xml"))
        run_to(3.0)
        return scene.find_engine(yt.RestSkipper).skipped

    assert skipped(True) == skipped(False) > 0


def test_trembling_on_the_spot_is_rest():
    """A body that creeps by 1 um a second, and goes to and fro: below the speed of rest, but faster than before."""
    O.reset()
    O.bodies.append(yt.box((0.4, 0.3, 0.2), (0, 0, 0)))
    O.engines = yt.engines(gravity=(0, 0, 0), skip_rest=GRAIN)
    O.dt = 2e-4
    direction = 1
    while O.time < 3.0:
        O.bodies[0].state.vel = (1e-6 + direction * (1e-5 if O.time < 1.0 else 4e-4), 0, 0)
        direction = -direction
        O.step()
    assert scene.find_engine(yt.RestSkipper).skipped > 1.0


def test_a_house_under_snow_comes_to_rest():
    """With the default step; light members are held by the sweeps over the dashpots, too."""
    scenario.build(scenario.Scenario("rest", "B", snow_depth=1.0))
    run_to(4.0)
    assert scene.find_engine(yt.RestSkipper).skipped > 1.2  # [s] of the four; the hold is 1.5


def test_the_last_step_is_not_skipped_over():
    block_on_plate(GRAIN, amplitude=0.0)
    scene.find_engine(yt.RestSkipper).last = round(6.01 / O.dt)
    run_to(6.01)
    assert O.iter == round(6.01 / O.dt)


def test_a_run_of_some_steps_ends():
    """YADE stops at just the step that O.run(n) asks for, or never."""
    block_on_plate(GRAIN, amplitude=0.0)
    run_to(5.0)
    assert scene.find_engine(yt.RestSkipper).skipped > 0
    step = O.iter
    for steps in (1, GRAIN - 1, GRAIN, 7 * GRAIN + 3):
        step += steps
        O.run(steps, True)
        assert O.iter == step


def test_a_time_to_stop_at_is_not_skipped_over():
    block_on_plate(GRAIN, amplitude=0.0)
    run_to(5.0)
    O.stopAtTime = 6.01
    O.run(-1, True)
    assert O.time == pytest.approx(6.01, abs=2 * O.dt)
