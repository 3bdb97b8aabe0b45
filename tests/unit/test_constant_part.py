# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Constant parts of records: a warning that names mean and remedy, from every reader; none for motions as recorded, nor
after processing.
"""
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from summaries import sample_summary
from timber_houses.motion import (
    GAL,
    GroundMotion,
    MotionRequest,
    RecordWarning,
    constant_note,
    default_motion,
    read_motion,
    synthetic_motion,
    trim,
)
from timber_houses.motion.record import STANDARD_GRAVITY
from timber_houses.recording.summary import LotResult
from timber_houses.recording.town import summary as town_summary
from timber_houses.text.english import record, sentence

ROOT = Path(__file__).resolve().parents[2]
TIME = np.arange(0, 20, 0.01)
BURST = 300 * np.sin(3 * np.pi * TIME) * np.exp(-(((TIME - 5) / 2) ** 2))
"""A motion without a mean. [gal]"""
WAVES = np.column_stack([BURST, 0.8 * BURST, 0.3 * BURST])
"""Columns ns, ew, ud. [gal]"""
OFFSETS = {
    "gravity up": ((
        0, 0, 980.665
    ), "constant part of 981 gal up-down (92 % of the peak) acts like a change of weight of 100 %; --detrend 0 removes "
       "it"
                   ),
    "gravity down": ((
        0, 0, -980.665
    ), "constant part of -981 gal up-down (92 % of the peak) acts like a change of weight of 100 %; --detrend 0 "
       "removes it"
                     ),
    "north": ((60, 0, 0),
              "constant part of 60 gal N-S (17 % of the peak) acts like a lean of 6.12 %; --detrend 0 removes it"),
    "west": ((0, -10, 0),
             "constant part of -10 gal E-W (4 % of the peak) acts like a lean of 1.02 %; --detrend 0 removes it"),
    "two": (
        (60, 0, -30),
        "constant part of 60 gal N-S (17 % of the peak) acts like a lean of 6.12 %, "
        "-30 gal up-down (25 % of the peak) acts like a change of weight of 3.06 %; --detrend 0 removes it",
    ),
}


def plain(folder, waves):
    rows = "\n".join(",".join(f"{value:.4f}" for value in row) for row in waves)
    (folder / "a.csv").write_text(f"# units: gal\n# dt: 0.01\nns,ew,ud\n{rows}\n")
    return str(folder / "a.csv")


def jma(folder, waves):
    rows = "\n".join(",".join(f"{value:.4f}" for value in row) for row in waves)
    (folder / "a.csv").write_text(f"SITE CODE= 1\nSAMPLING RATE= 100Hz\nUNIT = gal\nNS,EW,UD\n{rows}\n")
    return str(folder / "a.csv")


def peer(folder, waves):
    for values, name in zip(waves.T, ("000", "090", "-UP")):
        rows = "\n".join(f"{value * GAL / STANDARD_GRAVITY:.9E}" for value in values)
        (folder / f"a{name}.AT2").write_text(
            f"PEER\nA, 1, STA, {name.strip('-')}\nACCELERATION IN UNITS OF G\nNPTS= {len(values)}, DT= .01 SEC\n"
            f"{rows}\n"
        )
    return str(folder / "a")


@pytest.mark.parametrize("write", [plain, jma, peer])
@pytest.mark.parametrize("offset, note", OFFSETS.values(), ids=OFFSETS.keys())
def test_every_reader_warns(tmp_path, write, offset, note):
    path = write(tmp_path, WAVES + offset)
    with pytest.warns(RecordWarning) as caught:
        motion = read_motion(path)
    assert [str(warning.message) for warning in caught] == [f"a: {note}"]
    assert constant_note(motion) == note


@pytest.mark.parametrize("processing, offset", [
    *(({"detrend": order}, offset) for order in (0, 1) for offset, _ in OFFSETS.values()),
    ({"highpass": 0.1}, (60, 0, 0)),  # of gravity it leaves transients at both ends
])
@pytest.mark.filterwarnings("error")
def test_no_warning_where_it_is_removed(tmp_path, processing, offset):
    motion = MotionRequest(record=plain(tmp_path, WAVES + offset), **processing).motion(0.01)
    assert constant_note(motion) == ""


@pytest.mark.filterwarnings("error")
def test_no_warning_for_motions_as_recorded(tmp_path):
    for motion in (read_motion(plain(tmp_path,
                                     WAVES)), default_motion(), synthetic_motion(2), trim(default_motion(), 17, 25)):
        assert constant_note(motion) == ""


@pytest.mark.filterwarnings("error")
def test_noise_of_a_component_without_motion(tmp_path):
    """No warning of a vertical of the last digit, of a motion of zeros, nor of a constant part that is removed.
    """
    read_motion(plain(tmp_path, WAVES * (1, 1, 0) + (0, 0, 0.01)))
    read_motion(plain(tmp_path, 0 * WAVES))
    MotionRequest(record=plain(tmp_path, 0 * WAVES + (0, 0, -1177)), detrend=0).motion(0.01)


def test_a_constant_record_and_a_tiny_one(tmp_path):
    with pytest.warns(RecordWarning,
                      match=r"of -1177 gal up-down \(100 % of the peak\) acts like a change of weight of 120 %"):
        read_motion(plain(tmp_path, 0 * WAVES + (0, 0, -1177)))
    with pytest.warns(RecordWarning, match=r"0.002 gal N-S \(17 % of the peak\)"):
        read_motion(plain(tmp_path, (WAVES + (60, 0, 0)) / 30_000))


def test_a_pulse_is_read(tmp_path):
    """Of one sign: a legitimate motion, of which the user is told."""
    pulse = 400 * np.exp(-(((TIME - 5) / 0.5) ** 2))[:, None] * (1, 0, 0)
    with pytest.warns(RecordWarning, match="constant part of"):
        assert read_motion(plain(tmp_path, pulse)).pga_gal["ns"] == pytest.approx(400)


def test_each_record_of_a_sequence_counts(tmp_path):
    """Quiet between the records does not hide the constant part of one of them; factors and --scale act on it."""
    (tmp_path / "fore").mkdir()
    fore, main = plain(tmp_path / "fore", WAVES), plain(tmp_path, WAVES + (60, 0, 0))
    with pytest.warns(RecordWarning, match="60 gal N-S"):
        sequence = MotionRequest(record=fore, then=f"{main}@0.5", gap=1000.0).motion(0.01)
    assert "of 30 gal N-S (17 %" in constant_note(sequence) and "of 15 gal N-S (17 %" in constant_note(sequence, 0.5)
    assert constant_note(sequence, 0.0) == ""


def test_a_motion_of_python():
    acceleration = (WAVES[:, [1, 0, 2]] + (0, 60, 0)) * GAL
    with pytest.warns(RecordWarning, match="60 gal N-S"):
        MotionRequest().motion(0.01, GroundMotion(0.01, acceleration))


def test_the_note_is_in_the_sentences():
    note = "constant part of 60 gal N-S (17 % of the peak) acts like a lean of 6.12 %; --detrend 0 removes it"
    noted = sample_summary(record={"note": note})
    assert record(noted) == f"the record's {note}"
    lot = LotResult("lot", "A", "undamaged", [[[0.0, 0.0]]], {})
    assert sentence(town_summary("x", {"lot": (noted, np.eye(3), lot)},
                                 noted.record)).endswith(f"Town x: 1 houses, 1 undamaged; the record's {note}")
    assert record(sample_summary(record={"source": "a"})) == record(sample_summary()) == ""


def test_show_record_says_so(tmp_path):
    script = ROOT / "scripts" / "show" / "show_record.py"
    command = [sys.executable, str(script), plain(tmp_path, WAVES + (60, 0, 0)), "--out", str(tmp_path / "a.png")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr.splitlines() == [f"note: a: {OFFSETS['north'][1]}"]
