# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are either whole or not there: written beside their place, then renamed. Needs no YADE."""
import os
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_whole(path):
    """Gives a path beside `path`, of the same suffixes, to write to; renames it to `path` at the end, removes it on an error."""
    path = Path(path)
    part = path.with_name(f".part-{path.name}")
    try:
        yield part
        _to_disk(part)
        os.replace(part, path)
        _to_disk(path.parent)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _to_disk(path):
    """Has the system write a file, or the names in a folder, to the disk: a power cut keeps what comes later from overtaking it."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def write_text(path, text):
    """Write a text file (UTF-8, line ends as given). Raises OSError."""
    with written_whole(path) as part:
        part.write_text(text, encoding="utf-8", newline="")
