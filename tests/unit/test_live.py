# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes to the scene of a live run: another scene or an earlier state loaded, members removed. At a terminal:
test_run.
"""
import builtins
import json
import time
from contextlib import ExitStack
from types import SimpleNamespace

import numpy as np
import pytest
import yade_timber as yt
from yade import O, PyRunner
from timber_houses.recording import frames
from timber_houses.base import lock
from timber_houses.run import live
from timber_houses.run.options import RunOptions
from timber_houses.run.runner import Run
from timber_houses.scene import scenario

yt.guard()


def begin(folder, steps=4000, quiet=True, **more):
    """A live run of house A under snow, going on in the background. more: of the Scenario."""
    run = live.LiveRun(
        scenario.Scenario("live", "A", snow_depth=1.0, dt=2e-4, duration=steps * 2e-4, options={"skip_rest": 0},
                          **more), RunOptions(house="A", out=folder, no_views=True, quiet=quiet))
    folder_lock = ExitStack()
    assert folder_lock.enter_context(lock.locked(folder))
    run.start(folder_lock)
    return run


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)


def step_to(iteration):
    wait_for(lambda: O.iter >= iteration)
    O.pause()
    O.wait()


def test_another_scene(tmp_path, capfd):
    """The run ends without results and releases its folder."""
    begin(tmp_path)
    step_to(100)
    O.reset()
    wait_for(lambda: not lock.is_locked(tmp_path))
    assert "another scene was loaded" in capfd.readouterr().err and not (tmp_path / "summary.json").exists()


def test_the_prompt_shows_time_drift_and_events(tmp_path, monkeypatch, capfd):
    """Below IPython's prompt; nothing there after the end. The last line names the next command."""
    texts = []
    session = SimpleNamespace(app=SimpleNamespace(invalidate=lambda: texts.append(session.bottom_toolbar)))
    monkeypatch.setattr(builtins, "get_ipython", lambda: SimpleNamespace(pt_app=session), raising=False)
    run = begin(tmp_path, 2000, quiet=False)
    step_to(100)
    run.observer.judge.main.fall_s = 0.0
    O.run(run.steps - O.iter)
    wait_for(lambda: not lock.is_locked(tmp_path))
    assert "live 0.30/0.40 s, drift below 1/1000, 0/206 joints broken" in texts and texts[-1] is None
    said = capfd.readouterr().out.splitlines()
    assert sum(line.startswith("   0.00 s  collapse: ") for line in said) == 1
    assert said[-1] == f"next: scripts/show/show_run.py {tmp_path}"


def test_a_collapse_ends_the_run_on_request(tmp_path):
    """At the next frame (every 250 steps), with results."""
    run = begin(tmp_path, until_collapse=True)
    step_to(100)
    run.observer.judge.main.fall_s = 0.0
    O.run()
    wait_for(lambda: not lock.is_locked(tmp_path))
    found = json.loads((tmp_path / "summary.json").read_text())
    assert found["collapsed"] and found["steps"] == O.iter < 4000 and O.iter % 250 == 0


@pytest.mark.parametrize("replace", [O.reset, O.resetThisScene, O.switchScene])
def test_scene_replaced_within_a_step(replace):
    """A step that runs Python code ends before its scene is replaced: YADE by itself would wait for ever, with the
    interpreter locked.
    """
    O.reset()
    O.engines = [PyRunner(command="import time; time.sleep(0.05)", iterPeriod=1)]
    O.dt = 1e-3
    O.run()
    wait_for(lambda: O.iter > 2)
    replace()
    assert not O.running
    O.reset()


def test_pause_and_wait():
    """After O.wait() no step is computed any more, although O.pause() returns within one."""
    O.reset()
    O.engines = [PyRunner(command="import time; time.sleep(0.05); O.tags['id'] = str(O.iter)", iterPeriod=1)]
    O.dt = 1e-3
    O.run()
    wait_for(lambda: O.iter > 2)
    O.pause()
    O.wait()
    iteration, tag = O.iter, O.tags["id"]
    time.sleep(0.2)
    assert (O.iter, O.tags["id"]) == (iteration, tag)
    O.reset()


def test_an_earlier_state(tmp_path):
    """Later frames are dropped."""
    run = begin(tmp_path, 1500)
    step_to(600)
    saved = O.iter
    O.save(str(tmp_path / "state.yade.gz"), quiet=True)
    O.run()
    step_to(saved + 300)
    O.load(str(tmp_path / "state.yade.gz"), quiet=True)
    assert run.is_loaded()
    O.run(run.steps - O.iter)
    wait_for(lambda: not lock.is_locked(tmp_path))
    made = frames.load(tmp_path / frames.NAME)
    assert np.allclose(made.time, np.arange(7) * 0.05) and made.summary.steps == 1500


def test_results_before_the_end(tmp_path):
    """Written twice, frames and samples are those of the whole run, once each; also after checkpoints and a resume."""
    for name in ("live", "saved"):
        (tmp_path / name).mkdir()
    run = begin(tmp_path / "live", 1000)
    step_to(400)
    run.write()
    first = json.loads((tmp_path / "live" / "summary.json").read_text())
    O.run(run.steps - O.iter)
    wait_for(lambda: not lock.is_locked(tmp_path / "live"))
    options = RunOptions(house="A", out=tmp_path / "saved", no_views=True, quiet=True, resume=True,
                         export=tmp_path / "a.json")
    calm = scenario.Scenario("live", "A", snow_depth=1.0, dt=2e-4, duration=0.2, options={"skip_rest": 0})
    for stops in ((200, 400), (700, 1000)):  # the second time from the checkpoint
        (tmp_path / "a.json").unlink(missing_ok=True)
        run = Run(calm, options)
        for stop in stops:
            run.advance(stop)
            run.take(O.time)
            run.save()
            run.write()
            run.write()
        assert (tmp_path / "a.json").exists()
    for folder in ("live", "saved"):
        made = frames.load(tmp_path / folder / frames.NAME)
        assert len(set(made.time)) == len(made.time) and len(made.time) == len(made.position)
        assert np.allclose(made.history.time, np.arange(made.history.samples) * 0.01)
        assert made.history.samples >= 20
        assert len(set(made.contacts.time)) == len(made.contacts.time)
    assert first["wall_s"] > 0 and 0.07 < first["duration_s"] < 0.2


def test_removed_members(tmp_path):
    run = begin(tmp_path, 1000)
    step_to(100)
    column, beam = (next(k for k, e in enumerate(run.model.elements) if e.kind == kind) for kind in ("column", "beam"))
    for body in (column, beam):
        O.bodies.erase(body)
    O.run(run.steps - O.iter)
    wait_for(lambda: not lock.is_locked(tmp_path))
    assert frames.load(tmp_path / frames.NAME).summary.columns.total == len(run.model.of_kind("column")) - 1


@pytest.fixture(autouse=True)
def no_live_run():
    yield
    O.pause()
    live.live = None
