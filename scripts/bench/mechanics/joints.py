# SPDX-License-Identifier: GPL-2.0-or-later
"""Welds, springs and joints that break."""
import math
from dataclasses import replace

from mechanics.rows import EXACT, add, constant
from mechanics.scene import Body, Joint, Scene

# --- beam of welds ----------------------------------------------------------------------------------------------------
GAP = 0.002
"""Between the boxes of the beam, so that they do not touch. [m]"""


def beam(radius):
    """Ten boxes of 2 kg, welded in a row of 2 m to a fixed block; a weld has the corners of 0.1 x 0.1 m."""
    bodies, welds = [Body("wall", (-0.1, 0, 2), (0.2 - GAP, 0.3, 0.3))], []
    for k in range(10):
        bodies.append(Body(f"box{k}", (0.1 + 0.2 * k, 0, 2), (0.2 - GAP, 0.1, 0.1), mass=2.0))
        points = tuple((0.2 * k, y, 2 + z) for y in (-0.05, 0.05) for z in (-0.05, 0.05))
        welds.append(Joint("weld", bodies[-2].name, bodies[-1].name, points))
    return [Scene("beam", 0.5, tuple(bodies), tuple(welds), sample=0.002)]


def droop(run):
    """Of the last box, mean of the second half. [mm]"""
    return float(1e3 * (2 - run.position["box9"][run.times > 0.25, 2].mean()))


def softer(scene):
    return replace(scene, joints=tuple(replace(joint, stiffness=1e7) for joint in scene.joints))


add(key="beam", title="beam of welds: droop", unit="mm", scenes=beam, measure=droop,
    expected=constant(0.0), bound=5.0, source="rigid beam", needs=frozenset({"weld"}), fault=softer)

# --- spring and mass --------------------------------------------------------------------------------------------------
STIFFNESS, SPRING_MASS, AMPLITUDE = 1000.0, 10.0, 0.1
OMEGA = math.sqrt(STIFFNESS / SPRING_MASS)


def oscillator(radius):
    """A mass on a spring along x, struck to an amplitude of 0.1 m."""
    bodies = (Body("anchor", (-1, 0, 0), (0.2, 0.2, 0.2)),
              Body("mass", (0, 0, 0), (0.2, 0.2, 0.2), mass=SPRING_MASS, velocity=(AMPLITUDE * OMEGA, 0, 0)))
    return [Scene("spring", 19.0, bodies, (Joint("spring", "anchor", "mass", ((0.0, 0, 0),), STIFFNESS),), gravity=0.0)]


def last_amplitude(run):
    """Largest displacement in the last second over that of the closed form."""
    return float(abs(run.position["mass"][run.times > run.times[-1] - 1.0, 0]).max() / AMPLITUDE)


add(key="spring", title="spring and mass: amplitude", unit="-", scenes=oscillator,
    measure=last_amplitude, expected=constant(1.0), bound=0.02, source="no damping", needs=frozenset({"spring"}),
    fault=lambda scene: replace(scene, joints=(replace(scene.joints[0], stiffness=900.0),)))

# --- joints that break ------------------------------------------------------------------------------------------------
STRENGTH, RATE = 1000.0, 500.0
"""[N], [N/s]"""


def pulled(radius):
    """A joint of 1000 N under a force that grows by 500 N/s."""
    bodies = (Body("anchor", (-1, 0, 0), (0.2, 0.2, 0.2)),
              Body("mass", (0, 0, 0), (0.2, 0.2, 0.2), mass=1.0, force_rate=RATE))
    return [Scene("pulled", 2.1, bodies, (Joint("weld", "anchor", "mass", ((0, 0, 0),), 58800.0, STRENGTH),),
                  gravity=0.0)]


def break_force(run):
    """Force on the body when its joint broke over the strength."""
    return RATE * run.broken / STRENGTH


def stronger(scene):
    joint = scene.joints[0]
    return replace(scene, joints=(replace(joint, strength=1.1 * joint.strength),))


add(key="pulled", title="slow pull: break over strength", unit="-", scenes=pulled, measure=break_force,
    expected=constant(1.0), bound=EXACT, source="statics", needs=frozenset({"breaks"}), fault=stronger)

HAMMER, SPEED, STIFF = 10.0, 10.0, 1e8
"""Mass [kg] and velocity [m/s] of the hammer; stiffness of the joint [N/m]."""


def struck(radius):
    """A body of 10 kg on a stiff joint of 1000 N is struck by a hammer of 100 N s."""
    bodies = (Body("anchor", (-0.5, 0, 0), (0.1, 0.1, 0.1)), Body("mass", (0, 0, 0), (0.2, 0.2, 0.2), mass=10.0),
              Body("hammer", (0.2001, 0, 0), (0.2, 0.2, 0.2), mass=HAMMER, velocity=(-SPEED, 0, 0)))
    return [Scene("struck", 0.02, bodies, (Joint("weld", "anchor", "mass", ((0, 0, 0),), STIFF, STRENGTH),),
                  gravity=0.0)]


def taken_impulse(run):
    """Momentum that the joint took, over that of the hammer; nothing breaks: 1."""
    if not math.isfinite(run.broken):
        return 1.0
    left = sum(10.0 * run.velocity[name][-1, 0] for name in ("mass", "hammer"))
    return float(abs(1 + left / (HAMMER * SPEED)))


def largest_share(radius):
    """A joint of strength S and stiffness k takes S²/2k of energy at most; of a momentum m v that is S²/(2 k m v²)."""
    return STRENGTH**2 / (2 * STIFF) / (HAMMER * SPEED**2)


add(key="struck", title="struck stiff joint: impulse share", unit="-", scenes=struck, measure=taken_impulse,
    expected=largest_share, bound=EXACT, source="energy to break S² / 2k", needs=frozenset({"breaks"}),
    fault=lambda scene: replace(scene, joints=(replace(scene.joints[0], strength=1e6),)))
