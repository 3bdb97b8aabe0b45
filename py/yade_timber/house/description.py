# SPDX-License-Identifier: GPL-2.0-or-later
"""House files as checked descriptions: merged with the files they extend, without unknown names."""
from dataclasses import dataclass
from pathlib import Path

from ..base.input_file import is_file, is_folder, shown
from ..base.remedies import nearest
from .errors import HouseError
from .friction import check_friction
from .joint_values import check_joint_rules, check_joint_types
from .layout import HOUSE, MAX_SNOW, MIN_SNOW
from .loader import load_table, shipped_houses, shipped_paths
from .parser import Table
from .schema import fail
from .wall_types import check_wall_types


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
    _check_references(data)
    check_friction(data)
    check_joint_types(data["joint_types"])
    check_joint_rules(data["joints"])
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


def _check_references(data):
    """Every referenced material, joint type and structure must exist."""
    if not data["structures"]:
        fail(data.at("structures"), "structures", "a house needs at least one structure")
    for table, name in _material_users(data):
        _require_known(table, "material", data["materials"], name, "material")
    for name, rule in data["joints"].items():
        _require_known(rule, "type", data["joint_types"], f"joints.{name}", "joint type")
    for name, structure in data["structures"].items():
        for i, line in enumerate(structure["walls"]):
            for wall in line["type"]:
                if wall not in data["wall_types"]:
                    fail(line.at("type"), f"structures.{name}.walls[{i + 1}].type",
                         f"unknown wall type '{wall}', {nearest(wall, data['wall_types'])}")
    for i, region in enumerate(data["damage"]["regions"]):
        if region["structure"] is not None:
            _require_known(region, "structure", data["structures"], f"damage.regions[{i + 1}]", "structure")
    for i, pair in enumerate(data["friction"]):
        for key in pair["between"]:
            if key not in data["materials"]:
                fail(pair.at("between"), f"friction[{i + 1}]",
                     f"unknown material '{key}', {nearest(key, data['materials'])}")


def _material_users(data):
    yield data["ground"], "ground"
    yield data["snow"], "snow"
    for name, structure in data["structures"].items():
        yield structure["braces"], f"structures.{name}.braces"
        for i, layer in enumerate(structure["stack"]):
            yield layer, f"structures.{name}.stack[{i + 1}]"


def _require_known(table, key, names, path, noun):
    if table[key] not in names:
        fail(table.at(key), f"{path}.{key}", f"unknown {noun} '{table[key]}', {nearest(table[key], names)}")
