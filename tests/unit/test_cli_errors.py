# SPDX-License-Identifier: GPL-2.0-or-later
"""Bad input ends a run script with one line on standard error and status 1, before anything is built or written."""
import os
import re

import numpy as np
import pytest
from timber_houses.run import cli
from timber_houses.run.options import QUIET_DURATION, RunOptions
from timber_houses.run.plan import planned
from timber_houses.base.options import BY_SCRIPT, command_option, options
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import MAX_DT, MAX_DURATION, MIN_DT
from timber_houses.motion import GroundMotion, MotionRequest, pga, write_csv
from timber_houses.api import script
from timber_houses.study.ensemble.runs import tasks


@pytest.fixture
def record(tmp_path):
    """A good record, which the tests damage."""
    path = tmp_path / "record.csv"
    write_csv(GroundMotion(0.01, np.ones((50, 3))), path, ["test"])
    return path


@pytest.fixture
def refused(tmp_path, capsys, monkeypatch):
    """Call a script with options; returns its line on standard error."""

    def call(*options, house="C2", out=tmp_path / "out", earthquake=True):
        with pytest.raises(SystemExit) as stop:
            monkeypatch.setitem(script.PAPER_RUNS, "modelC2_quake", (house, earthquake, False))
            script.main("modelC2_quake", ["scripts/modelC2_quake.py", "--duration", "0.001", "--out", str(out),
                                          *map(str, options)])
        said = capsys.readouterr()
        assert stop.value.code == 1
        assert said.err.startswith("error: ") and said.err.count("\n") == 1, said.err
        assert not (tmp_path / "out" / "summary.json").exists()
        return said.err

    return call


AN_ENSEMBLE = "--ensemble=4"
REFUSED = [
    *((f"--dt={dt}", f"between {MIN_DT:g} and {MAX_DT:g}") for dt in ("0", "-1e-4", "nan", "inf", "1e-2", "1e-8")),
    *((f"{option}={value}", ">= 0") for option in ("--duration", "--scale", "--checkpoint")
      for value in ("-1", "nan", "inf")),
    *((f"{option}={value}", f"at most {MAX_DURATION:g}") for option in ("--duration", "--checkpoint")
      for value in ("1e308", "9" * 30, "9" * 5000, "100001")),  # the number of steps would overflow
    *((f"--joint-damping={value}", "between 0 and 1") for value in ("-0.1", "1.1", "nan")),
    *((f"--ensemble={value}", "between 2 and 999") for value in ("1", "0", "-3", "1000")),
    *((f"--ensemble={value}", "must be a whole number") for value in ("x", "", "2.5", "9" * 5000)),
    *((f"{option}={value}", f"{option} ''") for option in ("--out", "--export") for value in ("", "  ")),
    ("--snow 2", "--snow"), ("-x", "before the script"), ("--dur 1", "--dur"),
    ("--azimuth nan", "--azimuth nan: must be between -360 and 360"),
    ("--pga 0", "--pga 0: must be >= 0.001"),
    ("--intensity 9", "--intensity 9: must be between 0 and 8"),
    ("--pga 300 --intensity 6", "--pga and --intensity exclude each other"),
    ("--scale 2 --pga 300", "--pga and --scale exclude each other"),
    ("--record x --seed 1", "--record and --seed exclude each other"),
    ("--seed -1", "--seed -1: must be"),
    ("--units gal", "--units belongs to a record; give --record"),
    ("--start 9 --end 9", "--end 9: must be > 9 s"),
    ("--start 50", "nothing between 50 and"),
    ("--highpass 50", "it must lie between 0 and 50 Hz"),
    ("--detrend 1.5", "--detrend"),
    ("--report --no-frames", "--report and --no-frames exclude each other"),
    (f"{AN_ENSEMBLE} --resume", "--ensemble and --resume exclude each other: an ensemble always continues"),
    *((f"{AN_ENSEMBLE} {other}", f"--ensemble and {other.split()[0]} exclude each other")
      for other in ("--or-anew", "--export scene.json", "--disturb 2", "--checkpoint 1")),
    (f"{AN_ENSEMBLE} --dt 1", "--dt 1: must be between"),
    (f"{AN_ENSEMBLE} --jobs 0", "--jobs 0: must be between 1 and 999"),
    ("--jobs 2", "--jobs 2: belongs to an ensemble"),
    ("--disturb 0", "--disturb 0: must be >= 1"),
    ("--disturb x", "--disturb 'x': must be a whole number"),
]
"""(options, part of the message)"""


@pytest.mark.parametrize("words, said", REFUSED)
def test_refused_options(refused, words, said):
    assert said in refused(*([words] if words.endswith(" ") else words.split()))


@pytest.mark.parametrize("option", ["--record=x", "--scale=2", "--seed=0", "--resample"])
def test_no_earthquake_to_change(refused, option):
    assert "no earthquake" in refused(option, earthquake=False)


@pytest.mark.parametrize("option", ["--duration", "--dt", "--checkpoint", "--joint-damping"])
@pytest.mark.parametrize("value", ["long", "", "1e", "0x10", "1,5", "-", "\x00"])
def test_not_a_number(refused, option, value):
    assert option in refused(option, value)


def test_unknown_model(refused):
    assert "unknown house 'D9'" in refused("--duration", 0, house="D9")


def test_runs_of_an_ensemble_have_the_options_that_decide_the_results():
    argv = ["scripts/modelA_quake.py", "--ensemble", "4", "--jobs=2", "--scale", "2", "--no-views", "--out", "x"]
    given = cli.read("A", True, False, argv)
    first, second, *_ = tasks(given)
    assert (given.ensemble, given.jobs) == (4, 2)
    assert first.options.decisive() == {"name": "modelA_quake", "house": "A", "quake": True, "snow": 0.0, "scale": 2.0}
    assert second.options.decisive() == {**first.options.decisive(), "disturb": 2}


def test_motion_options_reach_the_scenario(record):
    argv = ["scripts/modelA_quake.py", "--record", str(record), "--pga", "250", "--azimuth", "90", "--end", "0.3"]
    scenario = planned(cli.read("A", True, False, argv))
    assert pga(scenario.motion, "level") == pytest.approx(250) and scenario.duration == pytest.approx(0.31)
    assert scenario.motion.source.endswith("turned by 90 degrees; cut to 0-0.3 s; scaled by 2.5")
    fine = planned(cli.read("A", True, False, [*argv, "--resample", "--dt", "2e-4"]))
    assert fine.motion.dt == 2e-4 and "resampled to 0.0002 s (bandlimited)" in fine.motion.source


def test_missing_record(refused, tmp_path):
    assert "no-such" in refused("--record", tmp_path / "no-such")


def test_binary_record(refused, record):
    record.write_bytes(bytes(range(256)) * 4)
    assert record.name in refused("--record", record)


@pytest.mark.parametrize("folder", ["/proc/x", "/proc", "/dev/null", "{record}/below", "{record}", "{long}"])
def test_unwritable_folder(refused, record, folder):
    """Not even root can write in these."""
    assert "--out" in refused("--duration", 0, out=folder.format(record=record, long="x" * 300))


def test_unwritable_export(refused, tmp_path):
    for path in (tmp_path / "nowhere" / "scene.json", tmp_path, "/proc/x", "x" * 300):
        assert "--export" in refused("--duration", 0, "--export", path)


@pytest.mark.parametrize("content",
                         [b"", b"no checkpoint", b"\n{}", b"\x00" * 1000 + b"\n[1]", b'xyz\n{"sha256": "0"}'])
def test_damaged_checkpoint(refused, tmp_path, content):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "checkpoint.yade").write_bytes(content)
    assert "checkpoint.yade" in refused("--resume")


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: os.symlink("/dev/zero", path)])
def test_checkpoint_that_is_no_file(refused, tmp_path, make):
    """A pipe does not block, a device does not fill the memory."""
    (tmp_path / "out").mkdir()
    make(tmp_path / "out" / "checkpoint.yade")
    assert "checkpoint.yade" in refused("--resume")


def test_results_that_cannot_be_removed(refused, tmp_path):
    (tmp_path / "out" / "history.csv").mkdir(parents=True)
    assert "history.csv" in refused()


def test_a_lock_that_is_a_link(refused, tmp_path):
    """The linked file keeps its content."""
    (tmp_path / "out").mkdir()
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "out" / ".lock").symlink_to(tmp_path / "mine")
    assert ".lock" in refused() and (tmp_path / "mine").read_text() == "mine"


def test_defaults():
    """Defaults of options come from the motion and the package's constants."""
    given = cli.read("C2", True, True, ["scripts/modelC2_snow.py"])
    scenario = planned(given)
    assert (scenario.name, scenario.duration, scenario.snow_depth,
            scenario.scale) == ("modelC2_snow", scenario.motion.duration, 1.0, 1.0)
    assert str(given.folder) == "results/modelC2_snow" and given.views and not given.resume
    scenario = planned(cli.read("A", False, True, ["scripts/modelA_snow.py"]))
    assert scenario.motion is None and scenario.duration == QUIET_DURATION


def test_record_warnings_are_one_line(monkeypatch, capsys, record):
    def noisy(_request, _dt, _given):
        import warnings

        warnings.warn("samples: 50, header says 60")
        return GroundMotion(0.01, np.ones((50, 3)))

    monkeypatch.setattr(MotionRequest, "motion", noisy)
    planned(cli.read("A", True, False, ["x.py", "--record", str(record)]))
    assert capsys.readouterr().err == "note: samples: 50, header says 60\n"


def test_help_names_every_option_but_those_of_studies(capsys):
    with pytest.raises(SystemExit) as stop:
        cli.read("A", True, False, ["scripts/modelA_quake.py", "-h"])
    assert stop.value.code == 0
    shown = capsys.readouterr().out
    assert [name for name in options(RunOptions) if name not in BY_SCRIPT and command_option(name) not in shown] == [
        "every_step", "disturb", "export", "or_anew"]


def test_help_begins_with_the_ten_main_options_and_ends_with_those_of_the_motion(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    with pytest.raises(SystemExit):
        cli.read_house(["scripts/house.py", "-h"])
    shown = capsys.readouterr().out.splitlines()
    main = [line.split()[0] for line in shown[:24] if line.startswith("  --")]
    assert len(main) >= 10 and {"--record", "--quake", "--snow", "--duration", "--out"} <= set(main)
    of_motion = [line.split()[0] for line in shown[shown.index("ground motion:"):] if line.startswith("  --")]
    assert of_motion == [command_option(name) for name in options(MotionRequest) if name != "record"]


@pytest.mark.parametrize("option, remedy", [("--quak", "did you mean '--quake'?"),
                                            ("--joint_damping=0.1", "did you mean '--joint-damping'?")])
def test_a_misspelt_option_is_answered_with_the_nearest(option, remedy):
    with pytest.raises(RunError, match=re.escape(remedy)):
        cli.read_house(["scripts/house.py", "A", option])


@pytest.mark.parametrize("earthquake, snow, loads", [(False, True, "1 m of snow only"),
                                                     (True, True, "earthquake and 1 m of snow"),
                                                     (True, False, "earthquake"), (False, False, "own weight only")])
def test_help_states_the_loads(earthquake, snow, loads, capsys):
    with pytest.raises(SystemExit):
        cli.read("A", earthquake, snow, ["scripts/run.py", "--help"])
    assert f"House A: {loads}. " in " ".join(capsys.readouterr().out.split())
