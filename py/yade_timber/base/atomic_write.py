# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are either complete or absent: written under a temporary name, then renamed.

A path or its links lead to a regular file or to nothing; folders, pipes, devices and sockets are refused.
"""
import errno
import os
import secrets
import shutil
import stat
from contextlib import contextmanager, suppress
from pathlib import Path

PART = ".part-"
"""Start of temporary names."""


@contextmanager
def written_whole(path):
    """Give a temporary file with the suffixes of `path` to write to. At the end it becomes `path`; on an error it is
    removed.

    The file is created exclusively (no link of that name is followed), with the permissions of the user's umask. Raises
    OSError.
    """
    target = _target(path)
    part = target.with_name(f"{PART}{secrets.token_hex(4)}-{target.name}")
    part.touch(exist_ok=False)
    try:
        yield part
        _sync(part)
        os.replace(part, target)
        _sync(target.parent)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


@contextmanager
def written_from_memory(path):
    """`written_whole` through a file in memory, for writers that crash on a full disk (YADE, HDF5) or miss it (VTK)."""
    descriptor = os.memfd_create(Path(path).name)
    with open(descriptor, "rb") as memory:
        yield Path(f"/proc/self/fd/{descriptor}")
        with written_whole(path) as part, open(part, "wb") as file:
            shutil.copyfileobj(memory, file)


def _target(path):
    """The regular file, there or not yet, that a path or its links lead to. Raises OSError for anything else."""
    with suppress(FileNotFoundError):
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode):
            raise OSError(errno.EINVAL, "is a folder" if stat.S_ISDIR(mode) else "is no regular file", str(path))
    return Path(os.path.realpath(path))


def _sync(path):
    """Flush a file, or the names in a folder, to the disk, so that a power cut keeps the order of changes."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def remove(path):
    """Remove the regular file that a path or its links lead to, if any; links stay. Raises OSError."""
    _target(path).unlink(missing_ok=True)


def remove_parts(folder):
    """Remove temporary files that killed processes have left in a folder. Raises OSError."""
    for part in Path(folder).glob(f"{PART}*"):
        part.unlink(missing_ok=True)


def make_folder(path):
    """Make a folder and those that it lies in, unless it exists. Raises OSError."""
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        reason = "is no folder" if os.path.exists(path) else "is a link to nothing"
        raise NotADirectoryError(errno.ENOTDIR, reason, str(path)) from None


def write_text(path, text):
    """Write a text file: UTF-8, line ends as given, halves of character pairs as escapes. Raises OSError."""
    with written_whole(path) as part:
        part.write_text(text, encoding="utf-8", errors="backslashreplace", newline="")
