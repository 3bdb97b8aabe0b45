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
    for name, table in types.items():
        path = f"joint_types.{name}"
        for key in SLIP_KEYS:
            if table["law"] == "slip" and table[key] is None:
                fail(table.where, path, f"law slip needs '{key}'")
            if table["law"] == "brittle" and table[key] is not None:
                fail(table.at(key), path, f"'{key}' belongs to law slip; add 'law: slip' or remove it")
        if table["law"] == "slip":
            _check_slip(table, path)


def _check_slip(table, path):
    """Yield, softening and ultimate stretch must follow each other; the slip law is isotropic."""
    if table["kn"] != table["ks"]:
        fail(table.at("ks"), f"{path}.ks", f"law slip needs ks = kn = {table['kn']:g} N/m, got {table['ks']:g}")
    start, first, last = table["strength"] / table["kn"], table["softening_stretch"], table["ultimate_stretch"]
    if not start < first < last:
        fail(table.at("softening_stretch"), path,
             f"strength / kn = {start:g} m, softening_stretch {first:g} m and ultimate_stretch {last:g} m must ascend")


def rules_by_kinds(rules):
    """{(kind a, kind b, across): (name, rule)}; a is the brace, else the column, else the first kind of the rule."""
    rules_of = {}
    for name, rule in rules.items():
        pairs = {frozenset((a, b)): (a, b) for a in rule["between"][0] for b in rule["between"][1]}
        for pair in pairs.values():
            rules_of.setdefault((*sorted(pair, key=_rank), rule["across"]), []).append((name, rule))
    return rules_of


def _rank(kind):
    return END_JOINED.index(kind) if kind in END_JOINED else len(END_JOINED)


def check_joint_rules(rules):
    """HouseError for two rules for the same kinds of members, and for a kind of joint that only walls have."""
    for name, rule in rules.items():
        if rule["kind"] in WALL_KINDS:
            fail(rule.at("kind"), f"joints.{name}.kind",
                 f"'{rule['kind']}' is the kind of the joints of sheathed walls; choose another name")
    pairs = {}
    for (a, b, across), entries in rules_by_kinds(rules).items():
        pairs.setdefault((*sorted((a, b)), across), []).extend(entries)
    for (a, b, _), entries in pairs.items():
        if len(entries) > 1:
            (first, _), (second, rule) = entries[:2]
            fail(rule.where, f"joints.{second}",
                 f"joins {a} and {b} as joints.{first} does; remove one, with null if it is inherited")


def joint_values(data, rule):
    """Entries of JointSpec that follow from the house file (checked) and the rule of a joint."""
    table = data["joint_types"][rule["type"]]
    factor = rule["number"] * rule["share"]
    return {"type": rule["type"], "kind": rule["kind"], "law": table["law"], "kn": factor * table["kn"],
            "ks": factor * table["ks"],
            "strength": factor * table["strength"] if rule["strength"] is None else rule["strength"],
            "per": table["per"] or data["law"]["joint_reading"],
            "damping_ratio": data["law"]["joint_damping"] if table["damping_ratio"] is None else table["damping_ratio"],
            **{key: table[key] for key in SLIP_KEYS}}
