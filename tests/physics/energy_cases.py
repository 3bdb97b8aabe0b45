# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 7: input by ground motion and gravity = kinetic + elastic + dissipated, over time and against the time step."""
import math

import reference_frame
import yade.wrapper as yw
import yade_timber as yt
from planar_scene import build_frame, recorded
from rows import Registry, Row, observed_order
from yade.minieigenHP import Vector3
from yade_timber import motion
from yade_timber.scene import scenario
from yade_timber.scene import engines as scene

case = Registry()
O = yw.Omega()
EVERY = 0.01
"""Between two looks at the balance. [s]"""
DEFAULT = scenario.DEFAULT_DT
"""Time step of the house scenarios. [s]"""
REQUIRED = 1e-3
"""Of the input [-]; held against DEFAULT, where light members hit each other within a step or two against half of it."""


def shaken_portal(dt, scale=1.0, strength=None, beam=0.3):
    """The portal frame of item 9. scale: of the ground motion [-], strength: of the springs [N], None: unbreakable."""
    shake = yw.GroundMotionEngine(
        step=reference_frame.SAMPLE, acceleration=[Vector3(scale * a, 0, 0) for a in reference_frame.ground_samples()], start=0.1
    )
    build_frame(reference_frame.portal(beam), dt, ground_motion=shake)
    if strength is not None:
        for joint in scene.find_engine(yw.JointEngine).joints:
            joint.strength = strength


def shaken_house(dt, house="B", start=18.5):
    """A house in the default ground motion, which sets in at `start` of the record: strong shaking at once."""
    O.reset()
    scenario.build(scenario.Scenario("energy", house, motion=motion.default_motion(), dt=dt))
    scene.find_engine(yw.GroundMotionEngine).start = -start


def balance(duration):
    """History of the balance: terms {name: (m,) [J]}, and under 'input' the ground motion's work and gravity's, under
    'residual' what the balance leaves over."""
    names = sorted(yt.energy())
    rows = recorded(duration, EVERY, lambda: [yt.energy()[n] for n in names] + [yt.energy_residual(yt.energy())])
    terms = dict(zip(names, rows.T))
    return {**terms, "input": terms["ground_motion"] - terms["gravity"], "residual": rows[:, -1] - rows[0, -1]}


def share(history):
    """Largest residual over largest input. [-]"""
    return abs(history["residual"]).max() / abs(history["input"]).max()


def closing(name, build, duration, judged, dts=(DEFAULT, DEFAULT / 2, DEFAULT / 4), note="", least_order=1.0):
    """Rows of the residual for several steps; `judged`: the largest step that the requirement is held against.

    What remains is the work of Hertz's force over a step: force at the step's ends times the way, against the energy between.
    It is second order while an impact lasts several steps. Where a light member meets another at metres per second the whole
    impact lasts one or two, the first touch falls anywhere in a step, and the dashpots let nothing of it come back.
    """
    shares = []
    for dt in dts:
        build(dt)
        shares.append(share(balance(duration)))
    order = observed_order(dts, shares)
    bounds = [REQUIRED if dt <= judged * 1.001 else math.inf for dt in dts]
    rows = [Row("7", f"{name}: residual / input [-]", 0, s, bound=b, dt=dt, note=note) for s, b, dt in zip(shares, bounds, dts)]
    rows[-1].order, rows[-1].least_order = order, least_order
    return rows


@case
def loaded_portal():
    """Beam of 880 kg: feet slide and lift. Seen: 3e-5, 9e-6, 1e-6."""
    return closing("loaded portal, shaken", lambda dt: shaken_portal(dt, beam=1.0), 1.0, DEFAULT)


@case
def light_portal():
    """Beam of 80 kg, on columns of 9 kg. Seen: 1.3e-3, 1.9e-4, 4e-5; a column lands with 3 m/s in one step."""
    return closing("light portal, shaken", shaken_portal, 1.0, DEFAULT / 2, note="impacts of 9 kg members last a few steps")


@case
def falling_frame():
    """Springs of 2 kN break, the frame falls apart. Seen: 7.2e-3, 2.0e-4, 1.5e-5: the brace's blow at 3 m/s, over in two steps."""
    return closing("frame, breaks and falls", lambda dt: shaken_portal(dt, 3.0, 2000.0), 1.5, DEFAULT / 2, note="impacts of 4 kg members last one step")


@case
def house_in_strong_shaking(duration=0.25, dts=(DEFAULT, DEFAULT / 2)):
    """House B, strong shaking at once. Seen: 2.9e-5, 1.3e-5 of 1 kJ; too little of a slope for an order."""
    return closing("house B, strong shaking", shaken_house, duration, DEFAULT, dts, least_order=None)


def blow(speed, dt, share):
    """A brace (2.8 kg) that flies upright against a plate; share: of the step in which it touches. Returns the residual over its kinetic energy. [-]"""
    O.reset()
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    brace = yt.box((0.045, 0.09, 2.0), (0, 0, 1.001 + share * speed * dt))
    O.bodies.append(brace)
    O.engines, O.dt = yt.engines(gravity=(0, 0, 0)), dt
    yt.set_velocity(brace, (0, 0, -speed))
    O.run(1, True)
    kinetic, before = yt.energy()["kinetic"], yt.energy_residual(yt.energy())
    O.run(math.ceil(0.01 / dt), True)
    return (yt.energy_residual(yt.energy()) - before) / kinetic


@case
def blows_of_a_step_or_two():
    """Four points that each stop it within a step. Seen: 5e-11, 0.09, 0.04, where a step is most of the way out, over which Hertz's law is
    not linear; 1.1, 1.5 and 1.7 while new points were booked as if they flew on."""
    shares = [(k + 0.5) / 16 for k in range(16)]
    return [
        Row("7", f"blow of a brace, {v:g} m/s: residual / kinetic [-]", 0, max((blow(v, DEFAULT, s) for s in shares), key=abs), bound=bound, dt=DEFAULT, note="over in two steps")
        for v, bound in ((5.0, 1e-9), (10.0, 0.1), (20.0, 0.1))
    ]
