# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs whose numbers fail: results until then are kept and named as cut off; energy from nothing is refused;
convergence is counted.
"""
import json
import math

import numpy as np
import pytest
from summaries import sample_summary
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from timber_houses.base.errors import InputError, RunError
from timber_houses.motion import GroundMotion
from timber_houses.recording import frames
from timber_houses.recording.summary import Summary
from timber_houses.run import runner, summary
from timber_houses.run.options import RunOptions
from timber_houses.run.plan import planned
from timber_houses.run.town import TownRun
from yade_timber.scene.engines import find_engine
from timber_houses.scene.scenario import Scenario
from timber_houses.text.english import sentence, unconverged


def run_with(folder, change):
    """Folder of a run of house A for 0.3 s, in which change() is called at 0.15 s. The run must fail."""
    run = runner.Run(Scenario("cut", "A", duration=0.3), RunOptions(house="A", out=folder, no_views=True, quiet=True))
    after = run.after_chunk

    def changed():
        if O.time >= 0.15 - 1e-9 and change:
            change()
        after()

    run.after_chunk = changed
    with pytest.raises(RunError) as error:
        run.complete()
    return str(error.value)


def read(folder):
    return json.loads((folder / "summary.json").read_text(),
                      parse_constant=lambda name: pytest.fail(f"{name} in summary.json"))


def column():
    return next(body for body in O.bodies if body.shape.kind == "column")


def too_fast():
    yt.set_velocity(column(), (900, 0, 0))


def too_fast_a_spin():
    yt.set_velocity(column(), (0, 0, 0), (0, 0, 1e5))


def not_a_number():
    O.forces.setPermF(column().id, (math.nan, 0, 0))


def no_energy():
    """Sums of energies overflow."""
    next(body for body in O.bodies if body.shape.kind == "beam").state.vel = (1e160, 1e160, 1e160)


@pytest.mark.parametrize("change", [too_fast, too_fast_a_spin, not_a_number, no_energy])
def test_results_until_the_failure_are_kept(tmp_path, change):
    error = run_with(tmp_path, change)
    assert "physical range" in error and "\n" not in error
    found = read(tmp_path)
    assert found["cut_off"] == error and 0.149 < found["duration_s"] < 0.201  # a force acts from the next step on
    assert sentence(
        Summary.read(tmp_path)).startswith("Cut off at 0.") and abs(found["energy"]["residual_fraction"]) < 1e-3
    recorded = frames.load(tmp_path / frames.NAME)
    assert recorded.time[-1] < 0.151 and (tmp_path / "history.csv").read_text().count("nan") == 0


def test_energy_from_nothing_is_refused(tmp_path):
    """More than 1e-4 of the input, once the run is complete."""

    def create():
        find_engine(yw.ContactForces).created = 1e6

    assert "created 1e+06 J" in run_with(tmp_path, create)
    assert read(tmp_path)["cut_off"].startswith("contacts and joints have created")
    energies = [sample_summary(energy={"created": created * 100, "input": 100}).energy for created in (0.9e-4, 1.1e-4)]
    assert [bool(summary.created_too_much(energy)) for energy in energies] == [False, True]


def test_a_lot_that_fails_ends_alone(tmp_path, monkeypatch):
    """The other lot has its results. The record of a town is in its axes, not in those of its first lot."""
    (tmp_path /
     "town.yaml").write_text("lots:\n  bad: {house: A, x: 0, y: 0, rotation: 90}\n  good: {house: A, x: 30, y: 0}\n")
    shaking = GroundMotion(0.01, np.outer(np.sin(np.arange(100)), [1.0, 3.0, 0.0]))
    options = RunOptions(town=str(tmp_path / "town.yaml"), ground_motion=shaking, duration=0.1, out=tmp_path / "out",
                         no_views=True, quiet=True)
    after = runner.Run.after_chunk

    def failing(run):
        if run.scenario.name.endswith("bad"):
            raise runner.PhysicsError("body 3 has left")
        after(run)

    monkeypatch.setattr(runner.Run, "after_chunk", failing)
    with pytest.raises(runner.PhysicsError, match="lot bad: body 3 has left"):
        TownRun(planned(options), options).complete()
    found = {name: Summary.read(tmp_path / "out" / "lots" / name) for name in ("bad", "good")}
    assert found["bad"].cut_off and not found["good"].cut_off and found["good"].duration_s == pytest.approx(0.1)
    assert "Cut off" in (tmp_path / "out" / "houses.csv").read_text()
    town = frames.load(tmp_path / "out" / frames.NAME).summary.record
    assert town.pga_gal == found["good"].record.pga_gal != found["bad"].record.pga_gal


def test_a_motion_too_long_for_the_summary_is_refused_before_the_run(tmp_path):
    motion = GroundMotion(0.001, np.ones((2_600_000, 3)))
    with pytest.raises(InputError, match="at most"):
        planned(RunOptions(house="A", ground_motion=motion, out=tmp_path))


def test_steps_that_do_not_converge_are_counted():
    """A stack of three blocks that settles: three sweeps are not enough, 2500 are."""
    for sweeps, expected in ((3, True), (2500, False)):
        O.reset()
        O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
        for k in range(3):
            O.bodies.append(yt.box((0.3, 0.3, 0.1), (0, 0, 0.05 + 0.1 * k)))
        O.dt, O.engines = 5e-4, yt.engines(sweeps=sweeps)
        O.run(20, True)
        forces = find_engine(yw.ContactForces)
        assert (forces.unconverged > 0) == expected == (forces.worstChange > 0), sweeps
        assert forces.sweepsMax <= sweeps


def test_sentence_names_steps_that_matter():
    found = sample_summary(solver={"unconverged_steps": 3, "worst_change_j": 1.0}, energy={"input": 1e5})
    assert unconverged(found) == "3 steps did not converge (largest change 1 J)"
    assert unconverged(found.changed(energy={"input": 1e7})) == ""


@pytest.mark.parametrize("duration, verdicts", [(20.0, ["unsafe", "unsafe"]), (27.0, ["total loss", "total loss"])])
def test_no_structure_is_a_total_loss_while_the_ground_shakes_strongly(duration, verdicts):
    """A residual drift is one after the strong shaking, until 27 s."""
    leaning = {"peak_drift": 0.3, "residual_drift": 0.2}
    draft = sample_summary(record={"onset_s": 18.8, "strong_end_s": 27.0}, earthquake=True, duration_s=duration,
                           **{key: {"storey1": {"ns": value, "ew": 0.0}} for key, value in leaning.items()},
                           structures={"entrance": leaning})
    found = summary.judged(draft)
    assert [facts.verdict for facts in found.structures.values()] == verdicts and found.verdict == verdicts[0]
    assert ("residual drift" in found.sentence) == (duration == 27.0)
