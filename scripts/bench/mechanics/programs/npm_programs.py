# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines of npm by their names, with their defaults; names with `_safe` have settings closer to mechanics."""
from mechanics.programs.npm_engine import engine_program

UNBREAKABLE = ("breaks", "no strength of joints")
AWAKE = {"awake": True}
MUJOCO_SAFE = {"option": 'cone="elliptic" integrator="RK4"'}


def jolt(name="Jolt", more="", **options):
    return engine_program("jolt", name, "jolt-physics", "damping 0, convex radius 1 mm" + more, lacks=(
        ("forces", "no contact forces"), UNBREAKABLE), **options)


def rapier(name="Rapier", more="", **options):
    return engine_program("rapier", name, "@dimforge/rapier3d-compat", "impulse joints" + more, lacks=(UNBREAKABLE,),
                          **options)


def havok(name="Havok", more="", **options):
    return engine_program("havok", name, "@babylonjs/havok", "damping 0, ideal step set" + more, lacks=(UNBREAKABLE,),
                          **options)


def cannon():
    return engine_program("cannon", "cannon-es", "cannon-es", "damping 0, created unrotated", lacks=(UNBREAKABLE,))


def bullet(name="Bullet", more="", **options):
    return engine_program("bullet", name, "ammojs3", "one step a call" + more, one_a_scene=True, **options)


def mujoco(name="MuJoCo", more="defaults", **options):
    return engine_program("mujoco", name, "@mujoco/mujoco", more, lacks=(UNBREAKABLE,), **options)


def jolt_safe():
    return jolt("Jolt, awake", ", no sleeping", options=AWAKE)


def rapier_safe():
    return rapier("Rapier, awake", ", no sleeping", options=AWAKE)


def havok_safe():
    return havok("Havok, awake", ", no sleeping", options=AWAKE)


def bullet_safe():
    return bullet("Bullet, awake", ", no sleeping", options=AWAKE)


def mujoco_safe():
    return mujoco("MuJoCo, elliptic", "elliptic cone, RK4", options=MUJOCO_SAFE)


def physx(name="PhysX", more="", **options):
    return engine_program("physx", name, "physx-js-webidl", "damping 0" + more, **options)


def physx_safe():
    return physx("PhysX, awake", ", no sleeping", options=AWAKE)
