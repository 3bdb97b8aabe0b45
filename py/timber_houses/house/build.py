# SPDX-License-Identifier: GPL-2.0-or-later
"""Description -> HouseModel: structures, members, construction tolerance, joints, damage, checks."""
from collections import Counter

import numpy as np

from .braces import lay_braces
from .check import check_house
from .damage import apply_damage
from .description import require_snow_depth
from .errors import HouseError
from .geometry import box
from .joints import find_joints
from .loads import apply_loads
from .members import column_plan, lay_columns, lay_floors, lay_strips
from .model import Element, HouseModel
from .plan import plan_of
from .roof import carry_roofs, lay_roof, lay_snow
from .structure import OUTWARD, Structure, require_few
from .wall_types import has_rated_walls
from .walls import sheathe

STRIPS = {"foundation": "foundation", "sill": "sill", "beams": "beam"}


def build_house(description, snow_depth=None, check=True, wall_level=None):
    """Build a described house. snow_depth [m]; wall_level: of rated walls, None: the file's. Raises HouseError."""
    data = description.data
    level = wall_level or data["law"]["wall_level"]
    depth = data["snow"]["depth"] if snow_depth is None else float(snow_depth)
    require_snow_depth(depth, "snow depth")
    structures = {}
    for name, table in data["structures"].items():
        structure = structures[name] = Structure(name, table, data["materials"], structures)
        structure.plans = {storey: plan_of(structure, storey) for storey in structure.storeys}
    _require_storeys(structures)
    elements = [_ground(data, structures)]
    for structure in structures.values():
        for layer in structure.layers:
            elements += _layer_elements(structure, layer, depth, data["snow"]["material"])
        require_few(len(elements), structure.table.where, f"structures.{structure.name}")
    if data["plumb"]["drift"]:
        _lean(elements[1:], structures, data["plumb"])
    _number_repeats(elements)
    apply_loads(elements, structures, data["loads"])
    _check_snow(data, elements, depth)
    joints = find_joints(elements, description)
    for structure in structures.values():
        carry_roofs(structure, elements, joints)
        joints += sheathe(structure, elements, data, level)
    apply_damage(joints, structures, data["damage"])
    model = _model(description, elements, joints, structures, depth)
    model.law["wall_level"] = level if has_rated_walls(data) else None
    if check:
        check_house(model)
    return model


def _require_storeys(structures):
    """HouseError for a storey that the stack does not have, and for a first structure without a storey: its drifts are
    reported."""
    for name, structure in structures.items():
        table, storeys = structure.table, list(structure.storeys)
        if table["columns"] and not storeys:
            raise HouseError(f"{table.at('columns')}: structures.{name}.columns: its stack has no layer of columns; add"
                             " one or remove the columns")
        for part, line in [*((f"columns[{i}]", group) for i, group in enumerate(table["columns"], 1)),
                           *(("braces", line) for line in table["braces"]["lines"]),
                           *(("walls", line) for line in table["walls"])]:
            absent = [storey for storey in line["storeys"] if storey not in storeys]
            if absent:
                raise HouseError(f"{line.at('storeys')}: {name}: {part}: no storey {absent[0]}; the stack has"
                                 f" {storeys}")
    name, main = next(iter(structures.items()))
    if not main.storeys:
        raise HouseError(f"{main.table.where}: structures.{name}: the first structure needs a layer of columns, as its"
                         " storey drifts are reported; put a structure with columns first")


def _check_snow(data, elements, depth):
    if depth > 0 and not any(element.kind == "snow" for element in elements):
        raise HouseError(f"{data['snow'].at('depth')}: snow: {depth:g} m of snow, but no roof for it; "
                         f"add a roof layer without 'snow: false' or set the depth to 0")


def _number_repeats(elements):
    """Repeated names (two beams on one line) get the suffix '.2', '.3', ...: joints refer to elements by name."""
    seen = Counter()
    for element in elements:
        seen[element.name] += 1
        if seen[element.name] > 1:
            element.name += f".{seen[element.name]}"


def _layer_elements(structure, layer, depth, snow_material):
    if layer.kind in STRIPS:
        return lay_strips(structure, layer, STRIPS[layer.kind])
    if layer.kind == "floor":
        return lay_floors(structure, layer)
    if layer.kind == "columns":
        return lay_columns(structure, layer) + lay_braces(structure, layer)
    return lay_roof(structure, layer) + lay_snow(structure, layer, depth, snow_material)


def _lean(elements, structures, plumb):
    """Construction tolerance: shear all above the lowest columns' feet by `drift`; faces stay flush."""
    foot = min(structure.storeys[1].z0 for structure in structures.values() if structure.storeys)
    direction = np.array([*OUTWARD[plumb["towards"]], 0.0])
    for element in elements:
        rise = np.maximum(element.vertices[:, 2] - foot, 0.0)
        element.move(element.vertices + plumb["drift"] * rise[:, None] * direction)


def _plans(elements, structure):
    """{storey: FloorPlan} at mid height of the storey's columns, which may lean."""
    plans = {}
    for storey, plan in structure.plans.items():
        column = next((e for e in elements if e.kind == "column" and e.group == structure.name
                       and e.storey == storey), None)
        node = next(iter(column_plan(structure, storey)), None)
        at = [structure.position(axis, n) for axis, n in zip("xy", node or ())]
        plans[storey] = plan.moved(column.solid.centroid[:2] - at) if column else plan
    return plans


def _ground(data, structures):
    """Fixed box with its top at z = 0 under the middle of the first structure."""
    ground = data["ground"]
    centre = np.mean(next(iter(structures.values())).area(), axis=0)
    half = ground["size"] / 2
    reach = max(np.abs(np.array(structure.area()) - centre).max() for structure in structures.values())
    if reach > half:
        raise HouseError(f"{ground.at('size')}: ground.size: {ground['size']:g} m is smaller than the house; give at"
                         f" least {2 * reach:.3g} m")
    vertices = box([*(centre - half), -ground["thickness"]], [*(centre + half), 0.0])
    material = ground["material"]
    return Element("ground", "ground", vertices, material, data["materials"][material]["density"], True,
                   source=ground.where)


def _model(description, elements, joints, structures, depth):
    data = description.data
    levels = {s.name: {storey: (layer.z0, layer.z1) for storey, layer in s.storeys.items()}
              for s in structures.values()}
    grids = {s.name: s.grid for s in structures.values()}
    return HouseModel(data["name"], data["description"], elements, joints,
                      {k: dict(v) for k, v in data["materials"].items()},
                      [(*pair["between"], pair["coefficient"]) for pair in data["friction"]], dict(data["law"]), depth,
                      levels, grids, {s.name: _plans(elements, s) for s in structures.values()},
                      {s.name: {**data["diagnosis"], "wall_load": _own(s, data, "wall")} for s in structures.values()})


def _own(structure, data, key):
    """A load of a structure: its own, or the house's."""
    return data["loads"][key] if structure.table["loads"][key] is None else structure.table["loads"][key]
