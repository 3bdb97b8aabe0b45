# SPDX-License-Identifier: GPL-2.0-or-later
"""House files of the plan of tiled_house with a given wall quantity, by the rules of the Japanese building code.

The sheets of a storey and direction are scaled by one factor, so that the existing wall quantity is `grade` times the
required one. Nothing else is changed.
"""
from house_storeys import AXES, wall_joints

from yade_timber.base.atomic_write import write_text
from yade_timber.house import build_house, changed_house, load_house
from yade_timber.house.parser import house_text
from yade_timber.house.weight import floor_area

HOUSE, STRUCTURE, MODULE = "tiled_house", "main", 0.91
"""The plan, its structure, and its module [m]."""
REQUIRED = {"light": (0.29, 0.15), "heavy": (0.33, 0.21)}
"""Length of wall of multiplier 1 per floor area, storeys 1 and 2 of a house of two storeys, light and heavy roof [m/m2]
(Enforcement Order of the Building Standard Law, Article 46, paragraph 4, table 2, as in force until March 2025)."""
LARGEST_MULTIPLIER = 5.0
"""Of sheets on one another. [-] (Article 46, paragraph 4, table 1)"""


def existing_quantity(model, wall_types, storey, direction):
    """Sum of length times multiplier over the bays without openings. [m]"""
    bays = {}
    for joint in wall_joints(model, storey, direction):
        bay, _, sheet = joint.label.removesuffix(".beams").rpartition(".")
        if sheet == joint.type:  # with an opening the label ends in its name
            bays.setdefault(bay, []).append(joint)
    return sum(bay_length(bay) * multiplier(sheets, wall_types) for bay, sheets in bays.items())


def multiplier(sheets, wall_types):
    """Of the sheets of a bay (JointSpecs) on one another. [-]"""
    return min(LARGEST_MULTIPLIER, sum(wall_types[j.type]["multiplier"] for j in sheets))


def bay_length(label):
    """From a label 'main.wall1.EW.y0.3-4'. [m]"""
    low, high = map(float, label.split(".", 4)[-1].split("-"))
    return MODULE * (high - low)


def factors(model, wall_types, grade, roof="heavy"):
    """{(storey, direction): factor on the sheets} for an existing wall quantity of `grade` times the required one."""
    return {(k, d): grade * required_quantity(model, k, roof) / existing_quantity(model, wall_types, k, d)
            for k in (1, 2) for d in AXES}


def required_quantity(model, storey, roof):
    """[m]"""
    return REQUIRED[roof][storey - 1] * floor_area(model, STRUCTURE, storey)


def listed(value):
    """A list, or one value alone, as a house file may have it."""
    return value if isinstance(value, (list, tuple)) else [value]


def graded_house(grade, level):
    """Content of the house file of a grade and level, as a dict."""
    data = changed_house(HOUSE)
    model = build_house(load_house(HOUSE))
    walls, types = [], {}
    for (storey, direction), factor in factors(model, data["wall_types"], grade).items():
        for name, table in data["wall_types"].items():
            types[f"{name}{storey}{direction}"] = {**table, "multiplier": factor * table["multiplier"]}
        for line in data["structures"][STRUCTURE]["walls"]:
            if line["along"] == "xy"[AXES[direction]] and storey in listed(line.get("storeys", (1, 2))):
                names = [f"{name}{storey}{direction}" for name in listed(line["type"])]
                walls.append({**line, "storeys": [storey], "type": names})
    data["structures"][STRUCTURE]["walls"], data["wall_types"] = walls, types
    data["law"]["wall_level"] = level
    data["name"] = f"graded_{grade:g}_{level}"
    return data


def house_file(folder, grade, level):
    """Write the house file of a grade and level. Returns its path."""
    data = graded_house(grade, level)
    path = folder / f"{data['name']}.yaml"
    about = f"# Sheets scaled to {grade:g} times the required wall quantity by scripts/validation/graded_houses.py"
    write_text(path, f"{about}\n{house_text(data)}")
    return path
