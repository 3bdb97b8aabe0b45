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
opposite, which belong to its joints.
"""
from dataclasses import dataclass, replace

import numpy as np

from .errors import HouseError
from .geometry import Polyhedron, box

SEAT = 0.05
"""Least reach of the soffit beyond the grid line: about the inner half of a wall plate. [m]"""
SPACING = 0.91
"""Of the tie beams of a gable roof along its ridge and of the posts of a mono-pitch roof, at most. [m]"""
OUTWARD = {"west": (-1, 0), "east": (1, 0), "south": (0, -1), "north": (0, 1)}


@dataclass(frozen=True, eq=False)
class Plan:
    """Pitched roof: corners (2,) of the outline, eave level z, run from eave to ridge [m], rise over run."""

    low: np.ndarray
    high: np.ndarray
    eave: float
    half: float
    slope: float

    def distance(self, side):
        """(d, e): a point p of the plan lies e - d . p [m] inside the eave of `side`."""
        d = np.array(OUTWARD[side], float)
        return d, max(d @ self.low, d @ self.high)

    def bottom(self, side, rise, drop):
        """Plane of the slab's underside: rises by `rise` [-], lies `drop` [m] below the parallel plane at the eave."""
        d, e = self.distance(side)
        return (*(-rise * d), -1.0), -(self.eave + rise * e - drop)

    def edge(self, side):
        """Vertical plane above the eave of `side`."""
        d, e = self.distance(side)
        return (*d, 0.0), e

    def top(self, side):
        """Plane of the slab's upper face: slope * d . p + z <= eave + slope * e."""
        d, e = self.distance(side)
        return (*(self.slope * d), 1.0), self.eave + self.slope * e

    def nearer(self, side, other):
        """Vertical plane between the points nearer to the eave of `side` and to that of `other`: a hip or the ridge."""
        (d, e), (d2, e2) = self.distance(side), self.distance(other)
        return (*(d2 - d), 0.0), e2 - e


@dataclass(frozen=True, eq=False)
class GablePlan(Plan):
    """Two slopes; the ridge runs along `ridge`, 'x' or 'y'."""

    ridge: str

    @property
    def sides(self):
        return ("west", "east") if self.ridge == "y" else ("south", "north")

    def outline(self, side):
        """Vertical planes of a slab except its own eave: the ridge and the two gables."""
        gables = [self.edge(other) for other in OUTWARD if other not in self.sides]
        return [self.nearer(side, next(other for other in self.sides if other != side)), *gables]


@dataclass(frozen=True, eq=False)
class HipPlan(Plan):
    """Four slopes. cut: distance of the hip ends' cuts from their corners [m]."""

    cut: float
    sides = tuple(OUTWARD)

    def outline(self, side):
        """Vertical planes of a slab except its own eave: hips, ridge, and the three corner cuts of a hip end."""
        opposite = next(other for other in OUTWARD if OUTWARD[other] == tuple(-np.array(OUTWARD[side])))
        length = np.abs(np.array(OUTWARD[side])) @ (self.high - self.low)
        hip_end = length >= (self.high - self.low).max() - 1e-9  # across the ridge; all four of a square plan
        planes = [self.nearer(side, other) for other in OUTWARD
                  if other != side and not (hip_end and other == opposite)]
        return planes + (self._corner_cuts(side) if hip_end else [])

    def _corner_cuts(self, side):
        d, e = self.distance(side)
        t = np.abs(d[::-1])
        apex = ((*(-d), 0.0), self.half - self.cut - e)
        return [apex, ((*t, 0.0), t @ self.high - self.cut), ((*(-t), 0.0), -(t @ self.low) - self.cut)]


@dataclass(frozen=True, eq=False)
class MonoPlan(Plan):
    """One slope, which falls to the only one of `sides`; half is its whole run."""

    sides: tuple

    def outline(self, _side):
        """Vertical planes of the slab except its own eave."""
        return [self.edge(other) for other in OUTWARD if other not in self.sides]


def outline(structure, layer):
    """Low and high corner (2,) [m] of a roof's outline; neighbouring roofs of one stack share a grid line."""
    areas = [other.table["area"] for other in structure.layers if other.kind == "roof" and other is not layer]
    return structure.area(layer.table["area"], areas, layer.table["eaves"])


def gable_plan(structure, layer):
    low, high = outline(structure, layer)
    ridge = layer.table["ridge"] or ("x" if high[0] - low[0] > high[1] - low[1] else "y")
    half = (high - low)[0 if ridge == "y" else 1] / 2
    return GablePlan(low, high, layer.z0, half, slope(structure, layer, half), ridge)


def hip_plan(structure, layer):
    low, high = outline(structure, layer)
    half, cut = (high - low).min() / 2, layer.table["corner_cut"]
    plan = HipPlan(low, high, layer.z0, half, slope(structure, layer, half), cut)
    if cut >= half / 2:
        raise HouseError(f"{layer.table.at('corner_cut')}: {structure.name}: corner_cut must be below a quarter of the"
                         f" roof's width ({half / 2:g} m), got {cut:g}")
    return plan


def mono_plan(structure, layer):
    low, high = outline(structure, layer)
    side = layer.table["falls"]
    run = float(np.abs(OUTWARD[side]) @ (high - low))
    return MonoPlan(low, high, layer.z0, run, slope(structure, layer, run), (side,))


PLANS = {"hip": hip_plan, "gable": gable_plan, "mono": mono_plan}


def slope(structure, layer, half):
    """Rise over run, from `pitch` or `ridge_height`. Raises HouseError for a ridge below the eaves."""
    table, pitch = layer.table, layer.table["pitch"]
    if pitch is None:
        rise = table["ridge_height"] - layer.z0
        if rise <= 0:
            raise HouseError(f"{table.at('ridge_height')}: {structure.name}: "
                             f"the ridge ({table['ridge_height']:g} m) must lie above the eaves ({layer.z0:g} m)")
        pitch = rise / half
    return pitch


def vertical_thickness(layer, plan):
    """Of a slab. [m]"""
    return layer.table["thickness"] * np.hypot(1.0, plan.slope)


def underside(structure, layer, plan):
    """(rise, drop) of `Plan.bottom`: parallel to the upper face, or steeper where the eaves are boxed."""
    drop = vertical_thickness(layer, plan)
    seat = layer.table["eaves"] + structure.table["margin"] + SEAT
    if not is_boxed(structure, layer, plan):
        return plan.slope, drop
    rise = (plan.slope * plan.half - drop) / (plan.half - seat)
    return rise, rise * seat


def is_boxed(structure, layer, plan):
    """Whether a slab between parallel planes would end before the plates, in a roof wider than these."""
    soffit, seat = vertical_thickness(layer, plan) / plan.slope, layer.table["eaves"] + structure.table["margin"] + SEAT
    return soffit < seat < plan.half


def pitched_roof(structure, layer):
    """{side: vertices} of slabs with level faces on the wall plates; the thickness is measured across the slope."""
    plan = PLANS[layer.table["type"]](structure, layer)
    bottom = underside(structure, layer, plan)
    slabs = {}
    for side in plan.sides:
        planes = [plan.top(side), plan.bottom(side, *bottom), ((0, 0, -1), -plan.eave), *plan.outline(side)]
        slabs[side] = structure.cut(f"roof.{side}", planes, layer.table.where)
    return slabs


def slab_masses(structure, layer):
    """{side: mass [kg]} of the hollow slabs of a roof with boxed eaves; empty for other roofs."""
    if layer.table["type"] not in PLANS:
        return {}
    plan = PLANS[layer.table["type"]](structure, layer)
    if not is_boxed(structure, layer, plan):
        return {}
    density = structure.materials[layer.table["material"]]["density"]
    areas = {side: Polyhedron(vertices).volume for side, vertices in pitched_snow(structure, layer, 1.0).items()}
    return {side: density * vertical_thickness(layer, plan) * area for side, area in areas.items()}


def pitched_snow(structure, layer, depth):
    """{side: vertices} of snow of vertical depth [m]: the slab's outline, extruded upwards from its upper face."""
    plan = PLANS[layer.table["type"]](structure, layer)
    bodies = {}
    for side in plan.sides:
        normal, offset = plan.top(side)
        planes = [(normal, offset + depth), (tuple(-v for v in normal), -offset), plan.edge(side), *plan.outline(side)]
        bodies[side] = structure.cut(f"snow.{side}", planes, layer.table.where)
    return bodies


def flat_roof(structure, layer):
    low, high = outline(structure, layer)
    return {"": box([*low, layer.z0], [*high, layer.z1])}


def flat_snow(structure, layer, depth):
    low, high = outline(structure, layer)
    return {"": box([*low, layer.z1], [*high, layer.z1 + depth])}


ROOFS = {**dict.fromkeys(PLANS, (pitched_roof, pitched_snow)), "flat": (flat_roof, flat_snow)}


def lay_roof(structure, layer):
    """Roof elements, one per slab."""
    slabs = ROOFS[layer.table["type"]][0](structure, layer)
    elements = [_element(structure, layer, "roof", side, vertices, layer.table) for side, vertices in slabs.items()]
    for element, mass in zip(elements, slab_masses(structure, layer).values()):
        element.set_mass(mass)
    return elements


def lay_snow(structure, layer, depth, material):
    """Snow elements on this roof; none for `snow: false` or a depth [m] of zero."""
    if depth == 0 or not layer.table["snow"]:
        return []
    bodies = ROOFS[layer.table["type"]][1](structure, layer, depth)
    return [_element(structure, layer, "snow", side, vertices, {"material": material})
            for side, vertices in bodies.items()]


def carry_roofs(structure, elements, joints):
    """Change and append joints, so that the walls bear the roofs' weight and no thrust: tie beams and posts."""
    for layer in structure.layers:
        if layer.kind == "roof" and layer.table["type"] == "gable":
            _tie_slabs(structure, layer, joints)
        elif layer.kind == "roof" and layer.table["type"] == "mono":
            joints += _posts(structure, layer, elements, joints)


def _tie_slabs(structure, layer, joints):
    """Move half of a ridge joint's springs down to tie beams at the level of the plates, which take the slabs' thrust.

    The ridge and each tie beam have the stiffness and strength of one fitting.
    """
    slabs = {f"{structure.name}.{slab_name(structure, layer, 'roof', side)}"
             for side in gable_plan(structure, layer).sides}
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
    high = _high_plates(mono_plan(structure, layer), plates.values()) if eave else []
    if not high or {eave.a, eave.b} & {plate.name for plate in high}:
        raise HouseError(f"{layer.table.where}: {name}: a mono-pitch roof lies on the beams of its eave and stands on"
                         " posts over those of the wall opposite; add beams below both and a rule of `joints` between"
                         " roof and beam")
    return [_post_row(eave, name, plate) for plate in high]


def _high_plates(plan, plates):
    """Those farthest from the eave, of the plates below the plan."""
    d, e = plan.distance(*plan.sides)
    centres = ((plate.solid.centroid[:2], plate) for plate in plates)
    runs = [(e - d @ centre, plate) for centre, plate in centres
            if (plan.low < centre).all() and (centre < plan.high).all()]
    most = max((run for run, _ in runs), default=0.0)
    return [plate for run, plate in runs if most - run < SEAT]


def _post_row(eave, slab, plate):
    """JointSpec of the posts on a plate. eave: that of the slab on a plate of its eave"""
    (x0, y0, _), (x1, y1, z) = plate.solid.bounds
    points = np.array([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]])
    pair = {"a": slab, "b": plate.name} if eave.a == slab else {"a": plate.name, "b": slab}
    return replace(eave, **pair, points=points, area=(x1 - x0) * (y1 - y0), side=plate.side,
                   **_row(eave, max(x1 - x0, y1 - y0)))


def _element(structure, layer, kind, side, vertices, table):
    name = slab_name(structure, layer, kind, side)
    return structure.element(kind, name, vertices, table, layer.table.where, storey=layer.storey,
                             side=frozenset(filter(None, [side])))


def slab_name(structure, layer, kind, side):
    """'roof.west', or 'roof2.west' of the second roof of a structure."""
    roofs = [other for other in structure.layers if other.kind == "roof"]
    number = str(roofs.index(layer) + 1) if len(roofs) > 1 else ""
    return f"{kind}{number}" + (f".{side}" if side else "")
