# SPDX-License-Identifier: GPL-2.0-or-later
"""Description -> HouseModel: structures, members, construction tolerance, joints, damage, checks."""
from collections import Counter

import numpy as np

from .check import check_house, warn_of_missing_joints
from .damage import apply_damage
from .description import require_snow_depth
from .frame import Frame
from .geometry import box
from .grid import Grid
from .joints import find_joints
from .layout import FRAME, OUTWARD
from .loads import apply_loads
from .members import require_few
from .model import Element, HouseModel
from .schema import fail
from .wall_types import has_rated_walls


def build_house(description, snow_depth=None, check=True, wall_level=None):
    """Build a described house. snow_depth [m]; wall_level: of rated walls, None: the file's. Raises HouseError."""
    data = description.data
    level = wall_level or data["law"]["wall_level"]
    depth = data["snow"]["depth"] if snow_depth is None else float(snow_depth)
    require_snow_depth(depth, "snow depth")
    structures = _structures(data)
    elements = [_ground(data, structures)]
    for structure in structures.values():
        elements += structure.lay((depth, data["snow"]["material"]))
        require_few(len(elements), structure.table.where, f"structures.{structure.name}")
    if data["plumb"]["drift"]:
        _lean(elements[1:], structures, data["plumb"])
    _number_repeats(elements)
    apply_loads(elements, structures, data["loads"])
    if depth > 0 and not any(element.kind == "snow" for element in elements):
        fail(data["snow"].at("depth"), "snow", f"{depth:g} m of snow, but no roof for it; add a roof layer without"
             " 'snow: false' or set the depth to 0")
    joints = find_joints(elements, data, {pair: rule for s in structures.values() for pair, rule in s.named.items()})
    for structure in structures.values():
        joints += structure.further_joints(elements, joints, data, level)
    apply_damage(joints, structures, data["damage"])
    model = _model(description, elements, joints, structures, depth)
    model.law["wall_level"] = level if has_rated_walls(data) else None
    if check:
        check_house(model)
        warn_of_missing_joints(model, data)
    return model


def _structures(data):
    """{name: Grid or Frame}. HouseError for a first structure without a storey: its drifts are reported."""
    structures: dict = {}
    for name, table in data["structures"].items():
        structures[name] = Grid(name, table, data["materials"], structures)
    for structure in structures.values():
        structure.require_storeys()
    if data["frame"] is not None:
        structures[FRAME] = Frame(data["frame"], data["materials"])
    main = next(iter(structures.values()))
    if not main.levels:
        main.table.refuse(None, "the first structure needs a layer of columns, as its storey drifts are reported; put a"
                          " structure with columns first")
    return structures


def _number_repeats(elements):
    """Repeated names (two beams on one line) get the suffix '.2', '.3', ...: joints refer to elements by name."""
    seen = Counter()
    for element in elements:
        seen[element.name] += 1
        if seen[element.name] > 1:
            element.name += f".{seen[element.name]}"


def _lean(elements, structures, plumb):
    """Construction tolerance: shear all above the lowest columns' feet by `drift`; faces stay flush."""
    foot = min(structure.levels[1][0] for structure in structures.values() if structure.levels)
    direction = np.array([*OUTWARD[plumb["towards"]], 0.0])
    for element in elements:
        rise = np.maximum(element.vertices[:, 2] - foot, 0.0)
        element.move(element.vertices + plumb["drift"] * rise[:, None] * direction)


def _ground(data, structures):
    """Fixed box with its top at z = 0 under the middle of the first structure."""
    ground = data["ground"]
    centre = np.mean(next(iter(structures.values())).area(), axis=0)
    half = ground["size"] / 2
    reach = max(np.abs(np.array(structure.area()) - centre).max() for structure in structures.values())
    if reach > half:
        ground.refuse("size", f"{ground['size']:g} m is smaller than the house; give at least {2 * reach:.3g} m")
    vertices = box([*(centre - half), -ground["thickness"]], [*(centre + half), 0.0])
    material = ground["material"]
    return Element("ground", "ground", vertices, material, data["materials"][material]["density"], True,
                   source=ground.where)


def _model(description, elements, joints, structures, depth):
    data, by_name, walls, plans = description.data, {element.name: element for element in elements}, {}, {}
    for s in structures.values():
        own, plans[s.name] = s.table["loads"]["wall"], {}
        walls[s.name] = data["loads"]["wall"] if own is None else own
        for storey, plan in s.plans.items():  # at mid height of the storey's columns, which may lean
            place, name = next(iter(plan.columns.items()), (None, None))
            plans[s.name][storey] = plan.moved(by_name[name].solid.centroid[:2] - place) if name else plan
    return HouseModel(data["name"], data["description"], elements, joints,
                      {k: dict(v) for k, v in data["materials"].items()},
                      [(*pair["between"], pair["coefficient"]) for pair in data["friction"]], dict(data["law"]), depth,
                      {s.name: s.levels for s in structures.values()},
                      {s.name: s.grid for s in structures.values() if isinstance(s, Grid)},
                      plans, {name: {**data["diagnosis"], "wall_load": load} for name, load in walls.items()})
