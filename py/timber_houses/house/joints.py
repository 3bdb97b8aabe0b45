# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints found from the contact areas between elements: four springs at the corners of the contact area (paper, 4), or
one at its centre."""
from collections import Counter
from itertools import combinations, product

import numpy as np

from .errors import HouseError
from .geometry import contact_polygon, facing_polygon, near_boxes, plane_axes, polygon_area, separation
from .joint_values import END_JOINED, first, joint_values, kinds_of
from .limits import MAX_PAIRS
from .model import JointSpec
from .schema import fail

LYING = 0.1
"""Vertical part of a contact's unit normal from which on one element lies on the other: slopes up to 84 degrees. [-]"""


def find_joints(elements, data, named=None):
    """JointSpec for every pair of elements whose kinds match a rule of the house file, or whose names one of `named`
    {frozenset of names: rule}, and whose faces lie flush on each other, or within the gap of `joint_search` or of the
    named rule.

    Contacts below `joint_search.min_area` get none: a 12 cm column touches the beam beside its own by a strip. Joints
    of a rule at one face of an end share its fittings by their areas: a column end on two crossing beams. HouseError
    for a rule between structures, or of two named members, that joins none."""
    named = named or {}
    contacts = _contacts(elements, data, named)
    used, structures = {key for *_, key, _ in contacts}, {e.group for e in elements if e.kind != "ground"}
    for name, rule in data["joints"].items():
        if rule["across"] and len(structures) > 1 and name not in used:
            rule.refuse(None, "'across: true' joins no two structures: let their members touch, or remove the rule"
                        f" ({name}: null)")
    for pair, rule in named.items():
        if pair not in used:
            _report_apart(elements, pair, rule)
    faces = [(a.name, key, *np.round(contact[1], 3)) if _is_end(a, contact[1]) else None
             for a, _, key, contact in contacts]  # of a column's or brace's end that a rule joins
    areas = Counter()
    for face, (*_, contact) in zip(faces, contacts):
        areas[face] += contact[2]
    rules = {**data["joints"], **named}
    return [_joint(a, b, contact, joint_values(data, rules[key], contact[2] / areas[face] if face else 1))
            for face, (a, b, key, contact) in zip(faces, contacts)]


def _contacts(elements, data, named):
    """[(element, element, key of the rule, polygon, normal and area)]; the first element is the rule's first kind."""
    rules = {(*kinds, rule["across"]): name for name, rule in data["joints"].items() for kinds in kinds_of(rule)}
    search, contacts = data["joint_search"], []
    gaps = [search["gap"], *(rule["gap"] for rule in named.values())]
    for pair in near_pairs(elements, max(search["plane_tolerance"], *gaps)):
        a, b = sorted(pair, key=lambda element: first(element.kind))
        key = next(filter(named.__contains__, map(frozenset, product(_names(a), _names(b)))), None) if named else None
        if key is None:
            across = a.group != b.group
            if (a.kind, b.kind, across) not in rules:
                a, b = b, a
            key = rules.get((a.kind, b.kind, across))
        contact = key and contact_polygon(a.solid, b.solid, search["plane_tolerance"])
        gap = max(search["gap"], named[key]["gap"] if key in named else 0.0)
        if key and gap and not contact:
            contact = facing_polygon(a.solid, b.solid, gap)
        if contact and contact[2] >= search["min_area"]:
            contacts.append((a, b, key, contact))
    return contacts


def _names(element):
    """Those by which a file may mean an element of a frame: its own, and that of all copies."""
    return element.name, element.name.rpartition(".")[0]


def _report_apart(elements, pair, rule):
    """HouseError for two named members that are not joined."""
    one, other = sorted(pair) if len(pair) == 2 else 2 * sorted(pair)
    gap = min(separation(a.solid, b.solid) for a in elements for b in elements
              if a is not b and one in _names(a) and other in _names(b))
    fail(rule.at("between"), "frame.joints", f"{' and '.join(rule['between'])} have no common face; they are"
         f" {1e3 * gap:.3g} mm apart, or touch by an edge: let an end lie flush on the other member, or state a gap")


def _is_end(a, normal):
    """Whether a face of an element is that of an end. Columns of two wings have joints at their sides."""
    return a.kind in END_JOINED and (a.kind != "column" or abs(normal[2]) > LYING)


def near_pairs(elements, margin):
    """Pairs of elements with bounding boxes within `margin` [m], in order; HouseError for more than MAX_PAIRS."""
    pairs = []
    for k, near in near_boxes([element.solid for element in elements], margin):
        element = elements[k]
        pairs += [(element, elements[other]) for other in near]
        if len(pairs) > MAX_PAIRS:
            raise HouseError(f"{element.source}: {element.kind} {element.name}: more than {MAX_PAIRS} pairs of elements"
                             " touch or overlap by their bounding boxes; move members apart")
    return pairs


def _joint(a, b, contact, values):
    polygon, normal, area = contact
    values["kind"] = values["kind"] or f"{a.kind}_{b.kind}"
    points = spring_points(polygon, normal)
    if values.pop("at") == "centre":  # one spring: no rotational stiffness
        points = points.mean(0)[None]
    end = ""
    if _is_end(a, normal):
        end = "top" if points[:, 2].mean() > a.solid.centroid[2] else "bottom"
    return JointSpec(a=a.name, b=b.name, points=points, normal=normal, area=area, storey=a.storey,
                     side=a.side if a.kind in END_JOINED else a.side or b.side, end=end, group=a.group, **values)


def spring_points(polygon, normal):
    """Four spring points (4, 3) [m] of a contact polygon (n, 3), counter-clockwise about `normal`. Of more than four
    corners, the four with the largest area; of three, these and the middle of the longest side."""
    if len(polygon) == 3:
        following = np.roll(polygon, -1, 0)
        longest = int(np.argmax(np.round(np.linalg.norm(following - polygon, axis=1), 9)))
        return np.insert(polygon, longest + 1, (polygon[longest] + following[longest]) / 2, 0)
    flat = polygon @ np.array(plane_axes(normal)).T
    chosen = max(combinations(range(len(polygon)), 4), key=lambda four: round(polygon_area(flat[list(four)]), 9))
    return polygon[list(chosen)]
