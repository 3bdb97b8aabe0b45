# SPDX-License-Identifier: GPL-2.0-or-later
"""A contact law of your own: timber blocks on pads of rubber, F = k n (1 + n/d), against timber on timber (Hertz).

    git apply scripts/examples/own_law/pad_law.patch && scripts/setup
    yade -n -x scripts/examples/own_law/own_law.py [--out DIR]

Writes own_law.png: the force at a contact point of blocks at rest beside the law, and the height of a block that falls
5 mm.
"""
import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from yade import O

import yade_timber as yt
from timber_houses.base.colors import BLUE, ORANGE

STIFFNESS, DEPTH = 2e5, 2e-3
"""Stiffness of the free pad [N/m] and overlap at which its force is twice that of constant stiffness [m]."""
SIDE = 0.3
"""Edge of the blocks. [m]"""


def scene(density, height, law):
    """A block above a fixed plate; returns their ids. law: the Law2 functor of timber contacts."""
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((SIDE, SIDE, SIDE), (0, 0, SIDE / 2 + height), material=yt.timber(density=density)))
    chain = yt.engines()
    functors = next(engine for engine in chain if isinstance(engine, yt.ContactLoop)).loop.lawDispatcher
    functors.functors = [law, yt.Law2_ManifoldGeom_SnowPhys_Linear()]
    O.dt, O.engines = 1e-4, chain
    return plate, block


def pad():
    return yt.Law2_ManifoldGeom_TimberPhys_Pad(stiffness=STIFFNESS, depth=DEPTH)


def at_rest(density):
    """(overlap [m], force [N]) of a contact point after two seconds."""
    plate, block = scene(density, 0.0, pad())
    O.run(20000, True)
    point = yt.contacts(plate, block)[0]
    return point["overlap"], point["normal_force"]


def fall(law):
    """(time [s], height above the plate [m]) of a block that falls 5 mm."""
    _, block = scene(340.0, 5e-3, law)
    rows = []
    while O.time < 0.2:
        rows.append((O.time, O.bodies[block].state.pos[2] - SIDE / 2))
        O.run(5, True)
    return np.array(rows).T


def plot(points, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.4), constrained_layout=True)
    overlap = np.linspace(0, 1.1 * max(points)[0], 100)
    left.plot(1e3 * overlap, STIFFNESS * overlap * (1 + overlap / DEPTH), color="0.6", label="k n (1 + n/d)")
    left.plot(*np.transpose([(1e3 * n, force) for n, force in points]), "o", color=BLUE, label="blocks at rest")
    left.set(xlabel="overlap n [mm]", ylabel="force at a point [N]", title="The law")
    left.legend()
    for name, law, colour in (("Hertz", yt.Law2_ManifoldGeom_TimberPhys_Hertz(), ORANGE), ("pad", pad(), BLUE)):
        time, height = fall(law)
        right.plot(1e3 * time, 1e3 * height, color=colour, label=name)
    right.set(xlabel="time [ms]", ylabel="height of the lower face [mm]", title="A block lands after 5 mm",
              xlim=(20, 120), ylim=(-0.4, 1))
    right.legend()
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("results/own_law"), help="folder (default %(default)s)")
    options = parser.parse_args()
    if not hasattr(yt, "Law2_ManifoldGeom_TimberPhys_Pad"):
        sys.exit("error: this module has no pad law: git apply scripts/examples/own_law/pad_law.patch && scripts/setup")
    points = [at_rest(density) for density in (100, 340, 1000, 3000, 8000)]
    errors = [abs(force / (STIFFNESS * n * (1 + n / DEPTH)) - 1) for n, force in points]
    print(f"largest difference of a block at rest from the law: {max(errors):.1e}")
    options.out.mkdir(parents=True, exist_ok=True)
    plot(points, options.out / "own_law.png")


main()
