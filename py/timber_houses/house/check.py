# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of a built house: no overlap, joints at both ends of columns and braces, every element supported; and a
warning of members of a frame that face each other without a joint, as they may be meant to."""
import warnings
from collections import defaultdict

import numpy as np

from .bars import OBLIQUE
from .errors import HouseError
from .geometry import contact_polygon, facing_polygon, separation
from .joints import END_JOINED, LYING, kinds_of, near_pairs
from .layout import FRAME

TOUCH = 1e-7  # [m] overlaps up to this count as flush; rounding in the builder stays below 1e-9
NEAR = 0.02  # distance up to which two faces may be meant to touch. [m]
SHOWN = 3  # pairs that a warning names


def check_house(model):
    """HouseError for the deepest overlap, a loose end of a column or brace, or an unsupported element. Returns the
    numbers of near and of touching pairs, and the deepest overlap [m], from rounding."""
    gaps = overlaps(model)
    deepest = min(gaps, key=lambda row: row[2], default=None)
    if deepest and deepest[2] < -TOUCH:
        a, b, gap = deepest
        _report_overlap(a, b, gap, sum(gap < -TOUCH for _, _, gap in gaps))
    touching = [(a, b) for a, b, gap in gaps if gap < TOUCH]
    _check_ends(model, touching)
    _check_supports(model, touching)
    return {"pairs": len(gaps), "touching": len(touching),
            "deepest": max(0.0, -min((g for *_, g in gaps), default=0.0))}


def overlaps(model):
    """[(element, element, gap [m])] of pairs whose bounding boxes touch; a negative gap is an overlap (exact)."""
    return [(a, b, separation(a.solid, b.solid)) for a, b in near_pairs(model.elements, TOUCH)]


def _report_overlap(a, b, gap, count):
    low = np.maximum(a.solid.bounds[0], b.solid.bounds[0])
    high = np.minimum(a.solid.bounds[1], b.solid.bounds[1])
    x, y, z = (low + high) / 2
    strips = {a.kind, b.kind} <= {"foundation", "sill", "beam"}
    remedy = "move or shorten one of them" + ", or give one of the lines cut: true where they meet" * strips
    if b.axis is not None:
        remedy = f"end one at the other (to: {{of: ...}}) or cut it (cuts: [{{by: {a.name.partition('.')[2]}}}])"
    more = f" (and {count - 1} more such pairs)" if count > 1 else ""
    raise HouseError(f"{b.source}: {b.kind} {b.name} overlaps {a.kind} {a.name} ({a.source}) by {-gap * 1000:.3g} mm "
                     f"near x {x:.3f}, y {y:.3f}, z {z:.3f} m; {remedy}{more}")


def _check_ends(model, touching):
    """Each column and brace of a grid needs a joint on a level face at its foot and one at its head; in a frame, a
    column needs a joint or support at its foot, a brace a joint at either end."""
    jointed = {(joint.a, joint.end) for joint in model.joints if abs(joint.normal[2]) > LYING}
    near = _joined_halves(model)
    for member in model.of_kind(*END_JOINED):
        is_single = member.axis is not None
        for end in ("bottom", "top") if member.kind == "brace" or not is_single else ("bottom",):
            if (member.name, end) not in (near if is_single else jointed) and not (
                    member.kind == "column" and is_single and _lying_at(member, end, touching)):
                _report_loose_end(member, end, touching)


def _joined_halves(model):
    """{(name of a member of a frame, 'top' or 'bottom' half in which it has a joint)}"""
    halves = set()
    for joint in (joint for joint in model.joints if joint.sheet is None):
        for member in map(model.element, (joint.a, joint.b)):
            if member.axis is not None:
                low, high = sorted(member.axis, key=lambda end: end[2])
                is_top = (joint.centre - (low + high) / 2) @ (high - low) > 0
                halves.add((member.name, "top" if is_top else "bottom"))
    return halves


def _report_loose_end(member, end, touching):
    x, y, _ = member.solid.centroid
    z = member.solid.bounds[0 if end == "bottom" else 1][2]
    place, where = f"{member.source}: {member.kind} {member.name}", f"x {x:.3f}, y {y:.3f}, z {z:.3f} m"
    for mate, area in _lying_at(member, end, touching):
        raise HouseError(f"{place} has no joint at its {end}, where a contact area of {1e4 * area:.3g} cm2 touches"
                         f" {mate.kind} {mate.name} at {where}; add a rule for {member.kind} and {mate.kind} to"
                         " 'joints', or enlarge the contact area (joint_search.min_area)")
    if member.axis is not None:
        raise HouseError(f"{place} {'stands on nothing' if end == 'bottom' else 'ends at nothing'} at {where}; let it"
                         " end at a member (from: {of: ...}), and see that a rule of 'joints' joins the two kinds")
    verb = "stands on nothing" if end == "bottom" else "supports nothing"
    raise HouseError(f"{place} {verb} at {where}; lay a beam, sill or floor there or remove the {member.kind}")


def _lying_at(member, end, touching):
    """[(element, common area [m2])] that the level face at one end of a member lies on."""
    mates = [b if a is member else a for a, b in touching if member in (a, b)]
    contacts = [(mate, contact_polygon(member.solid, mate.solid, TOUCH)) for mate in mates]
    return [(mate, contact[2]) for mate, contact in contacts
            if contact and (contact[1][2] < -LYING if end == "bottom" else contact[1][2] > LYING)]


def _check_supports(model, touching):
    """Each element must be connected to a fixed one by joints or by lying on supported elements."""
    supports = {element.name: set() for element in model.elements}  # name -> names of the elements that it supports
    for joint in (joint for joint in model.joints if joint.sheet is None):
        supports[joint.a].add(joint.b)
        supports[joint.b].add(joint.a)
    for a, b in touching:
        contact = (None if b.name in supports[a.name] or a.fixed and b.fixed
                   else contact_polygon(a.solid, b.solid, TOUCH))
        if contact and abs(contact[1][2]) > LYING:
            lower, upper = (a, b) if contact[1][2] > 0 else (b, a)
            supports[lower.name].add(upper.name)
    todo = [element.name for element in model.elements if element.fixed]
    supported = set(todo)
    while todo:
        new = supports[todo.pop()] - supported
        supported |= new
        todo += new
    loose = [element for element in model.elements if element.name not in supported]
    if not loose:
        return
    element = min(loose, key=lambda element: element.solid.bounds[0][2])
    x, y, _ = element.solid.centroid
    more = f" (and {len(loose) - 1} more elements)" if len(loose) > 1 else ""
    raise HouseError(f"{element.source}: {element.kind} {element.name} is unsupported near x {x:.3f}, y {y:.3f}, z"
                     f" {element.solid.bounds[0][2]:.3f} m: it lies on no element and has no joint; support it, join it"
                     f" (a rule in 'joints') or remove it{more}{_close_by(model, element)}")


def _close_by(model, element):
    """Of a member of a frame: which other member is nearly at it, and the remedy; else empty."""
    if element.axis is None:
        return ""
    gaps = [(separation(element.solid, other.solid), other) for other in model.elements if other is not element]
    near = [row for row in gaps if TOUCH < row[0] <= NEAR]
    if not near:
        return ""
    gap, other = min(near, key=lambda row: row[0])
    return (f"; {other.kind} {other.name} ({other.source}) is {1e3 * gap:.3g} mm from it: move them together or give"
            " joint_search.gap")


# --- missing joints ---------------------------------------------------------------------------------------------------


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
    lines = [_unjoined(a, b, ruled) for a, b in near_pairs(members, NEAR)
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
                          and not any(all(face.normal @ middle < face.offset - TOUCH for face in element.solid.faces)
                                      for element in common))


def _along(element):
    """(3,) from end to end of a member; zero for a plate, which has no ends. [m]"""
    return np.zeros(3) if element.axis is None else element.axis[1] - element.axis[0]


def _ends_at(element, normal):
    """Whether a face with this normal is an end of a member."""
    return abs(normal @ _along(element)) > OBLIQUE * np.linalg.norm(_along(element))


def _unjoined(a, b, ruled):
    gap = separation(a.solid, b.solid)
    apart = f"gap of {1e3 * gap:.3g} mm" if gap > TOUCH else "touching"
    remedy = (": move them together or raise joint_search.gap" if frozenset((a.kind, b.kind)) in ruled
              else f", no rule of 'joints' for {a.kind} and {b.kind}")
    return f"{a.name} ({a.source}) and {b.name} ({b.source}), {apart}{remedy}"
