# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Complete files, locks, tables. Needs no YADE."""
import os

import pytest
from yade_timber.base.atomic_write import remove_parts, write_text, written_whole
from yade_timber.base.errors import RunError
from yade_timber.base.lock import is_locked, locked
from yade_timber.base.input_file import require_regular
from yade_timber.base.table import csv_text


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


def test_links_are_replaced_not_followed(tmp_path):
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "a.txt").symlink_to(tmp_path / "mine")
    write_text(tmp_path / "a.txt", "x")
    assert (tmp_path / "mine").read_text() == "mine" and not (tmp_path / "a.txt").is_symlink()


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


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: path.symlink_to("/dev/zero"), lambda path: None])
def test_only_regular_files_are_read(tmp_path, make):
    make(tmp_path / "x")
    with pytest.raises(RunError, match="x: "):
        require_regular(tmp_path / "x")


def test_numbers_in_tables():
    assert csv_text(("a", "b"), [(-0.0, "x,y"), (1 / 3, 2)]) == 'a,b\n0,"x,y"\n0.333333333333,2\n'
