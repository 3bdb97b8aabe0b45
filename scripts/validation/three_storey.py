# SPDX-License-Identifier: GPL-2.0-or-later
"""First period of the three-storey post-and-beam house UBC3S, beside the lumped-mass model (shear_model.py).

    yade -n -x scripts/validation/three_storey.py [--out docs/validation]

Source: example NEW.UBC3S.IN and program of PB3D (University of British Columbia; repository TLCFEM/PB3D): plan,
sections, masses and 99 walls, each a nail in a foundation ("pseudo nail"). The 0.30 s in that file is an input: the
program reads DAMP, PERIOD for its damping. No period is computed there and none was measured.

Initial stiffness of a wall: a long nail, clamped at its head, on a foundation of modulus k: k / b, b^4 = k / 4EI.
Here the walls' sums of each storey and direction stand in the four outer walls. Runs: column ends as in tiled_house,
three fittings that yield and open; and ends that do not open, as the columns of PB3D are pinned.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import timber_houses as th
from shear_model import Storey, first_period, slip_spring
from timber_houses.base.atomic_write import write_text
from timber_houses.base.gravity import mass_of
from timber_houses.base.table import csv_text
from timber_houses.house.parser import house_text
from timber_houses.house.weight import weigh
from timber_houses.study.options import Parser, results_folder, run_script

STATED = 0.30
"""Period for the damping of PB3D. [s]"""
MASSES = (12490.0, 12330.0, 8710.0)
"""Of the levels, from below. [kg]"""
HEIGHT, MODULE, BAYS = 2.73, 0.91, 8
"""Of a storey, of the grid [m]; bays of a side."""
NAILS = {1: (5.5, 0.3), 2: (5.5, 0.2), 3: (4.5, 0.05), 4: (5.0, 0.1), 5: (5.5, 0.2), 6: (6.0, 0.3)}
"""Diameter [mm] and initial modulus of the foundation [kN/mm2] of the wall types; E of the nails is 200 kN/mm2."""
WALLS = {"ew": ({1: 7, 2: 4, 3: 2, 4: 1, 5: 2, 6: 1}, {1: 5, 2: 3, 3: 3, 4: 1, 5: 2}, {1: 5, 3: 4, 4: 2, 5: 1, 6: 1}),
         "ns": ({1: 9, 2: 2, 3: 3, 4: 1, 5: 4, 6: 1}, {1: 7, 2: 1, 3: 3, 4: 3, 5: 4}, {1: 7, 3: 1, 4: 5, 5: 2, 6: 2})}
"""Numbers of walls of each type, storeys from below."""
ENDS = {"three fittings": (1.7e6, 3, 7800.0), "pinned": (1e9, 1, 1e9)}
"""Stiffness [N/m], number and strength [N] of the fittings of a column end."""
DT = 5e-5
"""The walls are four times as stiff as those of the shipped houses. [s]"""
NO_SOFTENING = {"law": "slip", "friction_share": 0.15, "softening_stretch": 2.0, "ultimate_stretch": 4.0}
"""Of fittings: periods are those of small vibrations."""
SETTLING = 1.01
"""Simulated time, after which a run has its modes. [s]"""


def nail_stiffness(diameter, modulus):
    """Of a wall. [N/m]"""
    bending = 200 * np.pi * diameter**4 / 64
    return 1e6 * modulus / (modulus / (4 * bending)) ** 0.25


def storey_stiffness(storey, direction):
    """Sum over the walls of a storey, numbered from 0. [N/m]"""
    return sum(number * nail_stiffness(*NAILS[kind]) for kind, number in WALLS[direction][storey].items())


def model_period(direction):
    """By the lumped-mass model with the walls alone. [s]"""
    springs = [slip_spring(storey_stiffness(k, direction) * HEIGHT, 1e12, 0.2, 1e6, 2e6) for k in range(3)]
    return first_period([Storey(mass, HEIGHT, 0.0, 0.0, [spring]) for mass, spring in zip(MASSES, springs)])


def wall_type(storey, direction):
    """Sheets that spread the storey's stiffness over two outer walls; too strong to yield."""
    per_metre = storey_stiffness(storey, direction) * HEIGHT / (2 * BAYS * MODULE)
    return {"strength": 1e6, "stiffness": float(per_metre), "softening_drift": 0.9, "ultimate_drift": 1.0}


def house(ends, densities):
    """Content of the house file; densities of the floors and the roof [kg/m3], from below."""
    stack = [{"layer": "foundation", "height": 0.3, "width": 0.15}]
    for storey in range(3):
        slab = {"layer": "floor"} if storey < 2 else {"layer": "roof", "type": "flat"}
        stack += [{"layer": "columns", "height": HEIGHT - 0.43}, {"layer": "beams", "height": 0.33, "width": 0.105},
                  {**slab, "thickness": 0.1, "material": f"slab{storey}"}]
    stiffness, number, strength = ENDS[ends]
    whole = {"from": 0, "to": BAYS}
    lines = [{"along": "y", "at": [0, 4, BAYS], **whole}, {"along": "x", "at": [0, 4, BAYS], **whole, "cut": True}]
    sides = [{"along": axis, "at": [0, BAYS], **whole} for axis in "yx"]
    storeys = [(name, k) for name in WALLS for k in range(3)]
    timber = {"law": "timber", "young": 12e9, "poisson": 0.4}
    return {
        "extends": "plated",
        "name": f"ubc3s_{ends.split()[-1]}",
        "description": f"UBC3S, column ends: {ends}",
        "materials": {"timber": {**timber, "density": 450},
                      **{f"slab{k}": {**timber, "density": density} for k, density in enumerate(densities)}},
        "friction": [{"between": [f"slab{k}", "timber"], "coefficient": 0.5} for k in range(3)],
        "structures": {"main": {
            "place": {"origin": [0, 0]},
            "grid": {"x": {"module": MODULE, "count": BAYS}, "y": {"module": MODULE, "count": BAYS}}, "margin": 0.0525,
            "lines": lines, "stack": stack,
            "columns": [{"section": 0.105, "lines": sides}, {"section": 0.105, "at": [[4, 4]]}],
            "walls": [{**sides[name == "ew"], "type": f"{name}{k}", "storeys": k + 1} for name, k in storeys]
        }},
        "wall_types": {f"{name}{k}": wall_type(k, name) for name, k in storeys},
        "joint_types": {"column_end": {"kn": stiffness, "ks": stiffness, "strength": strength, **NO_SOFTENING}},
        "joints": {"column_ends": {"type": "column_end", "number": number}},
    }


def house_of_masses(ends, path):
    """House whose levels have MASSES."""
    densities = np.full(3, 340.0)
    for _ in range(3):  # the masses are linear in the densities; the last round checks them
        write_text(path, house_text(house(ends, densities.tolist())))
        built = th.house(path)
        levels = weigh(built.model())["storeys"]["main"]
        masses = np.array([mass_of(levels[str(k)]["level_kn"]) for k in (1, 2, 3)])
        slab = np.array([sum(e.volume for e in built.model().elements if e.material == f"slab{k}") for k in range(3)])
        densities += (np.array(MASSES) - masses) / slab
    assert np.allclose(masses, MASSES, rtol=1e-3), f"three storeys: masses {masses} kg instead of {MASSES}"
    return built


def package_periods(ends, folder):
    """First period of each direction in the package. [s]"""
    name = f"ubc3s_{ends.split()[-1]}"
    built = house_of_masses(ends, folder / f"{name}.yaml")
    run = th.run(built, duration=SETTLING, dt=DT, out=folder / name, no_frames=True, quiet=True)
    modes = run.summary.quantities.modes.before.modes
    return {d: max(mode.period_s for mode in modes if mode.direction == d) for d in WALLS}


def main():
    options = Parser(__doc__)
    options.add_argument("--out", type=results_folder, default=Path("results/validation"), metavar="DIR",
                         help="folder of the table (default %(default)s)")
    options.add_argument("--runs", type=results_folder, default=Path("results/three_storey"), metavar="DIR",
                         help="folder of the runs (default %(default)s)")
    given = options.parse_args()
    for folder in (given.out, given.runs):
        folder.mkdir(parents=True, exist_ok=True)
    periods = {ends: package_periods(ends, given.runs) for ends in ENDS}
    rows = [[d, f"{model_period(d):.3f}", *(f"{periods[ends][d]:.3f}" for ends in ENDS), STATED] for d in WALLS]
    names = [f"package_{ends.replace(' ', '_')}_s" for ends in ENDS]
    table = csv_text(["direction", "model_s", *names, "stated_s"], rows)
    write_text(given.out / "three_storey.csv", table)
    print(table)


if __name__ == "__main__":
    run_script(main)
