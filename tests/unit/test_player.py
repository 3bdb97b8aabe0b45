# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player's file: what is packed comes out again, small enough, whole, and needs nothing else. Needs no YADE and no
browser.
"""
import base64
import json
import re
import subprocess
import sys
import zlib
from hashlib import sha256
from pathlib import Path

import frames_sample
import numpy as np
import pytest
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.pictures import key_times, player
from timber_houses.recording.events import Collapse, ColumnsLost, Event, OwnWeight, SnowFallen, StructureFallen, Tilt
from timber_houses.recording.verdict import Structure
from timber_houses.text import japanese
from timber_houses.pictures.packing import pack
from timber_houses.recording import frames

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "show" / "make_player.py"


def unpack(text):
    """(info, {name: array}) of a packed text, read as packing.py describes it."""
    raw = zlib.decompress(base64.b64decode(text))
    start = 4 + int.from_bytes(raw[:4], "little")
    info, arrays = json.loads(raw[4:start]), {}
    for entry in info["arrays"]:
        count = int(np.prod(entry["shape"]))
        planes = np.frombuffer(raw, np.uint8, 4 * count, start).reshape(4, count).astype(np.int64)
        folded = planes[0] + (planes[1] << 8) + (planes[2] << 16) + (planes[3] << 24)
        change = np.where(folded % 2, -(folded + 1) // 2, folded // 2)
        rows = entry["shape"][0]
        arrays[entry["name"]] = (np.cumsum(change.reshape(-1, rows), axis=1).T *
                                 entry["step"]).reshape(entry["shape"]) if count else np.empty(entry["shape"])
        start += 4 * count
    assert start == len(raw)
    return info, arrays


def flight(count=20, times=60):
    """A run of elements that tumble up to 100 m away, with quaternions whose signs jump."""
    random = np.random.default_rng(1)
    made = frames_sample.run()
    position = np.cumsum(random.normal(size=(times, len(made.elements.name), 3)), axis=0) * 5
    turns = random.normal(size=(times, len(made.elements.name), 4))
    made.time, made.position = np.arange(times) * 0.05, position
    made.orientation = turns / np.linalg.norm(turns, axis=2, keepdims=True)
    made.load, made.broken = np.zeros((times, 8)), np.zeros((times, 8))
    return made


def turned_by(a, b):
    """Angles between unit quaternions. [degree]"""
    return np.degrees(2 * np.arccos(np.clip(np.abs(np.sum(a * b, axis=-1)), 0, 1)))


def test_positions_and_orientations_come_out_again():
    run = flight()
    _, arrays = unpack(player.packed("x", run))
    assert np.linalg.norm(arrays["positions"] - run.position, axis=2).max() < 0.45e-3  # half a step in each direction
    turns = arrays["orientations"][..., [3, 0, 1, 2]]
    assert turned_by(turns / np.linalg.norm(turns, axis=2, keepdims=True), run.orientation).max() < 0.005


def test_orientations_do_not_jump_between_frames():
    _, arrays = unpack(player.packed("x", flight()))
    turns = arrays["orientations"]
    assert (np.sum(turns[1:] * turns[:-1], axis=2) >= -1e-9).all()


@pytest.mark.parametrize("values", [np.zeros((0, 3)), np.zeros((1, 2)), np.array([[-1.0, 2**29], [2**29, -(2**29)]]),
                                    np.arange(-7, 7)])
def test_whole_numbers_come_out_exactly(values):
    info, arrays = unpack(pack({"x": 1}, {"before": ([3], 1), "values": (values, 1), "after": ([[4], [5]], 0.5)}))
    assert info["x"] == 1
    assert np.array_equal(arrays["values"], values)
    assert arrays["before"] == [3]
    assert np.array_equal(arrays["after"], [[4], [5]])


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e9])
def test_numbers_that_do_not_fit_are_refused(bad):
    run = frames_sample.run()
    run.position[3, 2, 1] = bad
    with pytest.raises(RunError, match="here.h5: positions: numbers must be finite and below"):
        player.packed("here.h5", run)


def test_a_long_run_stays_below_8_megabytes(tmp_path):
    """40 s of 191 elements and 294 joints, every number with noise in it: no real run is as large."""
    random = np.random.default_rng(2)
    run, times, count = frames_sample.run(), 801, 191
    for name in ("name", "kind", "group", "material", "vertices", "faces"):
        setattr(run.elements, name, (getattr(run.elements, name) * 28)[:count])
    for name in ("storey", "fixed", "position", "orientation"):
        setattr(run.elements, name, np.concatenate([getattr(run.elements, name)] * 28)[:count])
    for name in ("name", "kind", "storey", "side"):
        setattr(run.joints, name, (getattr(run.joints, name) * 37)[:294])
    for name in ("a", "b", "anchor", "springs", "damaged", "strength", "sheet"):
        setattr(run.joints, name, np.concatenate([getattr(run.joints, name)] * 37)[:294])
    run.time = np.arange(times) * 0.05
    run.position = np.cumsum(random.normal(size=(times, count, 3)), axis=0) * 0.02
    turns = np.cumsum(random.normal(size=(times, count, 4)), axis=0) * 0.01 + [1, 0, 0, 0]
    run.orientation = turns / np.linalg.norm(turns, axis=2, keepdims=True)
    run.load, run.broken = random.uniform(size=(times, 294)), random.integers(0, 5, (times, 294))
    frames.save(tmp_path / "frames.h5", run)
    assert player.make([("x", frames.load(tmp_path / "frames.h5"))], tmp_path / "player.html").stat().st_size < 8e6


def test_the_page_is_whole_and_needs_nothing_else(tmp_path):
    page = player.make([("x", frames_sample.run())], tmp_path / "player.html").read_text(encoding="utf-8")
    assert [path.name for path in tmp_path.iterdir()] == ["player.html"]
    assert not re.search(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=|@import|url\(", page.split("<script>")[0])
    assert not re.search(r"{{\w+}}", page) and page.count("</script>") == 2
    assert "MIT License" in page and "three.js authors" in page


def test_the_policy_permits_this_script_and_this_style_only(tmp_path):
    page = player.make([("x", frames_sample.run())], tmp_path / "player.html").read_text(encoding="utf-8")
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page)[1]
    assert "default-src 'none'" in policy and "unsafe" not in policy and "*" not in policy
    for tag in ("script", "style"):
        body = re.search(rf"<{tag}>(.*)</{tag}>", page, re.DOTALL)[1]
        assert f"{tag}-src 'sha256-{base64.b64encode(sha256(body.encode()).digest()).decode()}'" in policy
    assert page.index("Content-Security-Policy") < min(page.index("<style>"), page.index("<script"))


@pytest.mark.parametrize("text",
                         ["</script><script>alert(1)</script>", "<!--", "{{script}}", "\ud800", "'\"&<>", "a\nb\0c"])
def test_no_text_from_data_becomes_markup(tmp_path, text):
    """The title is escaped, everything else is base64; the page has the same tags for any text."""
    run = frames_sample.run()
    run.title, run.elements.name[1], run.elements.kind[1], run.joints.name[0] = [text] * 4
    run.summary = run.summary.changed(model=text, events=[Event(1.0, StructureFallen(text))])
    page = player.make([("x", run)], tmp_path / "player.html").read_text(encoding="utf-8")
    plain = player.make([("x", frames_sample.run())], tmp_path / "plain.html").read_text(encoding="utf-8")
    assert page.count("<") == plain.count("<")
    assert re.fullmatch(r"[A-Za-z0-9+/=]+", re.search(r'class="run-data">([^<]*)<', page)[1])
    title = re.search(r"<title>(.*?)</title>", page, re.DOTALL)[1]
    assert not set(title) & set("<>\"'")
    info, _ = unpack(player.packed("x", run))
    assert info["title"] == player.plain(text) and info["elements"][1]["kind"] == player.plain(text)


def test_events_are_in_order():
    texts = [f"{event['time']:.2f} {event['text']}" for event in player.events(frames_sample.run())]
    assert [text[:24] for text in texts] == sorted(text[:24] for text in texts)
    expected = [*("1.01 the shaking begins", "drift passes 1/120: damage limit",
                  "2.10 first spring breaks: column-beam joint, storey 1, south side, tension 5.9 kN"),
                *("drift passes 1/30: safety limit", "2.30 a storey drift N-S passes 1/10", "2.90 collapse")]
    assert all(any(part in text for text in texts) for part in expected), texts
    assert key_times.onset(frames_sample.motion()) == pytest.approx(1.01)


def test_peaks_of_joints_and_feet_come_from_the_tables(tmp_path):
    """Not those of joints broken before the start and of columns that fell."""
    path = tmp_path / "frames.h5"
    frames.save(path, frames_sample.with_tables(frames_sample.run()))
    info, _ = unpack(player.packed(path, frames.load(path)))
    assert [(joint.get("pull"), joint.get("shear"))
            for joint in info["joint_list"]] == [(None, None), *((1250 * k, 800 - 100 * k) for k in range(1, 8))]
    uplift = {element["name"]: element["uplift"] for element in info["elements"] if "uplift" in element}
    assert uplift == {"column.SE": 0.0029, "column.NW": 0.0, "column.NE": 0.0314}
    assert info["feet"] == [0, 1, 2, 3]


def test_runs_without_tables_have_no_peaks(tmp_path):
    """A town, or a run that has not ended."""
    info, _ = unpack(player.packed(tmp_path / "frames.h5", frames_sample.run()))
    assert not any({"pull", "uplift"} & entry.keys() for entry in info["joint_list"] + info["elements"])


@pytest.mark.parametrize("table, name", [("peaks", "pull"), ("columns", "uplift")])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_tables_with_other_content_are_refused(tmp_path, table, name, bad):
    run = frames_sample.with_tables(frames_sample.run())
    getattr(run, table)[name][2] = bad
    frames.save(tmp_path / "frames.h5", run)
    with pytest.raises(RunError, match=f"{name}: a number that is not finite"):
        frames.load(tmp_path / "frames.h5")


def test_the_japanese_result_judges_all_structures():
    """A house that stands beyond the safety limit, an entrance that falls, a shed beyond the damage limit, an undamaged
    porch.
    """
    others = {"entrance": Structure(peak_drift=0.0, collapsed=True), "shed": Structure(peak_drift=0.01),
              "porch": Structure(peak_drift=1e-3)}
    found = sample_summary(joints={"total": 8}, broken={"total": 7, "damaged_at_start": {"total": 1}}, peak_drift={
        "storey1": {"ns": 0.05, "ew": 0.01}
    }, structures=others, events=[Event(2.6, StructureFallen("entrance"))])
    assert japanese.result(found) == (
        "危険。最大層間変形角 1/20（南北、1 階）、残留変形角 1/1000 未満。自重による損傷。玄関は 2.6 秒に倒壊。shedは補修可能（最大層間変形角 1/100）。"
        "接合部 8 か所のうち 7 か所が破断（ほかに最初から破断 1 か所）。")


def test_the_japanese_result_has_all_warnings():
    drifts = {"peak_drift": {"storey1": {"ns": 0.3, "ew": 0.01}},
              "residual_drift": {"storey1": {"ns": 0.2, "ew": 0.01}}}
    assert "全壊（最後に傾いている）" in japanese.result(sample_summary(**drifts))
    found = sample_summary(**drifts, columns={"total": 90, "fallen": 1, "loose": 3}, still_moving=True,
                           final_amplitude={"storey1": {"ns": 0.02, "ew": 0.0}}, snow=True, record={"onset_s": 18.8},
                           duration_s=15.0, structures={"entrance": Structure(broken=2, peak_drift=5e-4)},
                           events=[Event(12.0, ColumnsLost(1, 90)), Event(13.5, SnowFallen("", "west", "roof"))])
    parts = ("終了時の変形角 1/5", "なお ±1/50（南北）で揺れている", "柱 90 本のうち1 本が倒れた、3 本が外れた（12.0 秒から）", "雪は 13.5 秒から落下",
             "強い揺れ（18.8 秒）の前に計算を終了", "玄関は補修可能（最大層間変形角 1/1000 未満）")
    assert [part for part in parts if part not in japanese.result(found)] == [], japanese.result(found)


def test_the_japanese_result_of_a_run_that_ends_in_the_strong_shaking():
    found = sample_summary(record={"onset_s": 18.8, "strong_end_s": 27.0}, duration_s=20.0,
                           structures={"entrance": Structure(peak_drift=0.3, residual_drift=0.2)})
    assert "強い揺れ（18.8～27.0 秒）の途中で計算を終了" in japanese.result(found)
    assert "玄関は全壊（最後に傾いている）（最大層間変形角 1/3）" in japanese.result(found)


def test_the_japanese_result_says_what_is_not_to_be_relied_on():
    found = sample_summary(cut_off="body 3", duration_s=5.9, earthquake=True, record={"note": "constant part"},
                           solver={"unconverged_steps": 7,
                                   "worst_change_j": 1e9}, events=[Event(0.9, OwnWeight(False, {}))])
    parts = ("5.90 秒で計算を打ち切り、以下の結果は信頼できない", "揺れの前に自重で損傷", "一定の成分", "7 ステップが収束していない")
    assert [part for part in parts if part not in japanese.result(found)] == [], japanese.result(found)


@pytest.mark.parametrize("facts, lot, expected", [
    (Collapse(), None, "倒壊：床が階高の半分以上落ちた"),
    (Collapse(), "h1", "h1：倒壊：床が階高の半分以上落ちた"),
    (Tilt("ew"), "h2", "h2：層間変形角が 1/10 を超える（東西）"),
    (StructureFallen("entrance"), "h1", "h1：玄関が倒れた"),
    (StructureFallen("entrance"), None, "玄関が倒れた"),
    (SnowFallen("", "west", "roof"), None, "西の屋根の雪が落ちる"),
    (OwnWeight(True, {"main": Structure(peak_drift=0.0), "entrance": Structure(peak_drift=1 / 14, broken=2)}), None,
     "揺れの前に自重と雪で損傷：玄関は接合部 2 か所が破断、最大層間変形角 1/14"),
])
def test_japanese_events(facts, lot, expected):
    assert japanese.event(Event(1.0, facts, lot)) == expected


def test_a_long_run_has_a_player():
    """Half an hour: times of the page are exact to 10 us."""
    run = frames_sample.run(until=1.5)
    run.time = [1800 * time for time in run.time]
    info, arrays = unpack(player.packed("x", run))
    assert arrays["time"] == pytest.approx(run.time, abs=1e-5) and arrays["time"][-1] > 1073.74


def test_a_run_that_has_not_ended_is_shown_as_far_as_it_is():
    run = frames_sample.run(until=1.5)
    run.summary = run.history = run.breaks = run.motion = None
    info, arrays = unpack(player.packed("x", run))
    assert info["result"] == "Not ended yet: the first 1.5 s"
    assert info["events"] == []
    assert arrays["time"][-1] == pytest.approx(1.5)


def test_no_frames_and_too_many_runs(tmp_path):
    run = frames_sample.run()
    run.time = []
    with pytest.raises(RunError, match="it has no frames"):
        player.packed("empty.h5", run)
    with pytest.raises(RunError, match="3 runs: the player shows one, or compares two"):
        player.make([("x", run)] * 3, tmp_path / "x.html")


def call(*arguments):
    return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True)


def test_script_makes_pages_of_one_and_two_runs(tmp_path):
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        frames_sample.write(tmp_path / name / "frames.h5", name=name)
    assert call(tmp_path / "first").returncode == 0 and (tmp_path / "first" / "player.html").exists()
    done = call(tmp_path / "first", tmp_path / "second" / "frames.h5")
    page = tmp_path / "first" / "compare_with_second.html"
    assert done.returncode == 0 and str(page) in done.stdout
    assert page.read_text(encoding="utf-8").count('class="run-data"') == 2
    assert call(tmp_path / "first", "--out", tmp_path / "other.html").returncode == 0
    assert (tmp_path / "other.html").exists()


def test_script_says_what_is_wrong_in_a_line(tmp_path):
    (tmp_path / "frames.h5").write_text("no HDF5")
    for run, word in ((tmp_path / "none", "no such file"), (tmp_path, "cannot read")):
        done = call(run)
        assert done.returncode == 1 and word in done.stderr and done.stderr.count("\n") == 1
    frames_sample.write(tmp_path / "frames.h5")
    done = call(tmp_path, "--out", tmp_path / "no" / "such" / "folder.html")
    assert done.returncode == 1 and "folder.html: cannot be written" in done.stderr and done.stderr.count("\n") == 1
