# SPDX-License-Identifier: GPL-2.0-or-later
"""The times of a run that are worth a picture."""
from dataclasses import dataclass

import numpy as np

from ..recording.summary import collapse_time
from ..recording.verdict import TILT
from ..text.english import counted, ratio, short

PANELS = 6
CLOSE = 0.5
"""Two key times are at least this far apart. [s]"""
DIFFERENT = 0.05
"""Two pictures differ visibly beyond this mean displacement of the elements. [m]"""
FARTHEST = 1.0
"""Largest displacement that counts for one element, so that one that rolls away does not outweigh the house. [m]"""
ONSET = 0.1
"""Ground acceleration at which the shaking begins. [m/s2]"""
AT_REST = 1e-3
"""Before the shaking a house with smaller storey drifts is at rest. [-]"""
STRONGEST, FIRST_DAMAGE = "strongest shaking", "first damage"
"""Captions."""
FAINT = 0.02
"""Acceleration after the shaking over the peak. [-]"""
LAG = 2.0
"""Time shown after the last change. [s]"""
LEAD = 1.0
"""Time shown before the shaking. [s]"""


@dataclass(frozen=True)
class KeyTime:
    """frame: number of the frame; reason: caption of a few words."""

    frame: int
    reason: str


def choose(frames, count=PANELS):
    """Up to `count` KeyTimes in the order of time, no two of which look alike.

    1. The start and the end.
    2. The named times (see `named`), in the order of their importance.
    3. The frames that differ most from all chosen so far.
    Fewer than `count` when the remaining frames look like chosen ones.
    """
    last = len(frames.time) - 1
    chosen = {last: "end" if frames.summary else "so far", 0: "start"}
    novelty = np.min([differences(frames, frame) for frame in chosen], axis=0)
    waiting = [(frames.at(time), reason) for time, reason in named(frames)]
    while len(chosen) < count:
        waiting = [(frame, reason) for frame, reason in waiting if novelty[frame] >= DIFFERENT]
        frame, reason = waiting.pop(0) if waiting else (int(np.argmax(novelty)), "")
        if novelty[frame] < DIFFERENT:
            break
        chosen[frame] = reason or state(frames, frame)
        novelty = np.minimum(novelty, differences(frames, frame))
    if len(chosen) == 2:
        chosen[last] += ", no visible change"
    return [KeyTime(frame, chosen[frame]) for frame in sorted(chosen)]


def state(frames, frame):
    """State of the house in a frame: collapsed, its storey drift, or the number of its broken joints."""
    time, collapse = frames.time[frame], collapse_time(frames.summary)
    if collapse is not None and time >= collapse:
        return "after the collapse"
    if frames.history and frames.history.samples:
        return f"drift {ratio(frames.history.largest_drift()[frames.history.row_at(time)])}"
    return counted(int((frames.joint_states(frame) == "broken").sum()), "broken joint")


def differences(frames, frame):
    """(F,) mean displacement of the elements between each frame and one frame, zero within CLOSE of its time. [m]"""
    positions = np.asarray(frames.position)[:, frames.shown]
    moved = np.minimum(np.linalg.norm(positions - positions[frame], axis=2), FARTHEST).mean(1)
    return np.where(np.abs(np.asarray(frames.time) - frames.time[frame]) < CLOSE, 0, moved)


def named(frames):
    """(time [s], reason) of the times that have a name, the most important first."""
    summary = frames.summary
    for kind, reason in (("collapse", "collapse"), ("tilt", f"drift {TILT.ratio}")) if summary else ():
        time = getattr(summary, f"{kind}_time_s")
        if time is not None:
            lot = next((event.lot for event in summary.events if event.kind == kind), None)
            yield time, reason if lot is None else f"{lot}: {reason}"
    if frames.motion:
        yield strongest_shaking(frames), STRONGEST
    for kind in ("structure_fallen", "snow_fallen"):
        yield from [(event.time_s, short(event)) for event in (summary.events if summary else ())
                    if event.kind == kind][:1]
    if frames.breaks is not None and len(frames.breaks["time"]):
        yield frames.breaks["time"][0], FIRST_DAMAGE
    if frames.history and frames.history.samples and not (summary and summary.collapsed):
        yield frames.history.time[np.argmax(frames.history.largest_drift())], "largest drift"


def onset(motion):
    """Time at which the shaking begins [s]; the motion's start when it stays below ONSET."""
    found = motion.first(ONSET)
    return float(motion.start) if found is None else found


def strongest_shaking(frames):
    """Time of the largest horizontal ground acceleration within the run. [s]"""
    motion = frames.motion
    within = (motion.time >= frames.time[0]) & (motion.time <= frames.time[-1])
    strength = np.where(within, np.hypot(*motion.acceleration[:, :2].T), -1)
    return motion.time[np.argmax(strength)]


def first_shown(frames):
    """Time at which curves and films begin: shortly before the shaking if the house rests until then, else 0. [s]"""
    if frames.motion is None or not frames.history:
        return 0.0
    start = min(onset(frames.motion), frames.time[-1]) - LEAD
    moving = frames.history.time[frames.history.largest_drift() > AT_REST]
    first = min([*moving[:1], *frames.breaks["time"][:1], np.inf])
    return float(start) if 0 < start < first else 0.0


def last_shown(frames):
    """Time at which curves end: LAG after the last shaking, motion of the house and broken joint, or the run's end. [s]
    """
    if frames.motion is None or not frames.history:
        return float(frames.time[-1])
    strong = np.abs(frames.motion.acceleration).max(1) >= FAINT * np.abs(frames.motion.acceleration).max()
    drifts = frames.history.largest_drift()
    moving = frames.history.time[np.abs(drifts - drifts[-1:]) > AT_REST]
    last = max([*frames.motion.time[strong][-1:], *moving[-1:], *frames.breaks["time"][-1:]], default=0.0)
    return min(float(last) + LAG, float(frames.time[-1]))


def last_change(frames):
    """Last time at which the picture differs visibly from the end of the run; the end, when none does. [s]"""
    differing = np.asarray(frames.time)[differences(frames, len(frames.time) - 1) >= DIFFERENT]
    return float(differing[-1] if len(differing) else frames.time[-1])
