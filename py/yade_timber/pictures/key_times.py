# SPDX-License-Identifier: GPL-2.0-or-later
"""Which moments of a run are worth a picture. Needs no YADE."""
from dataclasses import dataclass

import numpy as np

PANELS = 6
CLOSE = 0.25
"""Moments nearer than this to one that is chosen already are left out, but for the end. [s]"""
WORTH = 0.05
"""A path of the elements [m], root mean square, that a second without motion counts as: in a quiet run pictures are spread over time."""


@dataclass(frozen=True)
class Moment:
    """frame: number of the frame; reason: why it was chosen, in words; '' where it halves the motion between two others."""

    frame: int
    reason: str


def choose(frames, count=PANELS):
    """Up to `count` moments in the order of time.

    First those that have a name, in this order as far as there is room: the start, the end, collapse, the first lean beyond 1/10,
    strongest shaking, the first break, in a house that stands the largest drift. Then, again and again, the frame that halves the motion in the gap
    between two neighbours in which the elements move most.
    """
    chosen = {}
    for time, reason in named(frames):
        frame = frames.at(time)
        near = min((abs(frames.time[frame] - frames.time[k]) for k in chosen), default=np.inf)
        last = frame == len(frames.time) - 1
        if len(chosen) < count and near > 0 and (near >= CLOSE or last):
            chosen[frame] = reason
    path = motion_path(frames)
    while len(chosen) < min(count, len(path)):
        chosen[halving(path, sorted(chosen))] = ""
    return [Moment(frame, chosen[frame]) for frame in sorted(chosen)]


def named(frames):
    """(time [s], reason) of the moments that have a name, the most telling first."""
    yield frames.time[0], "start"
    yield frames.time[-1], "end" if frames.summary else "so far"
    found = frames.summary or {}
    if found.get("collapse_time_s") is not None:
        yield found["collapse_time_s"], "collapse: half a storey down"
    if found.get("tilt_time_s") is not None:
        yield found["tilt_time_s"], "leans by 1/10"
    if frames.motion:
        yield strongest_shaking(frames), "strongest shaking"
    if frames.breaks is not None and len(frames.breaks["time"]):
        yield frames.breaks["time"][0], "first spring breaks"
    if frames.history and len(frames.history[1]) and not found["collapsed"]:
        yield largest_drift(frames), "largest drift"


def strongest_shaking(frames):
    """When the horizontal ground acceleration is largest within the run. [s]"""
    motion = frames.motion
    within = (motion.time >= frames.time[0]) & (motion.time <= frames.time[-1])
    strength = np.where(within, np.hypot(*motion.acceleration[:, :2].T), -1)
    return motion.time[np.argmax(strength)]


def largest_drift(frames):
    """When a storey's drift is largest. [s]"""
    columns, rows = frames.history
    drifts = [k for k, name in enumerate(columns) if name.startswith("drift")]
    return rows[np.argmax(np.abs(rows[:, drifts]).max(1)), 0]


def motion_path(frames):
    """(F,) root-mean-square way of the elements up to each frame [m], and a little for the time itself."""
    steps = np.diff(np.asarray(frames.position, float)[:, frames.shown], axis=0)
    way = np.sqrt((steps**2).sum(2).mean(1))
    return np.concatenate([[0], np.cumsum(way + WORTH * np.diff(frames.time))])


def halving(path, chosen):
    """The frame that halves the path in the gap of `chosen` frames that has the longest path and a frame inside."""
    gaps = [(path[b] - path[a], a, b) for a, b in zip(chosen, chosen[1:]) if b - a > 1]
    _, a, b = max(gaps)
    inside = np.arange(a + 1, b)
    return int(inside[np.argmin(np.abs(path[inside] - (path[a] + path[b]) / 2))])
