# SPDX-License-Identifier: GPL-2.0-or-later
"""Random scenes that are not houses, each judged by `scene_judge`: piles, stacks, arches, walls, towers, posts, joints,
erased and added bodies, shaking, members that are struck.

`yade -j1 -n -x tests/stress/scenes.py [FAMILY | NUMBER | FIRST-LAST]...` prints the table, row by row.
"""
import itertools
import sys
from functools import partial
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import numpy as np
import scene_judge
import yade.wrapper as yw
import yade_timber as yt
from scene_joints import chain, frame, hammer, slip_chain
from scene_judge import Plan
from scene_parts import append, container, ground, masses, shaking, start
from scene_shapes import lump, placed, prism, ring, solid
from scipy.spatial import ConvexHull

O = yw.Omega()

LONG = 10.5
"""Duration of a scene that must be at rest after 10 s. [s]"""
SHORT = 3.0
"""Duration of a scene that is at rest from the start. [s]"""


# --- families ---------------------------------------------------------------------------------------------------------
def pile(random, side=1.1):
    """Bodies of all shapes and masses fall into a container."""
    container(side, 3.0)
    count = random.integers(9, 17)
    for k, mass in enumerate(masses(random, count)):
        cell = np.array([k % 3 - 1, k // 3 % 3 - 1, k // 9]) * 0.36 + [0, 0, 0.3]
        append(solid(lump(random, random.uniform(0.1, 0.165)), cell + random.uniform(-0.02, 0.02, 3), mass,
                     random.uniform(0.3, 0.8)))
    start()
    return Plan(LONG)


def stack(random):
    """Boards of 0.2 to 2 kg between blocks of 200 to 2400 kg, laid or dropped from 2 cm; or a slab on small cubes."""
    ground()
    if random.random() < 0.3:
        return slab_on_cubes(random)
    top, gap = 0.0, random.choice((0.0, 0.02))
    count = random.integers(4, 9)
    for k in range(count):
        side = random.uniform(0.4, 0.6)
        mass, height = ((10 ** random.uniform(-0.7, 0.3), random.uniform(0.01, 0.03)) if k % 2 == 0 else
                        (10 ** random.uniform(2.3, 3.4), random.uniform(0.3, 0.6)))
        at = (*random.uniform(-0.02, 0.02, 2), top + gap + height / 2)
        append(placed(yt.box, (side, side, height), at, mass, yaw=random.uniform(-0.1, 0.1)))
        top += gap + height
    start()
    return Plan(LONG + 5, stands=count * gap + (0.1 if gap else 2e-3))  # blocks on light boards swing


def slab_on_cubes(random):
    """A slab of 1 to 10 t on one to four cubes of 1 kg."""
    count, cube = random.integers(1, 5), random.uniform(0.09, 0.15)
    for x, y in ring(count, 0.0 if count == 1 else 0.4):
        append(placed(yt.box, [cube] * 3, (x, y, cube / 2), 1.0, yaw=random.uniform(0, 1)))
    side = 1.2 if count > 2 else 0.6
    if count == 2:  # a ridge: the slab stands on the breadth of the cubes
        side = 1.0
    append(placed(yt.box, (side, side, 0.5), (*random.uniform(-0.1, 0.1, 2) * cube, cube + 0.25),
                  10 ** random.uniform(3, 4)))
    start()
    return Plan(LONG, stands=5e-3)


def arch(random, key=None):
    """A semicircle of voussoirs on abutments, thicker than the limit t / R = 0.107 (Heyman 1969) without the rounded
    edges; its crown is loaded, or an abutment gives way by 0.4 % of the radius."""
    ground()
    count, mean = 2 * random.integers(3, 11) + 1, random.uniform(1.0, 2.5)
    thick, depth = mean * random.uniform(0.25, 0.4), random.uniform(0.3, 0.8)
    friction, density = random.uniform(0.6, 0.8), random.uniform(300, 2400)
    foot, inner, outer = random.uniform(0.3, 0.6), mean - thick / 2, mean + thick / 2
    feet = [append(yt.box((1.5 * thick, 1.5 * depth, foot), (sign * mean, 0, foot / 2),
                          material=yt.timber(friction=friction), fixed=True)) for sign in (-1, 1)]
    angles = np.linspace(0, np.pi, count + 1)
    ids = []
    for a, b in itertools.pairwise(angles):
        corners = [(r * np.cos(t), y, foot + r * np.sin(t))
                   for r in (inner, outer) for t in (a, b) for y in (-depth / 2, depth / 2)]
        ids.append(append(yt.polyhedron(corners, yt.timber(density=density, friction=friction))))
    if key is not None:
        key.append(ids[count // 2])
    start()
    events, kind = [], random.integers(3)
    if kind == 1:
        give = lambda speed: setattr(O.bodies[feet[1]].state, "vel", (speed, 0, 0))
        events = [(0.5, lambda: give(0.004 * mean)), (1.5, lambda: give(0.0))]
    elif kind == 2:
        load = 0.1 * sum(O.bodies[k].state.mass for k in ids)
        top = foot + outer * np.cos(np.pi / count / 2)
        events = [(1.0, lambda: append(placed(yt.box, (0.3 * mean / count, 0.5 * depth, 0.3), (0, 0, top + 0.151),
                                              load)))]
    return Plan(LONG, events, stands=0.02 * mean)


def wall(random):
    """A dry wall in random bond; shaken by 0.3 of the least acceleration that rocks or slides it, or by 3 times it."""
    friction, thick = random.uniform(0.5, 0.8), random.uniform(0.2, 0.4)
    append(yt.box((40, 40, 1), (0, 0, -0.5), material=yt.timber(friction=friction), fixed=True))
    length, gap, top = random.uniform(1.2, 2.4), random.choice((0.0, 1e-4, 2e-3)), 0.0
    material = yt.timber(friction=friction, density=10 ** random.uniform(2.5, 3.4))
    for _ in range(random.integers(3, 7)):
        height = random.uniform(0.12, 0.3)
        ends = np.cumsum(np.r_[-length / 2, random.dirichlet(np.full(random.integers(3, 7), 8.0)) * length])
        for a, b in itertools.pairwise(ends):
            append(yt.box((b - a - gap, thick, height), ((a + b) / 2, 0, top + height / 2), material=material))
        top += height
    kind = random.integers(3)
    if kind == 0:
        start()
        return Plan(SHORT, stands=2e-3)
    least = 9.81 * min(friction, 0.8 * thick / top)
    motion, speed = shaking(random, (0.3 if kind == 1 else 3) * least, 4.0, vertical=0.3)
    start(motion)
    return Plan(5.0 if kind == 1 else 14.5, stands=0.01 if kind == 1 else None, speed=speed, rests=kind == 1)


def tower(random):
    """Prisms one on the other: shifted by up to a twentieth of their breadth, or equal ones shifted by the tolerance of
    flush faces, 0.1 mm.
    """
    ground()
    radius, sides, yaw = random.uniform(0.15, 0.8), random.integers(3, 17), random.choice((0.0, random.uniform(0, 1)))
    equal, flush = random.random() < 0.75, random.random() < 0.6
    shift = 1e-4 * (1 + random.choice((0, 1e-3, 1e-6)) * random.uniform(-1, 1)) if flush else (
        radius * 10 ** random.uniform(-6, -1.3))
    if equal and random.random() < 0.6:
        sides, yaw = 4, np.pi / 4
    top, density = 0.0, 10 ** random.uniform(2, 3.5, 2)
    for k in range(2 if flush else random.integers(2, 9)):
        if not equal:
            sides, yaw = random.integers(3, 17), random.uniform(0, 6)
        height = random.uniform(0.2, 1.0) * radius
        offset = shift * (random.choice((-1, 1), 2) * (k % 2) if equal else random.uniform(-1, 1, 2))
        append(yt.polyhedron(prism(sides, radius, height, yaw) + [*offset, top + height / 2],
                             yt.timber(density=density[k % 2]), fixed=flush and k == 0))
        top += height
    start()
    return Plan(SHORT, stands=2e-3)


def post(random):
    """A post over the seam of two or four slabs, which are fixed, or lie on the ground: on their level faces, or a
    square one on their rounded edges."""
    fixed, thick, four = random.random() < 0.5, 10 ** random.uniform(-1.3, 0.3), random.random() < 0.5
    if not fixed:
        ground()
    base, yaw = 0.0 if not fixed else -thick, random.choice((0.0, random.uniform(0, 1)))
    gap, edge = random.choice((0.0, 0.0, 1e-4, 5e-3)), 0.1 * min(thick, 1.0)
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    for x, y in itertools.product((-1, 1), (-1, 1) if four else (0,)):
        extents = (1 - gap, (1 if four else 2) - gap, thick)
        centre = (*(turn @ [x / 2, y / 2]), base + thick / 2)
        append(placed(yt.box, extents, centre, 340 * np.prod(extents), yaw=yaw, fixed=fixed))
    half, height = edge + gap / 2, random.uniform(0.5, 1.5)  # of the groove without a level face
    drop = 0.0
    if random.random() < 0.5:
        breadth = random.uniform(1.6, 2.4) * half + 0.05
        corners, radius = prism(4, breadth / 2**0.5, height, np.pi / 4 + yaw), 0.1 * min(breadth, height)
        beyond = max(0.0, half + radius - breadth / 2)  # of its core from the level faces, on each side
        drop = (edge + radius) * (1 - np.sqrt(1 - (beyond / (edge + radius)) ** 2)) * (2 if four else 1)
    else:
        corners = post_on_faces(random, half, height, four, turn)
    append(yt.polyhedron(corners + [0, 0, base + thick + height / 2]))
    start()
    return Plan(SHORT, stands=2e-3 + 1.1 * drop)


def post_on_faces(random, half, height, four, turn):
    """Corners of a prism whose centre is within the parts of its foot that stand more than `half` from the seams."""
    while True:
        sides, radius, yaw = random.integers(3, 9), random.uniform(0.08, 0.4), random.uniform(0, 6)
        core = radius - 0.1 * min(2 * radius * np.sin(np.pi / sides), height) / np.cos(np.pi / sides)
        rim = prism(sides, core, height, yaw)[[*range(sides), 0], :2]
        at = random.choice((0.0, 0.1 * radius)) * random.uniform(-1, 1, 2)
        foot = np.vstack([np.linspace(p, q, 50) for p, q in itertools.pairwise(rim)]) + at
        distances = np.abs(foot @ turn)[:, : 2 if four else 1]
        on_faces = foot[(distances > half).all(axis=1)] - at
        if len(on_faces) > 2 and ConvexHull(on_faces).equations[:, 2].max() < -0.15 * radius:
            return prism(sides, radius, height, yaw) + [*at, 0]


def slope(random):
    """Blocks at rest on a slope below the angle of friction, as inclined gravity; another body is erased or added."""
    friction = random.uniform(0.3, 0.8)
    angle = np.arctan(0.8 * friction)
    append(yt.box((40, 40, 1), (0, 0, -0.5), material=yt.timber(friction=friction), fixed=True))
    other = append(yt.box((0.3, 0.3, 0.3), (10, 0, 0.15), fixed=random.random() < 0.5))
    for k in range(random.integers(2, 7)):
        side = np.sort(random.uniform(0.1, 0.5, 3))[::-1]
        append(placed(yt.box, side, (k, 0, side[2] / 2), 10 ** random.uniform(0, 3), yaw=random.uniform(0, 3),
                      friction=friction))
    start(gravity=9.81 * np.array([np.sin(angle), 0, -np.cos(angle)]))
    events = [(1.0, lambda: O.bodies.erase(other)),
              (1.5, lambda: append(yt.box((0.3, 0.3, 0.3), (-5, 0, 0.151), material=yt.timber(friction=0.8))))]
    return Plan(SHORT, events[: random.integers(1, 3)], stands=2e-3)  # the added one falls by 1 mm


def gate(random):
    """A pile behind a wall that is erased in the run; bodies are added on top."""
    ground()
    walls = container(0.9, 2.0)
    O.bodies.erase(walls[0])
    for k, mass in enumerate(masses(random, random.integers(6, 11))):
        cell = np.array([k % 2 - 0.5, k // 2 % 2 - 0.5, k // 4]) * 0.4 + [0, 0, 0.3]
        append(solid(lump(random, random.uniform(0.1, 0.165)), cell, mass, random.uniform(0.5, 0.8)))
    start()
    late = solid(lump(random, 0.15), (0, 0, 1.8), 20.0, 0.6)
    return Plan(3 + LONG, [(2.0, lambda: append(late)), (3.0, lambda: O.bodies.erase(walls[-1]))], rests=False)


def keystone(random):
    """An arch that loses its keystone, and falls."""
    key = []
    arch(random, key)
    return Plan(LONG, [(1.0, lambda: O.bodies.erase(key[0]))])


def shaken(random):
    """Blocks of all shapes on the ground, shaken strongly, under weights on four decades."""
    ground(random.uniform(0.3, 0.8))
    for k, mass in enumerate(masses(random, random.integers(6, 13))):
        corners = lump(random, random.uniform(0.12, 0.3), turned=False)
        at = np.array([k % 3, k // 3 % 3, k // 9]) * 0.7 + [0, 0, -corners[:, 2].min() + 0.01]
        append(solid(corners, at, mass, random.uniform(0.3, 0.8)))
    motion, speed = shaking(random, random.uniform(3, 12), 5.0)
    start(motion)
    return Plan(LONG, speed=speed, rests=False)


def table(random):
    """Boxes on a fixed plate that is moved to and fro; another plate stands still."""
    plate = append(yt.box((3, 3, 0.2), (0, 0, -0.1), fixed=True))
    append(yt.box((3, 3, 0.2), (3.6, 0, -0.1), fixed=True))
    for k in range(random.integers(2, 6)):
        side = random.uniform(0.15, 0.4, 3)
        append(placed(yt.box, side, (0.6 * k - 1, 0, side[2] / 2), 10 ** random.uniform(0, 3)))
    start()
    peak, frequency = random.uniform(0.1, 0.5), random.uniform(0.5, 3)
    move = lambda t: setattr(O.bodies[plate].state, "vel", (peak * np.sin(2 * np.pi * frequency * t), 0, 0))
    cycles = round(3 * frequency) / frequency
    times = np.arange(0.5, 0.5 + cycles, 0.005)
    events = [(t, lambda t=t: move(t - 0.5)) for t in times] + [(0.5 + cycles, lambda: move(0.0))]
    return Plan(0.5 + cycles + 3, events, speed=peak, rests=False)


def struck(random):
    """A block of 0.3 to 5 t falls on light members that stand or lean between it and beams. They are crushed: an
    elastic member, pressed until it slips, may leave with 90 m/s."""
    ground()
    member = partial(placed, yt.box, bearing=6e6)
    for x in (-0.5, 0.5):
        append(member((0.12, 2, 0.15), (x, 0, 0.075), 30.0))
    for k in range(random.integers(2, 6)):
        height, breadth = random.uniform(0.8, 1.4), random.uniform(0.05, 0.12)
        tilt = random.uniform(-0.3, 0.3)
        at = (random.uniform(-0.6, 0.6), 0.35 * k - 0.6, 0.2 + height / 2)
        append(member((breadth, breadth, height), at, 10 ** random.uniform(-0.3, 1.2), pitch=tilt))
    append(member((1.6, 1.8, 0.4), (0, 0, random.uniform(2.0, 3.5)), 10 ** random.uniform(2.5, 3.7)))
    start()
    return Plan(LONG, rests=False)


FAMILIES = {
    "pile": (pile, 30), "stack": (stack, 16), "arch": (arch, 16), "wall": (wall, 16), "tower": (tower, 20),
    "post": (post, 20), "slope": (slope, 8), "gate": (gate, 8), "keystone": (keystone, 6), "shaken": (shaken, 10),
    "table": (table, 8), "struck": (struck, 14), "hammer": (hammer, 8), "chain": (chain, 8),
    "slip_chain": (slip_chain, 6), "frame": (frame, 6),
}
"""Name -> (function, number of scenes)."""
ALL = [(family, seed) for family, (_, count) in FAMILIES.items() for seed in range(count)]


def wanted(words):
    """Scenes (family, seed) of the words of a command line: families, numbers in ALL, ranges of them."""
    chosen = []
    for word in words:
        first, _, last = word.partition("-")
        chosen += ([one for one in ALL if one[0] == word] if word in FAMILIES
                   else ALL[int(first):int(last or first) + 1])
    return chosen


def run(family, seed):
    """Verdict of a scene."""
    build, index = FAMILIES[family][0], list(FAMILIES).index(family)
    return scene_judge.judge(f"{family} {seed}", build, [index, seed])


def show(scenes):
    """Run scenes (family, seed) and print their rows -> verdicts."""
    print(scene_judge.HEADER, flush=True)
    verdicts = []
    for family, seed in scenes:
        verdicts.append(run(family, seed))
        print(verdicts[-1].row(), flush=True)
    return verdicts


def expect_sound(verdicts):
    faults = {one.outcome.name: one.faults() for one in verdicts if one.faults()}
    assert not faults, "\n".join(f"{name}: {'; '.join(found)}" for name, found in faults.items())


if __name__ == "__main__":
    show(wanted(sys.argv[1:]) or ALL)
