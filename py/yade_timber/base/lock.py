# SPDX-License-Identifier: GPL-2.0-or-later
"""At most one process per folder of results: a lock on a file in the folder, released when the process ends."""
import fcntl
import os
import tempfile
from contextlib import contextmanager, suppress

from .atomic_write import make_folder
from .errors import os_errors

LOCK = ".lock"
_descriptors = set()
"""Open lock files of this process."""


def prepare_folder(folder, option):
    """Create the folder and check that files can be written in it. option: its name for the user. Raises RunError."""
    with os_errors(lambda fault: f"{option} {folder}: results cannot be written there: {fault}; choose another folder"):
        make_folder(folder)
        tempfile.TemporaryFile(dir=folder).close()


@contextmanager
def locked(folder):
    """True while this process alone, without its copies (fork), has the folder; else False. Raises RunError."""
    with os_errors(lambda fault: f"{folder / LOCK}: cannot be opened: {fault}"):
        descriptor = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
    _descriptors.add(descriptor)
    try:
        free = False
        with suppress(BlockingIOError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            free = True
        yield free
    finally:
        _descriptors.discard(descriptor)
        os.close(descriptor)


def _close_in_copy():
    """In a copy of the process, which would hold the lock for as long as it lives."""
    for descriptor in _descriptors:
        os.close(descriptor)
    _descriptors.clear()


os.register_at_fork(after_in_child=_close_in_copy)


def is_locked(folder):
    """Whether a process has the lock of a folder."""
    if not (folder / LOCK).exists():
        return False
    with locked(folder) as free:
        return not free
