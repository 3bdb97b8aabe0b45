# SPDX-License-Identifier: GPL-2.0-or-later
"""Joints between bodies of the scene that is loaded in YADE."""
import math
from dataclasses import dataclass, fields
from functools import cache

import yade.wrapper as yw
from yade.minieigenHP import Vector3

from . import arguments
from .background import between_steps
from .engines import find_engine

PER = ("spring", "joint")  # owners of stiffness and strength
O = yw.Omega()


@dataclass(frozen=True)
class SlipLaw:
    """Yielding springs for `connect`: elastic to the strength, then plastic, with slip in cycles (docs/theory.md,
    section 4).

    Parameters
    ----------
    softening_stretch : float
        Stretch beyond which the strength falls [m], > strength / stiffness.
    ultimate_stretch : float
        Stretch at which the strength is zero and the spring breaks. [m]
    friction_share : float
        Share of stiffness and strength that dissipates energy in every cycle [-], 0 to 1; the rest slips.
    """

    softening_stretch: float
    ultimate_stretch: float
    friction_share: float = 0.3


PARAMETERS = {"brittle": (), "slip": tuple(part.name for part in fields(SlipLaw)),
              "wall": ("friction_force", "reload_target", "reload_share", "pinched_stiffness", "reload_stiffness",
                       "reload_stretch", "reload_power")}
"""Law of the springs -> its parameters besides the envelope."""


@between_steps()
def connect(id1, id2, points, normal=None, stiffness=(58800.0, 58800.0), strength=5880.0, per="spring", kind="",
            name="", damping_ratio=0.0, slip=None):
    """Join two bodies with springs.

    Parameters
    ----------
    id1, id2 : int or Body
        The bodies, or their ids.
    points : (n, 3) array_like
        Places of the springs, world frame [m]; the springs are unstretched in the present placement.
    normal : (3,) array_like, optional
        From body 1 to body 2; by default from centroid to centroid. It matters only for unequal stiffnesses.
    stiffness : (float, float)
        Normal and tangential stiffness, > 0 and >= 0. [N/m] With 0 the springs act along the normal only, which turns
        with body 1.
    strength : float
        Largest force P_max. [N]
    per : {"spring", "joint"}
        Whether stiffness and strength are those of each spring or of the whole joint.
    kind, name : str
        For pictures and tables.
    damping_ratio : float
        Of the vibration modes of the two bodies against each other, 0 to 1. [-]
    slip : SlipLaw, optional
        Springs yield at the strength; needs equal stiffnesses, or (kn, 0). By default they break at the strength.

    Returns
    -------
    TimberJoint
        Its ``springs`` give force, stretch and break.

    Raises
    ------
    ValueError
        For unknown bodies, no points, values out of range, and a joint that is there already.
    """
    id1, id2 = arguments.present_ids("connect", id1, id2)
    if id1 == id2:
        raise ValueError(f"connect: body {id1} cannot be joined with itself")
    springs = checked_springs(points, normal, stiffness, strength, per, kind, name, damping_ratio)
    require_near(springs["points"], id1, id2)
    if slip is not None:
        arguments.instance("connect: slip", slip, SlipLaw, "a SlipLaw or None")
        springs |= {"law": "slip", **{key: arguments.number(f"connect: slip.{key}", value)
                                      for key, value in vars(slip).items()}}
    joint, engine = make_joint(id1, id2, **springs), find_engine(yw.JointEngine) or add_joint_engine()
    if engine.hasSame(joint):
        raise ValueError(f"connect: bodies {id1} and {id2} have the same joint at these points already: give another"
                         " stiffness or strength to one joint")
    engine.append(joint)
    return joint


def checked_springs(points, normal, stiffness, strength, per, kind, name, damping_ratio):
    """Arguments of `make_joint` from those of `connect`. Raises ValueError or TypeError for a wrong one."""
    if not isinstance(per, str) or per not in PER:
        arguments.refuse(ValueError, "connect: per", per, f"one of {', '.join(PER)}")
    points = arguments.points("connect: points", points)
    if normal is not None:
        normal = arguments.vector("connect: normal", normal)
        if not any(normal):
            arguments.refuse(ValueError, "connect: normal", normal, "not zero")
    kn, ks = arguments.numbers_of_shape("connect: stiffness", stiffness, (2,), "two finite numbers, > 0 and >= 0 [N/m]")
    kn = arguments.positive("connect: stiffness[0]", kn, "N/m")
    if not (math.isfinite(ks) and ks >= 0):
        arguments.refuse(ValueError, "connect: stiffness[1]", ks, "a finite number >= 0 [N/m]")
    strength = arguments.positive("connect: strength", strength, "N", infinite=True)
    kind, name = arguments.text("connect: kind", kind), arguments.text("connect: name", name)
    damping_ratio = arguments.number("connect: damping_ratio", damping_ratio)
    if not 0 <= damping_ratio <= 1:
        arguments.refuse(ValueError, "connect: damping_ratio", damping_ratio, "between 0 and 1")
    return {"points": points, "normal": normal, "kind": kind, "name": name, "kn": kn, "ks": ks, "strength": strength,
            "per": per, "damping_ratio": damping_ratio}


def require_near(points, *ids):
    """ValueError for a point farther than a body's diagonal from each body: a slip of units or frames."""
    elements = [b for b in (O.bodies[k] for k in ids) if isinstance(b.shape, yw.RoundedPolyhedron)]
    reach = {b.id: max(v.norm() for v in b.shape.vertices) for b in elements}  # of the corners, from the centre
    for point in points if len(elements) == len(ids) else ():
        gaps = [(b.state.pos - Vector3(*point)).norm() - reach[b.id] for b in elements]
        if all(gap > 2 * reach[b.id] for gap, b in zip(gaps, elements)):
            form = f"in the world frame [m] and near one of the bodies: it is {min(gaps):.3g} m away from both"
            arguments.refuse(ValueError, "connect: points", tuple(float(x) for x in point), form)


def add_joint_engine():
    """A new JointEngine, put behind the contact loop of `O.engines`."""
    chain = list(O.engines)
    behind = next((k + 1 for k, e in enumerate(chain) if isinstance(e, (yw.ContactLoop, yw.InteractionLoop))), None)
    if behind is None:
        raise ValueError("connect: set O.engines = yade_timber.engines(...) first")
    engine = yw.JointEngine()
    O.engines = chain[:behind] + [engine] + chain[behind:]
    return engine


def make_joint(id1, id2, points, normal, per, **values):
    """TimberJoint between two bodies in their present placement. points: of its springs (n, 3) [m]; normal, per: as in
    `connect`; values: of further attributes, as `damping_ratio`."""
    s1, s2 = O.bodies[id1].state, O.bodies[id2].state
    points = [Vector3(*p) for p in points]
    direction = Vector3(*normal) if normal is not None else s2.pos - s1.pos
    return yw.TimberJoint(id1=id1, id2=id2, anchors1=[s1.ori.conjugate() * (p - s1.pos) for p in points],
                          anchors2=[s2.ori.conjugate() * (p - s2.pos) for p in points],
                          normal=s1.ori.conjugate() * direction.normalized(), perJoint=per == "joint",
                          **{attribute(name): value for name, value in values.items()})


@cache
def attribute(parameter):
    """'friction_share' -> 'frictionShare': name of a parameter in TimberJoint."""
    first, *others = parameter.split("_")
    return first + "".join(map(str.capitalize, others))


def joins_bodies(joint):
    """Whether both bodies of a TimberJoint are still in the scene."""
    return all(0 <= body < len(O.bodies) and O.bodies[body] is not None for body in (joint.id1, joint.id2))
