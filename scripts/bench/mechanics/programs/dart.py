# SPDX-License-Identifier: GPL-2.0-or-later
"""DART, from Debian's python3-dartpy. Joints are those of trees, its own form; hulls are read from files only."""
import math
import subprocess
import time

import dartpy
import numpy as np

from mechanics.program import LONGEST, NotPossible, Program, too_late
from mechanics.scene import Recorder, box_inertia, sampling, shaking_motion

D = dartpy.dynamics
TABLE_MASS = 1e6
"""Of a shaken body, whose velocity is set before each step. [kg]"""


def matrix(orientation):
    w, x, y, z = orientation
    return dartpy.math.Quaternion(w, x, y, z).to_rotation_matrix()


def isometry(position, orientation):
    made = dartpy.math.Isometry3()
    made.set_translation(np.asarray(position, float))
    made.set_rotation(matrix(orientation))
    return made


def quaternion(rotation):
    """(w, x, y, z)"""
    made = dartpy.math.Quaternion(rotation)
    return made.w(), made.x(), made.y(), made.z()


class Model:
    """A scene in a DART world."""

    def __init__(self, scene, dt, detector):
        self.scene, self.nodes, self.joints = scene, {}, {}
        self.world = dartpy.simulation.World()
        self.world.setGravity([0, 0, -scene.gravity])
        self.world.setTimeStep(dt)
        if detector:
            self.world.getConstraintSolver().setCollisionDetector(detector())
        for k in range(scene.removed):
            extra = D.Skeleton(f"extra{k}")
            extra.createFreeJointAndBodyNodePair()
            self.world.addSkeleton(extra)
            self.world.removeSkeleton(extra)
        links = {joint.second: joint for joint in scene.joints}
        for body in scene.bodies:
            self.add(body, links.get(body.name))
        for skeleton in {node.getSkeleton().getName(): node.getSkeleton() for node in self.nodes.values()}.values():
            self.world.addSkeleton(skeleton)

    def add(self, body, link):
        if body.corners:
            raise NotPossible("hulls only from files")
        pose = isometry(body.position, body.orientation)
        if link:
            fixed = self.scene.body(link.first).mass is None  # joints to fixed bodies are joints to the world
            parent = None if fixed else self.nodes[link.first]
            skeleton = D.Skeleton(body.name) if fixed else parent.getSkeleton()
            joint, node = self.child(skeleton, parent, link)
            place = np.mean(link.points, axis=0) if link.kind != "spring" else np.asarray(body.position)
            frame = isometry(place, (1, 0, 0, 0))
            inward = parent.getWorldTransform().inverse().multiply(frame) if parent else frame
            joint.setTransformFromParentBodyNode(inward)
            joint.setTransformFromChildBodyNode(pose.inverse().multiply(frame))
        else:
            skeleton = D.Skeleton(body.name)
            if body.mass is None and not body.shaken:
                joint, node = skeleton.createWeldJointAndBodyNodePair()
                joint.setTransformFromParentBodyNode(pose)
            else:
                joint, node = skeleton.createFreeJointAndBodyNodePair()
                joint.setTransform(pose)
                joint.setLinearVelocity(np.asarray(body.velocity, float))
                joint.setAngularVelocity(np.asarray(body.spin, float))
        self.nodes[body.name], self.joints[body.name] = node, joint
        node.setName(body.name)
        self.give_shape(body, node)
        if link and link.kind == "spring":
            joint.setVelocity(0, body.velocity[0])

    def child(self, skeleton, parent, link):
        if link.strength:
            raise NotPossible("no strength of joints")
        if link.kind == "weld":
            return skeleton.createWeldJointAndBodyNodePair(parent)
        if link.kind == "ball":
            return skeleton.createBallJointAndBodyNodePair(parent)
        if link.kind == "hinge":  # an assertion on finite impulses ends the process
            raise NotPossible("contacts at the axis of a hinge")
        joint, node = skeleton.createPrismaticJointAndBodyNodePair(parent)
        joint.setAxis([1, 0, 0])
        joint.setSpringStiffness(0, link.stiffness)
        return joint, node

    def give_shape(self, body, node):
        shape = node.createShapeNode(D.BoxShape(body.extents))
        shape.createCollisionAspect()
        surface = shape.createDynamicsAspect()
        surface.setFrictionCoeff(self.scene.friction)
        surface.setRestitutionCoeff(math.sqrt(self.scene.restitution))
        mass = body.mass or (TABLE_MASS if body.shaken else 1.0)
        inertia = D.Inertia()
        inertia.setMass(mass)
        inertia.setMoment(np.diag(box_inertia(mass, body.extents)))
        node.setInertia(inertia)
        if body.shaken:
            node.setGravityMode(False)

    def state(self, name):
        node = self.nodes[name]
        pose = node.getWorldTransform()
        return (np.ravel(pose.translation()), quaternion(pose.rotation()), np.ravel(node.getLinearVelocity()),
                np.ravel(node.getAngularVelocity()))

    def drive(self, time):
        for body in self.scene.bodies:
            if body.shaken:
                joint, dt = self.joints[body.name], self.world.getTimeStep()
                x, _ = shaking_motion(self.scene.shaking, time)
                later, _ = shaking_motion(self.scene.shaking, time + dt)
                place = np.asarray(body.position, float) + (x, 0, 0)
                joint.setTransform(isometry(place, body.orientation))
                joint.setLinearVelocity(np.array([(later - x) / dt, 0, 0]))
                joint.setAngularVelocity(np.zeros(3))

    def support(self):
        if not self.scene.weighed:
            return None
        return sum(abs(np.ravel(contact.force)[2]) for contact in self.world.getLastCollisionResult().getContacts())


def runner(detector):
    def run(scene, dt):
        model, since = Model(scene, dt, detector), time.process_time()
        every, count = sampling(scene, dt)
        recorder = Recorder(scene, model.state)
        recorder.sample(0.0, None)
        for k in range(count):
            if time.process_time() - since > LONGEST:
                raise too_late()
            model.drive(k * dt)
            model.world.step()
            if (k + 1) % every == 0 or k + 1 == count:
                recorder.sample((k + 1) * dt, model.support())
        return recorder.trajectory()

    return run


def version():
    return subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "python3-dartpy"], capture_output=True, text=True,
                          check=True).stdout


def variant(name, settings, detector):
    return Program(name, f"python3-dartpy {version()}", settings + "; joints of trees", runner(detector),
                   (1 / 60, 1 / 240, 1 / 1000), lacks=(("breaks", "no strength of joints"),))


def program():
    return variant("DART", "Bullet's detector", dartpy.collision.BulletCollisionDetector)


def fcl():
    return variant("DART FCL", "FCL, the default detector", None)
