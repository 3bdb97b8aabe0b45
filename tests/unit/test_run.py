# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Whole runs of the scripts in separate YADE processes: results, resume after a kill, interruption, failure, live
session.
"""
import ast
import csv
import hashlib
import json
import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
from ports import listening_ports
from timber_houses.api.script import PAPER_RUNS
from timber_houses.base import lock
from timber_houses.recording import frames
from timber_houses.recording.summary import Summary
from timber_houses.house import build_house, load_house
from timber_houses.motion import GroundMotion, write_csv
from timber_houses.motion.record import MAX_ACCELERATION

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
YADE = [shutil.which("yade") or "yade", "-n", "-x"]
SHORT = ["--dt", "2e-4", "--no-views", "--quiet"]
SHOVED = ["--no-views", "--quiet", "--duration", 0.6]  # with the record `shove`, at the default step
PUBLISHED = {  # script -> (house, earthquake, snow); DESIGN, section 4
    **{f"model{house}_quake": (house, True, False) for house in ("A", "B", "C", "B1", "B2", "C1", "C2")},
    **{f"model{house}_snow": (house, False, True) for house in "ABC"},
    **{f"model{house}_snow": (house, True, True) for house in ("B1", "B2", "C1", "C2")},
}
MAY_DIFFER = {"wall_s", "real_time_factor", "threads"}


def run(script, *options, threads=1, **changes):
    """CompletedProcess of a script."""
    command = [*YADE, f"-j{threads}", str(SCRIPTS / f"{script}.py"), *map(str, options)]
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, **changes)


def own_errors(process):
    """Lines on standard error that are not YADE's greeting."""
    return [
        line for line in process.stderr.splitlines()
        if line and not line.startswith(("TCP python", "XMLRPC", "Running script"))
    ]


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def shove(tmp_path_factory):
    """A record that breaks joints within half a second: 4 g to the east and 2 g to the south, and up."""
    path = tmp_path_factory.mktemp("record") / "shove.csv"
    write_csv(GroundMotion(0.01, np.tile([40.0, -20.0, 15.0], (60, 1))), path, ["test"])
    return path


@pytest.fixture(scope="module")
def straight(tmp_path_factory, shove):
    """Folder of a run with many broken joints."""
    folder = tmp_path_factory.mktemp("straight")
    done = run("modelB1_quake", *SHOVED, "--record", shove, "--out", folder)
    lines = own_errors(done)
    assert done.returncode == 0 and len(lines) == 1 and "constant part" in lines[0], done.stderr
    return folder


def test_fourteen_scripts():
    """Each script is one call of main with its name, a row of one table."""
    found = []
    for path in SCRIPTS.glob("model*.py"):
        calls = [
            n for n in ast.walk(ast.parse(path.read_text()))
            if isinstance(n, ast.Call) and getattr(n.func, "id", "") == "main"
        ]
        assert [call.args[0].value for call in calls] == [path.stem]
        found.append(path.stem)
    assert {*found} == {*PUBLISHED} and PAPER_RUNS == PUBLISHED and len(found) == 14


@pytest.mark.parametrize("script", ["modelA_snow", "house"])
def test_without_yade(script):
    """A line, whether or not that Python has the package."""
    for python in (sys.executable, "python3"):
        done = subprocess.run([python, str(SCRIPTS / f"{script}.py")], capture_output=True, text=True,
                              env={"PATH": os.environ["PATH"]})
        assert done.returncode == 1 and done.stderr.count("\n") == 1 and "yade -n -x" in done.stderr, done.stderr


def test_summary(straight, shove):
    found = summary(straight)
    assert (found["scenario"], found["model"], found["earthquake"],
            found["snow"]) == ("modelB1_quake", "B1", True, False)
    assert (found["steps"], found["duration_s"], found["dt"], found["threads"]) == (1200, 0.6, 5e-4, 1)
    assert found["record"]["pga_gal"] == {"ns": 2000, "ew": 4000, "ud": 1500}
    assert shove.name in found["record"]["source"]
    assert found["record"][
        "dt"] == 0.01 and 0 < found["record"]["interpolation_error"] < 1  # the ends of a constant, and nothing else
    assert found["joints"]["total"] == sum(n for kind, n in found["joints"].items() if kind != "total")
    assert set(found["broken"]["by_side"]) == {"north", "south", "east", "west", "inside"}
    assert set(found["broken"]["by_storey"]) == {"1", "2", "entrance"}
    assert found["broken"]["damaged_at_start"]["column_beam"] == 8
    for drift in ("peak_drift", "residual_drift"):
        assert all(
            found[drift][storey][direction] >= 0 for storey in ("storey1", "storey2") for direction in ("ns", "ew"))
    assert set(found["versions"]) == {"yade", "package"} and all(found["versions"].values())


def test_broken_joints_agree(straight):
    """The summary counts what the list of breaks lists: joints whose springs all broke, by storey, and springs."""
    found, lines = summary(straight)["broken"], list(csv.DictReader(open(straight / "breaks.csv")))
    assert len(lines) == found["springs"] > 20
    springs = {}
    for line in lines:
        springs.setdefault((line["joint"], line["storey"], line["kind"]), set()).add(line["spring"])
    whole = [joint for joint, broken in springs.items() if len(broken) == 4]
    assert len(whole) == found["total"] > 0 and len(springs) - len(whole) == found["partly_broken"]
    assert sum(kind == "column_beam" for _, _, kind in whole) == found["column_beam"]
    assert {s: sum(place == s for _, place, _ in whole) for s in found["by_storey"]} == found["by_storey"]
    assert {line["cause"] for line in lines} <= {"tension", "compression", "shear"}


def test_events(straight):
    """The first break is that of the list of breaks; the house still moves when the run ends."""
    found, first = summary(straight), next(csv.DictReader(open(straight / "breaks.csv")))
    (event,) = (event for event in found["events"] if event["kind"] == "first_break")
    facts = {"joint": first["kind"], **{key: first[key] for key in ("storey", "side", "cause")},
             "force_n": pytest.approx(float(first["force [N]"]))}
    assert event["time_s"] == pytest.approx(float(first["time [s]"]), abs=1e-6) and event["facts"] == facts
    assert [event["time_s"] for event in found["events"]] == sorted(event["time_s"] for event in found["events"])
    assert found["still_moving"] is True and max(found["final_amplitude"]["storey1"].values()) > 1e-3


def test_energy_is_accounted_for(straight):
    """input = kinetic + elastic + dissipated - residual, as the summary defines it."""
    energy = summary(straight)["energy"]
    kept = energy["kinetic"] + energy["elastic"] + sum(energy["dissipated"].values())
    assert kept - energy["input"] == pytest.approx(energy["residual"], abs=1e-9 * energy["input"])
    assert energy["residual_fraction"] == pytest.approx(abs(energy["residual"]) / energy["input"])


@pytest.mark.parametrize("study", ["paper_table", "robustness_study"])
def test_studies_take_the_runs_that_they_make(straight, study):
    """A study, which needs no YADE, imports the same state of the package as its runs."""
    options = summary(straight)["made_from"]["options"]
    code = f"""import pathlib, runpy
from timber_houses.run.options import RunOptions
of = runpy.run_path({str(SCRIPTS.parent / 'research' / study)!r} + '.py')
print(of['Task'](pathlib.Path({str(straight)!r}), RunOptions(**{options!r})).summary is not None)"""
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "True\n"


def assert_same_results(one, other):
    """Byte for byte, but for the wall time and the number of threads."""
    for name in ("history.csv", "breaks.csv"):
        assert digest(one / name) == digest(other / name), name
    first, second = ({k: v for k, v in summary(folder).items() if k not in MAY_DIFFER} for folder in (one, other))
    assert json.dumps(first) == json.dumps(second)
    assert_same_frames(one, other)


def assert_same_frames(one, other):
    """Every number and word of frames.h5."""
    with h5py.File(one / frames.NAME) as first, h5py.File(other / frames.NAME) as second:
        names = []
        first.visit(names.append)
        assert {"frames/position", "contacts/force", "breaks/cause"} <= set(names)
        for name in names:
            if isinstance(first[name], h5py.Dataset):
                assert np.array_equal(first[name][()], second[name][()]), name


def test_frames(straight):
    """20 a second and the last state; they agree with the other results, and print in a line."""
    made, found = frames.load(straight / frames.NAME), summary(straight)
    assert np.allclose(made.time, np.arange(13) * 0.05) and np.allclose(made.contacts.time, [0, 0.5, 0.6])
    assert made.summary == Summary.read(straight)
    assert made.title == "House B1: earthquake"
    assert len(made.breaks["time"]) == found["broken"]["springs"]
    assert made.history.text() == (straight / "history.csv").read_text()
    assert len(repr(made)) < 150 > len(repr(made.contacts))
    states = made.joint_states(-1)
    assert (states
            == "broken").sum() == found["broken"]["total"] and (states
                                                                == "partly").sum() == found["broken"]["partly_broken"]
    assert (states == "before").sum() == found["broken"]["damaged_at_start"]["total"]
    assert 0.5 < made.load.max() <= 1 and np.ptp(made.position[:, made.elements.kind.index("roof")], axis=0).max() > 0.1
    assert np.allclose(np.linalg.norm(made.orientation, axis=2), 1, atol=1e-6)


def test_frames_of_the_start_are_the_house(straight):
    """Corners, joints and contacts in the first frame and at the end, against the house that was built."""
    made, model = frames.load(straight / frames.NAME), build_house(load_house("B1"), snow_depth=0.0)
    assert made.elements.name == [e.name for e in model.elements] and made.joints.name == [j.name for j in model.joints]
    for k, element in enumerate(model.elements):
        assert np.allclose(made.corners(0, k), element.vertices, atol=1e-5), element.name
    assert np.allclose(made.joint_places(0), [j.centre for j in model.joints], atol=1e-5)
    pair, position = made.contacts.pair[-1], made.contacts.position[-1]
    assert len(pair) > 100
    for (a, _), place in list(zip(pair, position))[::20]:
        corners = made.corners(-1, a)
        assert (corners.min(0) - 0.02 < place).all() and (place < corners.max(0) + 0.02).all()


SHED = """extends: base
name: shed
snow: {depth: 0.5}
structures:
  shed:
    place: {origin: [0, 0]}
    grid: {x: {module: 1.2, count: 2}, y: {module: 1.2, count: 2}}
    margin: 0.06
    lines: [{along: y, at: [0, 2], from: 0, to: 2}, {along: x, at: [0, 2], from: 0, to: 2, cut: true}]
    stack:
      - {layer: sill, height: 0.12, width: 0.12}
      - {layer: columns, height: 2.2}
      - {layer: beams, height: 0.12, width: 0.12}
      - {layer: roof, type: gable, pitch: 1.0, thickness: 0.1, material: roofing}
    columns: [{section: 0.12, grid: {x: [0, 2], y: [0, 2]}}]
    braces: {lines: [{along: y, at: [0, 2], runs: [[0, 2]]}, {along: x, at: [0, 2], runs: [[2, 0]]}]}
"""
"""House file of a frame whose steep roof loses its snow: loose members, and equal periods of equal parts."""


@pytest.mark.rare
def test_summary_is_the_same_to_the_last_digit(tmp_path):
    """Natural modes included: with one and two threads, and after a resume. Free motions, and those of loose members
    alone, are none of them."""
    house = tmp_path / "shed.yaml"
    house.write_text(SHED)
    options = [house, "--quake", "--scale", 0.05, "--start", 18, "--no-views", "--quiet", "--checkpoint", 0.5]
    straight, two, resumed = (tmp_path / name for name in ("straight", "two", "resumed"))
    runs = ((straight, 1.6, 1), (two, 1.6, 2), (resumed, 1.2, 1), (resumed, 1.6, 1))
    for folder, duration, threads in runs:
        again = ["--resume"] if folder.exists() else []
        done = run("house", *options, "--duration", duration, "--out", folder, *again, threads=threads)
        assert done.returncode == 0, done.stderr
    assert_same_results(straight, two)
    assert_same_results(straight, resumed)
    modes = summary(straight)["quantities"]["modes"]
    assert all(mode["period_s"] is None or mode["period_s"] < 60 for when in modes.values() for mode in when["modes"])
    directions = {when: [mode["direction"] for mode in modes[when]["modes"]] for when in modes}
    assert directions == {"before": ["ew", "ns"], "after": ["ns", "ew"]}


def test_killed_and_resumed(tmp_path, shove, straight):
    """SIGKILL right after a checkpoint and again later: the end is the same to the last bit."""

    def options(duration):
        return [*SHOVED, "--duration", duration, "--record", shove, "--out", tmp_path, "--checkpoint", 0.05]

    victim = subprocess.Popen([*YADE, "-j1", str(SCRIPTS / "modelB1_quake.py"), *map(str, options(0.6))],
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wait_for(lambda: (tmp_path / "checkpoint.yade").exists(), victim)
    victim.kill()
    victim.wait()
    assert not (tmp_path / "summary.json").exists()
    assert run("modelB1_quake", *options(0.35), "--resume").returncode == 0  # ends early, goes on later
    assert not (tmp_path / "samples.log").exists()
    done = run("modelB1_quake", *options(0.6), "--resume")
    assert done.returncode == 0, done.stderr
    assert_same_results(straight, tmp_path)


def wait_for(condition, process, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert process.poll() is None and time.monotonic() < end, "the run ended too early or did not begin"
        time.sleep(0.02)


def test_interrupted(tmp_path):
    """SIGTERM: a checkpoint, one line, status 128 + 15; a checkpoint of another scenario is refused."""
    victim = subprocess.Popen([*YADE, "-j1", str(SCRIPTS / "modelA_quake.py"), *SHORT, "--checkpoint", "0.02", "--out",
                               str(tmp_path)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
    wait_for(lambda: (tmp_path / "checkpoint.yade").exists(), victim)
    victim.terminate()
    _, said = victim.communicate(timeout=60)
    assert victim.returncode == 128 + signal.SIGTERM and "--resume" in said.splitlines()[-1]
    other = run("modelA_quake", *SHORT, "--dt", "1e-4", "--out", tmp_path, "--resume")
    assert other.returncode == 1 and len(own_errors(other)) == 1, other.stderr
    assert "checkpoint.yade" in other.stderr and "dt is 0.0002 there and 0.0001 here" in other.stderr
    early = run("modelA_quake", *SHORT, "--duration", "0.001", "--out", tmp_path, "--resume")
    assert early.returncode == 1 and "--duration 0.001" in early.stderr
    anew = run("modelA_quake", *SHORT, "--dt", "1e-4", "--duration", "0.001", "--out", tmp_path, "--resume",
               "--or-anew")
    assert anew.returncode == 0 and summary(tmp_path)["steps"] == 10, anew.stderr


@pytest.mark.rare
def test_resume_without_the_frames_of_the_run(tmp_path, straight):
    """Frames that are missing, of another run, of an earlier time, or a pipe: a line before the first step; without
    frames, or anew, the run goes on.
    """
    longer = [*SHORT, "--duration", 0.1, "--out", tmp_path, "--resume"]
    recorded = tmp_path / frames.NAME

    def refused():
        done = run("modelA_snow", *longer)
        assert done.returncode == 1 and len(own_errors(done)) == 1 and frames.NAME in done.stderr, done.stderr

    assert run("modelA_snow", *SHORT, "--duration", 0.06, "--out", tmp_path).returncode == 0
    made = frames.load(recorded)
    recorded.unlink()
    refused()
    os.mkfifo(recorded)
    refused()
    recorded.unlink()
    shutil.copy(straight / frames.NAME, recorded)
    refused()
    for name in ("time", "position", "orientation", "load", "broken"):
        setattr(made, name, getattr(made, name)[:1])
    frames.save(recorded, made)
    refused()
    assert run("modelA_snow", *longer, "--no-frames").returncode == 0
    assert summary(tmp_path)["steps"] == 500
    assert not recorded.exists()
    longer[longer.index(0.1)] = 0.12
    assert run("modelA_snow", *longer, "--or-anew").returncode == 0 and len(frames.load(recorded).time) == 4


@pytest.mark.parametrize("checkpoint", [pytest.param(0, marks=pytest.mark.rare), 0.05])
def test_a_limit_of_the_file_size(tmp_path, checkpoint):
    """As by `ulimit -f`: one line of this package, and no crash at the end."""
    def limited():
        resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))

    done = run("modelA_snow", *SHORT, "--duration", 0.1, "--checkpoint", checkpoint, "--out", tmp_path,
               preexec_fn=limited)
    errors = [line for line in own_errors(done) if line.startswith("error: ")]
    assert done.returncode == 1 and len(errors) == 1 and "File too large" in errors[0], done.stderr


INTERRUPTED = """
import os, signal, threading
from timber_houses.api.script import main
for seconds in {times}:
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()
main("modelA_quake", ["modelA_quake.py", *{options}])
"""


@pytest.mark.parametrize("times", [
    (1.5,), (0.2, 0.21), *(pytest.param((time,), marks=pytest.mark.rare) for time in (0.05, 0.3)),
    pytest.param((2.0, 2.02, 2.3), marks=pytest.mark.rare)])
def test_interrupted_at_once_or_twice(tmp_path, times):
    """Ctrl-C while modules are imported, the house is built, or steps are made: a line, no traceback. times: after the
    start of `main` [s].
    """
    script = tmp_path / "script.py"
    script.write_text(INTERRUPTED.format(times=times, options=[*SHORT, "--out", str(tmp_path / "out")]))
    done = subprocess.run([*YADE, "-j1", str(script)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=120)
    assert done.returncode == 128 + signal.SIGINT and len(
        own_errors(done)) == 1 and "SIGINT" in done.stderr, done.stderr


def test_no_port_is_open_during_a_run(tmp_path):
    """YADE has opened its ports when the script begins; with -x they are closed."""
    command = [*YADE, "-j1", str(SCRIPTS / "modelA_snow.py"), *SHORT, "--duration", "60", "--out", str(tmp_path)]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        wait_for(lambda: listening_ports(process.pid), process)
        wait_for(lambda: (tmp_path / lock.LOCK).exists(), process)
        time.sleep(1.0)  # twice the time that a server takes to stop
        assert process.poll() is None and listening_ports(process.pid) == []
    finally:
        process.kill()
        process.communicate()


def test_output_files_follow_the_umask(tmp_path):
    """Parts of files that killed processes have left are removed."""
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / ".part-0123-frames.h5").write_text("half")
    done = subprocess.run(["sh", "-c", 'umask 027; exec "$0" "$@"', *YADE, "-j1", str(SCRIPTS / "modelA_snow.py"),
                           *SHORT, "--duration", "0.01", "--out", str(tmp_path / "out")], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=120)
    modes = {path.name: oct(path.stat().st_mode & 0o777) for path in (tmp_path / "out").iterdir()}
    assert done.returncode == 0 and len(modes) >= 5 and set(modes.values()) == {"0o640"}, (modes, done.stderr)
    assert not [name for name in modes if name.startswith(".part")]


@pytest.mark.rare
def test_a_collapse_ends_the_run_on_request(tmp_path, shove):
    """The run ends with the frame that follows the collapse (every 0.05 s), in the state of a run that goes on; also
    when it is resumed.
    """
    options = ["A", "--record", shove, "--duration", 1, "--dt", "4e-4", "--no-views", "--quiet", "--checkpoint", 0.2]
    for name, more in (("whole", ()), ("ended", ("--until-collapse",))):
        done = run("house", *options, *more, "--out", tmp_path / name)
        assert done.returncode == 0, done.stderr
    whole, ended = (summary(tmp_path / name) for name in ("whole", "ended"))
    assert ended["until_collapse"] and not whole["until_collapse"] and whole["duration_s"] == 1
    assert ended["collapse_time_s"] == whole["collapse_time_s"]
    assert 0 <= ended["duration_s"] - ended["collapse_time_s"] < 0.0505
    assert ended["steps"] == round(ended["duration_s"] / 4e-4)
    assert ended["events"] == whole["events"][:len(ended["events"])]
    histories = [(tmp_path / name / "history.csv").read_text() for name in ("whole", "ended")]
    assert histories[0].startswith(histories[1])
    again = run("house", *options, "--until-collapse", "--out", tmp_path / "ended", "--resume")
    assert again.returncode == 0 and summary(tmp_path / "ended")["duration_s"] == ended["duration_s"], again.stderr
    other = run("house", *options, "--out", tmp_path / "ended", "--resume")
    assert other.returncode == 1 and "until_collapse is True there and None here" in other.stderr


def test_one_process_a_folder(tmp_path):
    with lock.locked(tmp_path) as free:
        other = run("modelA_snow", "--duration", 0.001, "--out", tmp_path)
    assert free
    assert other.returncode == 1
    assert str(tmp_path) in other.stderr
    assert "another process" in other.stderr
    assert len(own_errors(other)) == 1


def test_nothing_simulated(tmp_path):
    """A run of no time: pictures of the start, a summary with nothing in it, status 0. Which options it had is in the
    summary, those of the output are not.
    """
    done = run("modelA_snow", "--duration", 0, "--dt", "2e-4", "--out", tmp_path)
    assert done.returncode == 0 and (tmp_path /
                                     "front.png").exists() and not (tmp_path / "history.png").exists(), done.stderr
    found = summary(tmp_path)
    assert found["steps"] == 0
    assert found["made_from"]["options"] == {"name": "modelA_snow", "house": "A", "snow": 1.0, "duration": 0.0,
                                             "dt": 2e-4}


def test_a_motion_without_shaking(tmp_path):
    """The quiet start of the shipped motion: no onset, and results as of any run."""
    done = run("modelA_quake", "--end", 1, "--duration", 0.01, "--no-views", "--out", tmp_path)
    assert done.returncode == 0 and summary(tmp_path)["record"]["onset_s"] is None, done.stderr


@pytest.mark.rare
def test_export_alone(tmp_path):
    """With no time to simulate nothing else is written; what lies in the folder stays, also when the file cannot be
    written.
    """
    assert run("modelA_snow", *SHORT, "--duration", 0.02, "--out", tmp_path).returncode == 0
    before = {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir() if path.name != lock.LOCK}
    assert run("modelA_snow", *SHORT, "--duration", 0, "--export", tmp_path.with_suffix(".json"), "--out",
               tmp_path).returncode == 0
    assert run("modelA_snow", *SHORT, "--duration", 0.02, "--export", tmp_path / "no" / "where.json", "--out",
               tmp_path).returncode == 1
    assert json.loads(tmp_path.with_suffix(".json").read_text())["elements"]
    assert before == {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir() if path.name != lock.LOCK}


def test_failed_run_is_named_as_cut_off(tmp_path):
    """The largest ground motion that is read: the health check's line, status 1; the results until then say where they
    end.
    """
    record = tmp_path / "wild.csv"
    write_csv(GroundMotion(0.01, np.full((20, 3), MAX_ACCELERATION)), record, ["test"])
    (tmp_path / "summary.json").write_text("{}")
    done = run("modelA_quake", *SHORT, "--no-frames", "--duration", 0.2, "--record", record, "--out", tmp_path)
    lines = own_errors(done)
    expected = ("check the unit", "constant part", "left the physical range")
    assert done.returncode == 1 and len(lines) == len(expected), done.stderr
    assert all(phrase in line
               for phrase, line in zip(expected, lines)) and "the run stops at 0.1400 s" in lines[-1], done.stderr
    assert "left the physical range" in summary(tmp_path)["cut_off"] and not (tmp_path / frames.NAME).exists()


def test_messages_pictures_export(tmp_path):
    """Without --quiet: house and loads first, a bar, a sentence, the files written; all of them are there. Snow only,
    with the scene exported.
    """
    done = run("modelA_snow", "--dt", "2e-4", "--duration", "0.02", "--out", tmp_path / "out", "--export",
               tmp_path / "scene.json")
    assert done.returncode == 0, done.stderr
    assert [line for line in done.stdout.splitlines() if "House" in line][0] == "House A: 1 m of snow only"
    assert "House A is undamaged: peak storey drift" in done.stdout
    assert re.search(r"snow 5\.6 t$", done.stdout, re.MULTILINE)
    *_, written, following = done.stdout.splitlines()
    files = written.removeprefix("written: ").split(", ")
    assert following == f"next: xdg-open {tmp_path / 'out' / 'player.html'}" and Path(following.split()[-1]).is_file()
    assert {Path(name).name for name in files} >= {"summary.json", "history.csv", "breaks.csv", "end_state.png",
                                                   "checkpoint.yade", "scene.json"}
    assert all(Path(name).stat().st_size > 0 for name in files) and "0.02 s" in done.stderr
    assert summary(tmp_path / "out")["record"] is None and not list(tmp_path.rglob(".part*"))
    assert json.loads((tmp_path / "scene.json").read_text())["joints"]


def test_live_session(tmp_path):
    """Without -x, at a terminal: the scene runs, O, yt and run are there, the results follow at the end. Until then the
    session has the folder's lock.
    """
    try:
        ours, theirs = pty.openpty()
    except OSError:
        pytest.skip("this system has no pseudo-terminal")
    command = [YADE[0], "-n", str(SCRIPTS / "modelA_snow.py"), "--dt", "2e-4", "--duration", "0.52", "--no-views",
               "--out", str(tmp_path)]
    session = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=subprocess.STDOUT, close_fds=True,
                               env={**os.environ, "TERM": "dumb"})
    os.close(theirs)
    said = ""
    try:
        while "<modelA_snow" not in said:  # the prompt is back
            said += os.read(ours, 1 << 20).decode(errors="replace")
        assert lock.is_locked(tmp_path) or (tmp_path / "summary.json").exists()
        wait_for(lambda: (tmp_path / "summary.json").exists(), session)
        wait_for(lambda: not lock.is_locked(tmp_path), session)
    finally:
        session.kill()
        session.wait()
        os.close(ours)
    assert summary(tmp_path)["steps"] == 2600
    assert np.allclose(frames.load(tmp_path / frames.NAME).time, [*np.arange(11) * 0.05, 0.52])
