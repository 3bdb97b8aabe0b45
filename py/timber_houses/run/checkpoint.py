# SPDX-License-Identifier: GPL-2.0-or-later
"""The state of a run on disk, from which it can be resumed: YADE's own saved scene with one line appended.

The last line is JSON: `identity` of the run, `progress` (wall time, events so far), `sha256` of all bytes before that
line. YADE's loader stops before it, so the file also opens with `O.load`. The binary format keeps every bit of every
number. The samples before the checkpoint are in SAMPLES beside it and, once the run has ended, before that line.

YADE's loader creates whatever object the file names, also a PyRunner, which runs code. The binary format names each
such class, with its namespace, before the first object of it; a file that names other classes than a run writes is
refused before YADE reads it. `sha256` finds damage, not forgery."""
import errno
import hashlib
import json
import os
import re
import resource
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yade.wrapper as yw
from yade_timber import _class_names

from ..base.atomic_write import remove, write_bytes
from ..base.errors import RunError, os_errors
from ..base.files import written_from_memory
from ..base.json_types import decode, encode
from ..base.record_file import MAX_SIZE, read_record, record
from ..recording.append_log import AppendLog
from ..recording.events import Event
from ..recording.history import Samples
from ..recording.judge import Judged
from ..recording.summary_parts import ModesAt

NAME, SAMPLES = "checkpoint.yade", "samples.log"
ROWS = b"V"  # kind of the records of SAMPLES: rows of the Sampler, float64
REMEDY = "run without --resume to start anew"


@dataclass(frozen=True)
class Progress:
    """What a checkpoint holds besides the scene."""

    wall_s: float
    samples: int
    events: list[Event]
    judged: dict[str, Judged]
    modes: ModesAt | None
    upright: list
    at_rest: float | None


CLASSES = {*_class_names, "Aabb", "ForceResetter", "InsertionSortCollider", "InteractionLoop"}
"""Classes of objects in a run's scene."""
O = yw.Omega()


def save(path, identity, progress):
    """Save the scene, whole or not at all. identity: see identity.py; progress: Progress. Raises OSError."""
    with written_from_memory(path) as memory:
        _save(memory)
        seal = {"identity": identity, "progress": encode(progress),
                "sha256": hashlib.sha256(memory.read_bytes()).hexdigest()}
        with open(memory, "ab") as file:
            file.write(b"\n" + json.dumps(seal).encode())


def _save(path):
    """Save the scene. Raises OSError, also where Boost says no more than 'output stream error'."""
    try:
        O.save(str(path), quiet=True)
    except RuntimeError as problem:
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)[0]
        limited = limit != resource.RLIM_INFINITY and path.stat().st_size >= limit
        number, reason = (errno.EFBIG, os.strerror(errno.EFBIG)) if limited else (errno.EIO, str(problem))
        raise OSError(number, reason) from None


def enclose(path, content):
    """Put the content of the file of samples into the checkpoint of a run that has ended. Raises RunError, OSError."""
    body, _, seal = _read(path)
    seal |= {"enclosed": len(content), "sha256": hashlib.sha256(body + content).hexdigest()}
    write_bytes(path, body + content + b"\n" + json.dumps(seal).encode())


def load(path, identity, kind=dict):
    """Load the saved scene; returns its progress, and the enclosed samples or b"". kind: of progress, as of json_types.
    Raises RunError for damage or another identity."""
    body, samples, seal = _read(path, kind)
    for key in sorted(seal["identity"].keys() | identity.keys()):
        there, here = seal["identity"].get(key), identity.get(key)
        if there != here:
            raise RunError(f"{path}: checkpoint of another run: {key} is {there} there and {here} here; use the same"
                           " options, another --out, or no --resume")
    foreign = sorted({name.decode() for name in re.findall(rb"yade::(\w*)", body)} - CLASSES)
    if foreign:
        raise RunError(f"{path}: holds {foreign[0][:40]}, which no run of this package saves; {REMEDY}")
    descriptor = os.memfd_create(NAME)
    try:
        with open(descriptor, "wb") as memory:  # of the bytes that were checked, whatever is at the path by now
            memory.write(body)
            memory.flush()
            O.load(f"/proc/self/fd/{descriptor}", quiet=True)
    except Exception as problem:  # of Boost: written by other classes than those loaded now
        raise RunError(f"{path}: YADE cannot load it ({problem}); {REMEDY}") from None
    return seal["progress"], samples


def _read(path, kind=dict):
    """(scene, enclosed samples, seal). kind: type of the progress. Raises RunError for damage."""
    path = Path(path)
    with record(path) as file:
        if os.fstat(file.fileno()).st_uid != os.geteuid():  # YADE's loader is not safe against every forged file
            raise RunError(f"{path}: belongs to another user; copy it if you trust its origin, or {REMEDY}")
        with os_errors(lambda fault: f"{path}: cannot read the checkpoint: {fault}"):
            content = file.read()
    try:
        content, _, line = content.rpartition(b"\n")
        seal = json.loads(line)
        complete = hashlib.sha256(content).hexdigest() == seal["sha256"] and isinstance(seal["identity"], dict)
        seal["progress"] = decode(kind, seal["progress"])
        end = len(content) - seal.get("enclosed", 0)
    except (ValueError, KeyError, TypeError, RecursionError):
        complete = False
    if not complete:
        raise RunError(f"{path}: damaged, or not a checkpoint of this package; {REMEDY}")
    return content[:end], content[end:], seal


class SampleFile:
    """The file SAMPLES of the loaded run. run: fingerprint of the run's identity"""

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
            enclose(path, read_record(self.log.path, limit=MAX_SIZE))
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
