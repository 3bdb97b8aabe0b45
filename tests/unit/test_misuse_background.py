# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes changed, read and saved while they run in the background, and energies of a scene that has made no step."""
import itertools
import os
import threading
import time

import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate
from yade import O
from yade_timber.plugin import compiled
from yade_timber.scene.background import between_steps
from yade_timber.scene.engines import find_engine
from timber_houses.scene.modes import natural_modes

yt.guard()

LISTS = {yw.Sampler: "axes load opening pull rows shear", yw.JointEngine: "breaks joints",
         yw.TimberJoint: "broken cycles forces largestStretches load plasticStretches springs stretches",
         yw.ManifoldGeom: "points", yw.ManifoldPhys: "points"}
"""Attributes that the engines change within a step."""
PLACES = itertools.count()
"""Of joints: the same one twice is refused. [mm]"""
CALLS = {"save": lambda scene: O.save(scene.path, quiet=True), "saveTmp": lambda scene: O.saveTmp(quiet=True),
         "sceneToString": lambda scene: O.sceneToString(), "engines": lambda scene: setattr(O, "engines", O.engines),
         "dict": lambda scene: scene[yw.Sampler].dict(),
         "append": lambda scene: scene[yw.JointEngine].append(yw.TimberJoint(**scene.joint)),
         "connect": lambda scene: yt.connect(0, 1, [(0, 0, 1e-3 * next(PLACES))]),
         "contacts": lambda scene: yt.contacts(0, 1),
         "energy": lambda scene: yt.energy(), "energy_residual": lambda scene: yt.energy_residual(),
         "stable_dt": lambda scene: yt.stable_dt(), "natural_modes": lambda scene: natural_modes(),
         "export_scene": lambda scene: yt.export_scene(scene.path),
         "record": lambda scene: yt.record(scene.path).take(),
         "check": lambda scene: scene[yw.HealthCheck].check(),
         "set_velocity": lambda scene: yt.set_velocity(1, (0, 0, 0)),
         "packed_contacts": lambda scene: compiled.packed_contacts(),
         "packed_joints": lambda scene: compiled.packed_joints(scene[yw.JointEngine]),
         "packed_placements": lambda scene: compiled.packed_placements()}
USES = {**CALLS, **{f"{cls.__name__}.{name}": lambda scene, cls=cls, name=name: getattr(scene[cls], name)
                    for cls, names in LISTS.items() for name in names.split()}}
"""What needs the state between two steps."""
SLOW = "import time; time.sleep(0.01)"


class Column(dict):
    """A column on a plate, joined to it: {class: object of the scene}. path: of a file to write."""

    def __init__(self, folder):
        column_on_plate(monitor=yw.Sampler(interval=0, jointInterval=0))
        contact = O.interactions[0, 1]
        parts = [*O.engines, find_engine(yw.JointEngine).joints[0], contact.geom, contact.phys]
        super().__init__((cls, part) for part in parts for cls in LISTS.keys() | {type(part)} if isinstance(part, cls))
        self.path, self.joint = str(folder / "scene"), self[yw.TimberJoint].dict()

    def add(self, command, **when):
        """Let each step end with Python code. when: PyRunner's attributes"""
        O.engines = [*O.engines, yw.PyRunner(command=command, iterPeriod=1, **when)]

    def run(self, *steps):
        """Run to the middle of a slow step."""
        O.run(*steps)
        time.sleep(0.002)


@pytest.fixture
def column(tmp_path):
    yield Column(tmp_path)
    O.pause()
    O.wait()


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


@pytest.mark.parametrize("use", USES.values(), ids=USES)
def test_a_step_in_the_background_ends_first(column, use):
    """And the run has gone on for a step when the call returns."""
    column.add(SLOW)
    column.run()
    step = O.iter
    use(column)
    assert O.iter > step and O.running


def test_all_of_them_within_a_step(column, monkeypatch):
    """Of a run, and of O.step(), which this thread computes."""
    done = []
    monkeypatch.setattr(yw, "use_all", lambda: done.append([use(column) for use in USES.values()]), raising=False)
    column.add("import yade.wrapper; yade.wrapper.use_all()")
    O.run(3, True)
    O.step()
    assert len(done) == 4


def test_run_called_within_a_step(column):
    end = O.iter + 3
    column.add("O.run()")
    O.run(3, True)
    assert O.iter == end


def test_joined_in_the_background():
    pile()
    for k in range(400):
        x, y, z = O.bodies[k % 40 + 1].state.pos
        yt.connect(0, k % 40 + 1, [(x, y, z + 1e-3 * (k // 40))])
    assert O.running and len(find_engine(yw.JointEngine).joints) == 400
    O.pause()
    O.wait()


def test_a_saved_scene_has_the_state_of_one_step(tmp_path):
    """A block falls; after n steps its velocity is n g dt. Within a step it has moved before the step counts."""
    O.reset()
    O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0)))
    O.dt, O.engines = 1e-4, [*yt.engines(), yw.PyRunner(command=SLOW, iterPeriod=1)]
    O.run()
    for k in range(5):
        O.save(str(tmp_path / f"{k}.yade"), quiet=True)
        time.sleep(0.007)
    for k in range(5):
        O.load(str(tmp_path / f"{k}.yade"), quiet=True)
        assert O.bodies[0].state.vel[2] == pytest.approx(-9.81 * O.dt * O.iter, rel=1e-9)


def test_contexts_may_be_nested(column):
    """The outermost one lets the run go on, up to its end."""
    end = O.iter + 30
    column.add(SLOW)
    column.run(30)
    with between_steps():
        step = O.iter
        with between_steps():
            yt.energy()
        assert O.iter == step and not O.running
    assert O.running
    for _ in range(30):
        yt.energy()
        with between_steps():
            yt.energy()
    assert not O.running and O.iter == end


@pytest.fixture
def one_core():
    """Threads that are started by this one share a core: any place of a step may be interrupted."""
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cores)})
    yield
    os.sched_setaffinity(0, cores)


def test_a_run_that_has_just_reached_its_end(column, one_core):
    """It counts as running until its thread is done, and its limit is gone by then: it is not continued."""
    for _ in range(15000):
        end = O.iter + 2
        O.run(2)
        for _ in range(3):
            yt.energy()
        while O.running and O.iter <= end:
            pass
        assert O.iter == end


def test_a_run_that_is_paused_in_the_step(column):
    """By an engine, while this thread waits for the end of that step. `O.run` waits for the first one."""
    column.add(f"{SLOW}; O.iter == {O.iter + 1} and O.pause()")
    column.run()
    yt.energy()
    assert not O.running


def test_a_run_that_another_thread_pauses(column):
    column.add(SLOW)
    column.run()
    with between_steps():
        other = threading.Thread(target=O.pause)
        other.start()
        other.join()
    assert not O.running


def test_a_run_that_fails_in_the_step(column):
    """That step is not computed again."""
    column.add(f"{SLOW}; assert O.iter == {O.iter}")
    column.run()
    step = O.iter
    yt.energy()
    assert not O.running and O.iter == step


def test_threads_take_turns(column):
    """A thread that reads all the time does not end the runs that another one waits for."""
    done = threading.Event()

    def read():
        while not done.is_set():
            len(column[yw.Sampler].rows)

    reader = threading.Thread(target=read)
    reader.start()
    try:
        for steps in (1, 10, 100) * 5:
            end = O.iter + steps
            O.run(steps, True)
            assert O.iter == end
            O.run(steps)
            yt.energy()
            O.wait()
            assert O.iter == end + steps
    finally:
        done.set()
        reader.join()
