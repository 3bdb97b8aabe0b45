# SPDX-License-Identifier: GPL-2.0-or-later
"""A built house: elements (convex polyhedra), joints (spring points), and counts of both."""
from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from .errors import HouseError
from .geometry import polyhedron


@dataclass(eq=False)
class Element:
    """One rigid member. World frame: x east, y north, z up, origin on the ground at the south-west column."""

    name: str               # e.g. 'main.column1.x4y0'
    kind: str               # a key of layout.KINDS
    vertices: np.ndarray    # (n, 3) [m]
    material: str           # key of HouseModel.materials
    density: float          # mass over volume, with what it carries and without hollows [kg/m3]
    fixed: bool = False
    storey: int = 0  # storey of the columns below it (columns, braces: their own); 0 below the first
    side: frozenset = frozenset()  # walls that it is part of: 'north', 'south', 'east', 'west'; empty inside the house
    section: tuple = ()  # (width, depth) [m] where the member has a section
    group: str = ""  # structure, e.g. 'main', 'entrance'
    source: str = ""  # file:line of its description
    axis: np.ndarray | None = None  # (2, 3) ends of a member of a frame, as described [m]

    def __repr__(self):
        return f"<Element {self.name}: {self.kind}, {len(self.vertices)} corners>"

    @cached_property
    def solid(self):
        try:
            solid = polyhedron(self.vertices)
            solid.hull
        except ValueError as problem:
            raise HouseError(f"{self.source}: {self.kind} {self.name} is not a convex body: {problem}; change its"
                             " dimensions") from None
        return solid

    def move(self, vertices):
        """Give it other corners (n, 3) [m]."""
        self.vertices = vertices
        self.__dict__.pop("solid", None)

    @property
    def volume(self):
        """[m3]"""
        return self.solid.volume

    @property
    def mass(self):
        """[kg]"""
        return self.density * self.volume

    def set_mass(self, mass):
        """Give it another mass [kg], spread evenly over its volume."""
        self.density = mass / self.volume


@dataclass(frozen=True)
class WallCycles:
    """Law 'wall' of a spring: its cycles (docs/theory.md, section 4). Of a wall type: of a wall 1 m long whose stretch
    is its drift [rad]."""

    friction_force: float  # [N] at zero stretch after yielding
    reload_target: float = 1.0  # stretch at which reloading meets the envelope, over the largest so far
    reload_share: float = 0.0  # of the slack, from which it reloads, unless reload_stiffness says otherwise
    pinched_stiffness: float = 0.0  # [N/m] within the slack
    reload_stiffness: float = 0.0  # [N/m] k0: stiffness of reloading k0 (reload_stretch / target)^reload_power
    reload_stretch: float = 0.0  # [m]
    reload_power: float = 0.0

    def scaled(self, lever, part):
        """Of a spring with the stretch `lever` times the drift [m] and the force `part` times the shear [m]."""
        rate = part / lever
        return replace(self, friction_force=part * self.friction_force, pinched_stiffness=rate * self.pinched_stiffness,
                       reload_stiffness=rate * self.reload_stiffness, reload_stretch=lever * self.reload_stretch)


@dataclass(frozen=True)
class Sheet:
    """A wall sheet. low, high: the columns of its bay (names); type: key of wall_types; opening: key of
    walls.OPENING_SHARES; multiplier, quasi_multiplier: as the rules count them, of its bearing wall, its panels [-]"""

    low: str
    high: str
    type: str
    opening: str
    multiplier: float = 0.0
    quasi_multiplier: float = 0.0


@dataclass(eq=False, kw_only=True)
class JointSpec:
    """Joint of elements `a` and `b`: springs at the corners of their contact area (paper, 2.4), or one.

    kind: 'column_beam', 'brace_beam', 'brace_column', 'floor_beam', 'roof_beam', 'roof_roof', ...; label: name of a
    joint that is not named after its members, of a wall"""

    a: str
    b: str
    points: np.ndarray   # (n, 3) spring points [m], world frame
    normal: np.ndarray   # (3,) from a to b; of a wall, along which its spring acts
    kind: str
    kn: float            # [N/m] normal stiffness, of each spring or of the joint, see `per`
    ks: float            # [N/m] tangential stiffness, likewise; 0: the springs act along the normal only
    strength: float      # [N] P_max, with law 'slip' the yield force, likewise; inf: unbreakable
    per: str             # 'spring': values of each spring; 'joint': of the joint as a whole
    law: str = "brittle"  # or 'slip', 'wall'
    damping_ratio: float = 0.0  # of the critical damping of the joined masses
    damping_time: float = 0.0  # [s] of dashpots that damp the sway of the house, over the stiffness
    initial_damping: bool = False  # dashpots keep the initial stiffness of yielded springs
    friction_share: float | None = None     # law 'slip': share of the yield force that acts in both directions
    softening_stretch: float | None = None  # [m] law 'slip': stretch from which the strength falls
    ultimate_stretch: float | None = None   # [m] law 'slip': stretch at which no strength is left
    envelope: tuple = ()  # laws 'slip', 'wall': (stretch [m], force [N]) of the first loading
    cycles: WallCycles | None = None  # law 'wall'
    broken: bool = False  # damaged before the run starts
    label: str = ""
    area: float = 0.0    # contact area [m2]
    type: str = ""       # key of joint_types
    storey: int = 0
    side: frozenset = frozenset()
    end: str = ""        # columns and braces: 'top' or 'bottom' end of a
    group: str = ""
    sheet: Sheet | None = None  # of which it is a half

    def __repr__(self):
        return f"<JointSpec {self.name}: {self.kind}, {self.law}{', broken' if self.broken else ''}>"

    @property
    def name(self):
        return self.label or "|".join(filter(None, (self.a, self.b)))

    @property
    def centre(self):
        """(3,) mean of the spring points [m]."""
        return self.points.mean(0)

    def whole(self, value):
        """Of the joint as a whole, from a value of it or of each of its springs."""
        return value * (1 if self.per == "joint" else len(self.points))


@dataclass(eq=False)
class HouseModel:
    """A built house, from which bodies and joints are made."""

    name: str
    description: str
    elements: list
    joints: list
    materials: dict  # name -> {'law': 'timber', 'density', 'young', 'poisson'} or
    # {'law': 'snow', 'density', 'stiffness_per_kg'}
    friction: list  # [(material, material, coefficient)]
    law: dict  # 'per', ...; 'wall_level': None without walls of a rated multiplier
    snow_depth: float  # [m]
    storey_levels: dict  # group -> {storey: (z foot, z head) of its columns [m]}
    grids: dict  # group -> {'x': positions of its nodes [m], 'y': likewise}
    plans: dict = field(default_factory=dict)  # group -> {storey: FloorPlan}
    code: dict = field(default_factory=dict)  # group -> settings of the diagnosis, 'wall_load': loads.wall [kN/m2]

    def __repr__(self):
        return (f"<HouseModel {self.name}: {len(self.elements)} elements, {self.joints_text}, {self.snow_depth:g} m of"
                " snow>")

    @cached_property
    def by_name(self):
        return {element.name: element for element in self.elements}

    def element(self, name):
        """Element `name`; raises KeyError."""
        return self.by_name[name]

    def of_kind(self, *kinds, group=None):
        """Elements of these kinds, in building order, of one structure or of all."""
        return [e for e in self.elements if e.kind in kinds and group in (None, e.group)]

    @property
    def sheets(self):
        """{Sheet: its number}, in the order of the joints."""
        return {sheet: k for k, sheet in enumerate(dict.fromkeys(joint.sheet for joint in self.joints if joint.sheet))}

    @property
    def joints_text(self):
        """'412 joints, 16 wall sheets': joints without those of walls; sheets only where there are some."""
        joints, sheets = sum(joint.sheet is None for joint in self.joints), len(self.sheets)
        return f"{joints} joints" + (f", {sheets} wall sheet{'s' * (sheets != 1)}" if sheets else "")

    def counts(self):
        """Numbers to check a house: elements, columns, braces, joints without those of walls, kinds, masses [kg]."""
        columns, braces = self.of_kind("column"), self.of_kind("brace")
        return {"elements": len(self.elements), "by_kind": dict(Counter(e.kind for e in self.elements)),
                "free": sum(not e.fixed for e in self.elements),
                "columns_by_section": dict(Counter(round(e.section[0], 4) for e in columns)),
                "columns_by_storey": dict(Counter(f"{e.group} {e.storey}" for e in columns)), "braces": len(braces),
                "walls": len({(sheet.low, sheet.high) for sheet in self.sheets}),
                "braces_by_storey": dict(Counter(f"{e.group} {e.storey}" for e in braces)),
                "joints": sum(j.sheet is None for j in self.joints),
                "joints_by_kind": dict(Counter(j.kind for j in self.joints)),
                "broken_by_kind": dict(Counter(j.kind for j in self.joints if j.broken)),
                "mass_timber_free": sum(e.mass for e in self.elements if not e.fixed and e.kind != "snow"),
                "mass_snow": sum(e.mass for e in self.of_kind("snow"))}
