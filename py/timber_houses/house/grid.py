# SPDX-License-Identifier: GPL-2.0-or-later
"""A structure of a grid and a stack of layers: its members, levels, plans, and joints of roofs and walls.

A structure of any kind (Grid, frame.Frame) has `name`, `table` with its `loads`, `margin` [m], `area()`, `levels`
{storey: (foot, head) [m]}, `heights` {storey: [m]}, `plans` {storey: FloorPlan}, `named` joints, `lay(snow)` and
`further_joints(elements, joints, data, level)`. All else, as joints, loads and damage, is the same for both."""
from dataclasses import dataclass

import numpy as np

from .errors import HouseError
from .geometry import halfspace_vertices
from .layout import ACROSS, MAX_STOREYS, MIN_SPACING, PLACE
from .members import column_plan, lay_braces, lay_columns, lay_floors, lay_strips, require_few
from .model import Element
from .plan import floor_plan
from .roof import carry_roofs, lay_roof, lay_snow
from .schema import fail
from .walls import sheathe

STRIPS = {"foundation": "foundation", "sill": "sill", "beams": "beam"}


@dataclass(frozen=True, eq=False)
class Layer:
    """One layer of the stack between z0 and z1 [m]; `storey`: number of column layers up to this one."""

    table: dict
    kind: str
    storey: int
    z0: float
    z1: float


class Grid:
    """Structure with layers, {storey: its layer of columns} and plans; makes elements with its name and source line.
    grid: {'x': positions [m] of the nodes in the world frame, 'y': ...}; a node may be fractional, between two of them
    """

    named: dict = {}  # joints given by the names of their members

    def __init__(self, name, table, materials, others):
        self.name, self.table, self.materials = name, table, materials
        local = {axis: _positions(table["grid"][axis]) for axis in "xy"}
        origin = _origin(table, local, others)
        self.grid = {axis: origin[i] + local[axis] for i, axis in enumerate("xy")}
        self.last = {axis: len(self.grid[axis]) - 1 for axis in "xy"}
        self.layers = _layers(table["stack"])
        self.storeys = {layer.storey: layer for layer in self.layers if layer.kind == "columns"}
        self.element_count = 0
        self.margin = table["margin"]
        self.levels = {storey: (layer.z0, layer.z1) for storey, layer in self.storeys.items()}
        self.heights = {storey: self._height(layer) for storey, layer in self.storeys.items()}
        self.plans = {storey: self._plan(storey) for storey in self.storeys}

    def lay(self, snow):
        """All elements. snow: (depth [m], material)"""
        elements = []
        for layer in self.layers:
            if layer.kind in STRIPS:
                elements += lay_strips(self, layer, STRIPS[layer.kind])
            elif layer.kind == "floor":
                elements += lay_floors(self, layer)
            elif layer.kind == "columns":
                elements += lay_columns(self, layer) + lay_braces(self, layer)
            else:
                elements += lay_roof(self, layer) + lay_snow(self, layer, *snow)
        return elements

    def further_joints(self, elements, joints, data, level):
        """JointSpecs of roofs and walls; changes those of ridges. level: of rated walls"""
        return [*carry_roofs(self, elements, joints), *sheathe(self, elements, data, level)]

    def _height(self, storey):
        """From the foot of a storey's columns to that of the next storey, or to the roof. [m]"""
        above = self.layers[self.layers.index(storey) + 1:]
        top = next((layer.z0 for layer in above if layer.kind in ("columns", "roof")),
                   above[-1].z1 if above else storey.z1)
        return top - storey.z0

    def _plan(self, storey):
        columns = {(self.position("x", x), self.position("y", y)): f"{self.name}.column{storey}.x{x:g}y{y:g}"
                   for x, y in column_plan(self, storey)}
        areas = []  # of the slabs above
        for layer in (layer for layer in self.layers if layer.storey >= storey):
            areas += (layer.table["areas"] or [None] if layer.kind == "floor"
                      else [layer.table["area"]] if layer.kind == "roof" else [])
        return floor_plan(columns, [self.area(area, beyond=-self.margin) for area in areas])

    def require_storeys(self):
        """HouseError for a storey of columns, braces or walls that the stack does not have."""
        table, storeys = self.table, list(self.storeys)
        if table["columns"] and not storeys:
            raise HouseError(f"{table.at('columns')}: structures.{self.name}.columns: its stack has no layer of"
                             " columns; add one or remove the columns")
        for part, line in [*((f"columns[{i}]", group) for i, group in enumerate(table["columns"], 1)),
                           *(("braces", line) for line in table["braces"]["lines"]),
                           *(("walls", line) for line in table["walls"])]:
            absent = [storey for storey in line["storeys"] if storey not in storeys]
            if absent:
                raise HouseError(f"{line.at('storeys')}: {self.name}: {part}: no storey {absent[0]}; the stack has"
                                 f" {storeys}")

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
