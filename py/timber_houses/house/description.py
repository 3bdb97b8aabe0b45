# SPDX-License-Identifier: GPL-2.0-or-later
"""House files as checked descriptions: merged with the files they extend, without unknown names."""
from dataclasses import dataclass
from pathlib import Path

from ..base.input_file import is_file, is_folder, shown
from ..base.remedies import nearest
from .errors import HouseError
from .joints import check_joint_rules, check_joint_types
from .layout import FRAME, HOUSE, MAX_SNOW, MAX_WOOD, MIN_SNOW
from .loader import load_table, shipped_houses, shipped_paths
from .parser import Table
from .schema import fail
from .wall_types import check_wall_types

FRICTION = 0.5  # coefficient of a material whose pair with itself is not in the file, that of the class ElementMat. [-]


@dataclass(frozen=True)
class Description:
    """A checked house description. `data`: tables and lists with file and line; lengths in m."""

    name: str
    path: Path
    data: Table

    def __repr__(self):
        return f"<Description {self.name}: {self.path}>"


def load_house(name_or_path):
    """Path of a YAML file or name of a shipped house -> Description; raises HouseError (one line, file:line)."""
    path = house_path(name_or_path)
    data = checked(load_table(path), path)
    return Description(data["name"], path, data)


def checked(table, path):
    """A house file's tables with all defaults filled in; raises HouseError."""
    data = HOUSE.check(table, f"{path.name}:1", "")
    if not data["structures"] and not (data["frame"] and data["frame"]["members"]):
        data.refuse("structures", "a house needs at least one structure, or a frame with members")
    if FRAME in data["structures"] and data["frame"]:
        fail(data["structures"].at(FRAME), "structures", f"'{FRAME}' is the name of the frame; choose another one")
    for name, known, noun, table, key in _references(data):
        if name not in known:
            table.refuse(key, f"unknown {noun} '{name}', {nearest(name, known)}")
    wood = data["materials"].get("timber")  # of all members that name no material
    if wood is not None and wood["density"] > MAX_WOOD:
        wood.refuse("density", f"must be at most {MAX_WOOD:g} kg/m3 as the density of wood, got {wood['density']:g};"
                    " give other materials another name")
    check_friction(data)
    check_joint_types(data["joint_types"])
    check_joint_rules(data)
    check_wall_types(data["wall_types"])
    require_snow_depth(data["snow"]["depth"], f"{data['snow'].at('depth')}: snow.depth")
    return data


def require_snow_depth(depth, where):
    """HouseError for a depth [m] that is neither 0 nor in [MIN_SNOW, MAX_SNOW]."""
    if not (depth == 0 or MIN_SNOW <= depth <= MAX_SNOW):
        raise HouseError(f"{where}: must be 0 or in [{MIN_SNOW:g}, {MAX_SNOW:g}] m, got {depth:g}")


def house_path(name):
    """File of a shipped house or of that path; raises HouseError."""
    own, shipped = [Path(name)], shipped_paths(str(name))
    for path in own + shipped if own[0].suffix else shipped + own:  # a file called 'A' hides no shipped house
        if is_file(path):
            return path
    if is_folder(own[0]):
        raise HouseError(f"unknown house {shown(str(name))}: is a folder; give a house file or a shipped house"
                         f" ({', '.join(shipped_houses())})")
    raise HouseError(f"unknown house {shown(str(name))}: no such regular file and no shipped house;"
                     f" {nearest(name, shipped_houses())}")


def _references(data):
    """(name, names that it may be, what it names, table, its key) of each reference."""
    structures, frame = data["structures"].values(), data["frame"] or {"members": {}, "plates": {}, "joints": ()}
    users = [data["ground"], data["snow"]]
    for structure in structures:
        users += [structure["braces"], *structure["stack"]]
    for table in (*users, *frame["members"].values(), *frame["plates"].values()):
        yield table["material"], data["materials"], "material", table, "material"
    for rule in (*data["joints"].values(), *frame["joints"]):
        yield rule["type"], data["joint_types"], "joint type", rule, "type"
    for line in (line for structure in structures for line in structure["walls"]):
        for wall in line["type"]:
            yield wall, data["wall_types"], "wall type", line, "type"
    for region in data["damage"]["regions"]:
        if region["structure"] is not None:
            known = [*data["structures"], *([FRAME] if data["frame"] else [])]
            yield region["structure"], known, "structure", region, "structure"


def own_coefficient(name, law, pairs):
    """Coefficient [-] of one material: that of its pair with itself; for snow the smallest of all its pairs. law:
    'timber' or 'snow'; pairs: [(material, material, coefficient)]"""
    alone = [c for a, b, c in pairs if a == b == name] or [FRICTION]
    return min(alone + [c for a, b, c in pairs if name in (a, b) and law == "snow"])


def check_friction(data):
    """HouseError for a pair whose coefficient is not the smaller one of its two materials, as YADE has it."""
    for entry in data["friction"]:
        for name in (name for name in entry["between"] if name not in data["materials"]):
            fail(entry.at("between"), entry.path, f"unknown material '{name}', {nearest(name, data['materials'])}")
    pairs = [(*entry["between"], entry["coefficient"]) for entry in data["friction"]]
    own = {name: own_coefficient(name, material["law"], pairs) for name, material in data["materials"].items()}
    for entry, (a, b, wanted) in zip(data["friction"], pairs):
        if wanted != min(own[a], own[b]):
            raise HouseError(f"{entry.at('coefficient')}: friction of {a} and {b} is {wanted:g}; it must be"
                             f" {min(own[a], own[b]):g}, the smaller coefficient of {a} ({own[a]:g}) and {b}"
                             f" ({own[b]:g}); change the pairs [{a}, {a}] and [{b}, {b}], too")
