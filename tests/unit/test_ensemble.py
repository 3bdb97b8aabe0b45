# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Disturbance of a house; medians, ranges and shares of an ensemble; its files, sentences and picture."""
import csv
import io
from contextlib import ExitStack
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import small_frames
from frames_sample import DURATION
from frames_sample import run as sample
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.house import build_house, load_house
from timber_houses.house.disturbance import LARGEST, disturb
from timber_houses.pictures import curves, provenance
from timber_houses.recording import ensemble, frames
from timber_houses.recording.history import History
from timber_houses.recording.summary import Summary
from timber_houses.recording.summary_parts import Ensemble
from timber_houses.run.identity import made_from
from timber_houses.run.options import RunOptions, scripted
from timber_houses.study import driver
from timber_houses.study.ensemble import runs, statistics
from timber_houses.text import japanese
from timber_houses.text.english import sentence


def summary(verdict="unsafe", drift=0.1, falls=None, springs=3, **more):
    """Summary of a run with a largest drift [-]; falls: collapse time [s]"""
    drifts = {"storey1": {"ns": drift, "ew": drift / 2}, "storey2": {"ns": None, "ew": None}}
    values = {"verdict": verdict, "collapsed": falls is not None, "collapse_time_s": falls, "peak_drift": drifts,
              "residual_drift": drifts}
    return sample_summary(**{**values, "broken": {"total": 1, "springs": springs}, **more})


# --- disturbance ------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def houses():
    """House C2 with snow as built, disturbed with seeds 2, 2 and 3."""
    built = [build_house(load_house("C2"), snow_depth=1.0) for _ in range(4)]
    for model, seed in zip(built[1:], (2, 2, 3)):
        disturb(model, seed)
    return built


def shifts(model, plain):
    """{name: (n, 3) displacements of the vertices [m]} of the free elements."""
    return {e.name: e.vertices - other.vertices for e, other in zip(model.elements, plain.elements) if not e.fixed}


def test_free_elements_are_disturbed_by_at_most_the_limit(houses):
    """The vectors fill the cube: the largest is within 2 % of the limit (1400 vertices), the mean component is 0 within
    five standard errors.
    """
    moved = np.vstack(list(shifts(houses[1], houses[0]).values()))
    sizes = np.linalg.norm(moved, axis=1)
    # an addition rounds a coordinate of up to 8 m to 1e-15 m
    assert 0.85 * LARGEST < sizes.max() <= LARGEST + 2e-15 and (sizes > 0).all()
    assert abs(moved.mean()) < 5 * LARGEST / 3 / np.sqrt(moved.size)
    for element, plain in zip(houses[1].elements, houses[0].elements):
        assert not element.fixed or np.array_equal(element.vertices, plain.vertices)


def test_the_seed_decides(houses):
    _, first, same, other = houses
    for a, b, c in zip(first.elements, same.elements, other.elements):
        assert np.array_equal(a.vertices, b.vertices) and (a.fixed or not np.array_equal(a.vertices, c.vertices))


def test_joints_and_shapes_stay(houses):
    """Joints have their points; each element has as many faces as before."""
    plain, moved = houses[:2]
    assert all(np.array_equal(a.points, b.points) and a.name == b.name for a, b in zip(plain.joints, moved.joints))
    for a, b in zip(plain.elements, moved.elements):
        vars(b).pop("solid", None)
        assert len(a.solid.faces) == len(b.solid.faces)


# --- statistics -------------------------------------------------------------------------------------------------------


def test_spread_by_hand():
    assert statistics.spread([4, 1, 3, 2, 10]) == {"runs": 5, "lowest": 1, "lower_quartile": 2, "median": 3,
                                                   "upper_quartile": 4, "highest": 10}
    assert statistics.spread([2])["median"] == 2


def test_numbers_and_words_of_a_summary():
    """Flags are no numbers; what has no value is the word 'none'."""
    found = sample_summary(dt=1e-4, collapsed=True, energy={"input": 5}, versions={"yade": "x"},
                           peak_drift={"storey1": {"ns": 0.2, "ew": 0.1}})
    numbers, words = statistics.numbers(found), statistics.words(found)
    expected = {"largest_peak_drift": 0.2, "largest_residual_drift": 0.0, "dt": 1e-4, "energy.input": 5,
                "peak_drift.storey1.ns": 0.2}
    assert numbers.items() >= expected.items()
    assert words.items() >= {"collapsed": "true", "tilt_direction": "none", "verdict": "collapsed"}.items()
    assert not {"collapsed", "events", "tilt_direction"} & numbers.keys()
    assert not {"model", "versions.yade", "dt"} & words.keys()


def test_spreads_count_the_runs_that_have_a_number():
    found = statistics.spreads([summary(falls=5.0), summary(falls=7.0), summary()])
    assert found["collapse_time_s"] == {"runs": 2, "lowest": 5.0, "lower_quartile": 5.5, "median": 6.0,
                                        "upper_quartile": 6.5, "highest": 7.0}
    assert found["largest_peak_drift"]["runs"] == 3
    assert statistics.counts([summary(falls=5.0), summary()])["collapsed"] == {"true": 1, "false": 1}


def test_share_has_its_interval():
    """3 of 10: Clopper and Pearson (1934) give 0.0667 to 0.6525 at 95 %; 4 digits."""
    found = statistics.share(3, 10)
    assert found["share"] == 0.3 and (found["low"], found["high"]) == pytest.approx((0.0667, 0.6525), abs=5e-5)


def test_outcomes_from_the_best_to_the_worst():
    assert list(statistics.outcomes([summary("collapsed"), summary(),
                                     summary("collapsed")]).items()) == [("unsafe", 1), ("collapsed", 2)]


@pytest.mark.parametrize("found, number", [
    ([summary(drift=d) for d in (0.1, 0.3, 0.2)], 3),
    ([summary(drift=0.125), summary(drift=0.375),
      summary("collapsed", 9.0, 5.0)], 1),  # equally near to 0.25: the first
    ([summary(), *(summary("collapsed", d, t)
                   for d, t in ((9.0, 6.0), (8.0, 5.0), (7.0, 8.0)))], 2),  # by the collapse time
    ([summary(drift=0.1), summary("collapsed", 9.0, 5.0)], 2),  # equally frequent: the worse
])
def test_the_run_that_is_shown(found, number):
    assert statistics.representative(dict(enumerate(found, 1))) == number


# --- files ------------------------------------------------------------------------------------------------------------


@pytest.fixture
def finished(tmp_path):
    """(RunOptions, tasks, summaries) of an ensemble of three runs in tmp_path; the third collapses."""
    options = scripted("modelA_quake", "A", True, out=tmp_path, ensemble=3, quiet=True, scale=2.0)
    planned = runs.tasks(options)
    found = [summary(drift=0.1), summary(drift=0.12), summary("collapsed", 1.3, 2.9)]
    found = [replace(one, made_from=made_from(task.options)) for task, one in zip(planned, found)]
    for number, (task, one) in enumerate(zip(planned, found)):
        task.folder.mkdir(parents=True)
        recorded = small_frames.frames()
        recorded.summary = one
        drifts = [1 + 0.1 * number * name.startswith("drift") for name in recorded.history.columns]
        recorded.history = History(recorded.history.columns, recorded.history.rows * drifts)
        frames.save(task.folder / frames.NAME, recorded)
        recorded.history.write(task.folder / "history.csv")
        one.write(task.folder)
    return options, planned, dict(enumerate(found, 1))


def test_tasks_are_disturbed_but_the_first(finished):
    """Run k has the seed k, whatever the number of runs: an ensemble can be extended."""
    options, planned, _ = finished
    assert [(task.options.scale, task.options.disturb) for task in planned] == [(2.0, None), (2.0, 2), (2.0, 3)]
    assert [task.folder.relative_to(options.folder).as_posix()
            for task in planned] == ["runs/001", "runs/002", "runs/003"]
    assert [task.request() for task in runs.tasks(replace(options, ensemble=5))[:3]] == [
        task.request() for task in planned]


def test_a_changed_house_file_outdates_its_runs(tmp_path):
    """A house file of any name, on the command line or given by the script."""
    path = tmp_path / "mine.txt"
    for options in (RunOptions(house=str(path)), scripted("mine", path)):
        path.write_text("extends: A\nname: mine\n")
        before = made_from(options)
        path.write_text("extends: B\nname: mine\n")
        assert made_from(options) != before


def test_reason_of_a_run_without_results(finished):
    """A killed run is not taken for that of another process; an exit status beyond all signals is no signal. A crash is
    a failure."""
    _, planned, _ = finished
    assert "stopped" in runs._reason(planned[0]) and str(planned[0].folder) in runs._reason(planned[0])
    assert [driver._signal(status) for status in (0, 1, -9, 139, 255)] == [None, None, "SIGKILL", "SIGSEGV", None]
    for status, outcome in ((-9, "stopped by SIGKILL"), (139, "failed: crashed (SIGSEGV)")):
        process = object.__new__(driver._Process)
        process.task, process.child, process.lock = planned[0], SimpleNamespace(returncode=status), ExitStack()
        assert process.outcome().startswith(outcome)


def complete(options, planned, monkeypatch):
    """`complete` in which no run is started."""
    monkeypatch.setattr(runs, "run_missing", lambda tasks, *_: {task: task.summary for task in tasks})
    runs.complete(options)


def test_files_of_an_ensemble(finished, monkeypatch):
    """One row a run; the folder has the results of the run that is shown, with its place in the ensemble."""
    options, planned, _ = finished
    complete(options, planned, monkeypatch)
    found = ensemble.read(options.folder)
    assert (found["runs"], found["finished"], found["shown"], found["disturbance_m"]) == (3, [1, 2, 3], 1, LARGEST)
    assert found["outcomes"]["unsafe"]["runs"] == 2 and found["outcomes"]["collapsed"]["share"] == pytest.approx(1 / 3)
    rows = list(csv.DictReader(io.StringIO((options.folder / "ensemble.csv").read_text())))
    assert [(row["run"], row["folder"], row["verdict"], row["collapse_time_s"]) for row in rows] == [
        ("1", "runs/001", "unsafe", ""), ("2", "runs/002", "unsafe", ""), ("3", "runs/003", "collapsed", "2.9")]
    shown = Summary.read(options.folder)
    assert shown.ensemble == Ensemble(1, 3, {"unsafe": 2, "collapsed": 1}, [0.1, 0.12])
    assert frames.load(options.folder / frames.NAME).summary == shown
    assert (options.folder / "history.csv").read_bytes() == (planned[0].folder / "history.csv").read_bytes()
    assert (options.folder / "ensemble.png").stat().st_size > 10000 and (options.folder / "player.html").exists()


def test_failed_runs_are_counted_and_end_in_an_error(finished, monkeypatch):
    options, planned, _ = finished
    options = replace(options, no_views=True)
    (planned[1].folder / "summary.json").unlink()
    (planned[1].folder / "run.json").write_text('{"status": "failed", "error": "too fast"}')
    with pytest.raises(RunError, match="^1 of 3 runs have no results; run 2: too fast$"):
        complete(options, planned, monkeypatch)
    assert ensemble.read(options.folder)["finished"] == [1, 3]
    assert Summary.read(options.folder).ensemble.outcomes == {"unsafe": 1, "collapsed": 1, "failed": 1}
    assert list(csv.DictReader(io.StringIO((options.folder / "ensemble.csv").read_text())))[1]["error"] == "too fast"
    (planned[2].folder / "summary.json").unlink()
    (options.folder / "summary.json").unlink()
    with pytest.raises(RunError, match="^2 of 3"):
        complete(options, planned, monkeypatch)
    assert not (options.folder / "summary.json").exists()  # one run has no distribution


def test_lines_for_the_terminal(finished):
    _, _, found = finished
    lines = runs.lines(runs.content(found, {}), found[1])
    assert lines[1:3] == ["unsafe: 2 runs, 67 % (95 % confidence: 9 to 99 %)",
                          "collapsed: 1 run, 33 % (95 % confidence: 1 to 91 %)"]
    assert [line.split() for line in lines if line.startswith("collapse [s]")] == [[
        "collapse", "[s]", "2.9", "2.9", "in", "1", "run"
    ]]
    assert lines[-1] == "shown: run 1, nearest to the median of the peak drift of the unsafe ones"


def test_wall_sheets_have_a_line_of_their_own():
    sheets = {k: summary(broken={"total": 1, "wall_sheets": k}) for k in (1, 2, 5)}
    lines = runs.lines(runs.content(sheets, {}), sheets[1])
    assert [line.split()[:6] for line in lines if "wall" in line] == [["broken", "wall", "sheets", "2", "1", "to"]]


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"finished": [1], "shown": "x"}'])
def test_a_damaged_file_is_refused(tmp_path, content):
    (tmp_path / "ensemble.json").write_text(content)
    with pytest.raises(RunError, match="ensemble.json"):
        ensemble.read(tmp_path)


# --- sentences and picture --------------------------------------------------------------------------------------------


def place(**more):
    return {
        "ensemble": {
            "run": 2, "runs": 3, "outcomes": {"unsafe": 2, "collapsed": 1}, "peak_drift_standing": [1 / 14, 1 / 8],
            **more
        }
    }


def test_sentences_name_the_run_and_the_outcomes():
    plain, shown = summary(), summary(**place())
    assert sentence(
        shown) == f"Run 2 of 3 (2 unsafe, 1 collapsed; peak drift 1/14 to 1/8 in those that stand). {sentence(plain)}"
    none = summary(**place(outcomes={"collapsed": 3}, peak_drift_standing=None))
    assert sentence(none).startswith("Run 2 of 3 (3 collapsed). House A ")
    assert japanese.result(shown) == f"3 回の計算の 2 番目（危険 2 回、倒壊 1 回）。{japanese.result(plain)}"


def test_origin_names_the_run():
    recorded = sample()
    plain = provenance.provenance(recorded)
    recorded.summary = recorded.summary.changed(**place())
    assert provenance.provenance(recorded) == plain.replace("; time", "; Run 2 of 3; time")
    assert "3 回の計算の 2 番目" in provenance.provenance(recorded, japanese)


def histories():
    """Histories of three runs of one storey; the second ends after half the time."""
    time = np.arange(0, DURATION, 0.01)
    columns = ["time [s]", "drift_ns1 [-]", "drift_ew1 [-]"]
    return [
        History(columns, np.column_stack([time[:n], k * time[:n], 0 * time[:n]]))
        for n, k in ((400, 1), (200, 5), (400, 2))
    ]


def test_bands_of_three_runs():
    """At 1 s the drifts are 1, 5 and 2, at 3 s 3, 9.95 and 6: the run that has ended keeps its last drift."""
    found = curves.quantiles(histories(), np.array([1.0, 3.0]), 1, "ns")
    assert found == pytest.approx(np.array([[1, 1.5, 2, 3.5, 5], [3, 4.5, 6, 7.975, 9.95]]).T)


def test_page_of_bands():
    """A panel for each storey and direction; run 2 is the line."""
    recorded = sample()
    recorded.summary = recorded.summary.changed(**place())
    figure = curves.bands(recorded, dict(enumerate([recorded.history] * 3, 1)), 40)
    assert len(figure.axes) == 2
    assert [text.get_text()
            for text in figure.legends[0].texts] == ["range", "middle half", "median", "run 2, which is shown"]
    (line,) = [line for line in figure.axes[0].lines if line.get_label().startswith("run 2")]
    assert np.array_equal(line.get_ydata(), recorded.history.drift(1, "ns"))
