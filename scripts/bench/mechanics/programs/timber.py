# SPDX-License-Identifier: GPL-2.0-or-later
"""This package. Runs in YADE."""
import math

import numpy as np
import yade.config
import yade.wrapper as yw
import yade_timber as yt
from yade.minieigenHP import Quaternion, Vector3

from mechanics.program import Program
from mechanics.scene import Recorder, hull_volume, sampling, shaking_motion

O = yw.Omega()
RADIUS = 1e-3
"""Rounding of edges. [m]"""
SHAKING_STEP = 1e-3
"""Between the samples of a ground motion, which is linear between them. [s]"""


def damping_ratio(restitution):
    """Of four points of a flat face: zeta_c = 2 zeta (6/5)^½ for Hertz's law (theory.md, section 5).
    1 for restitution 0.
    """
    if restitution == 0:
        return 1.0
    low, high = 0.0, 1.0 - 1e-12
    for _ in range(60):
        middle = (low + high) / 2
        if math.exp(-2 * middle * math.acos(middle) / math.sqrt(1 - middle**2)) > restitution:
            low = middle
        else:
            high = middle
    return 0.0 if restitution == 1 else low / (2 * math.sqrt(1.2))


def quaternion(orientation):
    w, x, y, z = orientation
    return Quaternion(w, x, y, z)


def make_body(body, scene):
    """A YADE body with this mass."""
    volume = np.prod(body.extents) if body.extents else hull_volume(body.corners)
    material = yt.timber(density=(body.mass or 1000 * volume) / volume, friction=scene.friction)
    if body.extents:
        return yt.box(body.extents, body.position, quaternion(body.orientation), material, body.mass is None, RADIUS)
    corners = np.asarray(body.corners) + body.position
    return yt.polyhedron(corners, material, body.mass is None, RADIUS)


def ground_motion(scene):
    """The shaking in the frame of the table."""
    if not scene.shaking:
        return None
    times = np.arange(round(scene.duration / SHAKING_STEP) + 2) * SHAKING_STEP
    levels = scene.shaking[0] * np.sin(2 * math.pi * scene.shaking[1] * times)
    return yt.GroundMotionEngine(step=SHAKING_STEP, acceleration=[Vector3(a, 0, 0) for a in levels], start=0)


def remove_some(count):
    """Add and remove bodies far away."""
    for body in [O.bodies.append(yt.box((0.3, 0.3, 0.3), (50 + k, 0, 5))) for k in range(count)]:
        O.bodies.erase(body)


def place(scene, dt):
    """Load a scene; returns {name: id}."""
    O.reset()
    O.dt = dt
    O.engines = yt.engines(gravity=(0, 0, -scene.gravity), ground_motion=ground_motion(scene),
                           damping_ratio=damping_ratio(scene.restitution))
    remove_some(scene.removed)
    ids = {body.name: O.bodies.append(make_body(body, scene)) for body in scene.bodies}
    for body in scene.bodies:
        velocity = np.array(body.velocity)
        if scene.shaking:
            velocity -= (shaking_motion(scene.shaking, 0.0)[1], 0, 0)
        if body.mass and (np.any(velocity) or np.any(body.spin)):
            yt.set_velocity(ids[body.name], tuple(velocity), body.spin)
        if body.torque:
            O.forces.setPermT(ids[body.name], Vector3(0, 0, body.torque))
    for joint in scene.joints:
        yt.connect(ids[joint.first], ids[joint.second], joint.points, stiffness=(joint.stiffness,) * 2,
                   strength=joint.strength or math.inf, damping_ratio=1.0 if joint.kind == "hinge" else 0.0)
    return ids


def state_of(ids):
    def state(name):
        now = O.bodies[ids[name]].state
        return now.pos, (now.ori[3], now.ori[0], now.ori[1], now.ori[2]), now.vel, now.angVel
    return state


def support(scene, ids):
    """Vertical contact force on the weighed body. [N]"""
    if not scene.weighed:
        return None
    return sum(point["normal_force"] for point in yt.contacts(ids["floor"], ids[scene.weighed]))


def break_time():
    """Of the first broken spring [s]; NaN without one."""
    breaks = [event for engine in O.engines if isinstance(engine, yt.JointEngine) for event in engine.breaks]
    return breaks[0].time if breaks else math.nan


def run(scene, dt):
    ids = place(scene, dt)
    every, count = sampling(scene, dt)
    recorder = Recorder(scene, state_of(ids))
    pulled = [(ids[body.name], body.force_rate) for body in scene.bodies if body.force_rate]
    recorder.sample(0.0, support(scene, ids))
    for k in range(count):
        for body, rate in pulled:
            O.forces.setPermF(body, Vector3(rate * (k + 1) * dt, 0, 0))
        O.step()
        if (k + 1) % every == 0 or k + 1 == count:
            recorder.sample((k + 1) * dt, support(scene, ids))
    recorder.broken = break_time() if any(joint.strength for joint in scene.joints) else math.nan
    return recorder.trajectory()


def program():
    return Program("this package", yt.__version__, f"YADE {yade.config.version}, edges rounded by 1 mm", run,
                   (5e-4, 1e-4, 2e-5), RADIUS)
