# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's own Polyhedra. Runs in YADE, without this package.

The law has no dashpots: a contact with restitution 0 is elastic here. NewtonIntegrator.damping is 0, since its default
of 0.2 changes friction and free motion.
"""
import itertools
import math
import time

import numpy as np
import yade.config
import yade.wrapper as yw
from yade import polyhedra_utils
from yade.minieigenHP import Quaternion, Vector3

from mechanics.program import LONGEST, NotPossible, Program, too_late
from mechanics.scene import Recorder, hull_volume, sampling, shaking_motion

O = yw.Omega()
YOUNG = 1e9
"""Force over overlap volume. [N/m3]"""


def corners_of(body):
    """World frame. [m]"""
    half = np.array(body.extents) / 2 if body.extents else None
    points = body.corners or [half * signs for signs in itertools.product((-1, 1), repeat=3)]
    turn = Quaternion(*body.orientation)
    return [Vector3(*body.position) + turn * Vector3(*point) for point in points]


def make_body(body, scene):
    volume = np.prod(body.extents) if body.extents else hull_volume(body.corners)
    material = yw.PolyhedraMat(young=YOUNG, poisson=0.3, frictionAngle=math.atan(scene.friction),
                               density=(body.mass or 1000 * volume) / volume)
    made = polyhedra_utils.polyhedra(material, v=corners_of(body), fixed=body.mass is None)
    if body.mass:
        made.state.vel, made.state.angVel = Vector3(*body.velocity), Vector3(*body.spin)
        start = made.state.ori
        moments = Vector3(*made.state.inertia)
        made.state.angMom = start * Vector3(*(m * w for m, w in zip(moments, start.conjugate() * made.state.angVel)))
    return made


def place(scene, dt):
    """Load a scene; returns {name: id}."""
    O.reset()
    O.dt = dt
    O.engines = [
        yw.ForceResetter(),
        yw.InsertionSortCollider([yw.Bo1_Polyhedra_Aabb()], verletDist=0.01),
        yw.InteractionLoop([yw.Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                           [yw.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                           [yw.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
        yw.NewtonIntegrator(damping=0, gravity=(0, 0, -scene.gravity), exactAsphericalRot=True),
    ]
    for k in range(scene.removed):
        extra = O.bodies.append(polyhedra_utils.polyhedra(yw.PolyhedraMat(), v=[
            Vector3(50 + k + x, y, z) for x, y, z in itertools.product((0, 0.3), repeat=3)]))
        O.bodies.erase(extra)
    return {body.name: O.bodies.append(make_body(body, scene)) for body in scene.bodies}


def state_of(scene, ids):
    """Orientations are relative to the pose in which a body was made: the program turns it to its principal axes."""
    starts = {name: O.bodies[body].state.ori for name, body in ids.items()}

    def state(name):
        now = O.bodies[ids[name]].state
        turn = now.ori * starts[name].conjugate() * Quaternion(*scene.body(name).orientation)
        return now.pos, (turn[3], turn[0], turn[1], turn[2]), now.vel, now.angVel

    return state


def support(scene, ids):
    """Vertical contact force on the weighed body. [N]"""
    if not scene.weighed:
        return None
    return sum(abs(contact.phys.normalForce[2]) for contact in O.interactions
               if contact.isReal and ids[scene.weighed] in (contact.id1, contact.id2))


def drive(scene, ids, time):
    """Velocities and forces of a step that begins at this time."""
    for body in scene.bodies:
        if body.shaken:
            O.bodies[ids[body.name]].state.vel = Vector3(shaking_motion(scene.shaking, time + O.dt / 2)[1], 0, 0)
        if body.torque:
            O.forces.setPermT(ids[body.name], Vector3(0, 0, body.torque))


def run(scene, dt):
    if scene.joints:
        raise NotPossible("no joints")
    if 0 < scene.restitution < 1:
        raise NotPossible("no restitution below 1")
    ids = place(scene, dt)
    since = time.process_time()
    every, count = sampling(scene, dt)
    recorder = Recorder(scene, state_of(scene, ids))
    recorder.sample(0.0, support(scene, ids))
    for k in range(count):
        if time.process_time() - since > LONGEST:
            raise too_late()
        drive(scene, ids, k * dt)
        O.step()
        if (k + 1) % every == 0 or k + 1 == count:
            recorder.sample((k + 1) * dt, support(scene, ids))
    return recorder.trajectory()


def program():
    return Program("YADE Polyhedra", f"YADE {yade.config.version}", f"damping 0, young {YOUNG:g} N/m3; impacts elastic",
                   run, (1e-4,))
