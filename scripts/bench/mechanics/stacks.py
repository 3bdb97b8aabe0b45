# SPDX-License-Identifier: GPL-2.0-or-later
"""Overhanging stacks and arches at their limit."""
import math
from dataclasses import replace

import numpy as np

from mechanics.rows import add, constant
from mechanics.scene import Body, Scene

# --- overhang ---------------------------------------------------------------------------------------------------------
SHARES = (0.8, 0.9, 0.95, 0.97, 0.98, 0.99)
"""Of the overhang at which the stack of five falls."""
LENGTH, WIDTH, THICKNESS, NUMBER = 0.4, 0.2, 0.1, 5


def harmonic_stack(share, radius):
    """Centres of the five blocks from below, along x [m]: the i upper ones lie `share` of (L/2 - r)/i beyond the edge
    that bears them.
    """
    offsets = [share * (LENGTH / 2 - radius) / i for i in range(NUMBER - 1, 0, -1)]
    return np.concatenate([[0.0], np.cumsum(offsets)])


def overhang(radius, factor=1.0):
    bodies = [Body("floor", (5, 0, -0.5), (16, 4, 1))]
    for n, share in enumerate(SHARES):
        for k, x in enumerate(harmonic_stack(factor * share, radius)):
            bodies.append(Body(f"block{n}{k}", (2 * n + x, 0, THICKNESS * (k + 0.5)), (LENGTH, WIDTH, THICKNESS),
                               mass=4.0))
    return [Scene("overhang", 3.0, tuple(bodies), sample=0.02)]


def standing_share(run):
    """Largest share up to which every stack stands; 0.5 if none does."""
    share = 0.5
    for n, value in enumerate(SHARES):
        top = run.position[f"block{n}{NUMBER - 1}"]
        if not abs(top[-1, 2] - top[0, 2]) < THICKNESS / 2:
            break
        share = value
    return share


add(key="overhang", title="overhang: share of limit", unit="-", scenes=overhang,
    measure=standing_share, expected=constant(1.0), bound=0.05, source="harmonic series, edges of radius r",
    fault=lambda scene: replace(scene, bodies=overhang(0.0, 1.1)[0].bodies))

# --- arch -------------------------------------------------------------------------------------------------------------
R, BLOCKS, DEPTH = 5.0, 27, 2.0
"""Radius of the centre line [m], number of voussoirs, width [m] of a semicircular arch."""
LIMIT = 0.1075
"""t/R at which it falls: Milankovitch; Makris and Alexakis, Eng. Struct. 52 (2013) 9."""


def voussoir(k, ratio):
    """Body of the k-th block from the right springing."""
    edges = [math.pi * k / BLOCKS, math.pi * (k + 1) / BLOCKS]
    corners = np.array([(rho * math.cos(phi), y, rho * math.sin(phi)) for phi in edges
                        for rho in (R * (1 - ratio / 2), R * (1 + ratio / 2)) for y in (-DEPTH / 2, DEPTH / 2)])
    half = math.pi / BLOCKS / 2  # a trapezoid: mean width over its height is linear
    low, high = R * (1 - ratio / 2) * math.cos(half), R * (1 + ratio / 2) * math.cos(half)
    centroid = (low + high) / 2 + (high - low) ** 2 / (6 * (low + high))
    middle = sum(edges) / 2
    centre = np.array([centroid * math.cos(middle), 0.0, centroid * math.sin(middle)])
    volume = (high - low) * (high + low) * math.tan(half) * DEPTH
    return Body(f"block{k}", tuple(centre), corners=tuple(map(tuple, corners - centre)), mass=20.0 * volume)


def arch(ratio, duration):
    """Voussoirs of some 13 kg, so that elastic contacts hardly yield: the limit does not depend on the weight."""
    bodies = (Body("floor", (0, 0, -0.5), (14, 4, 1)), *(voussoir(k, ratio) for k in range(BLOCKS)))
    return Scene(f"arch_{ratio:g}", duration, bodies, friction=0.7, sample=0.02)


def thick_arch(radius):
    return [arch(0.115, 4.0)]


def thin_arch(radius):
    return [arch(0.1, 4.0)]


def crown_sunk(run):
    """Over the radius."""
    crown = run.position[f"block{BLOCKS // 2}"][:, 2]
    return float((crown[0] - crown[-1]) / R)


def fallen(run):
    """1 if the crown has fallen by a tenth of the radius, else 0."""
    return float(crown_sunk(run) > 0.1)


add(key="arch_stands", title="arch t/R 0.115: crown sunk", unit="-", scenes=thick_arch, measure=crown_sunk,
    expected=constant(0.0), bound=0.002, source="Milankovitch: stands above 0.1075", fault=lambda scene: arch(0.1, 4.0))
add(key="arch_falls", title="arch t/R 0.1: falls (1)", unit="-", scenes=thin_arch, measure=fallen,
    expected=constant(1.0), bound=0.5, source="Milankovitch: falls below 0.1075", fault=lambda scene: arch(0.13, 4.0))
