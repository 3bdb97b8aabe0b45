# SPDX-License-Identifier: GPL-2.0-or-later
"""A structure of single members and plates: the part `frame` of a house file. Lengths in m. Interface: grid.py.

Columns and braces belong to the storey in which their feet are, other members to the nearest level; what is higher than
the last level carries the number of storeys + 1 (columns, braces) or that of the last storey."""
from collections import Counter

import numpy as np

from .bars import LEVEL, Parts, outline
from .joints import END_JOINED
from .layout import FRAME
from .limits import MAX_ELEMENTS
from .model import Element
from .plan import floor_plan

STEP = 0.5  # least distance of levels, and of columns' feet that do not stand on one level. [m]
SLABS = ("floor", "roof")


class Frame:
    """Members, plates, and named joints: {frozenset of two names of members or copies: rule}."""

    name, margin = FRAME, 0.0

    def __init__(self, table, materials):
        self.table, self.materials = table, materials
        self.parts = Parts(table["members"], table["plates"])
        twice = table["members"].keys() & table["plates"].keys()
        if twice:
            table["plates"].refuse(min(twice), "a member has this name; choose another one")
        self.elements, self.tops = [], {}
        for name, entry in self.parts.tables.items():
            self._add(name, entry)
        for rule in table["joints"]:
            for name in rule["between"]:
                self.parts.find(name, rule, "between")
        self.named = {frozenset(f"{FRAME}.{name}" for name in rule["between"]): rule for rule in table["joints"]}
        self.levels = self._given_levels() if table["storeys"] else self._found_levels()
        feet = [foot for foot, _ in self.levels.values()]
        self.heights = dict(zip(self.levels, np.diff([*feet, self.levels[len(feet)][1]]).tolist()))
        for element in self.elements:
            element.storey = self._storey(element)
        self._require_levels()
        self.plans = {storey: self._plan(storey) for storey in self.levels}
        for element in self.elements:
            element.side = self._sides(element)

    def area(self):
        """(low, high) corners (2,) of all members in plan."""
        bounds = np.array([element.solid.bounds[:, :2] for element in self.elements])
        return [bounds[:, 0].min(0), bounds[:, 1].max(0)]

    def lay(self, snow):
        """All elements, and snow on the plates of kind roof. snow: (depth [m], material)"""
        depth, material = snow
        layers = [self._element(f"snow.{element.name.removeprefix(FRAME + '.')}", "snow",
                                np.vstack([top, top + depth * LEVEL]), material, element.source, storey=element.storey,
                                side=element.side) for element, top in self.tops.values() if depth]
        return [*self.elements, *layers]

    def further_joints(self, _elements, _joints, _data, _level):
        return []

    def _add(self, name, entry):
        copies, is_plate = self.parts[name], name in self.table["plates"]
        if len(self.elements) + len(copies) > MAX_ELEMENTS:
            entry.refuse(None, f"more than {MAX_ELEMENTS} elements; make the frame smaller")
        section = () if is_plate else tuple(np.ptp(outline(entry), axis=0).tolist())
        for number, part in enumerate(copies, 1):
            label = f"{name}.{number}" if len(copies) > 1 else name
            element = self._element(label, entry["kind"], part.vertices, entry["material"], entry.where,
                                    fixed=entry["fixed"], section=section, axis=part.axis)
            element.solid  # HouseError for a solid that is not convex
            self.elements.append(element)
            if is_plate and entry["kind"] == "roof" and entry["snow"]:
                self.tops[label] = element, part.top

    def _element(self, label, kind, vertices, material, where, **more):
        return Element(f"{FRAME}.{label}", kind, vertices, material, self.materials[material]["density"], group=FRAME,
                       source=where, **more)

    def _given_levels(self):
        storeys = self.table["storeys"]
        heights = [z for storey in storeys for z in storey]
        if any(low + STEP > high for low, high in storeys) or heights != sorted(heights):
            self.table.refuse("storeys", f"give the feet and heads of storeys from below, {STEP:g} m or more apart")
        return dict(enumerate(map(tuple, storeys), 1))

    def _found_levels(self):
        """From the lowest foot of a column to each horizontal plate; without one to the head of the lowest columns, or
        over the height of a frame without columns."""
        columns = [e for e in self.elements if e.kind == "column"]
        standing = [e.solid.bounds[:, 2] for e in columns or self.elements]
        foot = float(min(low for low, _ in standing))
        slabs = sorted(tuple(e.solid.bounds[:, 2].tolist()) for e in self.elements
                       if e.kind in SLABS and np.ptp(e.solid.bounds[:, 2]) < STEP
                       and max(e.solid.face_normals[:, 2]) > 1 - 1e-6)
        levels: dict = {}
        for low, high in slabs:
            if low - foot >= STEP:
                levels[len(levels) + 1] = foot, low
                foot = high
        return levels or {1: (foot, float(max(high for low, high in standing if low < foot + STEP)))}

    def _storey(self, element):
        low, high = element.solid.bounds[:, 2]
        heads = [head for _, head in self.levels.values()]
        if element.kind in END_JOINED:
            return next((k for k, head in enumerate(heads, 1) if low < head - STEP / 2), len(heads) + 1)
        if all(other.kind != "column" for other in self.elements):
            return max(1, int(np.argmin(np.abs(np.array(heads) - (low + high) / 2))) + 1)
        return int(np.argmin(np.abs(np.array([self.levels[1][0], *heads]) - (low + high) / 2)))

    def _require_levels(self):
        there = Counter(e.storey for e in self.elements if e.kind not in END_JOINED and not e.fixed)
        for storey, (foot, head) in self.levels.items():
            if not there[storey]:
                self.table.refuse("storeys", f"no beam, rafter, floor or roof near the head of storey {storey}"
                                  f" (z {foot:.2f} to {head:.2f} m), whose drift is reported; give other levels")

    def _plan(self, storey):
        columns = {tuple(np.round(e.solid.centroid[:2], 6).tolist()): e.name for e in self.elements
                   if e.kind == "column" and e.storey == storey}
        return floor_plan(columns, [e.solid.bounds[:, :2] for e in self.elements
                                    if e.kind in SLABS and e.storey >= storey])

    def _sides(self, element):
        """Sides of the house to which a member belongs: it lies along an outer line of columns."""
        plan = self.plans[min(max(element.storey, 1), len(self.levels))]
        if not plan.floor.any() or element.kind in SLABS:
            return frozenset()
        (west, south), (east, north) = element.solid.bounds[:, :2]
        (x0, y0), (x1, y1) = plan.bounds
        band = max(element.section)
        near = {"west": east - x0, "east": x1 - west, "south": north - y0, "north": y1 - south}
        return frozenset(side for side, distance in near.items() if distance < band)
