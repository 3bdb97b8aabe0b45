# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities, their page and the report of a short run; resumed runs; the lines of invented results."""
import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import frames_sample
import h5py
import numpy as np
import pytest
from markupsafe import escape
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.base.table import read_rows
from timber_houses.pictures import figures, player, quantities, report, report_pictures
from timber_houses.pictures.key_times import LAG, last_shown
from timber_houses.pictures.sheets import Stills
from timber_houses.recording.failures import first_failures
from timber_houses.recording.events import Collapse, Event, SnowFallen
from timber_houses.recording.summary import Summary
from timber_houses.recording.summary_parts import Mode, ModesAt, OtherWalls, Walls, Weight
from timber_houses.recording.quantities import SUSTAINED, Storeys, band_limited, ground_velocity, storeys
from timber_houses.recording.frames import load, save
from timber_houses.recording.record import Motion
from timber_houses.run.options import RunOptions, scripted
from timber_houses.run.runner import clear
from timber_houses.text.lines import MOST, lines

ROOT = Path(__file__).resolve().parents[2]


def command(out, *options):
    words = ["yade", "-n", "-x", ROOT / "scripts" / "modelB1_quake.py", "--start", "17.5", "--dt", "5e-4", "--out", out,
             "--no-views", "--quiet", *options]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A run of 1.3 s that ends in strong shaking."""
    out = tmp_path_factory.mktemp("run")
    command(out, "--duration", "1.3")
    return out


def test_files_and_summary(folder):
    """Tables are complete and sorted; the summary's peaks are those of the tables."""
    found, joints, columns = load(folder / "frames.h5"), *(read_rows(folder / name) for name in ("joints.csv",
                                                                                                "columns.csv"))
    known = found.summary.quantities
    loads, uplift = ([float(row[name]) for row in rows]
                     for rows, name in ((joints, "utilisation [-]"), (columns, "uplift [m]")))
    assert loads == sorted(loads, reverse=True) and uplift == sorted(uplift, reverse=True)
    assert len(joints) == found.summary.joints.total and len(columns) == found.summary.columns.total
    assert known.largest_utilisation.value == pytest.approx(loads[0], abs=1e-4)
    assert known.largest_pull.force == pytest.approx(
        max(float(row["pull [N]"]) for row in joints if row["strength [N]"] != "inf"))
    assert known.until_s is None, "the house stands"
    for axis in ("ns", "ew"):
        assert known.base_shear.peak[axis] == pytest.approx(found.storeys.peak(f"base_shear_{axis}"), abs=1e-3)
    assert known.storeys["storey1"].mass_above_kg > known.storeys["storey2"].mass_above_kg > 1000


def test_the_record_has_the_tables(folder):
    """Numbers and states of the CSV files, to their twelve digits, and the peaks of the summary."""
    found = load(folder / "frames.h5")
    known, e, states = found.summary.quantities, found.elements, found.joint_states(-1)
    joints = {row["joint"]: row for row in read_rows(folder / "joints.csv")}
    for k, name in enumerate(found.joints.name):
        assert joints[name]["state"] == states[k]
        assert [float(joints[name][f"{quantity}"]) for quantity in ("utilisation [-]", "pull [N]", "shear [N]",
                                                                    "opening [m]")] == pytest.approx(
            [found.peaks[quantity][k] for quantity in ("load", "pull", "shear", "opening")], rel=1e-11)
    columns = [(row["column"], row["state"], float(row["uplift [m]"])) for row in read_rows(folder / "columns.csv")]
    assert [(name, state) for name, state, _ in columns] == [
        (e.name[k], state) for k, state in zip(found.columns["element"], found.columns["state"])]
    assert [uplift for *_, uplift in columns] == pytest.approx(found.columns["uplift"], rel=1e-11)
    assert found.storeys.text() == (folder / "storeys.csv").read_text()
    for quantity, key in (("pull", "largest_pull"), ("shear", "largest_shear")):
        largest = getattr(known, key)
        number = found.joints.name.index(largest.joint)
        assert found.peaks[quantity][number] == pytest.approx(largest.force) and largest.force > 0
    assert player.uplifts(found)[e.name.index(known.largest_uplift.column)] == pytest.approx(
        known.largest_uplift.uplift_m, abs=1e-6)


def test_shear_is_a_spring_force(folder):
    """Storey shear and drift have the same sign, and while the house stays elastic they are nearly proportional."""
    found = load(folder / "frames.h5")
    drift = np.interp(found.storeys.time, found.history.time, found.history.drift(2, "ns"))
    assert np.corrcoef(drift, found.storeys.column("shear_ns2"))[0, 1] > 0.5


@pytest.mark.rare
def test_a_resumed_run_has_the_same_tables(folder, tmp_path):
    """Momenta, joint peaks and the first modes are in the checkpoint: the files keep every bit."""
    command(tmp_path, "--duration", "1.2")
    command(tmp_path, "--duration", "1.3", "--resume", "--report")
    for name in ("storeys.csv", "joints.csv", "columns.csv"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name
    straight, resumed = (json.loads((path / "summary.json").read_text()) for path in (folder, tmp_path))
    assert resumed["quantities"] == straight["quantities"] and resumed["structures"] == straight["structures"]
    assert "report" not in resumed["made_from"]["options"] and (
        tmp_path / report.PAGE).exists(), "a report does not change results"
    clear(RunOptions(out=tmp_path))
    assert not (tmp_path / report.PAGE).exists(), "a report of an earlier run must not be taken for that of the next"


def test_page_and_report(folder, tmp_path):
    """Of the record alone."""
    shutil.copy(folder / "frames.h5", tmp_path)
    page = quantities.page(load(tmp_path / "frames.h5"), quantities.DPI)
    assert [path.suffix for path in figures.save(page, tmp_path / "quantities", ("png", "pdf"))] == [".png", ".pdf"]
    written = report.write(tmp_path)
    page = (tmp_path / report.PAGE).read_text()
    assert page.count("<img") == 4 and not re.search(r'(src|href)="(?!data:)', page), "the page is self-contained"
    found = Summary.read(folder)
    for part in (found.sentence, "Joints nearest to failure", "have reached their strength", "JMA intensity",
                 "snow steadies a braced house".capitalize(),
                 report.weight(found.weight), "scripts/modelB1_quake.py --start=17.5 --duration=1.3"):
        assert escape(part) in page, part
    if shutil.which("chromium"):
        assert written[1].name == report.PDF and len(
            re.findall(rb"/Type\s*/Page\b(?!s)", written[1].read_bytes())
        ) == 1, "one page"


def test_weight(folder):
    """Total and weight per floor area without snow, which is stated apart; a house without a floor area has a weight
    only.
    """
    known = Weight(83.2, 0.0, 119.2, 0.698, {})
    assert report.weight(known) == "Weight 83 kN, 0.70 kN per m² of 119 m² of floor."
    assert report.weight(Weight(83.2, 59.4, 0.0, None, {})) == "Weight 83 kN; snow 59 kN."
    light = load(folder / "frames.h5")
    heavy = replace(light, summary=light.summary.changed(weight={"per_floor_area_kn_m2": 2.7}))
    assert "weighs 0.7 kN per m² of floor" in report.page(Stills(light))
    assert "kN per m² of floor. Real houses" not in report.page(Stills(heavy))


def test_report_of_other_folders(folder, tmp_path):
    """A folder without results or without frames, results of an earlier version: one line."""
    with pytest.raises(RunError, match="the frames of a finished run without --no-frames"):
        report.write(tmp_path)
    shutil.copy(folder / "frames.h5", tmp_path)
    found = json.loads((folder / "summary.json").read_text())
    for part in ("weight", "quantities"):
        with h5py.File(tmp_path / "frames.h5", "a") as file:
            file.attrs["summary"] = json.dumps({key: value for key, value in found.items() if key != part})
        with pytest.raises(RunError, match=f"{part}: missing; repeat the run"):
            report.write(tmp_path)
    run = load(folder / "frames.h5")
    run.peaks = None
    save(tmp_path / "frames.h5", run)
    with pytest.raises(RunError, match="of a town, .*, or of another version"):
        report.write(tmp_path)


@pytest.mark.parametrize("options, command", [
    (scripted("modelC2_quake", "C2", True, scale=1.5, dt=2e-4), "scripts/modelC2_quake.py --scale=1.5 --dt=0.0002"),
    (RunOptions(house="my house.yaml", quake=True, snow=1.0,
                report=True), "scripts/house.py 'my house.yaml' --quake --snow=1.0"),
])
def test_command_that_repeats_the_run(options, command):
    assert report.command(options.decisive()) == f"yade -n -x {command}"


def test_a_motion_from_python_has_no_command():
    assert report.command({"house": "A", "quake": True, "ground_motion": "0"}) is None


def test_hostile_names_are_text(folder):
    """Names from files cannot put markup into the page."""
    run = load(folder / "frames.h5")
    run.joints.name = ["<script>alert(1)</script>|b"] * len(run.joints.name)
    page = report.page(Stills(run))
    assert "<script" not in page and "&lt;script" in page


# --- lines ------------------------------------------------------------------------------------------------------------


def test_ten_lines(folder):
    """Ten at most, whatever happens; events take places from the last of the others."""
    found = Summary.read(folder)
    assert len(lines(found)) <= MOST and lines(found)[0].startswith("Main: ")
    made = lines(
        found.changed(
            events=[*(Event(2.0 + k, SnowFallen("", f"{k}.", "roof")) for k in range(5)),
                    Event(9.0, Collapse())]))
    snow = [f"{2 + k}.00 s: snow has fallen from the {k}. roof." for k in (0, 1)]
    assert len(made) == MOST and made[-3:] == [*snow, "9.00 s: collapse: a floor has come down by half a storey."]


def test_main_mode_moves_most_of_the_mass():
    shares = [Mode(share, "ns", {"ns": share, "ew": 0.0}, {}) for share in (0.1, 0.7, 0.3)]
    found = sample_summary(quantities={"modes": {"before": ModesAt(1.0, shares)}})
    assert found.main_mode(
        "before",
        "ns").period_s == 0.7 and found.main_mode("before", "ew") is None and found.main_mode("after", "ns") is None


# --- storeys ----------------------------------------------------------------------------------------------------------


def test_storeys_of_known_momenta():
    """Two storeys whose levels have accelerations of 2 and 3 m/s2 east on a ground of 1 m/s2: forces by hand."""
    time, masses = np.arange(0, 0.5, 0.01), [0.0, 10.0, 100.0, 20.0, 200.0]
    rates = np.array([0.0, 5.0, 200.0, 15.0, 600.0])  # momentum per second of each part
    samples = np.column_stack([time, *(column for rate in rates for column in (rate * time, 0 * time, 0 * time))])
    found = storeys(samples, masses, Motion(0.01, 0.0, np.tile([1.0, 0.0, 0.0], (60, 1)), np.zeros((60, 3))))
    assert found.column("base_shear_ew") == pytest.approx(-(rates.sum() + sum(masses)))
    assert found.column("shear_ew1") == pytest.approx(-(200 + 15 + 600 + 320))
    assert found.column("shear_ew2") == pytest.approx(-(600 + 200))
    assert found.column("ground_acceleration_ew") == pytest.approx(1)
    assert not found.column("ground_acceleration_ud").any()
    assert found.column("acceleration_ew1") == pytest.approx(2 + 1)
    assert found.column("acceleration_ew2") == pytest.approx(3 + 1)
    assert found.sustained("shear_ew2") == pytest.approx(800) and found.until(0.2).samples == 20


def test_sustained_shear_of_an_impact():
    """An impact of one sample counts with its share of the time."""
    time = np.arange(100) * 0.01
    values = np.where(np.arange(100) == 50, 1000.0, 10.0)
    table = Storeys(["time [s]", "x [N]"], np.column_stack([time, values]))
    assert table.peak("x") == 1000 and table.sustained("x") == pytest.approx(10 + 990 * 0.01 / SUSTAINED, rel=1e-6)


def test_accelerations_are_those_of_an_accelerometer():
    """Slow motion passes, the limit of the band has 1/sqrt(2), an impact of one sample hardly counts; gaps and unequal
    steps stay.
    """
    time = np.arange(0, 10, 0.01)
    middle = (time > 2) & (time < 8)
    for hertz, share in ((0.0, 1.0), (1.0, 1.0), (5.0, 0.992), (10.0, 0.7071), (30.0, 0.037)):
        wave = np.cos(2 * np.pi * hertz * time)
        assert np.abs(band_limited(time, wave)[middle]).max() == pytest.approx(share, abs=2e-3)
    impact = np.where(np.arange(len(time)) == 500, 130.0, 0.0)
    found = band_limited(time, impact)
    assert found.max() == pytest.approx(130.0 * 0.01 * 2 * 10 * 1.402, rel=0.02) and found.sum() == pytest.approx(
        130.0, rel=1e-3)  # integral of the gain
    kept = np.r_[0:300, 300:700:5, 700:1000]
    gap = np.where(np.arange(len(kept)) == 50, np.nan, np.sin(2 * np.pi * time[kept]))
    found = band_limited(time[kept], gap)
    assert np.isnan(found[50]) and np.nanmax(np.abs(found - gap)[20:-20]) < 0.02
    assert np.isnan(band_limited(time[:3], np.full(3, np.nan))).all() and len(band_limited(time[:0], time[:0])) == 0


def test_ground_velocity():
    """Exact for the straight lines between samples, also between and beyond them."""
    acceleration = np.array([[0.0, 1, 0], [2.0, 1, 0], [2.0, 1, 0], [0.0, 1, 0]])
    found = ground_velocity(Motion(0.5, 1.0, acceleration, 0 * acceleration), [0.0, 1.0, 1.25, 1.5, 2.5, 9.0])
    assert found[:, 0] == pytest.approx([0, 0, 0.125, 0.5, 2.0, 2.0])
    assert found[:, 1] == pytest.approx([0, 0, 0.25, 0.5, 1.5, 1.5])
    assert not ground_velocity(None, [0.0, 1.0]).any()


# --- collapses --------------------------------------------------------------------------------------------------------


def collapsed_run():
    """The sample's frames: its roof comes down; joint 3 breaks first, joint 1 next, joint 3 again."""
    run = frames_sample.run()
    run.breaks = {
        "time": [2.3, 2.2, 2.4], "joint": [1, 3, 3], "spring": [0, 0, 1], "cause": ["shear", "tension", "tension"],
        "force": [5900.0] * 3
    }
    return run


def test_first_failures():
    """Each joint once, by its first spring, in the order of time, with the drift of its storey then."""
    run = collapsed_run()
    chain = first_failures(run)
    assert [(failure.joints, failure.time, failure.cause)
            for failure in chain] == [((3,), 2.2, "tension"), ((1,), 2.3, "shear")]
    for failure in chain:
        drifts = [abs(np.interp(failure.time, run.history.time, run.history.drift(1, key))) for key in ("ns", "ew")]
        assert failure.drift == pytest.approx(max(drifts)) and failure.direction == ("ns", "ew")[int(np.argmax(drifts))]
    assert [failure.joints for failure in first_failures(run, 1)] == [(3,)]
    run.breaks = None
    assert first_failures(run) == []


def test_failures_of_one_time_are_one_line():
    """Like joints within 0.05 s; another cause or material is another line. Sheets have their bay and material."""
    run = collapsed_run()
    run.joints.kind[:4] = ["wall_column"] * 4
    sheets = ("plywood", "plywood", "plywood", "stucco")
    run.joints.name[:4] = [f"main.wall1.EW.y0.{k}-{k + 1}.{sheet}.columns" for k, sheet in enumerate(sheets)]
    run.joints.storey[:4] = ["1"] * 4
    run.breaks = {"time": [2.2, 2.205, 2.3, 2.2], "joint": [0, 1, 2, 3], "spring": [0] * 4, "cause": ["shear"] * 4,
                  "force": [0.0] * 4}
    failures = first_failures(run)
    assert [(failure.time, failure.joints) for failure in failures] == [(2.2, (0, 1)), (2.2, (3,)), (2.3, (2,))]
    run.peaks = {"load": np.ones(8), "pull": 1000.0 * np.arange(8), "shear": np.zeros(8)}
    both, stucco, _ = report.failed_joints(run, failures)
    assert both["place"] == "wall1.EW.y0.0-1, plywood and 1 more" and both["forces"][0] == "1.0"
    assert stucco["place"] == "wall1.EW.y0.3-4, stucco"
    assert report.joints(run) == []
    run.broken[-1], run.joints.damaged[:] = 0, False
    assert report.at_strength(run) == "8 of 8 joints have reached their strength."
    run.broken[-1, :3] = 4, 4, 1
    assert report.at_strength(run) == "8 of 8 joints have reached their strength: 2 broken, 1 partly."


def test_the_report_names_the_level_of_the_walls():
    same = OtherWalls("design", "undamaged", {})
    for other, words in ((None, ""), (same, "; the verdict with design walls is the same"),
                         (replace(same, verdict="unsafe"), "; the verdict with design walls is unsafe")):
        assert report.sentence_of_walls(sample_summary(walls=Walls("mean", other))) == f"Walls of the level mean{words}"


def test_curves_end_with_what_happens():
    """2 s after the shaking, the motion of the house and the last break."""
    run = collapsed_run()
    run.time = np.append(run.time, run.time[-1] + 100)
    assert run.breaks["time"][0] + LAG <= last_shown(run) < run.time[-1]


def test_report_of_a_collapse():
    """A chain of the first failures instead of joints most loaded after their fall; how far the others were before it.
    """
    run = collapsed_run()
    run.peaks = {"load": 0.1 * np.arange(8), "pull": np.full(8, 4600.0), "shear": np.full(8, 1500.0)}
    run.summary, run.joints.damaged[:] = sample_summary(quantities={"until_s": 2.5}), False
    run.broken[:] = 0
    run.broken[run.time > 2.35, 3] = 4
    failures = first_failures(run)
    first, second = report.failed_joints(run, failures)
    assert first["time"] == "2.20"
    assert first["cause"] == "tension"
    assert second["time"] == "2.30"
    assert second["cause"] == "shear"
    assert first["forces"] == ["4.6", "1.5", "5.9"]
    others = report.others(run)
    for part in ("Then 1 of 8 joints that can break had failed", "of the others 0 had used more than 0.9",
                 "more than 0.40."):
        assert part in others
    texts = [text.get_text() for axis in report_pictures.plans(run, failures).axes for text in axis.texts]
    assert sorted(" ".join(texts).split()) == ["1", "2"]


def test_lines_of_a_collapse(folder):
    """No drift of a wreck: when it fell, and forces before the fall."""
    fallen = {"collapsed": True, "collapse_time_s": 5.77, "tilt_time_s": 4.28, "tilt_direction": "ew"}
    main = {"collapsed": True, "peak_drift": 3.92}
    texts = lines(Summary.read(folder).changed(**fallen, structures={"main": main}, quantities={"until_s": 4.28}))
    assert texts[0] == "Main: collapsed at 5.8 s, 1.5 s after a storey drift of 1/10 E-W."
    assert not any("3.92" in line for line in texts)
    assert any(line.startswith("Largest base shear before 4.28 s, ") for line in texts)
