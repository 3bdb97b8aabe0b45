# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of the monitors of the loaded run; those before the last checkpoint are in a file beside it, or in the
checkpoint itself once the run has ended."""
from contextlib import contextmanager

import numpy as np
import yade.wrapper as yw
from yade_timber.scene.engines import find_engine

from ..base.atomic_write import remove, write_bytes
from ..base.errors import RunError
from ..base.record_file import MAX_SIZE, read_record
from ..recording.append_log import AppendLog
from . import checkpoint

NAME = "samples.log"
MONITORS = {b"H": yw.HouseMonitor, b"M": yw.StructureMonitor}
"""Kind of the records, and the engine whose `rows` they hold, float64."""
O = yw.Omega()


class Samples:
    """run: fingerprint of the run's identity"""

    def __init__(self, path, run):
        self.log = AppendLog(path, run)

    def save(self):
        """Move the rows from the scene to the file; returns the file's size. Raises OSError."""
        for kind, monitor in MONITORS.items():
            engine = find_engine(monitor)
            self.log.add(kind, O.time, np.array(engine.rows))
            engine.rows = []
        return self.log.flush()

    def enclose(self, path):
        """Move the file into the checkpoint at that path, and all rows into the scene. Raises OSError, RunError."""
        if not self.log.path.exists():
            return
        checkpoint.enclose(path, read_record(self.log.path, limit=MAX_SIZE))
        self._set(self._rows())
        remove(self.log.path)

    def resume(self, size, enclosed, remedy):
        """Drop rows after the present time. size: of the file at the checkpoint, whose content may be enclosed there.
        Raises OSError, RunError."""
        if enclosed:
            write_bytes(self.log.path, enclosed)
        if self.log.cut(O.time + O.dt / 2) != size:
            raise RunError(f"{self.log.path}: missing, damaged or older than the checkpoint at {O.time:g} s; {remedy}")
        for kind, time, content in self.log.records():
            if kind not in MONITORS or len(content) % np.dtype(float).itemsize:
                raise RunError(f"{self.log.path}: no rows of a monitor at {time:g} s; {remedy}")

    @contextmanager
    def restored(self):
        """Context in which the scene's monitors have all rows, for the results."""
        latest = {kind: find_engine(monitor).rows for kind, monitor in MONITORS.items()}
        try:
            self._set(self._rows())
            yield
        finally:
            self._set(latest)

    def _rows(self):
        """All rows by kind."""
        parts = {kind: [] for kind in MONITORS}
        for kind, _, content in self.log.records():
            parts[kind].append(np.frombuffer(content))
        return {kind: np.concatenate([*earlier, find_engine(MONITORS[kind]).rows]).tolist()
                for kind, earlier in parts.items()}

    @staticmethod
    def _set(rows):
        for kind, monitor in MONITORS.items():
            find_engine(monitor).rows = rows[kind]
