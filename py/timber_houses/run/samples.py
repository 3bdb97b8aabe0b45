# SPDX-License-Identifier: GPL-2.0-or-later
"""Samples of the loaded run: those before the last checkpoint are in a file beside it, or in the checkpoint itself once
the run has ended."""
import numpy as np
import yade.wrapper as yw

from ..base.atomic_write import remove, write_bytes
from ..base.errors import RunError
from ..base.record_file import MAX_SIZE, read_record
from ..recording.append_log import AppendLog
from ..recording.history import Samples
from . import checkpoint

NAME = "samples.log"
ROWS = b"V"  # kind of the records: rows of the Sampler, float64
O = yw.Omega()


class SampleFile:
    """run: fingerprint of the run's identity"""

    def __init__(self, path, run):
        self.log = AppendLog(path, run)

    def save(self, observer):
        """Move an Observer's rows to the file; returns the file's size. Raises OSError."""
        self.log.add(ROWS, O.time, *observer.fresh)
        observer.fresh = []
        return self.log.flush()

    def all(self, observer):
        """Samples of the run, those of its Observer included; none that were taken before an earlier state was loaded.
        """
        rows = [np.frombuffer(content) for _, _, content in self.log.records()]
        samples = Samples(observer.columns, np.concatenate([*rows, *map(np.ravel, observer.fresh), []]))
        next_times = np.append(samples.time[1:], np.inf)
        return samples._replace(rows=samples.rows[samples.time < np.minimum.accumulate(next_times[::-1])[::-1]])

    def enclose(self, path, observer):
        """Move the file into the checkpoint at that path; the Observer has all rows then. Raises OSError, RunError."""
        if self.log.path.exists():
            checkpoint.enclose(path, read_record(self.log.path, limit=MAX_SIZE))
            observer.fresh = [self.all(observer).rows]
            remove(self.log.path)

    def resume(self, size, enclosed, remedy):
        """Drop rows after the present time. size: of the file at the checkpoint, whose content may be enclosed there.
        Raises OSError, RunError."""
        if enclosed:
            write_bytes(self.log.path, enclosed)
        if self.log.cut(O.time + O.dt / 2) != size:
            raise RunError(f"{self.log.path}: missing, damaged or older than the checkpoint at {O.time:g} s; {remedy}")
        for kind, time, content in self.log.records():
            if kind != ROWS or len(content) % np.dtype(float).itemsize:
                raise RunError(f"{self.log.path}: no samples at {time:g} s; {remedy}")
