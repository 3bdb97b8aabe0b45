# SPDX-License-Identifier: GPL-2.0-or-later
"""Readings of what the paper leaves open, each as a change to the shipped houses. Needs no YADE."""
import copy
import json
from dataclasses import dataclass, field

import yaml

from .claims import loads
from ..base.atomic_write import write_text
from ..house.loader import SHIPPED, load_table


@dataclass(frozen=True)
class Reading:
    """words: what is read differently; change: entries laid over every house; houses: more entries for some, by house name."""

    words: str
    change: dict = field(default_factory=dict)
    houses: dict = field(default_factory=dict)

    def entries(self, house):
        """What is laid over that house: B's entries hold for B, B1 and B2."""
        return merged(self.change, self.houses.get(house[0], {}))


def merged(base, change):
    """`change` laid over `base`: tables entry by entry, everything else replaced as a whole."""
    result = copy.deepcopy(base)
    for key, value in change.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        result[key] = merged(result[key], value) if both else copy.deepcopy(value)
    return result


def house_options(reading, run, folder):
    """Options of scripts/house.py that do a published run under that reading; its house file is written to the folder. Raises OSError."""
    _, earthquake, snow = loads(run)
    return (write_house(reading, run, folder), "--snow", 1.0 if snow else 0.0, *(["--quake"] if earthquake else []))


def write_house(reading, run, folder):
    """House file of a published run under that reading, in the folder; returns its path. Raises OSError."""
    house, _, _ = loads(run)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"model{house}.yaml"
    entries = {"extends": str(SHIPPED / f"model{house}.yaml"), **reading.entries(house)}
    write_text(path, yaml.safe_dump(entries, sort_keys=False))
    return path


# --- changes ------------------------------------------------------------------------------------------------------------


def shipped(name="base"):
    """A shipped house file, with what it extends, as plain tables."""
    return json.loads(json.dumps(load_table(SHIPPED / f"{name}.yaml")))


def changes(reading, house):
    """Whether a reading changes that shipped house."""
    table = shipped(f"model{house}")
    return merged(table, reading.entries(house)) != table


def differs(reading):
    """Whether a reading changes any of the houses A, B, C as they are shipped."""
    return any(changes(reading, house) for house in "ABC")


def friction(timber=None, snow=None):
    """Coefficients of timber on timber and of snow on its roof; None: as shipped."""
    now = {tuple(entry["between"]): entry["coefficient"] for entry in shipped()["friction"]}
    timber, snow = timber or now["timber", "timber"], snow or now["snow", "snow"]
    pairs = {("timber", "timber"): timber, ("roofing", "timber"): min(timber, snow), ("roofing", "roofing"): snow, ("snow", "roofing"): snow, ("snow", "snow"): snow}
    return {"friction": [{"between": list(pair), "coefficient": value} for pair, value in pairs.items()]}


def layers(kinds, **entries):
    """Entries laid over the layers of these kinds in all structures."""
    changed = {}
    for name, structure in shipped()["structures"].items():
        changed[name] = {"stack": [{**layer, **entries} if layer["layer"] in kinds else layer for layer in structure["stack"]]}
    return {"structures": changed}


def beam_width(width):
    """Width of sills and beams [m]."""
    return layers(("sill", "beams"), width=width)


def joint_values(kn, strength, *types):
    """These joint types with stiffness kn = ks [N/m] and strength [N]."""
    return {"joint_types": {name: {"kn": kn, "ks": kn, "strength": strength} for name in types}}


def more_joints(*rules):
    """Joint rules beside the shipped ones."""
    return {"joints": shipped()["joints"] + list(rules)}


def inner_columns(*nodes):
    """The seven inner columns of a floor at these nodes (x, y)."""
    groups = [{**group, "at": [list(node) for node in nodes]} if "at" in group else group for group in shipped()["structures"]["main"]["columns"]]
    return {"structures": {"main": {"columns": groups}}}


def braced(main=None, entrance=None):
    """Braces of the main house and of the entrance, as in house files."""
    lines = {"main": main, "entrance": entrance}
    return {"structures": {name: {"braces": {"lines": some}} for name, some in lines.items() if some}}


def turned(name):
    """Braces of a house leaning the other way: [foot, head] -> [head, foot]."""
    lines = {part: structure["braces"].get("lines", []) for part, structure in shipped(f"model{name}")["structures"].items()}
    return braced(**{part: [{**line, "runs": [run[::-1] for run in line["runs"]]} for line in some] for part, some in lines.items()})


_ALL = {
    "shipped": Reading("the houses as shipped"),
    "joint-each": Reading("stiffness and P_max belong to each of a joint's springs", {"law": {"joint_reading": "spring"}}),
    "joint-whole": Reading("stiffness and P_max belong to the joint", {"law": {"joint_reading": "joint"}}),
    "flush-off": Reading("a vertex exactly over a border is not supported", {"law": {"flush_supports": False}}),
    "vertex-edge": Reading("vertex-edge and vertex-vertex contacts, too", {"law": {"vertex_edge_contacts": True}}),
    "increment": Reading("Hertz force in increments (Eq 38)", {"law": {"hertz": "increment"}}),
    "timber-0.3": Reading("friction timber-timber 0.3", friction(timber=0.3)),
    "timber-0.4": Reading("friction timber-timber 0.4", friction(timber=0.4)),
    "timber-0.5": Reading("friction timber-timber 0.5", friction(timber=0.5)),
    "snow-0.1": Reading("friction snow-roof 0.1: it slides off by itself", friction(snow=0.1)),
    "snow-0.3": Reading("friction snow-roof 0.3", friction(snow=0.3)),
    "snow-0.5": Reading("friction snow-roof 0.5", friction(snow=0.5)),
    "snow-1": Reading("friction snow-roof 1", friction(snow=1.0)),
    "snow-2": Reading("friction snow-roof 2: snow guards", friction(snow=2.0)),
    "plumb-0": Reading("perfectly plumb", {"plumb": {"drift": 0}}),
    "plumb-1e-3": Reading("out of plumb by 1/1000 to the north", {"plumb": {"drift": 1e-3, "towards": "north"}}),
    "plumb-1e-2": Reading("out of plumb by 1/100 to the north", {"plumb": {"drift": 1e-2, "towards": "north"}}),
    "beam-0.12": Reading("sills and beams 12 cm wide", beam_width(0.12)),
    "floor-roof-stiff": Reading("floors and roof do not come off their beams", joint_values(1e7, float("inf"), "floor_bolt", "roof_plate")),
    "floor-roof-soft": Reading("floors and roof on their beams with the corner fitting's values", joint_values(58800, 5880, "floor_bolt", "roof_plate")),
    "tie-corner": Reading("roof slabs tied with the corner fitting's values", joint_values(58800, 5880, "roof_tie")),
    "joints-x10": Reading("joints ten times as stiff and strong: not in the paper, shows what floors that lift do",
        merged(joint_values(588000, 58800, "corner_fitting"), joint_values(695800, 69580, "bracing_plate"))),
    "beams-joined": Reading("beams joined where they butt", more_joints({"between": ["beam", "beam"], "type": "corner_fitting", "kind": "beam_beam"})),
    "braces-turned": Reading("braces leaning the other way", {}, {"B": turned("B"), "C": turned("C")}),
    "braces-inwards": Reading("B's braces one bay away from the corners", {}, {"B": braced([
        {"along": "y", "at": [0, 8], "runs": [[1, 2], [8, 7]]}, {"along": "x", "at": [0, 9], "runs": [[1, 2], [7, 6]]}])}),
    "entrance-braced": Reading("B with two more braces at the entrance, 18 in all (section 4.1)", {}, {"B": braced(entrance=[
        {"along": "x", "at": [0, 1], "runs": [[2, 1]]}])}),
    "inner-columns": Reading("inner columns of A and B at other nodes", {}, dict.fromkeys("AB", inner_columns((4, 2), (4, 3), (4, 5), (4, 6), (4, 7), (2, 4), (6, 4)))),
    "damage-top": Reading("damaged joints at the columns' heads", {"damage": {"end": "top"}}),
}
READINGS = {name: reading for name, reading in _ALL.items() if name == "shipped" or differs(reading)}
"""Name -> Reading; each but 'shipped' differs from the shipped houses in one thing."""
