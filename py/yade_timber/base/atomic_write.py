# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are either complete or absent: written under a temporary name, then renamed. Needs no YADE."""
import os
import secrets
from contextlib import contextmanager
from pathlib import Path

PART = ".part-"
"""Start of temporary names."""


@contextmanager
def written_whole(path):
    """Give a temporary file beside `path`, with its suffixes, to write to; rename it to `path` at the end, remove it on an error.

    The file is created exclusively (no link of that name is followed), with the permissions of the user's umask. Raises OSError.
    """
    path = Path(path)
    part = path.with_name(f"{PART}{secrets.token_hex(4)}-{path.name}")
    os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
    try:
        yield part
        _sync(part)
        os.replace(part, path)
        _sync(path.parent)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _sync(path):
    """Flush a file, or the names in a folder, to the disk, so that a power cut keeps the order of changes."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def remove_parts(folder):
    """Remove temporary files that killed processes have left in a folder. Raises OSError."""
    for part in Path(folder).glob(f"{PART}*"):
        part.unlink(missing_ok=True)


def write_text(path, text):
    """Write a text file (UTF-8, line ends as given; halves of character pairs, as in undecodable names of files, as escapes). Raises OSError."""
    with written_whole(path) as part:
        part.write_text(text, encoding="utf-8", errors="backslashreplace", newline="")
