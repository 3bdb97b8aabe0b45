# SPDX-License-Identifier: GPL-2.0-or-later
"""Input files of unknown content: only regular files, only up to a size."""
import errno
import os
import stat
from pathlib import Path

MAX_SHOWN = 80  # longest value that a message quotes in full. [characters]


def shown(value):
    """repr of a value for a message, the beginning only where it is long."""
    try:
        text = repr(value)
    except ValueError:  # Python converts no whole number of more than 4300 digits
        return "a whole number of more than 4300 digits"
    except RecursionError:
        return "a deeply nested value"
    return text if len(text) <= MAX_SHOWN else f"{text[: MAX_SHOWN - 20]}... ({len(text)} characters)"


def is_file(path):
    """True for a regular file; False for anything else, paths that the system refuses included."""
    return _is(Path.is_file, path)


def is_folder(path):
    """True for a folder; False for anything else, paths that the system refuses included."""
    return _is(Path.is_dir, path)


def exists(path):
    """True for anything at that path; False for paths that the system refuses."""
    return _is(Path.exists, path)


def _is(kind, path):
    try:
        return kind(Path(path))
    except (OSError, ValueError):
        return False


def read_bytes(path, limit):
    """Content of a regular file of at most `limit` bytes. Raises OSError; never waits for a pipe or a device."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    except ValueError:
        raise OSError(errno.EINVAL, "not a possible path") from None
    with open(descriptor, "rb") as file:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, "not a regular file")
        content = file.read(limit + 1)
    if content is None:
        raise OSError(errno.EAGAIN, "nothing to read")
    if len(content) > limit:
        raise OSError(errno.EFBIG, f"larger than {limit / 1e6:g} MB; give a smaller file")
    return content
