# SPDX-License-Identifier: GPL-2.0-or-later
"""The first failures of a run: which joint, when, why, at which storey drift."""
from dataclasses import dataclass

import numpy as np

MOST = 8
"""Number of failures."""


@dataclass(frozen=True)
class Failure:
    """Break of a joint's first spring. joint: its number; drift: of its storey then, None in another structure [-]"""

    time: float
    joint: int
    cause: str
    drift: float
    direction: str


def first_failures(frames, most=MOST):
    """The joints whose first springs break first, in the order of time. Fewer where fewer break."""
    if frames.breaks is None:
        return []
    first = {}
    for time, joint, cause in sorted(zip(*(frames.breaks[key] for key in ("time", "joint", "cause"))),
                                     key=lambda entry: entry[0]):
        first.setdefault(int(joint), (float(time), cause))
    return [Failure(time, joint, cause, *_drift(frames, joint, time))
            for joint, (time, cause) in list(first.items())[:most]]


def _drift(frames, joint, time):
    """(drift of the joint's storey at a time, 'ns' or 'ew'); (None, '') in another structure or without a history."""
    storey = frames.joints.storey[joint]
    if not storey.isdigit() or not frames.history or int(storey) not in frames.history.storeys:
        return None, ""
    drifts = {key: abs(float(np.interp(time, frames.history.time, frames.history.drift(int(storey), key))))
              for key in ("ns", "ew")}
    direction = max(drifts, key=drifts.get)
    return drifts[direction], direction
