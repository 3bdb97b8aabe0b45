# SPDX-License-Identifier: GPL-2.0-or-later
"""From a house and a ground motion to a scene in YADE. Knows nothing of houses A, B, C: they are files."""
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

import yade.wrapper as yw
from yade.minieigenHP import Vector3

from . import bodies as elements
from ..base import colors as palette
from . import engines as scene
from .joints import make_joint
from .queries import stable_dt
from ..recording.frames import steps_between
from ..house import build_house, load_house
from ..house.errors import StepError
from ..house.friction import own_coefficient

O = yw.Omega()

DEFAULT_DT = 2.5e-4
"""Time step of the house scenarios. [s]"""
MAX_DT = 5e-4
"""Largest time step that a house scenario takes [s]: the joints of floors and roof are unstable at 5.1e-4."""
MIN_DT = 1e-7
"""Smallest time step that a house scenario takes [s]: a hundredth of the paper's."""
JOINT_SAFETY = 0.98
"""Largest time step over the joints' stability limit, which is that of linear springs without dashpots. [-]"""


@dataclass
class Scenario:
    """What is run. house: name of a shipped house or path of a YAML file; motion: GroundMotion or None; snow depth [m]."""

    name: str
    house: str
    motion: object = None
    snow_depth: float = 0.0
    scale: float = 1.0
    dt: float = DEFAULT_DT
    duration: float = 30.0
    options: dict = field(default_factory=dict)  # of scene.engines

    def fingerprint(self):
        """What a checkpoint must agree with to go on: everything that decides the run but its duration. A house file may have moved: its content is compared as built."""
        motion = self.motion and [self.motion.name, self.motion.dt, sha256(self.motion.acceleration.tobytes()).hexdigest()[:16]]
        return {
            "name": self.name,
            "house": Path(self.house).stem,
            "motion": motion,
            "snow_depth": self.snow_depth,
            "scale": self.scale,
            "dt": self.dt,
            "options": {key: str(value) for key, value in self.options.items()},
        }


def build(scenario):
    """Empty YADE and build the scenario's scene in it. Returns the HouseModel."""
    model = build_house(load_house(scenario.house), snow_depth=scenario.snow_depth)
    O.reset()
    ids = add_elements(model)
    joints = add_joints(model, ids)
    motion = None
    if scenario.motion is not None:
        motion = scene.ground_motion_engine(scenario.motion, scale=scenario.scale)
    options = {**law_options(model.law), "skip_rest": steps_between(scenario.dt), **scenario.options}
    O.engines = scene.engines(ground_motion=motion, joints=joints, monitor=house_monitor(model, ids), **options)
    O.dt = scenario.dt
    check_step(model)
    return model


def check_step(model):
    """Raise StepError when the joints, which have no dashpots, are too stiff for the time step: those of light members are."""
    limit = stable_dt(JOINT_SAFETY)
    if O.dt > limit:
        raise StepError(f"{model.name}: a time step of {O.dt:g} s is too large for the joints between the lightest members: take at most {limit:.2g} s (--dt), or less stiff joints")


def law_options(law):
    """Arguments of `scene.engines` that the `law` of a house file decides."""
    return {"vertex_edge": law["vertex_edge_contacts"], "flush_supports": law["flush_supports"], "increment": law["hertz"] == "increment"}


def add_elements(model):
    """Append the model's elements to O.bodies; returns {element name: body id}."""
    materials = {name: make_material(name, spec, model) for name, spec in model.materials.items()}
    ids = {}
    for element in model.elements:
        body = elements.polyhedron(
            element.vertices,
            materials[element.material],
            fixed=element.fixed,
            name=element.name,
            kind=element.kind,
            color=palette.KINDS.get(element.kind),
        )
        ids[element.name] = O.bodies.append(body)
    return ids


def make_material(name, spec, model):
    """Material of a house description."""
    friction = own_coefficient(name, spec["law"], model.friction)
    if spec["law"] == "snow":
        return elements.snow(spec["density"], spec["stiffness_per_kg"], friction, label=name)
    return elements.timber(spec["young"], spec["poisson"], spec["density"], friction, label=name)


def add_joints(model, ids):
    """TimberJoints of the model, between the bodies in their present placement."""
    return [make_joint(ids[j.a], ids[j.b], j) for j in model.joints]


def level_marks(model, structure):
    """Bodies that mark the levels of a structure: [(element, level)]; level k is the top of storey k.

    The floor where there is one, else the beams under the roof, or the roof; in a structure without floors the roof itself, which moves as one.
    """
    kinds = ("floor", "beam", "roof") if model.of_kind("floor", group=structure) else ("roof", "beam")
    marks = []
    for storey in sorted(model.storey_levels[structure]):
        levels = [[e for e in model.of_kind(kind, group=structure) if e.storey == storey] for kind in kinds]
        marks += [(e, storey) for e in next(filter(None, levels), [])]
    return marks


def house_monitor(model, ids):
    """HouseMonitor of the main structure's storeys; their height is that of the columns."""
    main, storeys = next(iter(model.storey_levels.items()))
    marks = level_marks(model, main)
    return yw.HouseMonitor(
        bodies=[ids[e.name] for e, _ in marks],
        levels=[level for _, level in marks],
        heights=[head - foot for _, (foot, head) in sorted(storeys.items())],
    )
