# SPDX-License-Identifier: GPL-2.0-or-later
"""Weight of a house by storey, for summaries and drawings. Fixed members (foundations, anchored sills) do not count."""
from collections import Counter

from ..base.gravity import weight_of

HALVED = ("column", "brace")
"""Kinds of members of which one half belongs to the level above and one to the level below."""


def weigh(model):
    """Weights of a HouseModel [kN].

    total_kn                of all members that can move, without snow
    snow_kn                 of the snow
    floor_area_m2           sum over the storeys of the floor between the axes of the outer columns (plan.py)
    per_floor_area_kn_m2    total over floor area
    storeys                 {structure: {storey: {level_kn, carried_kn}}}: of the level at its top, with half the
    columns and walls below and
                            above; of this level and all higher ones, the weight that drives the storey's shear. Without
                            snow."""
    area = sum(model.plans[group][storey].area for group, storeys in model.storey_levels.items() for storey in storeys)
    total = weight_of(sum(e.mass for e in model.elements if not e.fixed and e.kind != "snow"))
    return {"total_kn": round(total, 3), "snow_kn": round(weight_of(sum(e.mass for e in model.of_kind("snow"))), 3),
            "floor_area_m2": round(area, 3), "per_floor_area_kn_m2": round(total / area, 3) if area > 0 else None,
            "storeys": {group: _storeys(model, group) for group, storeys in model.storey_levels.items() if storeys}}


def level_masses(model, group, without=None):
    """Masses of the levels of a structure from below. [kg] without: a kind of elements"""
    members = [e for e in model.elements if e.group == group and not e.fixed and e.kind != without]
    levels = model.storey_levels[group]
    return [sum(_share(e, storey, max(levels)) * e.mass for e in members) for storey in sorted(levels)]


def _storeys(model, group):
    levels, carried = {}, 0.0
    masses = zip(sorted(model.storey_levels[group]), level_masses(model, group, "snow"))
    for storey, mass in reversed(list(masses)):
        level = weight_of(mass)
        carried += level
        levels[str(storey)] = {"level_kn": round(level, 3), "carried_kn": round(carried, 3)}
    return dict(reversed(levels.items()))


def _share(element, storey, last):
    """Part of a member that belongs to the level at the top of a storey, that of the last one with all above it."""
    if element.kind in HALVED and element.storey > last:
        return 1.0 if storey == last else 0.0
    if element.kind in HALVED:
        return 0.5 if element.storey in (storey, storey + 1) else 0.0
    return 1.0 if element.storey == storey else 0.0


def sentence(weights):
    """'weighs 83 kN, 0.70 kN per m2 of floor; carried by storey 1 70 kN, storey 2 28 kN', sums over the structures."""
    per_area = ("" if weights["per_floor_area_kn_m2"] is None
                else f", {weights['per_floor_area_kn_m2']:.2f} kN per m2 of floor")
    storeys = Counter()
    for structure in weights["storeys"].values():
        storeys.update({name: values["carried_kn"] for name, values in structure.items()})
    carried = ", ".join(f"storey {name} {load:.0f} kN" for name, load in sorted(storeys.items()))
    return f"weighs {weights['total_kn']:.0f} kN{per_area}; carried by {carried}"
