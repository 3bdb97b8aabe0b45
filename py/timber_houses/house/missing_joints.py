# SPDX-License-Identifier: GPL-2.0-or-later
"""Members of a frame that face each other without a joint: a warning, as they may be meant to."""
import warnings
from collections import defaultdict

import numpy as np

from .bars import OBLIQUE
from .geometry import contact_polygon, facing_polygon, separation
from .joint_values import kinds_of
from .joints import near_pairs
from .layout import FRAME

NEAR = 0.02  # distance up to which two faces may be meant to touch. [m]
TOUCHING = 1e-7  # [m]
SHOWN = 3


def warn_of_missing_joints(model, data):
    """One warning of the pairs of a frame that face each other within NEAR without a joint.

    Left out: members without a rule that bear on a foundation with less than half of their length, as columns on stones
    do; and pairs with a joint to a common member, unless one of the two ends at the other's face and no common member
    lies between them."""
    members = [e for e in model.elements if e.group == FRAME and e.kind != "snow"]
    if not members:
        return
    mates = defaultdict(set)
    for joint in model.joints:
        mates[joint.a].add(joint.b)
        mates[joint.b].add(joint.a)
    ruled = {frozenset(kinds) for rule in data["joints"].values() if not rule["across"] for kinds in kinds_of(rule)}
    lines = [_line(a, b, ruled) for a, b in near_pairs(members, NEAR)
             if b.name not in mates[a.name] and not (a.fixed and b.fixed)
             and _may_miss(a, b, [model.element(name) for name in sorted(mates[a.name] & mates[b.name])], ruled,
                           data["joint_search"]["min_area"])]
    if lines:
        more = f"; and {len(lines) - SHOWN} more such pairs" if len(lines) > SHOWN else ""
        warnings.warn("members face each other without a joint: " + "; ".join(lines[:SHOWN]) + more, stacklevel=3)


def _may_miss(a, b, common, ruled, min_area):
    """Whether two members face each other where a joint may be missing. common: elements that both are joined to"""
    contact = contact_polygon(a.solid, b.solid, NEAR) or facing_polygon(a.solid, b.solid, NEAR)
    if not contact or contact[2] < min_area:
        return False
    for one, other in ((a, b), (b, a)) if frozenset((a.kind, b.kind)) not in ruled else ():
        if one.kind == "foundation" and np.ptp(contact[0] @ _along(other)) < _along(other) @ _along(other) / 2:
            return False
    middle = contact[0].mean(0) + max(0.0, separation(a.solid, b.solid)) / 2 * contact[1]
    return not common or ((_ends_at(a, contact[1]) or _ends_at(b, contact[1]))
                          and not any(all(face.normal @ middle < face.offset - TOUCHING for face in element.solid.faces)
                                      for element in common))


def _along(element):
    """(3,) from end to end of a member; zero for a plate, which has no ends. [m]"""
    return np.zeros(3) if element.axis is None else element.axis[1] - element.axis[0]


def _ends_at(element, normal):
    """Whether a face with this normal is an end of a member."""
    return abs(normal @ _along(element)) > OBLIQUE * np.linalg.norm(_along(element))


def _line(a, b, ruled):
    gap = separation(a.solid, b.solid)
    apart = f"gap of {1e3 * gap:.3g} mm" if gap > TOUCHING else "touching"
    remedy = (": move them together or raise joint_search.gap" if frozenset((a.kind, b.kind)) in ruled
              else f", no rule of 'joints' for {a.kind} and {b.kind}")
    return f"{a.name} ({a.source}) and {b.name} ({b.source}), {apart}{remedy}"
