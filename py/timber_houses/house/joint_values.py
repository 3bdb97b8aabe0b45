# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of joints: a joint type has those of one fitting, a rule the number of fittings and their share."""
from ..base.joint_kinds import WALL_KINDS
from .layout import SLIP_KEYS
from .schema import fail

END_JOINED = ("brace", "column")
"""Kinds of members with a joint at each end; of the two members of a joint, the first is the one that comes first here.
"""


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
