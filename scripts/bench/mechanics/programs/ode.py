# SPDX-License-Identifier: GPL-2.0-or-later
"""ODE, from Debian's libode-dev: ode.cpp is compiled on first use. Boxes alone."""
from mechanics.program import NotPossible, Program
from mechanics.programs.compiled import compiled, debian_version, described, ran


def run(scene, dt):
    if any(body.corners for body in scene.bodies):
        raise NotPossible("inertia is an input")
    if any(joint.strength for joint in scene.joints):
        raise NotPossible("no strength of joints")
    return ran(compiled("ode"), described(scene, dt), scene)


def program():
    return Program("ODE", f"libode {debian_version('libode-dev')}", "dWorldStep, 8 contacts a pair", run,
                   (1 / 60, 1 / 240, 1 / 1000))
