# SPDX-License-Identifier: GPL-2.0-or-later
"""At most one process per folder of results: a lock on a file in the folder, released when the process ends, however it ends."""
import fcntl
import os
from contextlib import contextmanager

from .errors import RunError

LOCK = ".lock"


@contextmanager
def locked(folder):
    """True while this process alone has the folder, False when another process has it. Raises RunError."""
    try:
        descriptor = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
    except OSError as problem:
        raise RunError(f"{folder / LOCK}: cannot be opened: {problem.strerror}") from None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        yield False
        return
    try:
        yield True
    finally:
        os.close(descriptor)


def is_locked(folder):
    """Whether a process has the lock of a folder."""
    if not (folder / LOCK).exists():
        return False
    with locked(folder) as free:
        return not free
