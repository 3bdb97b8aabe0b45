# SPDX-License-Identifier: GPL-2.0-or-later
"""Strengthening measures: a brace or a wall in a free bay, double fittings in a group of joints, snow cleared."""
import math
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from ...base.atomic_write import write_text
from ...house import BayName, HouseError, build_house, changed_house, free_bays, free_wall_bays, load_house
from ...house.parser import house_text
from ..batch import HouseChanges

KINDS = ("brace", "wall", "fitting", "snow")
USUAL_KINDS = ("brace", "fitting", "snow")  # without walls, which are as many as braces
SHEATHING = "plywood"  # type of the walls that are added
GROUPS = ("bay", "wall")
"""What a brace or wall measure fills: one free bay, or all free bays of a line of columns in a storey."""


@dataclass(frozen=True)
class Candidate:
    """name: of its runs; text: for people; changes of the house; options: {option: value} of its runs."""

    name: str
    text: str
    changes: HouseChanges = HouseChanges()
    options: dict = field(default_factory=dict)


AS_IT_IS = Candidate("as_it_is", "house as it is")


def candidates(house, snow, kinds=USUAL_KINDS, texts=("",), group="bay"):
    """Candidates of these kinds whose names contain one of the texts. snow [m]; group: of GROUPS. Raises HouseError."""
    description = load_house(house)
    model = build_house(description, check=False)
    bays = free_bays(description) if "brace" in kinds else []
    bays += buildable(house, free_wall_bays(description, SHEATHING)) if "wall" in kinds else []
    chosen = in_walls(model, bays) if group == "wall" else [
        Candidate(name, bay_text(model, BayName.read(name)), HouseChanges(braces=(name,))) for name in bays]
    chosen += fittings(description, model) if "fitting" in kinds else []
    if "snow" in kinds and snow > 0:
        chosen.append(Candidate("snow_cleared", "snow cleared from the roofs", options={"snow": 0.0}))
    return [candidate for candidate in chosen if any(text in candidate.name for text in texts)]


def buildable(house, names):
    """Those of the walls with which the house can be built: with a beam, sill or floor above and below."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "house.yaml"
        if _is_buildable(house, names, path):
            return names
        return [name for name in names if _is_buildable(house, [name], path)]


def _is_buildable(house, walls, path):
    try:
        write_text(path, house_text(changed_house(house, braces=walls)))
        build_house(load_house(path), check=False)
    except HouseError:
        return False
    return True


def fittings(description, model):
    """Double fittings in each group of joints that occurs and can break."""
    groups, types = description.data["joints"], description.data["joint_types"]
    kinds = {joint.kind for joint in model.joints if math.isfinite(joint.strength)}
    found = []
    for name, group in groups.items():
        if group["kind"] in kinds and math.isfinite(types[group["type"]]["strength"]):
            doubled = tuple(f"joints.{name}.{key}={2 * group[key]:g}" for key in ("number", "strength")
                            if group[key] is not None)
            found.append(Candidate(f"double_{name}", f"double fittings: {name.replace('_', ' ')}",
                                   HouseChanges(set=doubled)))
    return found


def in_walls(model, names):
    """A measure for each line of columns in a storey, 'main.brace1.EW.y0': all its free bays at once."""
    lines = {}
    for name in names:
        lines.setdefault(BayName.read(name).line, []).append(name)
    return [Candidate(line, line_text(model, BayName.read(bays[0]), len(bays)), HouseChanges(braces=tuple(bays)))
            for line, bays in lines.items()]


def bay_text(model, bay):
    """'brace: main, storey 1, south wall, 3.2 m east': place of the bay's centre; 'plywood wall: ...'."""
    along, direction = bay_ends(model, bay)["xy".index(bay.along)], {"x": "east", "y": "north"}[bay.along]
    return f"{line_text(model, bay)}, {sum(along) / 2:.1f} m {direction}"


def line_text(model, bay, bays=1):
    """'brace: main, storey 1, south wall' of a brace or wall; 'braces in 4 bays: ...' of several in one line."""
    measure, number = f"{bay.type} wall" if bay.type else "brace", f"s in {bays} bays" if bays > 1 else ""
    across = 1 if bay.along == "x" else 0
    at = bay_ends(model, bay)[across][0]
    lines = [column.solid.centroid[across] for column in model.of_kind("column", group=bay.structure)]
    low, high = ("south", "north") if bay.along == "x" else ("west", "east")
    side = (low if at < min(lines) + 0.01 else high if at > max(lines) - 0.01
            else f"inner {'E-W' if bay.along == 'x' else 'N-S'}")
    return f"{measure}{number}: {bay.structure}, storey {bay.storey}, {side} wall"


def bay_ends(model, bay):
    """((x, x), (y, y)) [m] of the centres of the columns of a bay."""
    nodes = [(node, bay.at) if bay.along == "x" else (bay.at, node) for node in (bay.start, bay.end)]
    centres = [model.element(f"{bay.structure}.column{bay.storey}.x{x:g}y{y:g}").solid.centroid for x, y in nodes]
    return [centre[0] for centre in centres], [centre[1] for centre in centres]
