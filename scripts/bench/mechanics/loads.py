# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces of rest, light bodies under heavy ones, and what must not matter: order and removed bodies."""
import math
from dataclasses import replace

import numpy as np

from mechanics.rows import EXACT, STANDS, add, constant
from mechanics.scene import G, Body, Scene

FLOOR = Body("floor", (0, 0, -0.5), (10, 10, 1))


# --- force of rest ----------------------------------------------------------------------------------------------------
def rest(radius):
    return [Scene("rest", 2.0, (FLOOR, Body("block", (0, 0, 0.1), (0.4, 0.4, 0.2), mass=20.0)), weighed="block")]


def support_over_weight(run):
    """Mean contact force of the last half second, as the program reports it, over the weight."""
    return float(np.mean(run.support[run.times > 1.5]) / (20.0 * G))


add(key="rest", title="rest: contact force over weight", unit="-", scenes=rest,
    measure=support_over_weight, expected=constant(1.0), bound=EXACT, source="equilibrium",
    needs=frozenset({"forces"}), fault=lambda scene: replace(scene, gravity=9.6))


# --- mass ratios ------------------------------------------------------------------------------------------------------
def sunk(run, name="top", start=None):
    """Largest way of a body from its start. [mm]"""
    places = run.position[name]
    return float(1e3 * np.linalg.norm(places - places[0], axis=1).max())


def two_cubes(name, lower, upper):
    size = (0.4, 0.4, 0.4)
    return Scene(name, 2.0, (FLOOR, Body("bottom", (0, 0, 0.2), size, mass=lower), Body("top", (0, 0, 0.6), size,
                                                                                        mass=upper)))


def light_below(radius):
    return [two_cubes("light_below", 1.0, 1e4)]


def light_above(radius):
    return [two_cubes("light_above", 1e4, 1.0)]


def falling(scene):
    """The upper body begins 5 mm above its support."""
    *others, top = scene.bodies
    place = top.position
    return replace(scene, bodies=(*others, replace(top, position=(place[0], place[1], place[2] + 0.005))))


YIELDS = 4.0
"""1 % of the edge: elastic bodies yield by some millimetres under 10 t. [mm]"""

add(key="light_below", title="10 t on 1 kg: movement", unit="mm", scenes=light_below,
    measure=sunk, expected=constant(0.0), bound=YIELDS, source="equilibrium", fault=falling)
add(key="light_above", title="1 kg on 10 t: movement", unit="mm", scenes=light_above, measure=sunk,
    expected=constant(0.0), bound=YIELDS, source="equilibrium", fault=falling)


def tower(name, masses):
    cubes = [Body(f"cube{k}" if k < 9 else "top", (0, 0, 0.2 + 0.4 * k), (0.4, 0.4, 0.4), mass=mass)
             for k, mass in enumerate(masses)]
    return Scene(name, 5.0, (FLOOR, *cubes), sample=0.01)


def heavy_above(radius):
    return [tower("heavy_above", [2.0**k for k in range(10)])]


def heavy_below(radius):
    return [tower("heavy_below", [2.0**k for k in range(9, -1, -1)])]


def lean(scene):
    """The top cube is laid beyond its support."""
    *others, top = scene.bodies
    return replace(scene, bodies=(*others, replace(top, position=(0.21, 0, top.position[2]))))


add(key="heavy_above", title="tower, heaviest above: movement", unit="mm",
    scenes=heavy_above, measure=sunk, expected=constant(0.0), bound=10.0, source="equilibrium", fault=lean)
add(key="heavy_below", title="tower, heaviest below: movement", unit="mm", scenes=heavy_below,
    measure=sunk, expected=constant(0.0), bound=10.0, source="equilibrium", fault=lean)


# --- roof on columns --------------------------------------------------------------------------------------------------
def roof(radius):
    """A slab of 2 t on four free columns of 12 kg."""
    columns = [Body(f"column{k}", (x, y, 1.365), (0.105, 0.105, 2.73), mass=12.0)
               for k, (x, y) in enumerate([(-1.5, -1.5), (1.5, -1.5), (-1.5, 1.5), (1.5, 1.5)])]
    return [Scene("roof", 5.0, (FLOOR, *columns, Body("top", (0, 0, 2.83), (4, 4, 0.2), mass=2000.0)), sample=0.01)]


def leaning_columns(scene):
    """Columns under the edge of the slab on one side only."""
    bodies = [replace(body, position=(abs(body.position[0]), *body.position[1:])) if "column" in body.name else body
              for body in scene.bodies if body.name not in ("column0", "column2")]
    return replace(scene, bodies=tuple(bodies))


add(key="roof", title="roof on columns: movement", unit="mm", scenes=roof, measure=sunk,
    expected=constant(0.0), bound=10.0, source="equilibrium", fault=leaning_columns)


# --- order and removed bodies -----------------------------------------------------------------------------------------
def struck_pyramid(name, **changes):
    """Six cubes 3 + 2 + 1, struck by a sliding one."""
    cubes = [Body(f"cube{row}{k}", (0.42 * (k - (2 - row) / 2), 0, 0.2 + 0.4 * row), (0.4, 0.4, 0.4), mass=10.0)
             for row in range(3) for k in range(3 - row)]
    striker = Body("striker", (-1.6, 0.03, 0.2), (0.4, 0.4, 0.4), mass=10.0, velocity=(3.0, 0, 0))
    return replace(Scene(name, 1.0, (FLOOR, *cubes, striker)), **changes)


def both_orders(radius):
    scene = struck_pyramid("in_order")
    return [scene, replace(scene, name="reversed", bodies=(scene.bodies[0], *reversed(scene.bodies[1:])))]


def with_removed(radius):
    return [struck_pyramid("in_order"), struck_pyramid("removed", removed=3)]


def difference(first, second):
    """Largest distance of the two runs' bodies at the end. [mm]"""
    return float(1e3 * max(math.dist(first.position[name][-1], second.position[name][-1]) for name in first.position))


def pushed(scene):
    """One of the two scenes with a striker 1 % faster."""
    if scene.name == "in_order":
        return scene
    bodies = [replace(body, velocity=(3.03, 0, 0)) if body.name == "striker" else body for body in scene.bodies]
    return replace(scene, bodies=tuple(bodies))


add(key="order", title="order reversed: difference", unit="mm",
    scenes=both_orders, measure=difference, expected=constant(0.0), bound=STANDS, source="the same scene", fault=pushed)
add(key="removed", title="bodies removed before: difference", unit="mm", scenes=with_removed,
    measure=difference, expected=constant(0.0), bound=STANDS, source="the same scene", fault=pushed)
