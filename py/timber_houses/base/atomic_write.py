# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that are either complete or absent: written under a temporary name, then renamed.

Only regular files are replaced, where a path or its links lead to one or to nothing. What else can be written to (a
terminal, a pipe with a reader, a character device) gets the content of the complete file; folders, sockets and disks
are refused."""
import errno
import os
import secrets
import shutil
import stat
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

PART = ".part-"  # start of temporary names


@contextmanager
def written_whole(path):
    """Give a temporary file with the suffixes of `path` to write to. At the end it becomes `path`; on an error it is
    removed.

    The file is created exclusively (no link of that name is followed), with the permissions of the user's umask. Raises
    OSError."""
    path = Path(path)
    with _written_to(path) if _is_stream(path) else _replaced(Path(os.path.realpath(path))) as part:
        yield part


def _is_stream(path):
    """Whether content is written to what is at `path` instead of replacing it. Raises OSError for neither."""
    try:
        status = path.stat()
    except FileNotFoundError:
        return False
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, "is a folder", str(path))
    if stat.S_ISBLK(status.st_mode) or stat.S_ISSOCK(status.st_mode):
        raise OSError(errno.EINVAL, "is a disk or a socket; give a file", str(path))
    return not stat.S_ISREG(status.st_mode) or _output_of(status) is not None


def _output_of(status):
    """Standard output or error (1, 2) that goes to the file of that status, None when neither does."""
    for descriptor in (1, 2):
        try:
            if os.path.samestat(status, os.fstat(descriptor)):
                return descriptor
        except OSError:  # closed
            pass
    return None


@contextmanager
def _replaced(path):
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


@contextmanager
def _written_to(path):
    with tempfile.TemporaryDirectory() as folder, _opened(path) as stream:
        part = Path(folder) / path.name
        part.touch()
        yield part
        with open(part, "rb") as content:
            shutil.copyfileobj(content, stream)


def _opened(path):
    """Stream to what is at `path`. A pipe without a reader is refused: it would wait for ever."""
    output = _output_of(path.stat())
    if output is not None:
        (sys.stdout if output == 1 else sys.stderr).flush()
        return open(os.dup(output), "wb")
    try:
        descriptor = os.open(path, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
    except OSError as problem:
        if problem.errno != errno.ENXIO:
            raise
        raise OSError(errno.ENXIO, "nothing reads from it; start the reader first", str(path)) from None
    os.set_blocking(descriptor, True)
    return open(descriptor, "wb")


def _sync(path):
    """Flush a file, or the names in a folder, to the disk, so that a power cut keeps the order of changes."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def remove(path):
    """Remove the regular file at a path or its links, if any; links and streams stay. Raises OSError."""
    if not _is_stream(Path(path)):
        Path(os.path.realpath(path)).unlink(missing_ok=True)


def write_bytes(path, content):
    """Write a file. Raises OSError."""
    with written_whole(path) as part:
        part.write_bytes(content)


def write_text(path, text):
    """Write a text file: UTF-8, line ends as given, halves of character pairs as escapes. Raises OSError."""
    write_bytes(path, text.encode("utf-8", errors="backslashreplace"))
