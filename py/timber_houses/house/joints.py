# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints found from the contact areas between elements: four springs at the corners of the contact area (paper, 4), or
one at its centre. A joint type has the values of one fitting, a rule the number of fittings and their share."""
from collections import Counter
from itertools import combinations, product

import numpy as np

from ..base.joint_kinds import WALL_KINDS
from .errors import HouseError
from .geometry import contact_polygon, facing_polygon, near_boxes, plane_axes, polygon_area, separation
from .layout import SLIP_KEYS
from .limits import MAX_PAIRS
from .model import JointSpec
from .schema import fail

END_JOINED = ("brace", "column")
"""Kinds of members with a joint at each end; of the two members of a joint, the first is the one that comes first here.
"""
LYING = 0.1
"""Vertical part of a contact's unit normal from which on one element lies on the other: slopes up to 84 degrees. [-]"""


def check_joint_types(types):
    """HouseError for a joint type whose keys do not fit its law."""
    for table in types.values():
        for key in SLIP_KEYS:
            if table["law"] == "slip" and table[key] is None:
                table.refuse(None, f"law slip needs '{key}'")
            if table["law"] == "brittle" and table[key] is not None:
                fail(table.at(key), table.path, f"'{key}' belongs to law slip; add 'law: slip' or remove it")
        if table["law"] == "brittle":
            continue
        if table["kn"] != table["ks"]:
            table.refuse("ks", f"law slip needs ks = kn = {table['kn']:g} N/m, got {table['ks']:g}")
        start, first, last = table["strength"] / table["kn"], table["softening_stretch"], table["ultimate_stretch"]
        if not start < first < last:
            fail(table.at("softening_stretch"), table.path, f"strength / kn = {start:g} m, softening_stretch {first:g}"
                 f" m and ultimate_stretch {last:g} m must ascend")


def kinds_of(rule):
    """[(kind a, kind b)] of a rule; a is the brace, else the column, else the first kind of the rule."""
    pairs = {frozenset((a, b)): (a, b) for a in rule["between"][0] for b in rule["between"][1]}
    return [tuple(sorted(pair, key=first)) for pair in pairs.values()]


def first(kind):
    return (*END_JOINED, kind).index(kind)


def check_joint_rules(data):
    """HouseError for two rules for the same kinds of members; for a kind of joint that only walls have, and for a
    strength that a yielding joint cannot have, also of a rule for members of the frame that are given by their names.
    """
    named = data["frame"]["joints"] if data["frame"] else ()
    for rule in (*data["joints"].values(), *named):
        table = data["joint_types"][rule["type"]]
        most = rule["number"] * rule["share"] * table["kn"] * (table["softening_stretch"] or 0.0)
        if table["law"] == "slip" and rule["strength"] is not None and not rule["strength"] < most:
            rule.refuse("strength", f"must be below number x share x kn x softening_stretch = {most:g} N with law slip,"
                        f" got {rule['strength']:g}")
        if rule["kind"] in WALL_KINDS:
            rule.refuse("kind", f"'{rule['kind']}' is the kind of the joints of sheathed walls; choose another name")
    names = {}
    for name, rule in data["joints"].items():
        for a, b in map(sorted, kinds_of(rule)):
            first = names.setdefault((a, b, rule["across"]), name)
            if first != name:
                rule.refuse(None, f"joins {a} and {b} as joints.{first} does; remove one, with null if it is inherited")


def joint_values(data, rule, part=1):
    """Entries of JointSpec, and `at`, that follow from the house file (checked) and the rule of a joint. part: of the
    rule's fittings that this joint has [-]"""
    table = data["joint_types"][rule["type"]]
    factor = rule["number"] * rule["share"] * part
    return {"at": table["at"], "type": rule["type"], "kind": rule["kind"], "law": table["law"],
            "kn": factor * table["kn"], "ks": factor * table["ks"],
            "strength": factor * table["strength"] if rule["strength"] is None else part * rule["strength"],
            "per": table["per"] or data["law"]["per"],
            "damping_ratio": data["law"]["joint_damping"] if table["damping_ratio"] is None else table["damping_ratio"],
            "initial_damping": data["law"]["damping_stiffness"] == "initial",
            **{key: table[key] for key in SLIP_KEYS}}


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
