# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Complete files, locks, tables. Needs no YADE."""
import os
import socket
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from timber_houses.base.atomic_write import remove, write_text, written_whole
from timber_houses.base.files import make_folder, remove_parts, written_from_memory
from timber_houses.base.lock import is_locked, locked
from timber_houses.base.processors import processors, quota
from timber_houses.base.table import csv_text, read_csv


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_failed_write_leaves_the_earlier_file(tmp_path):
    write_text(tmp_path / "a.txt", "old")
    with pytest.raises(ZeroDivisionError), written_whole(tmp_path / "a.txt") as part:
        part.write_text("half")
        1 / 0
    assert names(tmp_path) == ["a.txt"] and (tmp_path / "a.txt").read_text() == "old"


@pytest.mark.parametrize("mask, mode", [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_umask(tmp_path, mask, mode):
    before = os.umask(mask)
    try:
        write_text(tmp_path / "a.txt", "x")
    finally:
        os.umask(before)
    assert (tmp_path / "a.txt").stat().st_mode & 0o777 == mode


@pytest.mark.parametrize("target", ["there", "new"])
def test_links_stay(tmp_path, target):
    """To a file, or to one that does not exist yet; the content comes to where it leads."""
    (tmp_path / "there").write_text("old")
    (tmp_path / "a.txt").symlink_to(target)
    write_text(tmp_path / "a.txt", "x")
    assert (tmp_path / "a.txt").is_symlink() and (tmp_path / target).read_text() == "x"
    remove(tmp_path / "a.txt")
    assert (tmp_path / "a.txt").is_symlink() and not (tmp_path / target).exists()


def test_a_link_to_nowhere(tmp_path):
    (tmp_path / "a.txt").symlink_to(tmp_path / "no" / "folder")
    with pytest.raises(OSError):
        write_text(tmp_path / "a.txt", "x")
    (tmp_path / "round").symlink_to("round")
    with pytest.raises(OSError):
        write_text(tmp_path / "round", "x")
    assert names(tmp_path) == ["a.txt", "round"]


@pytest.mark.parametrize("link", [False, True])
def test_a_device_stays(tmp_path, link):
    """A terminal of our own: in its folder no file can be made, so a fault cannot replace it."""
    master, slave = os.openpty()
    device = Path(os.ttyname(slave))
    if link:
        (tmp_path / "a.txt").symlink_to(device)
        device = tmp_path / "a.txt"
    write_text(device, "x")
    assert os.read(master, 9) == b"x"
    remove(device)
    assert stat.S_ISCHR(device.stat().st_mode) and device.is_symlink() == link
    os.close(master)
    os.close(slave)


@pytest.mark.parametrize("writer", [written_whole, written_from_memory])
def test_a_pipe_with_a_reader(tmp_path, writer):
    """The reader gets the whole content, or nothing when the writer fails."""
    os.mkfifo(tmp_path / "a.txt")
    with open(os.open(tmp_path / "a.txt", os.O_RDONLY | os.O_NONBLOCK), "rb") as reader:
        with writer(tmp_path / "a.txt") as part:
            part.write_text("whole")
        assert reader.read() == b"whole"
        with pytest.raises(ZeroDivisionError), writer(tmp_path / "a.txt") as part:
            part.write_text("half")
            1 / 0
        assert reader.read() == b"" and names(tmp_path) == ["a.txt"]


def test_a_pipe_without_a_reader_does_not_wait(tmp_path):
    os.mkfifo(tmp_path / "a.txt")
    with pytest.raises(OSError, match="nothing reads"):
        write_text(tmp_path / "a.txt", "x")
    assert (tmp_path / "a.txt").is_fifo()


def test_what_cannot_be_written(tmp_path):
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(tmp_path / "socket"))
        for path in (tmp_path, tmp_path / "socket", Path("/"), tmp_path / "no" / "folder"):
            with pytest.raises(OSError):
                write_text(path, "x")
    assert names(tmp_path) == ["socket"] and (tmp_path / "socket").is_socket()


@pytest.mark.parametrize("path", ["/dev/stdout", "{file}"])
def test_standard_output(tmp_path, path):
    """What it holds already, and what follows, stays."""
    target = path.format(file=tmp_path / "log")
    script = ("print('before'); from timber_houses.base.atomic_write import write_text; "
              f"write_text({target!r}, 'x\\n'); print('after')")
    with open(tmp_path / "log", "w") as log:
        subprocess.run([sys.executable, "-c", script], stdout=log, check=True)
    assert (tmp_path / "log").read_text() == "before\nx\nafter\n"
    assert subprocess.run([sys.executable, "-c", script.replace(str(tmp_path / "log"), "/dev/stdout")],
                          stdout=subprocess.PIPE).stdout == b"before\nx\nafter\n"


def test_folders_are_made_in_folders_only(tmp_path):
    make_folder(tmp_path / "a" / "b")
    (tmp_path / "link").symlink_to("a")
    make_folder(tmp_path / "link")
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "nowhere").symlink_to("nothing")
    for path, reason in ((Path(os.devnull), "no folder"), (tmp_path / "pipe", "no folder"),
                         (tmp_path / "nowhere", "link to nothing")):
        with pytest.raises(OSError, match=reason):
            make_folder(path)
    assert (tmp_path / "a" / "b").is_dir() and names(tmp_path) == ["a", "link", "nowhere", "pipe"]


def test_temporary_names_differ_and_keep_the_suffix(tmp_path):
    with written_whole(tmp_path / "a.yade.gz") as one, written_whole(tmp_path / "a.yade.gz") as other:
        assert one != other and one.suffixes == other.suffixes == [".yade", ".gz"] and one.parent == tmp_path


def test_parts_of_killed_processes(tmp_path):
    (tmp_path / ".part-00-a").write_text("")
    (tmp_path / "a").write_text("")
    remove_parts(tmp_path)
    assert names(tmp_path) == ["a"]


def test_one_process_a_folder(tmp_path):
    assert not is_locked(tmp_path)
    with locked(tmp_path) as first, locked(tmp_path) as second:
        assert first and not second and is_locked(tmp_path)
    assert not is_locked(tmp_path)


def test_letters_beyond_ascii_in_tables(tmp_path):
    """A spreadsheet knows them by the byte order mark, which is not read back."""
    write_text(tmp_path / "a.csv", csv_text(("\u540d", "b"), [("\u57fa", 1)]))
    assert (tmp_path / "a.csv").read_bytes().startswith(b"\xef\xbb\xbf")
    assert read_csv(tmp_path / "a.csv") == (["\u540d", "b"], [["\u57fa", "1"]])
    assert not csv_text(("a",), []).startswith("\ufeff")


@pytest.mark.parametrize("files, expected", [
    ({"cpu.max": "150000 100000\n"}, 1.5), ({"cpu.max": "max 100000\n"}, float("inf")), ({}, float("inf")),
    ({"cpu/cpu.cfs_quota_us": "400000\n", "cpu/cpu.cfs_period_us": "100000\n"}, 4.0),
    ({"cpu/cpu.cfs_quota_us": "-1\n", "cpu/cpu.cfs_period_us": "100000\n"}, float("inf")),
])
def test_quota_of_a_container(tmp_path, monkeypatch, files, expected):
    (tmp_path / "cpu").mkdir()
    for name, content in files.items():
        (tmp_path / name).write_text(content)
    assert quota(tmp_path) == expected
    monkeypatch.setattr("timber_houses.base.processors.quota", lambda: 0.5)
    assert processors() == 1


def test_numbers_in_tables():
    assert csv_text(("a", "b"), [(-0.0, "x,y"), (1 / 3, 2)]) == 'a,b\n0,"x,y"\n0.333333333333,2\n'
