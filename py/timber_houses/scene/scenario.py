# SPDX-License-Identifier: GPL-2.0-or-later
"""House and ground motion -> scene in YADE. Nothing here is particular to the houses A, B, C: they are files."""
from dataclasses import dataclass, field

import numpy as np
import yade.wrapper as yw
from yade_timber.plugin import compiled
from yade_timber.scene import bodies, engines
from yade_timber.scene.joints import PARAMETERS, make_joint
from yade_timber.scene.queries import stable_dt

from ..base.colors import KINDS
from ..base.time_step import DEFAULT_DT, rest_stride
from ..house import build_house, load_house
from ..house.description import own_coefficient
from ..house.disturbance import disturb
from ..house.errors import StepError
from . import sway

SETTLING = 0.2  # time in which a house comes to rest under its weight before its sway modes are computed. [s]
O = yw.Omega()


@dataclass
class Scenario:
    """House, loads and time of a run. house: name of a shipped house or path of a file; motion: GroundMotion or None;
    snow_depth [m], joint_damping: ratio of sway and joints [-], wall_level: of walls of a rated multiplier, None for
    each: the house's own.

    scale: factor on the motion [-]; delay: time at which it begins [s]; dt, duration [s]; until_collapse, until_rest:
    whether a collapse ends the run, whether the rest of its wreck does; disturb: seed of the house's disturbance, None:
    none; options: of `engines.engines`; record, other_walls: of the summary, on the motion and on walls of the other
    level; lot: of a town."""

    name: str
    house: str
    motion: object = None
    snow_depth: float | None = None
    scale: float = 1.0
    delay: float = 0.0
    dt: float = DEFAULT_DT
    duration: float = 30.0
    until_collapse: bool = False
    until_rest: bool = False
    joint_damping: float | None = None
    wall_level: str | None = None
    disturb: int | None = None
    options: dict = field(default_factory=dict)
    record: object = None
    other_walls: object = None
    lot: str | None = None

    def __post_init__(self):
        self.description = load_house(self.house)

    def build_model(self):
        model = build_house(self.description, self.snow_depth, wall_level=self.wall_level)
        if self.joint_damping is not None:
            model.law = {**model.law, "joint_damping": self.joint_damping}
            for joint in model.joints:
                if joint.sheet is None:
                    joint.damping_ratio = self.joint_damping
        if self.disturb is not None:
            disturb(model, self.disturb)
        return model


def build(scenario):
    """Build the scenario's scene in an emptied YADE; returns the HouseModel."""
    model = scenario.build_model()
    if model.law["joint_damping"] > 0 and any(joint.sheet for joint in model.joints):
        damp_sway(model)
    O.reset()
    ids = add_elements(model)
    joints = add_joints(model, ids)
    motion = None
    if scenario.motion is not None:
        motion = engines.ground_motion_engine(scenario.motion, scale=scenario.scale, start=scenario.delay)
    options = {**law_options(model.law), "skip_rest": rest_stride(scenario.dt), **scenario.options}
    O.engines = engines.engines(ground_motion=motion, joints=joints, monitor=sampler(model, ids), **options)
    O.dt = scenario.dt
    check_step(model)
    return model


def damp_sway(model):
    """Give the walls of a model the damping times with which its structures sway with the damping ratio of its law. The
    scene in YADE is replaced by the house at rest under its weight."""
    O.reset()
    ids = add_elements(model)
    O.engines = engines.engines(joints=add_joints(model, ids), **law_options(model.law))
    O.dt = min(DEFAULT_DT, stable_dt(compiled.joint_step_factor))
    try:
        for _ in range(round(SETTLING / O.dt)):
            O.step()
    except RuntimeError:
        return  # which the run will meet and report itself
    for structure in model.storey_levels:
        bodies = {ids[element.name] for element in model.elements if element.group == structure}
        chosen = np.array([joint.group == structure and joint.sheet is not None for joint in model.joints], bool)
        for joint, time in zip(model.joints, sway.damping_times(model.law["joint_damping"], bodies, chosen)):
            joint.damping_time += float(time)


def check_step(model):
    """Raise StepError when the joints are too stiff for the time step, as between light members."""
    limit = stable_dt(compiled.joint_step_factor)
    if O.dt > limit:
        fault = f"a time step of {O.dt:g} s is too large for the joints between the lightest members"
        raise StepError(f"{model.name}: {fault}: take at most {limit:.2g} s (--dt), or less stiff joints")


def law_options(law):
    """Arguments of `engines.engines` that the `law` of a house file decides."""
    return {"vertex_edge": law["vertex_edge_contacts"], "flush_supports": law["flush_supports"],
            "increment": law["hertz"] == "increment"}


def add_elements(model):
    """Append the model's elements to O.bodies; returns {element name: body id}."""
    materials = {name: make_material(name, spec, model) for name, spec in model.materials.items()}
    ids = {}
    for element in model.elements:
        body = bodies.polyhedron(element.vertices, materials[element.material], fixed=element.fixed, name=element.name,
                                 kind=element.kind, color=KINDS.get(element.kind))
        loaded = element.density / model.materials[element.material]["density"]  # by what it carries
        body.state.mass *= loaded
        body.state.inertia *= loaded
        ids[element.name] = O.bodies.append(body)
    return ids


def make_material(name, spec, model):
    friction = own_coefficient(name, spec["law"], model.friction)
    if spec["law"] == "snow":
        return bodies.snow(spec["density"], spec["stiffness_per_kg"], friction, label=name)
    return bodies.timber(spec["young"], spec["poisson"], spec["density"], friction, label=name,
                         bearing=model.law["bearing"] or None)


JOINT_VALUES = ("points", "normal", "per", "kn", "ks", "strength", "kind", "name", "law", "envelope", "damping_ratio",
                "damping_time", "initial_damping")
"""Of a JointSpec, which `make_joint` takes as they are."""


def add_joints(model, ids):
    """TimberJoints of the model, between the bodies in their present placement."""
    return [make_joint(ids[j.a], ids[j.b], broken=[int(j.broken)] * len(j.points),
                       **{name: getattr(j, name) for name in JOINT_VALUES},
                       **{name: getattr(j.cycles or j, name) for name in PARAMETERS[j.law]}) for j in model.joints]


LEVEL_KINDS = (("floor",), ("beam", "roof"), ("rafter",))
"""Kinds of elements that mark a level: the first of these that it has."""


def level_marks(model, structure):
    """[(element, level)] of a structure; level k is the top of storey k."""
    marks = []
    for storey in sorted(model.storey_levels[structure]):
        found = ([e for kind in kinds for e in model.of_kind(kind, group=structure) if e.storey == storey]
                 for kinds in LEVEL_KINDS)
        marks += [(e, storey) for e in next(filter(None, found), [])]
    return marks


STANDING = ("column", "brace", "wall")
"""Kinds of elements that stand in a storey; all others belong to the level above or below."""


def sampled_columns(model):
    """Columns whose drifts are judged, in the order of the sampled axes."""
    return [e for e in model.of_kind("column") if e.group in model.storey_levels]


def sampler(model, ids):
    """Sampler of a house. Its groups: the levels of each structure from below, the main one first; then the parts of
    the main structure, part 2k: level k, part 2k - 1: what stands in storey k."""
    groups = [[e for e, level in level_marks(model, structure) if level == storey]
              for structure, storeys in model.storey_levels.items() for storey in sorted(storeys)]
    levels, (main, storeys) = len(groups), next(iter(model.storey_levels.items()))
    top, numbered = max(storeys), [(k, e) for k, group in enumerate(groups) for e in group]
    numbered += [(levels + 2 * min(e.storey, top) - (e.kind in STANDING and e.storey <= top), e)
                 for e in model.elements if e.group == main and not e.fixed]
    return yw.Sampler(bodies=[ids[e.name] for _, e in numbered], groups=[group for group, _ in numbered],
                      members=[ids[e.name] for e in sampled_columns(model)])
