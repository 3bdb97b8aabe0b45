# SPDX-License-Identifier: GPL-2.0-or-later
"""One structure of a house (main house, entrance): its grid, its position, the levels of its layers."""
from dataclasses import dataclass

import numpy as np

from .errors import HouseError
from .geometry import halfspace_vertices
from .layout import MAX_STOREYS, MIN_SPACING, PLACE
from .limits import MAX_ELEMENTS
from .model import Element
from .schema import fail

ACROSS = {"x": "y", "y": "x"}
ENDS = {"x": ("west", "east"), "y": ("south", "north")}
"""Sides of a house at the lower and at the higher end of an axis."""
OUTWARD = {"west": (-1, 0), "east": (1, 0), "south": (0, -1), "north": (0, 1)}  # horizontal unit vectors


@dataclass(frozen=True, eq=False)
class Layer:
    """One layer of the stack between z0 and z1 [m]; `storey`: number of column layers up to this one."""

    table: dict
    kind: str
    storey: int
    z0: float
    z1: float


class Structure:
    """Grid, layers and {storey: its layer of columns}; makes elements with its name and source line. grid: {'x':
    positions [m] of the nodes in the world frame, 'y': ...}; a node may be fractional, between two of them"""

    def __init__(self, name, table, materials, others):
        self.name, self.table, self.materials = name, table, materials
        local = {axis: _positions(table["grid"][axis]) for axis in "xy"}
        origin = _origin(table, local, others)
        self.grid = {axis: origin[i] + local[axis] for i, axis in enumerate("xy")}
        self.last = {axis: len(self.grid[axis]) - 1 for axis in "xy"}
        self.layers = _layers(table["stack"])
        self.storeys = {layer.storey: layer for layer in self.layers if layer.kind == "columns"}
        self.plans = {}  # {storey: FloorPlan}
        self.element_count = 0

    def position(self, axis, node):
        """Of a node along one axis. [m]"""
        return float(np.interp(node, np.arange(self.last[axis] + 1), self.grid[axis]))

    def area(self, area=None, others=(), beyond=0.0):
        """(low, high) corners (2,) [m] of a rectangle of grid nodes (None: all), extended by margin and `beyond` [m].
        An edge shared with one of the `others` (areas of the same layer) is not extended."""
        nodes = self._span(area)
        others = [self._span(other) for other in others]
        out = self.table["margin"] + beyond
        corners = []
        for edge, sign in ((0, -1), (1, 1)):
            reach = [0.0 if any(_abut(nodes, other, axis, edge) for other in others) else sign * out for axis in "xy"]
            corners.append(np.array([self.position(axis, nodes[axis][edge]) + r for axis, r in zip("xy", reach)]))
        return corners

    def _span(self, area):
        """{'x': (low, high), 'y': (low, high)} nodes of an area (None: the whole grid)."""
        if area is None:
            return {axis: (0, self.last[axis]) for axis in "xy"}
        for axis in "xy":
            self.check_nodes(axis, area[axis], area.at(axis))
            if min(area[axis]) == max(area[axis]):
                raise HouseError(f"{area.at(axis)}: {self.name}: an area from {axis} node {area[axis][0]:g} to itself"
                                 " is empty; give two different nodes")
        return {axis: (min(area[axis]), max(area[axis])) for axis in "xy"}

    def outer_sides(self, storey, along, at, start, end):
        """Side of the house of a stretch of a grid line between two nodes in a storey; empty inside the house."""
        return self.plans[storey].sides(along, self.position(ACROSS[along], at), *(
            self.position(along, node) for node in sorted((start, end))))

    def check_nodes(self, axis, nodes, where):
        """HouseError when a node lies outside the grid."""
        for node in nodes:
            if not 0 <= node <= self.last[axis]:
                raise HouseError(f"{where}: {self.name}: {axis} node {node:g} is outside the grid; give 0 to"
                                 f" {self.last[axis]}")

    def element(self, kind, name, vertices, table, where, **more):
        """Element '<structure>.<name>' of the material of `table`."""
        self.element_count += 1
        require_few(self.element_count, where, f"structures.{self.name}")
        material = table["material"]
        return Element(f"{self.name}.{name}", kind, vertices, material, self.materials[material]["density"],
                       group=self.name, source=where, **more)

    def cut(self, name, planes, where):
        """Vertices (n, 3) between `planes` (see `halfspace_vertices`) of a member; HouseError where nothing is left."""
        try:
            return halfspace_vertices(planes)
        except ValueError as problem:
            raise HouseError(f"{where}: {self.name}.{name}: no volume is left between its faces ({problem}); change its"
                             " dimensions") from None


def in_storey(lines, storey):
    """Those of the tables with a list of storeys that are in a storey; an empty list stands for all."""
    return [line for line in lines if not line["storeys"] or storey in line["storeys"]]


def require_few(count, where, name):
    """HouseError for more than MAX_ELEMENTS elements."""
    if count > MAX_ELEMENTS:
        raise HouseError(f"{where}: {name}: more than {MAX_ELEMENTS} elements; make the house smaller")


def _abut(nodes, other, axis, edge):
    """True when edge 0 (low) or 1 (high) of rectangle `nodes` lies on the facing edge of `other` over some length."""
    across = ACROSS[axis]
    shared = min(nodes[across][1], other[across][1]) - max(nodes[across][0], other[across][0])
    return nodes[axis][edge] == other[axis][1 - edge] and shared > 0


def _positions(axis):
    """Grid positions [m] relative to the structure's origin."""
    if axis["positions"] is None:
        return axis["module"] * np.arange((axis["count"] or 1) + 1)
    if axis["count"] is not None:
        axis.refuse("count", "has no effect beside positions; remove it")
    positions = np.array(axis["positions"])
    if len(positions) < 2 or (np.diff(positions) < MIN_SPACING).any():
        axis.refuse("positions", f"give at least two positions in rising order, {MIN_SPACING:g} m or more apart")
    return positions


def _origin(table, local, others):
    """World position (2,) [m] of the structure's grid origin."""
    place = table["place"]
    if place["origin"] is not None:
        for key in ("side", "align", "gap", "shift"):
            if place[key] != PLACE.fields[key].default:
                place.refuse(key, "belongs to 'beside'; change the origin instead")
        return np.array(place["origin"])
    if place["beside"] not in others:
        fail(place.at("beside"), place.path, f"no structure '{place['beside']}' before this one; known:"
             f" {', '.join(others) or 'none yet'}")
    low, high = others[place["beside"]].area()
    size = np.array([local[axis][-1] - local[axis][0] for axis in "xy"])
    start = np.array([local[axis][0] for axis in "xy"])
    out = 0 if place["side"] in ("east", "west") else 1
    margin = table["margin"]
    corner = (low + high - size) / 2
    if place["align"] != "middle":
        if (place["align"] in ("east", "west")) == (out == 0):
            place.refuse("align", f"on the {place['side']} side, align"
                         f" {' or '.join(('north', 'south') if out == 0 else ('east', 'west'))}")
        corner = high - margin - size if place["align"] in ("east", "north") else low + margin
    corner = corner + place["shift"]
    clear = place["gap"] + margin
    corner[out] = high[out] + clear if place["side"] in ("east", "north") else low[out] - clear - size[out]
    return corner - start


def _layers(stack):
    """Layers from the ground (z = 0) up; a roof adds no height because no layer lies on it."""
    layers, z, storey = [], 0.0, 0
    for table in stack:
        kind = table["layer"]
        storey += kind == "columns"
        if layers and layers[-1].kind == "roof" and kind != "roof":
            fail(table.at("layer"), table.path, "nothing can stand on a roof; make roofs the last layers")
        top = z + table.get("height", table.get("thickness"))
        if storey > MAX_STOREYS:
            fail(table.at("layer"), table.path, f"more than {MAX_STOREYS} layers of columns; remove some")
        layers.append(Layer(table, kind, storey, z, top))
        z = z if kind == "roof" else top
    return layers
