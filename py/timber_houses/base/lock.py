# SPDX-License-Identifier: GPL-2.0-or-later
"""At most one process per folder of results: a lock on a file in the folder, released when the process ends."""
import fcntl
import os
import tempfile
from contextlib import contextmanager, suppress


from .errors import os_errors
from .files import make_folder

LOCK = ".lock"  # of the process that computes a run


def prepare_folder(folder, option):
    """Create the folder and check that files can be written in it. option: its name for the user. Raises RunError."""
    with os_errors(lambda fault: f"{option} {folder}: results cannot be written there: {fault}; choose another folder"):
        make_folder(folder)
        tempfile.TemporaryFile(dir=folder).close()


@contextmanager
def locked(folder, name=LOCK):
    """True while this process alone has the lock of that name in a folder; else False. Raises RunError."""
    with os_errors(lambda fault: f"{folder / name}: cannot be opened: {fault}"):
        descriptor = os.open(folder / name, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666)
    try:
        free = False
        with suppress(BlockingIOError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            free = True
        yield free
    finally:
        os.close(descriptor)


def is_locked(folder):
    """Whether a process has the lock of a folder."""
    if not (folder / LOCK).exists():
        return False
    with locked(folder) as free:
        return not free
