# SPDX-License-Identifier: GPL-2.0-or-later
"""The first failures of a run: which joints, when, why, at which storey drift."""
from dataclasses import dataclass

import numpy as np

from ..base.joint_kinds import WALL_COLUMN

MOST = 8  # number of failures
ONE_TIME = 0.05  # failures of like joints within this time are one. [s]


@dataclass(frozen=True)
class Failure:
    """Break of the first springs of like joints at one time. joints: their numbers; drift: of their storey then, None
    in another structure [-]"""

    time: float
    joints: tuple
    cause: str
    drift: float
    direction: str


def first_failures(frames, most=MOST):
    """The failures of the joints whose first springs break first, in the order of time. Fewer where fewer break."""
    if frames.breaks is None:
        return []
    first, groups = {}, {}
    for time, joint, cause in sorted(zip(*(frames.breaks[key] for key in ("time", "joint", "cause"))),
                                     key=lambda entry: entry[0]):
        first.setdefault(int(joint), (float(time), cause))
    for joint, (time, cause) in first.items():
        earlier = groups.setdefault((material(frames, joint), frames.joints.storey[joint], cause), [])
        if not earlier or time - earlier[-1][0] > ONE_TIME:
            earlier.append((time, []))
        earlier[-1][1].append(joint)
    return sorted((Failure(time, tuple(joints), cause, *_drift(frames, joints[0], time))
                   for (_, _, cause), times in groups.items() for time, joints in times),
                  key=lambda failure: (failure.time, failure.joints))[:most]


def material(frames, joint):
    """'plywood' of a wall's sheet, else the kind of the joint: 'column-beam'."""
    return place(frames, joint)[1] if frames.joints.kind[joint] == WALL_COLUMN else (
        frames.joints.kind[joint].replace("_", "-"))


def place(frames, joint):
    """('main.wall1.EW.y0.3-4', 'plywood') of a wall's sheet; ('main.column1.x0y0', material of this member) else."""
    name, first = frames.joints.name[joint], frames.joints.a[joint]
    if frames.joints.kind[joint] == WALL_COLUMN:
        return tuple(name.removesuffix(".columns").rpartition(".")[::2])
    return frames.elements.name[first], frames.elements.material[first]


def _drift(frames, joint, time):
    """(drift of the joint's storey at a time, 'ns' or 'ew'); (None, '') in another structure or without a history."""
    storey = frames.joints.storey[joint]
    if not storey.isdigit() or not frames.history or int(storey) not in frames.history.storeys:
        return None, ""
    drifts = {key: abs(float(np.interp(time, frames.history.time, frames.history.drift(int(storey), key))))
              for key in ("ns", "ew")}
    direction = max(drifts, key=drifts.get)
    return drifts[direction], direction
