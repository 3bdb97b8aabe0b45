# SPDX-License-Identifier: GPL-2.0-or-later
"""Record files: files of a run that are read back, perhaps from a folder of unknown origin.

One rule for all: a regular file of a bounded size; no link is followed, no pipe or device is waited for."""
import errno
import os
import stat
from contextlib import contextmanager

from .errors import RunError

MAX_SIZE = 2_000_000_000  # largest file of binary tables. [bytes] A house of 500 elements for 600 s has 250 MB.
MAX_TABLE = 128_000_000  # largest table of text. [bytes] A history of 600 s has 20 MB.
MAX_JSON = 32_000_000  # longest text of JSON. [bytes]


def open_record(path, flags=os.O_RDONLY, limit=MAX_SIZE):
    """Binary file of a path, opened with flags of os.open. Raises RunError for what is no record file, OSError."""
    try:
        descriptor = os.open(path, flags | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY, 0o666)
    except OSError as problem:
        reason = {errno.ELOOP: "a link, not a regular file; put the file itself there",
                  errno.EISDIR: "a folder, not a regular file"}.get(problem.errno)
        if reason is None:
            raise
        raise RunError(f"{path}: {reason}") from None
    status = os.fstat(descriptor)
    if stat.S_ISREG(status.st_mode) and status.st_size <= limit:
        return os.fdopen(descriptor, "rb" if flags == os.O_RDONLY else "r+b")
    os.close(descriptor)
    raise RunError(f"{path}: {status.st_size / 1e6:.0f} MB; at most {limit / 1e6:.0f} MB are read"
                   if stat.S_ISREG(status.st_mode) else f"{path}: not a regular file")


@contextmanager
def record(path, missing="", limit=MAX_SIZE):
    """Binary file of a record file, to be read. missing: remedy for a missing one. Raises RunError."""
    try:
        file = open_record(path, limit=limit)
    except FileNotFoundError:
        raise RunError(f"{path}: no such file{missing and f'; {missing}'}") from None
    except (OSError, ValueError) as problem:  # ValueError: an impossible path
        reason = getattr(problem, "strerror", None) or problem
        raise problem if isinstance(problem, RunError) else RunError(f"{path}: cannot be read: {reason}") from None
    with file:
        yield file


def read_record(path, missing="", limit=MAX_JSON):
    """Content of a record file. missing: remedy for a missing one. Raises RunError."""
    with record(path, missing, limit) as file:
        try:
            return file.read(limit)
        except OSError as problem:
            raise RunError(f"{path}: cannot be read: {problem.strerror}") from None
