# SPDX-License-Identifier: GPL-2.0-or-later
"""Variants: interpretations of the paper's open choices, each as a change to the shipped houses. Needs no YADE."""
import copy
import json
from dataclasses import dataclass, field

import yaml

from .claims import parse_run
from ..base.atomic_write import write_text
from ..house.loader import SHIPPED, load_table


@dataclass(frozen=True)
class Variant:
    """description: the choice; change: entries that replace those of every house; houses: further entries by house name."""

    description: str
    change: dict = field(default_factory=dict)
    houses: dict = field(default_factory=dict)

    def entries(self, house):
        """Entries that replace those of a house; the entries for B hold for B, B1 and B2."""
        return merged(self.change, self.houses.get(house[0], {}))

    def changes(self, house):
        """Whether the variant differs from a shipped house."""
        table = shipped(f"model{house}")
        return merged(table, self.entries(house)) != table


def merged(base, change):
    """`base` with the entries of `change`: tables are merged entry by entry, other values replaced."""
    result = copy.deepcopy(base)
    for key, value in change.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        result[key] = merged(result[key], value) if both else copy.deepcopy(value)
    return result


def house_options(variant, run, folder):
    """Options of scripts/house.py for a published run of a variant; its house file is written to the folder. Raises OSError."""
    _, earthquake, snow = parse_run(run)
    return (write_house(variant, run, folder), "--snow", 1.0 if snow else 0.0, *(["--quake"] if earthquake else []))


def write_house(variant, run, folder):
    """Write the house file of a published run of a variant; returns its path. Raises OSError."""
    house, _, _ = parse_run(run)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"model{house}.yaml"
    entries = {"extends": str(SHIPPED / f"model{house}.yaml"), **variant.entries(house)}
    write_text(path, yaml.safe_dump(entries, sort_keys=False))
    return path


# --- changes ------------------------------------------------------------------------------------------------------------


def shipped(name="base"):
    """A shipped house file and the files it extends, as plain tables."""
    return json.loads(json.dumps(load_table(SHIPPED / f"{name}.yaml")))


def friction(timber=None, snow=None):
    """Friction coefficients timber-timber and snow-roof; None: as shipped."""
    now = {tuple(entry["between"]): entry["coefficient"] for entry in shipped()["friction"]}
    timber, snow = timber or now["timber", "timber"], snow or now["snow", "snow"]
    pairs = {("timber", "timber"): timber, ("roofing", "timber"): min(timber, snow), ("roofing", "roofing"): snow,
             ("snow", "roofing"): snow, ("snow", "snow"): snow}
    return {"friction": [{"between": list(pair), "coefficient": value} for pair, value in pairs.items()]}


def joint_values(kn, strength, *types):
    """Stiffness kn = ks [N/m] and strength [N] of these joint types."""
    return {"joint_types": {name: {"kn": kn, "ks": kn, "strength": strength} for name in types}}


def more_joints(*rules):
    """The shipped joint rules and further ones."""
    return {"joints": shipped()["joints"] + list(rules)}


def inner_columns(*nodes):
    """The seven inner columns of a storey at these nodes (x, y)."""
    groups = [{**group, "at": [list(node) for node in nodes]} if "at" in group else group for group in shipped()["structures"]["main"]["columns"]]
    return {"structures": {"main": {"columns": groups}}}


def braced(main=None, entrance=None):
    """Lines of braces of the main house and of the entrance, as in house files."""
    lines = {"main": main, "entrance": entrance}
    return {"structures": {name: {"braces": {"lines": some}} for name, some in lines.items() if some}}


def reversed_braces(name):
    """Braces of a house with foot and head exchanged."""
    lines = {part: structure["braces"].get("lines", []) for part, structure in shipped(f"model{name}")["structures"].items()}
    return braced(**{part: [{**line, "runs": [run[::-1] for run in line["runs"]]} for line in some] for part, some in lines.items()})


VARIANTS = {
    "shipped": Variant("the houses as shipped"),
    "joint-whole": Variant("stiffness and P_max belong to the joint, not to each spring", {"law": {"joint_reading": "joint"}}),
    "flush-off": Variant("no support for a vertex exactly above an edge", {"law": {"flush_supports": False}}),
    "timber-0.3": Variant("friction timber-timber 0.3", friction(timber=0.3)),
    "snow-2": Variant("friction snow-roof 2: snow guards", friction(snow=2.0)),
    "floor-roof-soft": Variant("floors and roof joined to their beams with the corner fitting's values", joint_values(58800, 5880, "floor_bolt", "roof_plate")),
    "joints-x10": Variant("joints ten times as stiff and strong (not in the paper): effect of uplift of the floors",
        merged(joint_values(588000, 58800, "corner_fitting"), joint_values(695800, 69580, "bracing_plate"))),
    "beams-joined": Variant("butting beams joined", more_joints({"between": ["beam", "beam"], "type": "corner_fitting", "kind": "beam_beam"})),
    "braces-turned": Variant("braces inclined the other way", houses={"B": reversed_braces("B"), "C": reversed_braces("C")}),
    "braces-inwards": Variant("B's braces one bay away from the corners", houses={"B": braced([
        {"along": "y", "at": [0, 8], "runs": [[1, 2], [8, 7]]}, {"along": "x", "at": [0, 9], "runs": [[1, 2], [7, 6]]}])}),
    "entrance-braced": Variant("B with two more braces at the entrance, 18 in all (section 4.1)", houses={"B": braced(entrance=[
        {"along": "x", "at": [0, 1], "runs": [[2, 1]]}])}),
    "inner-columns": Variant("inner columns of A and B at other nodes",
        houses=dict.fromkeys("AB", inner_columns((4, 2), (4, 3), (4, 5), (4, 6), (4, 7), (2, 4), (6, 4)))),
    "damage-top": Variant("damaged joints at the heads of the columns", {"damage": {"end": "top"}}),
}
"""Name -> Variant; each except 'shipped' differs from the shipped houses in one choice."""
