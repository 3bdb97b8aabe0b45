# SPDX-License-Identifier: GPL-2.0-or-later
"""Random scenes with joints of all kinds: brittle by spring and by joint, stiff, yielding, damped."""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from scene_judge import G, Plan
from scene_parts import append, ground, shaking, start
from scene_shapes import placed
from yade_timber.scene.engines import find_engine

O = yw.Omega()

STIFFNESS = (1e7, 1e9)
"""Of a spring of a stiff joint. [N/m]"""
STRETCH = (1e-3, 3e-2)
"""Of other springs at their strength. [m]"""
DAMPINGS = (0.0, 0.03, 1.0)
"""Ratios. [-]"""


def springs(random, capacity, count, kinds=("spring", "joint", "stiff", "slip")):
    """Arguments of `yt.connect` for a joint of `count` springs that carries `capacity` [N]."""
    kind = random.choice(kinds)
    per = "joint" if kind == "joint" else random.choice(("spring", "joint"))
    strength = capacity if per == "joint" else capacity / count
    stretch = np.exp(random.uniform(*np.log(STRETCH)))
    stiffness = np.exp(random.uniform(*np.log(STIFFNESS))) if kind == "stiff" else strength / stretch
    slip = None
    if kind == "slip":
        softening = strength / stiffness * random.uniform(2, 5)
        slip = yt.SlipLaw(softening, softening * random.uniform(2, 4), random.uniform(0.1, 1))
    return {"stiffness": (stiffness, stiffness), "strength": strength, "per": str(per), "slip": slip,
            "damping_ratio": random.choice(DAMPINGS)}


def corners(x, y, z, dx, dy):
    """Points of the springs: corners of a rectangle at height z. [m]"""
    return [(x + sx * dx, y + sy * dy, z) for sx in (-1, 1) for sy in (-1, 1)]


def breaks():
    return find_engine(yw.JointEngine).breaks


def momentum():
    """Of the free bodies along x. [N s]"""
    return sum(b.state.mass * b.state.vel[0] for b in O.bodies if b.dynamic)


def hammer(random):
    """A block on a joint is struck: the joint takes at most its strength times the time that it holds."""
    masses, speed = 10 ** random.uniform(0, 2, 2), random.uniform(2, 10)
    anchor = append(yt.box((0.1, 0.1, 0.1), (-0.6, 0, 5), fixed=True))
    block = append(placed(yt.box, (0.2, 0.2, 0.2), (0, 0, 5), masses[0]))
    head = append(placed(yt.box, (0.2, 0.2, 0.2), (0.2001, 0, 5), masses[1]))
    start(gravity=(0, 0, 0))
    capacity = 10 ** random.uniform(2, 4)
    joint = springs(random, capacity, 4) | {"damping_ratio": 0.0}
    yt.connect(anchor, block, [(-0.1, y, 5 + z) for y in (-0.05, 0.05) for z in (-0.05, 0.05)], **joint)
    yt.set_velocity(O.bodies[head], (-speed, 0, 0))
    duration, before = 0.3 / speed, momentum()

    def answer():
        held = breaks()[-1].time if len(breaks()) == 4 else duration
        taken, most = abs(momentum() - before), capacity * (held + 2 * O.dt)
        return [] if taken <= most else [f"joint took {taken:.2g} N s, at most {most:.2g}"]

    return Plan(duration, speed=speed, rests=False, answer=answer)


def chain(random):
    """Bodies of four decades hang on joints that hold six times the weight below them, and swing."""
    count = random.integers(2, 8)
    masses = random.permutation(np.geomspace(0.2, 400, count))
    top = 0.35 * count + 1
    above = append(yt.box((0.3, 0.3, 0.3), (0, 0, top + 0.155), fixed=True))
    links = []
    for k, mass in enumerate(masses):
        body = append(placed(yt.box, (0.2, 0.2, 0.3), (0, 0, top - 0.15 - 0.31 * k), mass))
        links.append((above, body, top - 0.31 * k, G * masses[k:].sum()))
        above = body
    start()
    for first, second, z, load in links:
        yt.connect(first, second, corners(0, 0, z, 0.08, 0.08), **springs(random, 6 * load, 4))
    push = random.uniform(0, 0.3)
    yt.set_velocity(O.bodies[above], (push, push, 0))
    return Plan(5.0, speed=push, rests=False, answer=lambda: [f"{len(breaks())} springs broke"] if breaks() else [])


def slip_chain(random):
    """Light bodies on yielding joints, pulled until these break."""
    count, mass = random.integers(1, 11), 10 ** random.uniform(-1, 1)
    before = append(yt.box((0.1, 0.1, 0.1), (0, 0, 5), fixed=True))
    links = []
    for k in range(count):
        body = append(placed(yt.box, (0.1, 0.1, 0.1), (0.15 * (k + 1), 0, 5), mass))
        links.append((before, body, 0.15 * k + 0.075))
        before = body
    start(gravity=(0, 0, 0))
    for first, second, x in links:
        points = [(x, y, 5 + z) for y in (-0.04, 0.04) for z in (-0.04, 0.04)]
        stiffness, strength = 10 ** random.uniform(5, 7.3), 10 ** random.uniform(2, 4)
        softening = strength / stiffness * random.uniform(1.5, 5)
        yt.connect(first, second, points, stiffness=(stiffness, stiffness), strength=strength,
                   damping_ratio=random.choice(DAMPINGS),
                   slip=yt.SlipLaw(softening, softening + random.uniform(0.005, 0.02), random.uniform(0, 1)))
    speed = random.uniform(1, 5)
    yt.set_velocity(O.bodies[before], (speed, *random.uniform(-1, 1, 2)), random.uniform(-5, 5, 3))
    return Plan(1.0, speed=2 * speed, rests=False)


def frame(random):
    """A slab on posts with joints of all kinds, shaken; one post is erased in the run."""
    floor = ground()
    height, breadth = random.uniform(1.0, 2.5), random.uniform(0.08, 0.15)
    thick = random.uniform(0.1, 0.3)
    posts = [append(placed(yt.box, (breadth, breadth, height), (x, y, height / 2), 10 ** random.uniform(0, 1.5)))
             for x in (-1, 1) for y in (-1, 1)]
    mass = 10 ** random.uniform(2, 3.7)
    slab = append(placed(yt.box, (2.4, 2.4, thick), (0, 0, height + thick / 2), mass))
    motion, speed = shaking(random, random.uniform(1, 8), 6.0)
    start(motion)
    for post in posts:
        x, y, _ = O.bodies[post].state.pos
        for other, z in ((floor, 0.0), (slab, height)):
            yt.connect(other, post, corners(x, y, z, breadth / 2, breadth / 2),
                       **springs(random, G * mass * random.uniform(0.2, 2), 4))
    events = [(4.0, lambda: O.bodies.erase(posts[0]))] if random.random() < 0.5 else []
    return Plan(9.0, events, speed=speed, rests=False)
