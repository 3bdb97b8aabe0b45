# SPDX-License-Identifier: GPL-2.0-or-later
"""House files of the plan of tiled_house with a given wall quantity, by Japanese rules.

The counted sheets of a storey and direction are scaled by one factor, so that the existing wall quantity is the one
that a rule requires for `grade`: 1.0, 1.25, 1.5. Nothing else is changed. Rules:
law    the building code's wall quantity times the grade
label  the quantity of grade 2 (1.25) or 3 (1.5) of the housing performance labelling, which counts all walls; the code
       presumes that others than the counted ones carry a third
"""
from house_storeys import AXES, wall_joints

from timber_houses.base.atomic_write import write_text
from timber_houses.house import build_house, changed_house, load_house
from timber_houses.house.loads import bay_length
from timber_houses.house.parser import house_text

HOUSE, STRUCTURE = "tiled_house", "main"
"""The plan and its structure."""
REQUIRED = (0.33, 0.21)
"""Length of wall of multiplier 1 per floor area, storeys 1 and 2 of a house of two storeys with a heavy roof [m/m2]
(Enforcement Order of the Building Standard Law, Article 46, paragraph 4, table 2, as in force until March 2025)."""
LABEL = {1.25: (0.58, 0.25), 1.5: (0.69, 0.30)}
"""Of a heavy roof, storeys 1 and 2, over K1 = 0.4 + 0.6 Rf and K2 = 1.3 + 0.07 / Rf with the ratio Rf of the floor
areas of storeys 2 and 1 [m/m2] (evaluation standard of the performance labelling, Notification 1347 of 2001, 5.1-1)."""
RULES = {"law": (1.0, 1.25, 1.5), "label": tuple(LABEL)}
"""{rule: its grades}"""
LARGEST_MULTIPLIER = 5.0
"""Of sheets on one another. [-] (Article 46, paragraph 4, table 1)"""


def existing_quantity(model, wall_types, storey, direction):
    """Sum of length times multiplier over the bays without openings. [m]"""
    bays = {}
    for joint in wall_joints(model, storey, direction):
        if joint.sheet.opening == "none":
            bays.setdefault((joint.sheet.low, joint.sheet.high), []).append(joint.sheet)
    return sum(bay_length(*map(model.element, bay)) * multiplier(sheets, wall_types) for bay, sheets in bays.items())


def multiplier(sheets, wall_types):
    """Of the sheets of a bay on one another. [-]"""
    return min(LARGEST_MULTIPLIER, sum(wall_types[sheet.type]["multiplier"] for sheet in sheets))


def factors(model, wall_types, grade, rule="law"):
    """{(storey, direction): factor on the sheets} for the wall quantity of a grade by a rule."""
    areas = [model.plans[STRUCTURE][k].area for k in (1, 2)]
    return {(k, d): required_share(grade, rule, areas[1] / areas[0])[k - 1] * areas[k - 1]
            / existing_quantity(model, wall_types, k, d) for k in (1, 2) for d in AXES}


def required_share(grade, rule, ratio):
    """Wall quantity over floor area, storeys 1 and 2 [m/m2]. ratio: Rf [-]"""
    if rule == "law":
        return [grade * share for share in REQUIRED]
    first, second = LABEL[grade]
    return [first * (0.4 + 0.6 * ratio), second * (1.3 + 0.07 / ratio)]


def scaled(table, factor):
    """A wall type with a multiple of its shear and its multiplier."""
    changed = {**table, "multiplier": factor * table["multiplier"]}
    if "envelope" in table:
        changed["envelope"] = [[drift, factor * shear] for drift, shear in table["envelope"]]
    return changed


def listed(value):
    """A list, or one value alone, as a house file may have it."""
    return value if isinstance(value, (list, tuple)) else [value]


def graded_house(grade, level, rule, house=HOUSE):
    """Content of the house file of a grade, level of walls and rule, as a dict. house: with the plan"""
    data = changed_house(house)
    model = build_house(load_house(house))
    walls, types = [], {}
    for (storey, direction), factor in factors(model, data["wall_types"], grade, rule).items():
        for name, table in data["wall_types"].items():
            types[f"{name}{storey}{direction}"] = scaled(table, 1.0 if table.get("finish") else factor)
        for line in data["structures"][STRUCTURE]["walls"]:
            if line["along"] == "xy"[AXES[direction]] and storey in listed(line.get("storeys", (1, 2))):
                names = [f"{name}{storey}{direction}" for name in listed(line["type"])]
                walls.append({**line, "storeys": [storey], "type": names})
    data["structures"][STRUCTURE]["walls"], data["wall_types"] = walls, types
    data["law"]["wall_level"] = level
    data["name"] = f"graded_{grade:g}_{level}"
    return data


def house_file(folder, grade, level, rule="law"):
    """Write the house file of a grade, level and rule. Returns its path."""
    data = graded_house(grade, level, rule)
    path = folder / f"{data['name']}.yaml"
    about = f"# Sheets scaled to the wall quantity of grade {grade:g} ({rule}) by scripts/validation/graded_houses.py"
    write_text(path, f"{about}\n{house_text(data)}")
    return path
