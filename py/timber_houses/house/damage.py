# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints broken from the start, selected by side, storey, kind and end."""
import numpy as np

from .schema import fail

KINDS = ("column_beam", "brace_beam")


def apply_damage(joints, structures, damage):
    """Mark joints as broken. A region breaks `count` joints of a kind on one wall and storey, at one end: those nearest
    to the middle of the wall, the southern or western one first."""
    for region in damage["regions"]:
        structure = structures[region["structure"] or next(iter(structures))]
        if not any(region[kind] for kind in KINDS):
            region.refuse(None, f"give {' or '.join(KINDS)}: the joints to be broken")
        for kind in KINDS:
            if region[kind] is not None:
                _break(joints, structure, region, kind, damage["end"])
    if damage["plate"] == "whole":  # one plate joins a brace's end to beam and column
        torn = {(joint.a, joint.end) for joint in joints if joint.kind == "brace_beam" and joint.broken}
        for joint in joints:
            joint.broken |= joint.kind == "brace_column" and (joint.a, joint.end) in torn


def _break(joints, structure, region, kind, default_end):
    wanted, side, storey = region[kind], region["side"], region["storey"]
    end = wanted["end"] or default_end
    candidates = [j for j in joints if j.group == structure.name and j.kind == kind and j.storey == storey
                  and side in j.side and j.end == end and not j.broken]
    if not candidates:
        fail(wanted.at("count"), wanted.path, f"the {side} side of {structure.name} has no such whole joint at the"
             f" {end} of storey {storey}: sides are those of the outline of its floor")
    if wanted["count"] > len(candidates):
        fail(wanted.at("count"), wanted.path, f"{wanted['count']} joints are to be broken, but the {side} wall of"
             f" {structure.name} has {len(candidates)} whole ones at the {end} of storey {storey}; lower the count")
    along = 1 if side in ("east", "west") else 0
    middle = np.mean(structure.area(), axis=0)[along]
    candidates.sort(key=lambda j: (round(abs(j.centre[along] - middle), 9), j.centre[along]))
    for joint in candidates[: wanted["count"]]:
        joint.broken = True
