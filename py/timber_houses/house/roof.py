# SPDX-License-Identifier: GPL-2.0-or-later
"""Roof slabs and the snow on them. Lengths in m. The outline is the roof's rectangle of the grid, extended by margin
and eaves.

All slopes of a roof are equal. Each slab lies between two parallel planes and above the level of the wall plates, on
which it rests with a level face, the soffit of the eaves. Where that face would end before the plates, the eaves are
boxed: the soffit reaches over the plates, and from there the underside rises to the slab's own thickness at the ridge.
A boxed slab is hollow: it has the mass of its thickness over its sloped area. Gable: two slabs that share the ridge,
tied at the level of the plates. Hip (paper, 3.4): hips run at 45 degrees in plan; each slab is the part of the outline
nearest to its own eave. The long slopes are hexahedra; the hip ends, whose three corners are cut off, octahedra. A
square plan gives a pyramid. Mono-pitch: one slab, on the plates of its eave and on posts over those of the wall
opposite, which belong to its joints."""
from dataclasses import dataclass, replace

import numpy as np

from .errors import HouseError
from .geometry import Polyhedron, box
from .layout import ACROSS, ENDS, OUTWARD

SEAT = 0.05  # least reach of the soffit beyond the grid line: about the inner half of a wall plate. [m]
SPACING = 0.91  # of the tie beams of a gable roof along its ridge and of the posts of a mono-pitch roof, at most. [m]


@dataclass(frozen=True, eq=False)
class Plan:
    """Pitched roof: corners (2,) of the outline, eave level z, run from eave to ridge [m], rise over run, sides with an
    eave, distance of a hip end's cuts from its corners [m], vertical thickness of the slabs [m], width of the soffit
    that reaches over the plates [m]. A plane is its normal (3,) and its offset [m]."""

    low: np.ndarray
    high: np.ndarray
    eave: float
    run: float
    slope: float
    sides: tuple
    cut: float
    thickness: float
    seat: float

    def distance(self, side):
        """(d, e): a point p of the plan lies e - d . p [m] inside the eave of `side`."""
        d = np.array(OUTWARD[side], float)
        return d, max(d @ self.low, d @ self.high)

    @property
    def is_boxed(self):
        """Whether a slab between parallel planes would end before the plates, in a roof wider than these."""
        return self.thickness / self.slope < self.seat < self.run

    def rising(self, side, rise, lift=0.0):
        """Plane through the eave of `side`, moved up by `lift` [m]: rise * d . p + z <= eave + rise * e + lift."""
        d, e = self.distance(side)
        return (*(rise * d), 1.0), self.eave + rise * e + lift

    def slab(self, side):
        """Planes of a slab with a level face on the wall plates. Its underside is steeper where the eaves are boxed."""
        rise, drop = self.slope, self.thickness
        if self.is_boxed:
            rise = (self.slope * self.run - self.thickness) / (self.run - self.seat)
            drop = rise * self.seat
        return [self.rising(side, self.slope), opposite(self.rising(side, rise, -drop)), ((0, 0, -1), -self.eave),
                *self.outline(side)]

    def snow(self, side, depth):
        """Planes of snow of vertical depth [m]: the slab's outline, extruded upwards from its upper face."""
        return [self.rising(side, self.slope, depth), opposite(self.rising(side, self.slope)), self.edge(side),
                *self.outline(side)]

    def edge(self, side):
        d, e = self.distance(side)
        return (*d, 0.0), e

    def nearer(self, side, other):
        """Vertical plane between the points nearer to the eave of `side` and to that of `other`: a hip or the ridge."""
        (d, e), (d2, e2) = self.distance(side), self.distance(other)
        return (*(d2 - d), 0.0), e2 - e

    def outline(self, side):
        """Vertical planes of a slab except its own eave: ridge or hips, gables, and the three cuts of a hip end."""
        (d, e), size = self.distance(side), self.high - self.low
        across = np.abs(d[::-1])
        hip_end = len(self.sides) == 4 and np.abs(d) @ size >= size.max() - 1e-9  # all four ends of a square plan
        planes = [self.nearer(side, other) for other in self.sides
                  if other != side and not (hip_end and d @ OUTWARD[other])]
        planes += [self.edge(other) for other in OUTWARD if other not in self.sides]
        if hip_end:
            planes += [((*(-d), 0.0), self.run - self.cut - e), ((*across, 0.0), across @ self.high - self.cut),
                       ((*(-across), 0.0), -(across @ self.low) - self.cut)]
        return planes


def opposite(plane):
    normal, offset = plane
    return tuple(-v for v in normal), -offset


def outline(structure, layer):
    """Low and high corner (2,) [m] of a roof's outline; neighbouring roofs of one stack share a grid line."""
    areas = [other.table["area"] for other in structure.layers if other.kind == "roof" and other is not layer]
    return structure.area(layer.table["area"], areas, layer.table["eaves"])


def pitched_plan(structure, layer):
    """Plan of a roof that is not flat. Raises HouseError for a ridge below the eaves and for too large corner cuts."""
    table, (low, high) = layer.table, outline(structure, layer)
    size, cut = high - low, table.get("corner_cut", 0.0)
    if table["type"] == "gable":
        ridge = table["ridge"] or ("x" if size[0] > size[1] else "y")
        sides = tuple(ENDS[ACROSS[ridge]])
    else:
        sides = (table["falls"],) if table["type"] == "mono" else tuple(OUTWARD)
    run = min(np.abs(OUTWARD[side]) @ size for side in sides) / min(len(sides), 2)
    slope = table["pitch"]
    if slope is None:
        rise = table["ridge_height"] - layer.z0
        if rise <= 0:
            raise HouseError(f"{table.at('ridge_height')}: {structure.name}: "
                             f"the ridge ({table['ridge_height']:g} m) must lie above the eaves ({layer.z0:g} m)")
        slope = rise / run
    if cut >= run / 2:
        raise HouseError(f"{table.at('corner_cut')}: {structure.name}: corner_cut must be below a quarter of the"
                         f" roof's width ({run / 2:g} m), got {cut:g}")
    return Plan(low, high, layer.z0, run, slope, sides, cut, table["thickness"] * np.hypot(1.0, slope),
                table["eaves"] + structure.table["margin"] + SEAT)


def bodies(structure, layer, depth=None):
    """{side: vertices} of a roof's slabs, or of snow of vertical depth [m] on them."""
    kind, z0, z1 = ("roof", layer.z0, layer.z1) if depth is None else ("snow", layer.z1, layer.z1 + depth)
    if layer.table["type"] == "flat":
        low, high = outline(structure, layer)
        return {"": box([*low, z0], [*high, z1])}
    plan = pitched_plan(structure, layer)
    return {side: structure.cut(f"{kind}.{side}", plan.slab(side) if depth is None else plan.snow(side, depth),
                                layer.table.where) for side in plan.sides}


def lay_roof(structure, layer):
    elements = _elements(structure, layer, "roof", layer.table, bodies(structure, layer))
    plan = None if layer.table["type"] == "flat" else pitched_plan(structure, layer)
    if plan and plan.is_boxed:
        for element, vertices in zip(elements, bodies(structure, layer, 1.0).values()):  # the volume is the plan's area
            element.set_mass(element.density * plan.thickness * Polyhedron(vertices).volume)
    return elements


def lay_snow(structure, layer, depth, material):
    """Snow elements on this roof; none for `snow: false` or a depth [m] of zero."""
    if depth == 0 or not layer.table["snow"]:
        return []
    return _elements(structure, layer, "snow", {"material": material}, bodies(structure, layer, depth))


def carry_roofs(structure, elements, joints):
    """JointSpecs of posts; changes those of ridges to tie beams: the walls bear the roofs' weight and no thrust."""
    posts = []
    for layer in (layer for layer in structure.layers if layer.kind == "roof"):
        if layer.table["type"] == "gable":
            _tie_slabs(structure, layer, joints)
        elif layer.table["type"] == "mono":
            posts += _posts(structure, layer, elements, joints)
    return posts


def _tie_slabs(structure, layer, joints):
    """Move half of a ridge joint's springs down to tie beams at the level of the plates, which take the slabs' thrust.
    The ridge and each tie beam have the stiffness and strength of one fitting."""
    slabs = {f"{structure.name}.{slab_name(structure, layer, 'roof', side)}"
             for side in pitched_plan(structure, layer).sides}
    for joint in joints:
        if {joint.a, joint.b} == slabs:
            joint.points[joint.points[:, 2] < joint.centre[2], 2] = layer.z0
            for name, value in _row(joint, np.ptp(joint.points, axis=0).max()).items():
                setattr(joint, name, value)


def _row(joint, length):
    """Stiffness and strength of a row of fittings over a length [m]. joint: JointSpec with those of one"""
    number = 1 + np.ceil(length / SPACING)
    return {name: number * getattr(joint, name) for name in ("kn", "ks", "strength")}


def _posts(structure, layer, elements, joints):
    """JointSpecs of a mono-pitch slab with its high plates; a post is like one fitting of its eave."""
    side = layer.table["falls"]
    name = f"{structure.name}.{slab_name(structure, layer, 'roof', side)}"
    plates = {e.name: e for e in elements
              if e.kind == "beam" and e.group == structure.name and abs(e.solid.bounds[1][2] - layer.z0) < SEAT}
    eave = next((joint for joint in joints if name in (joint.a, joint.b) and (joint.a in plates or joint.b in plates)),
                None)
    high = _high_plates(pitched_plan(structure, layer), plates.values()) if eave else []
    if not high or {eave.a, eave.b} & {plate.name for plate, *_ in high}:
        raise HouseError(f"{layer.table.where}: {name}: a mono-pitch roof lies on the beams of its eave and stands on"
                         " posts over those of the wall opposite; add beams below both and a rule of `joints` between"
                         " roof and beam")
    return [_post_row(eave, name, *part) for part in high]


def _high_plates(plan, plates):
    """[(plate, lowest, highest x and y of its part below the plan)] of those farthest from the eave."""
    d, e = plan.distance(*plan.sides)
    bounds = [(plate, np.array(plate.solid.bounds)[:, :2]) for plate in plates]
    parts = [(plate, np.maximum(low, plan.low), np.minimum(high, plan.high)) for plate, (low, high) in bounds]
    runs = [(e - d @ (low + high) / 2, plate, low, high) for plate, low, high in parts if (high - low > SEAT).all()]
    most = max((run for run, *_ in runs), default=0.0)
    return [part for run, *part in runs if most - run < SEAT]


def _post_row(eave, slab, plate, low, high):
    """JointSpec of the posts on a part of a plate. eave: that of the slab on a plate of its eave"""
    (x0, y0), (x1, y1), z = low, high, plate.solid.bounds[1][2]
    points = np.array([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]])
    pair = {"a": slab, "b": plate.name} if eave.a == slab else {"a": plate.name, "b": slab}
    return replace(eave, **pair, points=points, area=(x1 - x0) * (y1 - y0), side=plate.side,
                   **_row(eave, max(x1 - x0, y1 - y0)))


def _elements(structure, layer, kind, table, vertices_of):
    """Elements from {side: vertices}. table: with their material"""
    return [structure.element(kind, slab_name(structure, layer, kind, side), vertices, table, layer.table.where,
                              storey=layer.storey, side=frozenset(filter(None, [side])))
            for side, vertices in vertices_of.items()]


def slab_name(structure, layer, kind, side):
    """'roof.west', or 'roof2.west' of the second roof of a structure."""
    roofs = [other for other in structure.layers if other.kind == "roof"]
    number = str(roofs.index(layer) + 1) if len(roofs) > 1 else ""
    return f"{kind}{number}" + (f".{side}" if side else "")
