# SPDX-License-Identifier: GPL-2.0-or-later
"""Sliding and resting by friction; the block on a shaken table."""
import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from mechanics.rows import EXACT, STANDS, add, constant
from mechanics.scene import G, Body, Scene

BLOCK = (0.4, 0.4, 0.1)
FLOOR = Body("floor", (0, 0, -0.5), (14, 14, 1))
SPEED, MU = 5.0, 0.3


def rougher(scene):
    return replace(scene, friction=1.05 * scene.friction)


# --- sliding on a floor -----------------------------------------------------------------------------------------------
def slide(name, direction):
    velocity = (SPEED * math.cos(direction), SPEED * math.sin(direction), 0.0)
    return Scene(name, 2.5, (FLOOR, Body("block", (0, 0, 0.05), BLOCK, mass=10.0, velocity=velocity)), friction=MU)


def slide_along(radius):
    return [slide("slide_along", 0.0)]


def slide_across(radius):
    return [slide("slide_45", math.pi / 4)]


def sliding_way(run):
    """Way over v² / (2 mu g)."""
    return float(np.linalg.norm(run.position["block"][-1, :2]) / (SPEED**2 / (2 * MU * G)))


for key, title, scenes in (("slide_along", "slide along an axis: way", slide_along),
                           ("slide_45", "slide at 45°: way", slide_across)):
    add(key=key, title=title, unit="-", scenes=scenes, measure=sliding_way, expected=constant(1.0), bound=EXACT,
        source="v² / (2 mu g)", fault=rougher)


# --- slopes -----------------------------------------------------------------------------------------------------------
def turned(body, angle):
    """The body with its position turned about y by an angle [rad], and itself with it."""
    x, y, z = body.position
    place = (x * math.cos(angle) + z * math.sin(angle), y, z * math.cos(angle) - x * math.sin(angle))
    return replace(body, position=place, orientation=(math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0))


def slope(degrees, duration=11.0):
    """A block at rest on a slope that falls towards +x, friction 0.5."""
    angle, plate = math.radians(degrees), Body("slope", (4, 0, -0.5), (12, 3, 1))
    bodies = (plate, Body("block", (0, 0, 0.05), BLOCK, mass=10.0))
    return Scene(f"slope_{degrees}", duration, tuple(turned(body, angle) for body in bodies), sample=0.01)


def slope_26(radius):
    return [slope(26)]


def slope_27(radius):
    return [slope(27)]


def creep(run):
    """Way from 1 to 11 s. [mm]"""
    return 1e3 * way_down(run)


def way_down(run):
    """Way from 1 to 11 s. [m]"""
    return float(np.linalg.norm(run.position["block"][-1] - run.position["block"][run.at(1.0)]))


def slope_way(degrees):
    angle = math.radians(degrees)
    return G * (math.sin(angle) - 0.5 * math.cos(angle)) / 2 * (11**2 - 1)


add(key="slope_26", title="slope 26°, mu 0.5: way", unit="mm", scenes=slope_26, measure=creep, expected=constant(0.0),
    bound=STANDS, source="Coulomb: tan 26° < mu", fault=lambda scene: replace(scene, friction=0.48))
add(key="slope_27", title="slope 27°, mu 0.5: way", unit="m", scenes=slope_27,
    measure=way_down, expected=constant(slope_way(27)), bound=0.02, relative=True,
    source="g (sin 27° - mu cos 27°) (11² - 1) s² / 2", fault=lambda scene: replace(scene, friction=0.498))


def neighbours(radius):
    """A block at rest on a slope of 20 degrees, and one that slides down 0.6 m beside it."""
    angle = math.radians(20)
    down = (3 * math.cos(angle), 0.0, -3 * math.sin(angle))
    bodies = (Body("slope", (2, 0, -0.5), (8, 3, 1)), Body("block", (0, 0, 0.05), BLOCK, mass=10.0),
              replace(Body("other", (-1, 0.6, 0.05), BLOCK, mass=10.0), velocity=down))
    return [Scene("neighbours", 2.0, tuple(turned(body, angle) for body in bodies))]


def moved(run):
    """[mm]"""
    places = run.position["block"]
    return float(1e3 * np.linalg.norm(places - places[0], axis=1).max())


add(key="neighbours", title="beside a sliding block: movement", unit="mm", scenes=neighbours, measure=moved,
    expected=constant(0.0), bound=STANDS, source="Coulomb", fault=lambda scene: replace(scene, friction=0.36))


# --- seams of flush faces ---------------------------------------------------------------------------------------------
def tiles(radius):
    """A box without friction slides over twenty flush tiles."""
    plates = [Body(f"tile{k}", (0.5 * k, 0, -0.1), (0.5, 2, 0.2)) for k in range(-1, 22)]
    box = Body("box", (0, 0, 0.05), (0.3, 0.3, 0.1), mass=3.0, velocity=(3.0, 0, 0))
    return [Scene("tiles", 3.0, (*plates, box), friction=0.0)]


def kept_speed(run):
    return float(run.velocity["box"][-1, 0] / 3.0)


add(key="tiles", title="flush tiles: velocity kept", unit="-", scenes=tiles, measure=kept_speed, expected=constant(1.0),
    bound=EXACT, source="no force along a flush plane", fault=lambda scene: replace(scene, friction=0.002))


def seam(radius):
    """A post on the seam of two flush slabs."""
    slabs = [Body(f"slab{side}", (side, 0, -0.25), (2, 2, 0.5)) for side in (-1, 1)]
    return [Scene("seam", 2.0, (*slabs, Body("post", (0, 0, 0.5), (0.105, 0.105, 1.0), mass=3.75)))]


def post_sunk(run):
    """[mm]"""
    return float(1e3 * (0.5 - run.position["post"][-1, 2]))


add(key="seam", title="post on a seam: sunk", unit="mm", scenes=seam, measure=post_sunk,
    expected=constant(0.0), bound=STANDS, source="equilibrium",
    fault=lambda scene: replace(scene, bodies=tuple(
        replace(body, position=(1.06 * body.position[0], 0, body.position[2])) for body in scene.bodies)))

# --- a shaken table ---------------------------------------------------------------------------------------------------
FREQUENCY, SHAKEN_MU, PERIODS = 2.0, 0.2, 10


def table_scene(share):
    """Table and block have the same velocity at the start. share: peak acceleration [g]"""
    start = (-share * G / (2 * math.pi * FREQUENCY), 0.0, 0.0)
    bodies = (Body("table", (0, 0, -0.5), (6, 3, 1), shaken=True, velocity=start),
              Body("block", (0, 0, 0.05), BLOCK, mass=10.0, velocity=start))
    return Scene(f"shaken_{share:g}", PERIODS / FREQUENCY, bodies, friction=SHAKEN_MU, shaking=(share * G, FREQUENCY))


def shaken_weakly(radius):
    return [table_scene(0.15)]


def shaken_strongly(radius):
    return [table_scene(0.5)]


def slips(run):
    """Way of the block on the table (n,). [mm]"""
    way = run.position["block"][:, 0] - run.position["table"][:, 0]
    return 1e3 * (way - way[0])


def largest_slip(run):
    return float(abs(slips(run)).max())


def last_slip(run):
    return float(slips(run)[-1])


@lru_cache
def newmark_slip(share, step=1e-6):
    """Way of a sliding block on the table after all periods, by small steps (Newmark, Geotechnique 15 (1965) 139). [mm]
    """
    limit, slip, speed = SHAKEN_MU * G, 0.0, 0.0
    drive = share * G * np.sin(2 * math.pi * FREQUENCY * step * (np.arange(round(PERIODS / FREQUENCY / step)) + 0.5))
    for acceleration in drive.tolist():
        wanted = speed - acceleration * step  # velocity relative to the table without friction
        speed = wanted - math.copysign(min(abs(wanted), limit * step), wanted)
        slip += speed * step
    return 1e3 * slip


add(key="shaken_weakly", title="shaken table, 0.15 g: slip", unit="mm", scenes=shaken_weakly, measure=largest_slip,
    expected=constant(0.0), bound=STANDS, source="0.15 < mu", fault=lambda scene: replace(scene, friction=0.12))
add(key="shaken_strongly", title="shaken table, 0.5 g: slip", unit="mm", scenes=shaken_strongly,
    measure=last_slip, expected=lambda radius: newmark_slip(0.5), bound=0.05, relative=True,
    source="Newmark's sliding block, 1965", fault=lambda scene: replace(scene, friction=0.25))
