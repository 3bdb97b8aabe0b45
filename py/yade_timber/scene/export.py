# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene as JSON, for other solvers."""
import json
import math
from pathlib import Path

import yade.wrapper as yw

from . import engines
from .background import between_steps
from .joints import PARAMETERS, attribute, joins_bodies

O = yw.Omega()


@between_steps()
def export_scene(path):
    """Write the loaded scene to a JSON file: elements, materials with friction per pair, joints, gravity.

    Parameters
    ----------
    path : str or Path
        File to write.

    Raises
    ------
    ValueError
        For a body that is no RoundedPolyhedron.
    OSError
        When the file cannot be written.

    Notes
    -----
    ``elements``: id, name, kind, vertices (n, 3) world [m], faces (lists of vertex indices, outward), density (mass
    over volume) [kg/m3], radius [m], fixed, material.

    ``materials``: name to law, density, young [Pa], poisson and, if finite, bearing [Pa], or stiffness_per_kg
    [N/m/kg]. ``friction``: name, name,
    coefficient.

    ``joints``: elements (ids), points (n, 3) world [m], normal (from the first to the second), stiffness (kn, ks)
    [N/m], strength [N] (null: unbreakable), reading 'spring' or 'joint', damping_ratio [-], damping_time [s],
    initial_damping, broken (one flag per spring), kind, name, slip and wall (the parameters and the history of each
    spring with this law; null for both: brittle); none of a removed body.
    """
    bodies = polyhedra("export_scene")
    joint_engine = engines.find_engine(yw.JointEngine)
    materials = {}
    elements = [describe_element(body, materials) for body in bodies]
    content = {
        "format": "yade-timber scene 1",
        "units": "SI; world frame x east, y north, z up",
        "gravity": list(engines.gravity_now()),
        "materials": materials,
        "friction": [[a, b, min(materials[a]["friction"], materials[b]["friction"])]
                     for a in materials for b in materials if a <= b],
        "elements": elements,
        "joints": ([describe_joint(joint) for joint in joint_engine.joints if joins_bodies(joint)] if joint_engine
                   else []),
    }
    Path(path).write_text(json.dumps(content, indent=1, allow_nan=False), encoding="ascii")


def polyhedra(caller):
    """List of the scene's bodies. Raises ValueError for one that is no RoundedPolyhedron."""
    for body in O.bodies:
        if not isinstance(body.shape, yw.RoundedPolyhedron):
            raise ValueError(f"{caller}: body {body.id} is no RoundedPolyhedron")
    return list(O.bodies)


def describe_material(material):
    common = {"density": material.density, "friction": material.friction}
    if isinstance(material, yw.SnowMat):
        return {"law": "snow", "stiffness_per_kg": material.stiffnessPerMass, **common}
    bearing = {"bearing": material.bearing} if math.isfinite(material.bearing) else {}
    return {"law": "timber", "young": material.young, "poisson": material.poisson, **bearing, **common}


def material_name(material, materials):
    """Name of a material; a new one is added to `materials`. Bodies share a name when all values are equal."""
    described = describe_material(material)
    for name, other in materials.items():
        if other == described:
            return name
    name = material.label or described["law"]
    while name in materials:
        name += "'"
    materials[name] = described
    return name


def describe_element(body, materials):
    vertices = [list(body.state.pos + body.state.ori * v) for v in body.shape.vertices]
    return {"id": body.id, "name": body.shape.name, "kind": body.shape.kind, "vertices": vertices,
            "faces": body.shape.faces(), "density": float(f"{body.state.mass / body.shape.massProperties()[0]:.12g}"),
            "radius": body.shape.radius, "fixed": not body.dynamic, "material": material_name(body.material, materials)}


def describe_joint(joint):
    """Dictionary of a TimberJoint; points: ends of the springs on the first element. Law slip: its stretches, plastic
    in the world and largest [m]; law wall: the history of each spring."""
    state = O.bodies[joint.id1].state
    law: dict = {"envelope": [list(point) for point in joint.envelope],
                 **{name: getattr(joint, attribute(name)) for name in PARAMETERS[joint.law]}}
    if joint.law == "slip":
        law |= {"plastic": [list(state.ori * p) for p in joint.plasticStretches],
                "largest": list(joint.largestStretches)}
    elif joint.law == "wall":
        law["springs"] = [{key: list(value) if isinstance(value, tuple) else value for key, value in spring.items()}
                          for spring in joint.cycles]
    return {"elements": [joint.id1, joint.id2], "points": [list(state.pos + state.ori * a) for a in joint.anchors1],
            "normal": list(state.ori * joint.normal), "stiffness": [joint.kn, joint.ks],
            "strength": joint.strength if math.isfinite(joint.strength) else None,
            "reading": "joint" if joint.perJoint else "spring", "damping_ratio": joint.dampingRatio,
            "damping_time": joint.dampingTime, "initial_damping": joint.initialDamping,
            "broken": [bool(b) for b in joint.broken], "kind": joint.kind, "name": joint.name,
            **{name: law if joint.law == name else None for name in ("slip", "wall")}}
