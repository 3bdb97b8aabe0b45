# SPDX-License-Identifier: GPL-2.0-or-later
"""The list of engines of a scene. Needs a running YADE."""
import yade.wrapper as yw
from yade.minieigenHP import Vector3

from ..plugin import compiled
from . import arguments

GRAVITY = tuple(yw.UniformGravity().gravity)  # [m/s2]
BOUND_MARGIN = 5e-3  # distance that bodies may move before the collider runs again [m]; results do not depend on it
_FORCES, _RATIO = yw.ContactForces(), yw.Ip2_TimberMat_TimberMat_TimberPhys().dampingRatio  # with their defaults
O = yw.Omega()


def engines(gravity=GRAVITY, ground_motion=None, joints=None, monitor=None, vertex_edge=True, flush_supports=True,
            increment=False, damping_ratio=_RATIO, sweeps=_FORCES.sweeps, tolerance=_FORCES.tolerance, health_check=100,
            skip_rest=0):
    """List for ``O.engines`` with the engines that the scene needs.

    Parameters
    ----------
    gravity : (3,) array_like
        [m/s2]
    ground_motion : GroundMotion or GroundMotionEngine, optional
        By default none.
    joints : list of TimberJoint, optional
        By default the joints that are in ``O.engines`` already (`connect` adds to them).
    monitor : Sampler or list of them, optional
        By default none.
    vertex_edge : bool
        Whether vertex-edge and vertex-vertex contacts exist too. The paper ignores them: bodies whose edges or corners
        meet then sink into each other by up to the sum of their rounding radii, and more.
    flush_supports : bool
        Whether a face supports vertices exactly over its border.
    increment : bool
        Normal force from increments (Eq. 38) instead of the closed form (Eq. 37).
    damping_ratio : float
        Share of critical damping [-]; below 1, impacts shorter than some ten steps lose more energy than the dashpots
        take (docs/theory.md, section 5).
    sweeps : int
        Most Gauss-Seidel sweeps of the implicit contacts; 0: explicit springs and dashpots as in the paper.
    tolerance : float
        Largest change of an island's contact impulses in the last sweep, relative to the resultant impulses on its
        bodies; smaller at rest. [-]
    health_check : int
        Steps between checks for finite numbers; 0: no check of scene, engines and overlaps at all.
    skip_rest : int
        Number of steps of which one is computed while scene and ground are at rest (``RestSkipper.stride``); 0: all are
        computed.

    Returns
    -------
    list of Engine
    """
    for name, value in (("vertex_edge", vertex_edge), ("flush_supports", flush_supports), ("increment", increment)):
        arguments.flag(f"engines: {name}", value)
    arguments.number("engines: damping_ratio", damping_ratio)
    arguments.count("engines: sweeps", sweeps)
    arguments.positive("engines: tolerance", tolerance)
    chain = [yw.HealthCheck(every=health_check)] if arguments.count("engines: health_check", health_check) else []
    # verletDist = 0: the margin of the boxes and CollisionTrigger replace it, without NewtonIntegrator
    collider = yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb(margin=BOUND_MARGIN)], verletDist=0)
    chain += [yw.ForceResetter(), yw.CollisionTrigger(collider=collider),
              contact_loop(vertex_edge, flush_supports, increment, damping_ratio)]
    if health_check:
        chain.append(yw.OverlapCheck())
    gravity = arguments.vector("engines: gravity", gravity, "m/s2")
    joints = find_engine(yw.JointEngine) if joints is None else joint_engine(joints)
    if ground_motion is not None and not isinstance(ground_motion, yw.GroundMotionEngine):
        ground_motion = ground_motion_engine(ground_motion)
    forces = (joints, yw.UniformGravity(gravity=gravity) if any(gravity) else None, ground_motion)
    chain += [engine for engine in forces if engine is not None]
    chain += [yw.ContactForces(sweeps=sweeps, tolerance=tolerance), yw.SymplecticIntegrator(), *monitors(monitor)]
    if arguments.count("engines: skip_rest", skip_rest):
        chain.append(yw.RestSkipper(stride=skip_rest))
    return chain


def contact_loop(vertex_edge, flush_supports, increment, damping_ratio):
    """ContactLoop with the functors of all laws: YADE ends the process for a pair of materials without one."""
    geometry = yw.Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom(vertexEdge=vertex_edge,
                                                                       flushSupports=flush_supports)
    physics = [getattr(yw, ip2)(dampingRatio=damping_ratio) for ip2, _, _ in compiled.contact_laws()]
    laws = [getattr(yw, law2)() for _, _, law2 in compiled.contact_laws()]
    for law in laws:
        if hasattr(law, "increment"):
            law.increment = increment
    return yw.ContactLoop(loop=yw.InteractionLoop([geometry], physics, laws))


def monitors(given):
    """List of the monitors that the argument of `engines` gives."""
    given = [] if given is None else given if isinstance(given, (list, tuple)) else [given]
    return [arguments.instance("engines: monitor", monitor, yw.Sampler, "a Sampler, a list of them, or None")
            for monitor in given]


def ground_motion_engine(motion, scale=1.0, start=0.0):
    """GroundMotionEngine of a `GroundMotion`; scale [-], start: simulated time of its first sample [s]."""
    if not (hasattr(motion, "dt") and hasattr(motion, "acceleration")):
        arguments.refuse(TypeError, "ground_motion", motion, "a GroundMotion, a GroundMotionEngine or None")
    acceleration = [Vector3(*a) for a in motion.acceleration]
    scale = arguments.number("ground_motion_engine: scale", scale)
    start = arguments.number("ground_motion_engine: start", start, "s")
    return yw.GroundMotionEngine(step=motion.dt, acceleration=acceleration, scale=scale, start=start)


def joint_engine(joints):
    engine, wanted = yw.JointEngine(), "a list of TimberJoint or None"
    for joint in arguments.instance("engines: joints", joints, (list, tuple), wanted):
        engine.append(arguments.instance("engines: joints", joint, yw.TimberJoint, wanted))
    return engine


def find_engine(classes):
    """The first engine of a class, or of one of a tuple of classes, in `O.engines`; None without one."""
    return next((e for e in O.engines if isinstance(e, classes)), None)


def gravity_now():
    """Acceleration of gravity in the scene, from this package's or YADE's engine. [m/s2]"""
    engine = find_engine((yw.UniformGravity, yw.GravityEngine))
    return engine.gravity if engine else Vector3.Zero
