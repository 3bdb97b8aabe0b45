# SPDX-License-Identifier: GPL-2.0-or-later
"""Files to which an unfinished run appends its samples and frames at each checkpoint, so that the bytes written grow
with the result, and logs of users' scenes (`yt.record`), of unknown origin. Needs no YADE.

Their records are entries of `yade_timber.log`; the first one has the fingerprint of the run's identity."""
import json
import os
import zlib

import numpy as np
from yade_timber.log import CHECKSUM, CONTACTS, FIELDS, FRAME, OWN_SCENE, RUN, SCENE, packed

from ..base.errors import RunError
from ..base.json_types import require
from ..base.record_file import MAX_JSON, open_record, record
from .table_file import KINDS

FRAMES_LOG = "frames.log"  # of a run, beside its frames.h5
WITHOUT = {"group", "storey", "side", "sheet"}  # tables of a frames.h5 that the description of a scene does not have


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


def frame_type(frames):
    """Data type of a frame: the content of its record, and the types of the file's tables."""
    n, j = len(frames.elements.name), len(frames.joints.name)
    return np.dtype([("position", "f4", (n, 3)), ("orientation", "f4", (n, 4)), ("load", "f4", (j,)),
                     ("broken", "u1", (j,))])


def series(frames):
    """The frames as arrays of the file's types; without frames their shapes hold the numbers of elements and joints."""
    types = {"time": np.dtype("f8"), **{name: kind for name, (kind, _) in frame_type(frames).fields.items()}}
    return {name: np.asarray(getattr(frames, name), kind.base).reshape(len(frames.time), *kind.shape)
            for name, kind in types.items()}


def add_frames(frames, records):
    """Append frames and contacts of an AppendLog's records to Frames. Raises ValueError for records of other sizes."""
    form, parts = frame_type(frames), {FRAME: [], CONTACTS: []}
    for kind, time, content in records:
        parts[kind].append((time, content))
    frames.time = [*frames.time, *(time for time, _ in parts[FRAME])]
    added = [np.frombuffer(content, form).reshape(1)[0] for _, content in parts[FRAME]]
    for name in form.names:
        setattr(frames, name, [*getattr(frames, name), *(frame[name] for frame in added)])
    for time, content in parts[CONTACTS]:
        words = np.frombuffer(content, "i4").reshape(8, -1).ravel()
        pair, position, force = np.split(words, np.array([2, 5]) * len(words) // 8)
        values = time, pair.reshape(-1, 2), position.view("f4").reshape(-1, 3), force.view("f4").reshape(-1, 3)
        for name, value in zip(("time", "pair", "position", "force"), values):
            getattr(frames.contacts, name).append(value)
    vars(frames).update(series(frames))


def log_frames(log, frames):
    """Add records of all frames and contacts of Frames to an AppendLog, in the order of time."""
    names = frame_type(frames).names
    added = [(time, FRAME, [getattr(frames, name)[k] for name in names]) for k, time in enumerate(frames.time)]
    c = frames.contacts
    added += [(time, CONTACTS, arrays) for time, *arrays in zip(c.time, c.pair, c.position, c.force)]
    for time, kind, arrays in sorted(added, key=lambda record: record[0]):
        log.add(kind, time, *arrays)


def read_scene(path, layout):
    """(title, elements, joints, records): {table: values} and the further records of the log. layout: of a frames.h5.
    Raises RunError, or an error of json or numpy, for other logs."""
    records = read(path, OWN_SCENE)
    try:
        kind, _, content = next(records, (b"", 0.0, b""))
    except RunError as problem:
        raise RunError(f"{problem}; an unfinished run is shown from its frames.h5") from None
    if kind != SCENE or len(content) > MAX_JSON:
        raise ValueError("no description of the scene")
    scene = require(json.loads(content), dict, "scene")
    if scene.keys() != {"title", "elements", "joints"}:
        raise ValueError("scene: unknown or missing entries")
    elements, joints = (_tables(require(scene[name], dict, name), layout[name].tables, name)
                        for name in ("elements", "joints"))
    return require(scene["title"], str, "title"), elements, joints, records


def _tables(values, layout, group):
    """{table: array, or list of texts} of lists from JSON. layout: as of table_file.Group. Raises ValueError."""
    if values.keys() != layout.keys() - WITHOUT:
        raise ValueError(f"{group}: unknown or missing tables")
    lengths: dict[str, int] = {}
    for name, column in values.items():
        kind, length, *width = layout[name]
        count = len(require(column, list, f"{group}/{name}"))
        if lengths.setdefault(length, count) != count:
            raise ValueError(f"{group}/{name}: {count} entries instead of {lengths[length]}")
        if kind != "text":
            values[name] = _numbers(column, kind, width, f"{group}/{name}")
        elif not all(isinstance(entry, str) for entry in column):
            raise ValueError(f"{group}/{name}: no texts")
    return values


def _numbers(column, kind, width, place):
    """Array of a list of numbers, or of rows of a width. Raises ValueError; only strengths may be infinite."""
    table = np.array(column) if column else np.empty((0, *width), int if kind == "whole" else float)
    if table.shape != (len(column), *width) or column and table.dtype.kind not in KINDS[kind]:
        raise ValueError(f"{place}: no {kind}s in rows of {width or 1}")
    if np.isnan(table).any() or np.isinf(table).any() and place != "joints/strength":
        raise ValueError(f"{place}: a number that is not finite")
    return table
