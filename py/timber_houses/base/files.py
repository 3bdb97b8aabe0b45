# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders of results, and files written from memory."""
import errno
import os
import shutil
from contextlib import contextmanager
from pathlib import Path

from .atomic_write import PART, written_whole


@contextmanager
def written_from_memory(path):
    """`written_whole` through a file in memory, for a writer that needs a path and crashes on a full disk (YADE). The
    system's limit of a file's size holds in memory, too: the writer must report that."""
    descriptor = os.memfd_create(Path(path).name)
    with open(descriptor, "rb") as memory:
        yield Path(f"/proc/self/fd/{descriptor}")
        with written_whole(path) as part, open(part, "wb") as file:
            shutil.copyfileobj(memory, file)


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
