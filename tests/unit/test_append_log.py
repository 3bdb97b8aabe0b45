# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The file of an unfinished run: appended, cut, torn at any byte; frames in it. Needs no YADE."""
import os

import numpy as np
import pytest
from small_frames import frames
from timber_houses.base.errors import RunError
from timber_houses.recording import append_log
from timber_houses.recording import frames as files
from timber_houses.recording.append_log import AppendLog

SAMPLES = [(b"H", 0.0, b"ab"), (b"M", 0.0, b""), (b"H", 0.5, b"cde"), (b"H", 1.0, b"f" * 20)]


@pytest.fixture
def log(tmp_path):
    made = AppendLog(tmp_path / "a.log", "run 1")
    for kind, time, content in SAMPLES:
        made.add(kind, time, np.frombuffer(content, "u1"))
    return made


def test_written_is_read_back(log):
    """Pending records, records in the file, and both."""
    assert list(log.records()) == SAMPLES and not log.path.exists()
    assert log.flush() == log.path.stat().st_size > 25 and list(append_log.read(log.path, "run 1")) == SAMPLES
    log.add(b"H", 2.0, np.arange(2, dtype="u1"))
    assert list(log.records()) == [*SAMPLES, (b"H", 2.0, b"\0\1")]


def test_a_flush_appends(log):
    """The bytes before it stay, and a flush without new records writes none."""
    size = log.flush()
    before = log.path.read_bytes()
    assert log.flush() == size
    log.add(b"H", 2.0, np.zeros(3))
    log.flush()
    assert log.path.read_bytes()[:size] == before


def test_torn_at_any_byte(log):
    """The complete records before the tear are read; the next flush after a cut follows them."""
    log.flush()
    content = log.path.read_bytes()
    for size in range(len(content)):
        log.path.write_bytes(content[:size])
        read = list(append_log.read(log.path, "run 1"))
        assert read == SAMPLES[:len(read)] and len(read) < len(SAMPLES)
        log.cut(np.inf)
        log.add(b"H", 3.0, np.zeros(1))
        log.flush()
        assert list(log.records()) == [*read, (b"H", 3.0, bytes(8))]


def test_a_damaged_byte_ends_the_reading(log):
    """Of the content, the time, the kind or the length."""
    log.flush()
    content = bytearray(log.path.read_bytes())
    for place in range(len(content)):
        content[place] ^= 64
        log.path.write_bytes(content)
        content[place] ^= 64
        try:
            read = list(append_log.read(log.path, "run 1"))
        except RunError:  # the damaged byte is the run's
            continue
        assert len(read) < len(SAMPLES) and read == SAMPLES[:len(read)]


@pytest.mark.parametrize("time, left", [(-1.0, 0), (0.0, 2), (0.7, 3), (1.0, 4)])
@pytest.mark.parametrize("flushed", [True, False])
def test_cut(log, time, left, flushed):
    if flushed:
        log.flush()
    size = log.cut(time)
    assert list(log.records()) == SAMPLES[:left] and size == (log.path.stat().st_size if flushed else 0)


def test_another_run_and_what_is_no_file(log, tmp_path):
    log.flush()
    with pytest.raises(RunError, match="a.log: of another run"):
        list(append_log.read(log.path, "run 2"))
    with pytest.raises(RunError, match="of another run"):
        AppendLog(log.path, "run 2").cut(9.0)
    log.path.unlink()
    os.mkfifo(log.path)
    for action in (log.flush, lambda: log.cut(9.0), lambda: list(append_log.read(log.path, "run 1"))):
        with pytest.raises(RunError, match="not a regular file"):
            action()
    assert list(append_log.read(tmp_path / "none.log", "run 1")) == []


def unfinished(folder):
    """Frames of the small run in files of an unfinished one; returns the log."""
    made, described = frames(ended=False), frames(ended=False)
    made.run = described.run = "run 1"
    for name in ("time", "position", "orientation", "load", "broken"):
        setattr(described, name, [])
    described.contacts = files.Contacts()
    files.save(folder / files.NAME, described)
    log = AppendLog(folder / append_log.FRAMES_LOG, "run 1")
    append_log.log_frames(log, made)
    log.flush()
    return log


def test_frames_of_an_unfinished_run(tmp_path):
    """Read from the log to the last bit and as far as it is complete; frames of an ended run are those of the file
    alone.
    """
    unfinished(tmp_path)
    made, read = frames(ended=False), files.load(tmp_path / files.NAME)
    for name in ("time", "position", "orientation", "load", "broken"):
        assert np.array_equal(getattr(read, name), getattr(made, name)) and getattr(read, name).dtype == getattr(
            made, name).dtype, name
    for name, values in vars(made.contacts).items():
        assert all(map(np.array_equal, getattr(read.contacts, name), values)), name
    os.truncate(tmp_path / append_log.FRAMES_LOG, (tmp_path / append_log.FRAMES_LOG).stat().st_size // 2)
    assert 0.4 * len(made.time) < len(files.load(tmp_path / files.NAME).time) < 0.6 * len(made.time)
    files.save(tmp_path / files.NAME, frames())
    assert len(files.load(tmp_path / files.NAME).time) == len(made.time)


@pytest.mark.parametrize("kind", [append_log.FRAME, append_log.CONTACTS, b"X"])
@pytest.mark.parametrize("size", [0, 1, 33, 10**5])
def test_hostile_records(tmp_path, kind, size):
    """One line for records of other kinds and sizes."""
    log = unfinished(tmp_path)
    log.add(kind, 9.0, np.full(size, 255, "u1"))
    log.flush()
    if (kind, size) == (append_log.CONTACTS, 0):
        assert files.load(tmp_path / files.NAME).contacts.time[-1] == 9.0
        return
    with pytest.raises(RunError, match="frames.h5: cannot read the frames") as raised:
        files.load(tmp_path / files.NAME)
    assert "\n" not in str(raised.value)
