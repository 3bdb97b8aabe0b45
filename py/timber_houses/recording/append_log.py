# SPDX-License-Identifier: GPL-2.0-or-later
"""A file to which an unfinished run appends its samples at each checkpoint, so that the bytes written grow with the
result. Needs no YADE.

Its records are entries of `yade_timber.log`; the first one has the fingerprint of the run's identity."""
import os
import zlib

import numpy as np
from yade_timber.log import CHECKSUM, FIELDS, RUN, packed

from ..base.errors import RunError
from ..base.record_file import open_record, record


class AppendLog:
    """Records of a run with that fingerprint: those in the file, and pending ones, which `flush` appends."""

    def __init__(self, path, run):
        self.path, self.run, self.pending = path, run, []

    def add(self, kind, time, *arrays):
        """Add a record of the arrays' bytes. kind: one byte; time [s], not before that of the last record."""
        self.pending.append((kind, time, b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)))

    def records(self):
        """(kind, time, content) of each record. Raises RunError for a file of another run."""
        yield from read(self.path, self.run)
        yield from self.pending

    def flush(self):
        """Append the pending records; returns the file's size. Raises OSError, RunError for what is no regular file."""
        with open_record(self.path, os.O_RDWR | os.O_APPEND | os.O_CREAT) as file:
            if file.seek(0, os.SEEK_END) == 0:
                file.write(packed(RUN, 0.0, self.run.encode()))
            for pending in self.pending:
                file.write(packed(*pending))
            file.flush()
            os.fsync(file.fileno())
            self.pending = []
            return file.tell()

    def cut(self, time):
        """Drop records after a time [s] and incomplete ones; returns the file's size. Raises RunError, OSError."""
        self.pending = [record for record in self.pending if record[1] <= time]
        if not os.path.lexists(self.path):
            return 0
        size = sum(FIELDS.size + CHECKSUM.size + len(content) for _, when, content in _all(self.path, self.run)
                   if when <= time)
        with open_record(self.path, os.O_RDWR) as file:
            file.truncate(size)
        return size


def is_log(path, missing=""):
    """Whether a file begins as a log. missing: remedy for a missing file. Raises RunError."""
    with record(path, missing) as file:
        return file.read(1) == RUN


def read(path, run):
    """(kind, time, content) of each complete record, none without the file. Raises RunError for another run's file."""
    return (record for record in _all(path, run) if record[0] != RUN) if os.path.lexists(path) else iter(())


def _all(path, run):
    with record(path) as file:
        first = next(_complete(file), None)
        if first and (first[0], first[2]) != (RUN, run.encode()):
            raise RunError(f"{path}: of another run")
        file.seek(0)
        yield from _complete(file)


def _complete(file):
    left = os.fstat(file.fileno()).st_size
    while (left := left - FIELDS.size - CHECKSUM.size) >= 0:
        fields, checksum = file.read(FIELDS.size), file.read(CHECKSUM.size)
        kind, length, time = FIELDS.unpack(fields)
        left -= length
        content = file.read(length) if left >= 0 else b""
        if left < 0 or (zlib.crc32(content, zlib.crc32(fields)),) != CHECKSUM.unpack(checksum):
            return
        yield kind, time, content
