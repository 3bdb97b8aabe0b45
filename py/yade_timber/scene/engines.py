# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines, joints and questions to the scene that is loaded in YADE."""
import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Vector3

from .bodies import angular_momentum  # noqa: F401  (part of this module's interface)

GRAVITY = (0.0, 0.0, -9.81)
"""[m/s2]"""
BOUND_MARGIN = 5e-3
"""How far bodies may move before the collider looks again [m]; results do not depend on it."""
LOOPS = (yw.ContactLoop, yw.InteractionLoop)
"""Engines that loop over contacts: this package's holds YADE's."""
JOINT_READINGS = {"spring": False, "joint": True}
"""What stiffness and strength belong to -> TimberJoint.perJoint."""

O = yw.Omega()


def engines(
    gravity=GRAVITY,
    ground_motion=None,
    joints=None,
    monitor=None,
    vertex_edge=False,
    flush_supports=True,
    increment=False,
    damping_ratio=1.0,
    sweeps=50,
    tolerance=1e-3,
    track_energy=True,
    health_check=100,
    skip_rest=0,
):
    """List for `O.engines`, with nothing in it that the scene has no use for.

    gravity        (3,) [m/s2]
    ground_motion  `yade_timber.motion.GroundMotion`, a GroundMotionEngine, or None
    joints         list of TimberJoint; None keeps the joints that are in O.engines already (`connect` adds to them)
    monitor        HouseMonitor, or None
    vertex_edge    whether vertex-edge and vertex-vertex contacts exist too (the paper ignores them)
    flush_supports whether a vertex exactly over a face's border is supported
    increment      normal force from increments (Eq. 38) instead of the closed form (Eq. 37)
    damping_ratio  share of critical damping [-]; below 1, contacts that last fewer than some ten steps may gain energy (docs/theory.md, section 5)
    sweeps         most Gauss-Seidel sweeps of the implicit contacts; 0: explicit springs and dashpots as in the paper
    tolerance      share of an island's contact impulses, each over the root of its equivalent mass, that the last sweep may change [-]
    track_energy   whether `energy()` can be asked
    health_check   steps between checks for finite numbers; 0: none
    skip_rest      steps to skip at a time while the scene rests and the ground is quiet (RestSkipper); 0: none
    """
    # the snow functors cost nothing without snow, and YADE ends the process when a pair of materials has none
    laws = [yw.Law2_ManifoldGeom_TimberPhys_Hertz(increment=increment), yw.Law2_ManifoldGeom_SnowPhys_Linear()]
    pairs = [yw.Ip2_TimberMat_TimberMat_TimberPhys(dampingRatio=damping_ratio), yw.Ip2_ElementMat_ElementMat_SnowPhys(dampingRatio=damping_ratio)]
    geometry = yw.Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom(vertexEdge=vertex_edge, flushSupports=flush_supports)
    chain = [
        yw.ForceResetter(),
        # verletDist = 0: the boxes' own margin and CollisionTrigger do that work without NewtonIntegrator
        yw.CollisionTrigger(collider=yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb(margin=BOUND_MARGIN)], verletDist=0)),
        yw.ContactLoop(loop=yw.InteractionLoop([geometry], pairs, laws)),
    ]
    kept = find_engine(yw.JointEngine) if joints is None else joint_engine(joints)
    if kept is not None:
        chain.append(kept)
    if np.any(gravity):
        chain.append(yw.UniformGravity(gravity=Vector3(*gravity)))
    if ground_motion is not None:
        chain.append(ground_motion if isinstance(ground_motion, yw.GroundMotionEngine) else ground_motion_engine(ground_motion))
    chain.append(yw.ContactForces(sweeps=sweeps, tolerance=tolerance, trackEnergy=track_energy))
    chain.append(yw.SymplecticIntegrator())
    if health_check:
        chain.append(yw.HealthCheck(every=health_check))
    if monitor is not None:
        chain.append(monitor)
    if skip_rest:
        chain.append(yw.RestSkipper(grain=skip_rest))
    return chain


def ground_motion_engine(motion, scale=1.0, start=0.0):
    """GroundMotionEngine for a `yade_timber.motion.GroundMotion`; scale [-], start: simulated time of its first sample [s]."""
    return yw.GroundMotionEngine(step=motion.dt, acceleration=[Vector3(*a) for a in motion.acceleration], scale=scale, start=start)


def joint_engine(joints):
    """JointEngine with these TimberJoints."""
    engine = yw.JointEngine()
    for joint in joints:
        engine.append(joint)
    return engine


def find_engine(kind):
    """The engine of that class, or of one of a tuple of them, in `O.engines`, or None."""
    return next((e for e in O.engines if isinstance(e, kind)), None)


def interaction_loop():
    """The scene's InteractionLoop, which holds the functors and stands in `O.engines` by itself or in a ContactLoop, or None."""
    engine = find_engine(LOOPS)
    return engine.loop if isinstance(engine, yw.ContactLoop) else engine


def gravity_now():
    """Acceleration of gravity in the scene, this package's or YADE's engine. [m/s2]"""
    engine = find_engine((yw.UniformGravity, yw.GravityEngine))
    return engine.gravity if engine else Vector3.Zero


def connect(id1, id2, points, normal=None, stiffness=(58800.0, 58800.0), strength=5880.0, per="spring", kind="", name=""):
    """Join two bodies with springs at `points`; returns the TimberJoint, whose `.springs` tell force, stretch and break.

    points     (n, 3) world frame [m]: the springs are unstretched in the present placement
    normal     (3,) from body 1 to body 2; None: from centroid to centroid. It matters only for unequal stiffnesses
    stiffness  (kn, ks) [N/m], strength P_max [N]: of each spring or of the whole joint, as `per` says
    Raises ValueError for unknown bodies, no points, stiffness or strength that is not > 0, an unknown reading.
    """
    if id1 == id2:
        raise ValueError(f"connect: body {id1} cannot be joined with itself")
    require_bodies("connect", id1, id2)
    if per not in JOINT_READINGS:
        raise ValueError(f"connect: per = {per!r}: it must be one of {', '.join(JOINT_READINGS)}")
    points = np.atleast_2d(np.asarray(points, float))
    if points.shape[1:] != (3,) or not np.isfinite(points).all():
        raise ValueError("connect: points must be finite and of shape (n, 3)")
    kn, ks = stiffness
    if not (kn > 0 and ks > 0 and strength > 0):
        raise ValueError(f"connect: stiffness {stiffness} N/m and strength {strength} N must be > 0")
    joint = make_joint(O.bodies[id1], O.bodies[id2], id1, id2, points, normal, kn, ks, strength, per, kind, name)
    engine = find_engine(yw.JointEngine)
    if engine is None:
        chain = list(O.engines)
        place = next((k + 1 for k, e in enumerate(chain) if isinstance(e, LOOPS)), None)
        if place is None:
            raise ValueError("connect: set O.engines = yade_timber.engines(...) first")
        engine = yw.JointEngine()
        O.engines = chain[:place] + [engine] + chain[place:]
    engine.append(joint)
    return joint


def require_ids(caller, *ids):
    """Raise ValueError for what is no id of a body of the scene, there or taken out: YADE itself would read beyond its list."""
    for body in ids:
        if not isinstance(body, (int, np.integer)) or not 0 <= body < len(O.bodies):
            raise ValueError(f"{caller}: there is no body {body}; bodies have the ids 0 ... {len(O.bodies) - 1}")


def require_bodies(caller, *ids):
    """Raise ValueError for what is no id of a body in the scene."""
    require_ids(caller, *ids)
    for body in ids:
        if O.bodies[body] is None:
            raise ValueError(f"{caller}: body {body} was taken out")


def joins_bodies(joint):
    """Whether both bodies of a TimberJoint are still in the scene."""
    return all(0 <= body < len(O.bodies) and O.bodies[body] is not None for body in (joint.id1, joint.id2))


def make_joint(body1, body2, id1, id2, points, normal, kn, ks, strength, per, kind="", name="", broken=False):
    """TimberJoint between two bodies in their present placement; arguments as in `connect`."""
    s1, s2 = body1.state, body2.state
    points = [Vector3(*p) for p in np.asarray(points, float)]
    direction = Vector3(*normal) if normal is not None else s2.pos - s1.pos
    return yw.TimberJoint(
        id1=id1,
        id2=id2,
        anchors1=[s1.ori.conjugate() * (p - s1.pos) for p in points],
        anchors2=[s2.ori.conjugate() * (p - s2.pos) for p in points],
        normal=s1.ori.conjugate() * direction.normalized(),
        kn=kn,
        ks=ks,
        strength=strength,
        perJoint=JOINT_READINGS[per],
        broken=[int(broken)] * len(points),
        kind=kind,
        name=name,
    )


def contacts(id1, id2):
    """Contact points between two bodies: list of dictionaries, world frame.

    position [m], normal (from id1 to id2), overlap [m], normal_force [N] (elastic and dashpot, >= 0), shear_force (3,) on
    id2 [N]. Empty when they do not touch. Forces are those of the last step. Raises ValueError for what was never a body.
    """
    require_ids("contacts", id1, id2)
    interaction = O.interactions[id1, id2] if O.interactions.has(id1, id2) else None
    if interaction is None or not interaction.isReal:
        return []
    sign = 1 if interaction.id1 == id1 else -1
    forces = {f[0]: f[1:] for f in interaction.phys.points}
    found = []
    for position, normal, overlap, feature in interaction.geom.points:
        elastic, shear, dashpot = forces.get(feature, (0.0, Vector3.Zero, Vector3.Zero))
        along = dashpot.dot(normal)
        found.append(
            {
                "position": position,
                "normal": sign * normal,
                "overlap": overlap,
                "normal_force": elastic + along,
                "shear_force": sign * (shear + dashpot - along * normal),
            }
        )
    return found


def energy():
    """Terms of the energy balance of the scene now. [J]

    kinetic; gravity (potential, from the reference placement); elastic_contacts, elastic_joints; ground_motion
    (work done by it); dissipated: dashpot_normal, dashpot_shear, friction, broken_springs, lost_contacts (points that
    ceased to exist under load). kinetic + gravity + elastic + dissipated - ground_motion is constant.
    """
    monitor = find_engine(yw.HouseMonitor)
    if monitor is None:
        monitor = yw.HouseMonitor()
    return dict(monitor.energy())


def energy_residual(terms):
    """What the balance of `energy()` leaves over [J]; zero at the start of a scene at rest."""
    return sum(value for name, value in terms.items() if name != "ground_motion") - terms.get("ground_motion", 0.0)


def stable_dt(safety=0.5):
    """Largest stable time step of the elastic contacts and joints as they are now, times `safety`. [s]

    2 / omega_max of the linearised scene (leapfrog; paper, Eq. 44 for one contact), with omega_max^2 the largest eigenvalue of
    M^-1 K by power iteration over all contact points and joint springs. It is sharp for explicit springs without dashpots (sweeps=0)
    and for joints; implicit contacts (the default) are stable beyond it. Contacts that do not touch yet do not count: ask after a
    few steps, or leave a safety for impacts. Infinite when nothing touches.
    """
    solver = find_engine(yw.ContactForces)
    if solver is None:
        raise ValueError("stable_dt: set O.engines = yade_timber.engines(...) first")
    squared = solver.largestEigenvalue()
    return safety * 2 / np.sqrt(squared) if squared > 0 else np.inf
