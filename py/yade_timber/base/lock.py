# SPDX-License-Identifier: GPL-2.0-or-later
"""One process a run's folder: a lock on a file in the run's folder, which goes with the process, however it ends."""

import fcntl
from contextlib import contextmanager

LOCK = ".lock"


@contextmanager
def locked(folder):
    """True while this process alone has the folder; False where another one has it."""
    with open(folder / LOCK, "w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            yield False
            return
        yield True


def held(folder):
    """Whether a process has the folder."""
    if not (folder / LOCK).exists():
        return False
    with locked(folder) as free:
        return not free
