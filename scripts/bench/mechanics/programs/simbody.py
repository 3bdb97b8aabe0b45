# SPDX-License-Identifier: GPL-2.0-or-later
"""Simbody, from Debian's libsimbody-dev: simbody.cpp is compiled on first use. Compliant contacts of bricks with one
half space; joints are those of trees, its own form.
"""
import itertools
import math

from mechanics.program import NotPossible, Program
from mechanics.programs.compiled import compiled, debian_version, described, ran

STIFFNESS, DISSIPATION = 1e7, 1.0
"""Of a contact material [N/m at a corner, s/m]; without dissipation where the restitution is 1."""


def meets_bricks(scene):
    """Whether two bricks may touch: more than one floor, a hinge (of falling blocks), or bodies within reach."""
    if scene.joints:
        return any(joint.kind == "hinge" for joint in scene.joints)
    free = [body for body in scene.bodies if body.mass]
    near = any(math.dist(first.position, second.position) < math.hypot(*first.extents)
               for first, second in itertools.combinations(free, 2))
    return near or len(scene.bodies) - len(free) > 1


def refuse(scene):
    if any(body.corners for body in scene.bodies):
        raise NotPossible("inertia is an input")
    if any(joint.strength for joint in scene.joints):
        raise NotPossible("no strength of joints")
    if 0 < scene.restitution < 1:
        raise NotPossible("no restitution below 1 but by velocity")
    if meets_bricks(scene):
        raise NotPossible("bricks meet half spaces alone")


def variant(name, accuracy, transition):
    """transition: velocity of sliding at which friction is full [m/s]."""
    def run(scene, dt):
        refuse(scene)
        text = f"{STIFFNESS} {DISSIPATION} {accuracy} {transition} {described(scene, dt)}"
        return ran(compiled("simbody"), text, scene)

    return Program(name, f"libsimbody {debian_version('libsimbody-dev')}",
                   f"accuracy {accuracy:g}, stiffness {STIFFNESS:g}, dissipation {DISSIPATION:g} s/m (0 where e is 1), "
                   f"transition {transition:g} m/s", run, (1 / 1000,), lacks=(("breaks", "no strength of joints"),))


def program():
    return variant("Simbody", 1e-3, 1e-2)


def safe():
    return variant("Simbody, accurate", 1e-6, 1e-4)
