# SPDX-License-Identifier: GPL-2.0-or-later
"""A structure of a grid and a stack of layers: its members, levels, plans, and joints of roofs and walls.

A structure of any kind (Grid, frame.Frame) has `name`, `table` with its `loads`, `margin` [m], `area()`, `levels`
{storey: (foot, head) [m]}, `heights` {storey: [m]}, `plans` {storey: FloorPlan}, `named` joints, `lay(snow)` and
`further_joints(elements, joints, data, level)`. All else, as joints, loads and damage, is the same for both."""
from .braces import lay_braces
from .errors import HouseError
from .members import column_plan, lay_columns, lay_floors, lay_strips
from .plan import floor_plan
from .roof import carry_roofs, lay_roof, lay_snow
from .structure import Structure
from .walls import sheathe

STRIPS = {"foundation": "foundation", "sill": "sill", "beams": "beam"}


class Grid(Structure):
    """Structure with plans and members."""

    named: dict = {}  # joints given by the names of their members

    def __init__(self, name, table, materials, others):
        super().__init__(name, table, materials, others)
        self.margin = table["margin"]
        self.levels = {storey: (layer.z0, layer.z1) for storey, layer in self.storeys.items()}
        self.heights = {storey: self._height(layer) for storey, layer in self.storeys.items()}
        self.plans |= {storey: self._plan(storey) for storey in self.storeys}

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
