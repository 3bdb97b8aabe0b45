# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes changed while they run in the background, and energies of a scene that has made no step."""
import time

import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate
from yade import O
from yade_timber.scene.engines import find_engine


def pile():
    """Blocks on a plate that run in the background."""
    O.reset()
    O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
    for k in range(40):
        O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.3 * (k % 8) - 1, 0.3 * (k // 8) - 1, 0.1001)))
    O.dt, O.engines = 1e-4, yt.engines()
    O.run()


def test_bodies_erased_and_added_in_the_background():
    pile()
    for k in range(1, 41):
        O.bodies.erase(k)
        assert O.running
        O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.3 * (k % 8) - 1, 0.3 * (k // 8) - 1, 0.5)))
        time.sleep(0.002)
    step = O.iter
    while O.iter < step + 200:
        time.sleep(0.01)
    O.pause()
    O.wait()
    assert O.running is False and sum(b is not None for b in [O.bodies[k] for k in range(len(O.bodies))]) == 41


def test_parts_and_attributes_changed_in_the_background():
    pile()
    for k in range(1, 41):
        O.bodies[k].material = yt.timber(friction=0.3)
        O.bodies[k].shape = yt.box((0.2, 0.2, 0.2), (0, 0, 0)).shape
        with pytest.raises(ValueError):
            O.bodies[k].material = None
        find_engine(yw.ContactForces).sweeps = 40 + k % 3
    assert O.running
    O.pause()
    O.wait()


def test_a_run_of_some_steps_keeps_its_end():
    pile()
    O.pause()
    O.wait()
    time.sleep(0.1)
    end = O.iter + 500
    O.run(500)
    for k in range(1, 20):
        O.bodies.erase(k)
    O.wait()
    while O.running:
        time.sleep(0.01)
    assert O.iter == end


def test_erased_by_an_engine():
    """In the thread that computes the steps nothing waits."""
    pile()
    O.pause()
    O.wait()
    time.sleep(0.1)
    O.engines = [*O.engines, yw.PyRunner(command="O.bodies.erase(5)", iterPeriod=10, nDo=1, initRun=True)]
    O.run(50, True)
    assert O.bodies[5] is None


def test_energy_leaves_the_engines_alone(tmp_path):
    """Also those of a scene that was loaded and has made no step."""
    column_on_plate()
    before = yt.energy()
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    assert yt.energy() == pytest.approx(before, rel=1e-12, abs=1e-15) and np.isfinite(list(before.values())).all()
