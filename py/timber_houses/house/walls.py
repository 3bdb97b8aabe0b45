# SPDX-License-Identifier: GPL-2.0-or-later
"""Sheathed walls: springs in each bay, whose shear follows the envelope and cycles of their type. Lengths in m.

A sheet is nailed to the beams above and below it and to the columns at its sides. Its drift is that of its bay. Half of
its shear H acts between the beams, horizontally; the other half between the columns, vertically: as a force H h / L,
with the bay's height h and length L, which does the same work and pulls the columns out of their joints. The half is
the factor 0.5 by which the rule for fittings of the Japanese code (Notification 1460 of 2000, N-value method) takes the
restraint of neighbouring members into account.

Each half is one spring at the middle of the bay, anchored in both members. It acts along one axis: walls have no
stiffness across their plane."""
from dataclasses import dataclass

import numpy as np

from ..base.joint_kinds import WALL_BEAM, WALL_COLUMN
from .errors import HouseError
from .layout import ACROSS
from .loads import bay_length
from .members import column_plan, line_name, nodes_on_line, require_column
from .model import JointSpec, Sheet
from .wall_types import cycles, envelope, multiplier, quasi_multiplier, steepest

SHARE = 0.5  # of a wall's shear, between beams and between columns. [-]
OPENING_SHARES = {"none": (1.0, 1.0, 1.0), "window": (0.4, 0.3, 0.2), "door": (0.2, 0.15, 0.1)}
"""Strength and stiffness over those without an opening, in bays up to 1 m, up to 2 m, and longer (strength: JBDPA,
precise diagnosis of 2004; stiffness: assumed to be the same). [-]"""
REACH = 1e-3  # beyond the ends of the columns, where beam and sill are looked for. [m]


@dataclass(frozen=True)
class Bay:
    """A bay with sheathing: its two columns (elements), walls of the house, opening and source in the house file."""

    name: str
    low: object
    high: object
    side: frozenset
    opening: str
    panel: object  # None: a bearing wall; else the share of the clear height that its panels cover [-]
    where: str

    @property
    def length(self):
        """Between the axes of the columns. [m]"""
        return bay_length(self.low, self.high)

    def multipliers(self, table):
        """(multiplier, quasi-bearing multiplier) by which the rules count a type in this bay: a bay with an opening has
        neither, one with panels the second. [-]"""
        if self.opening != "none":
            return 0.0, 0.0
        return (multiplier(table), 0.0) if self.panel is None else (0.0, quasi_multiplier(table, self.panel))

    def share(self, table):
        """Of the strength of a bearing wall of this type without an opening. [-]"""
        whole = 1.0 if self.panel is None else table["panel_share"] * self.panel
        return whole * OPENING_SHARES[self.opening][np.searchsorted((1.0, 2.0), self.length - 1e-9)]


def sheathe(structure, elements, data, level):
    """JointSpecs of a structure's walls. elements: of the house; data: of the house file; level: of rated walls."""
    members = [element for element in elements if element.group in (structure.name, "")]
    joints, seen = [], {}
    for line in structure.table["walls"]:
        names = [name for name in line["type"] if data["finishes"] or not data["wall_types"][name]["finish"]]
        for bay in _bays(structure, line, {element.name: element for element in members}):
            for name in names:
                if (bay.name, name) in seen:
                    raise HouseError(f"{bay.where}: {bay.name} has sheathing of type {name} already"
                                     f" ({seen[bay.name, name]}); remove one")
                seen[bay.name, name] = bay.where
                joints += _joints(bay, name, members, data, level)
    return joints


def _bays(structure, line, by_name):
    """Bays of a line of the house file in all its storeys and positions, between columns at its first and last node."""
    along, bays = line["along"], []
    for storey in line["storeys"] or structure.storeys:
        for at in line["at"]:
            on_line = nodes_on_line(column_plan(structure, storey), along, at)
            place = f"{structure.name}: walls along {along} at {ACROSS[along]} node {at:g}, storey {storey}"
            for key in ("from", "to"):
                require_column(on_line, line[key], f"{line.at(key)}: {place}")
            if line["from"] >= line["to"]:
                raise HouseError(f"{line.at('from')}: {structure.name}: a wall runs from {line['from']:g} to"
                                 f" {line['to']:g}; 'from' must be below 'to'")
            nodes = [node for node in on_line if line["from"] <= node <= line["to"]]
            places = [(node, at) if along == "x" else (at, node) for node in nodes]
            columns = [by_name[f"{structure.name}.column{storey}.x{x:g}y{y:g}"] for x, y in places]
            start = f"{structure.name}.wall{storey}.{line_name(along, at)}"
            bays += [Bay(f"{start}.{first:g}-{last:g}", low, high,
                         structure.outer_sides(storey, along, at, first, last), line["opening"], line["panel"],
                         line.where)
                     for first, last, low, high in zip(nodes, nodes[1:], columns, columns[1:])]
    return bays


def _joints(bay, name, members, data, level):
    """The two halves of a wall of a type; their labels end in '.plywood.beams', '.plywood.window.beams', ..."""
    parts = [bay.opening] * (bay.opening != "none") + ["panel"] * (bay.panel is not None)
    label = ".".join([bay.name, name, *parts])
    low, high = bay.low.solid, bay.high.solid
    height = float(np.diff(low.bounds[:, 2])[0])
    along = np.append((high.centroid - low.centroid)[:2], 0.0)
    below, above = (_member_at(bay, members, top) for top in (False, True))
    table = data["wall_types"][name]
    beams, columns = (_values(bay, table, level, lever, height / lever) for lever in (height, bay.length))
    common = dict(points=(low.centroid + high.centroid)[None] / 2, area=0.0, ks=0.0, per="spring",
                  storey=bay.low.storey, side=bay.side, group=bay.low.group,
                  initial_damping=data["law"]["damping_stiffness"] == "initial",
                  sheet=Sheet(bay.low.name, bay.high.name, name, bay.opening, *bay.multipliers(table)))
    return [
        JointSpec(a=below.name, b=above.name, normal=along / np.linalg.norm(along), kind=WALL_BEAM,
                  label=f"{label}.beams", **beams, **common),
        JointSpec(a=bay.low.name, b=bay.high.name, normal=np.array([0.0, 0.0, 1.0]), kind=WALL_COLUMN,
                  label=f"{label}.columns", **columns, **common),
    ]


def _values(bay, table, level, lever, ratio):
    """Law of one half. table: wall type; lever: stretch over drift [m]; ratio: force of the spring over the shear that
    it stands for [-]. The spring unloads along the steepest line of its envelope, unless its cycles are steeper."""
    part = SHARE * bay.share(table) * bay.length * ratio
    points, (cyclic, steepness) = envelope(table, level), cycles(table, level)
    scaled = tuple((lever * drift, part * shear) for drift, shear in points)
    strength = max(force for _, force in scaled)
    softening = max(stretch for stretch, force in scaled if force == strength)
    common = {"kn": steepness * steepest(scaled), "strength": strength, "envelope": scaled,
              "softening_stretch": softening, "ultimate_stretch": scaled[-1][0]}
    if table["friction_share"] is not None:
        return {**common, "law": "slip", "friction_share": table["friction_share"]}
    return {**common, "law": "wall", "cycles": cyclic.scaled(lever, part)}


def _member_at(bay, members, top):
    """The element on which the columns of a bay stand, or which lies on them, midway between them."""
    level = bay.low.solid.bounds[int(top)][2]
    ends = [column.vertices[np.abs(column.vertices[:, 2] - level) < REACH].mean(0) for column in (bay.low, bay.high)]
    point = np.mean(ends, axis=0) + [0, 0, REACH if top else -REACH]
    for element in members:
        low, high = element.solid.bounds
        if element.kind not in ("column", "brace", "snow") and (low <= point).all() and (point <= high).all():
            return element
    raise HouseError(f"{bay.where}: {bay.name}: no beam, sill or floor {'above' if top else 'below'} the wall near x"
                     f" {point[0]:.3f}, y {point[1]:.3f}, z {point[2]:.3f} m; lay one there or remove the wall")
