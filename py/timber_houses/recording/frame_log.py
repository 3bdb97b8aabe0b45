# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames and contacts in a log, a record for each time: of an unfinished run beside frames.h5, or of a user's scene."""
import numpy as np
from yade_timber.log import CONTACTS, FRAME

NAME = "frames.log"


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
    kind, parts = frame_type(frames), {FRAME: [], CONTACTS: []}
    for record, time, content in records:
        parts[record].append((time, content))
    frames.time = [*frames.time, *(time for time, _ in parts[FRAME])]
    added = [np.frombuffer(content, kind).reshape(1)[0] for _, content in parts[FRAME]]
    for name in kind.names:
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
