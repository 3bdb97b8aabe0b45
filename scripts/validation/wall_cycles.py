# SPDX-License-Identifier: GPL-2.0-or-later
"""Cycles of the wall types of the shipped houses, and of a published parameter set, beside values of tests.

    yade -j1 -n -x scripts/validation/wall_cycles.py [--out docs/validation]

A bay of 0.91 m x 2.73 m under two cycles at each drift, then a push. Writes wall_cycles.csv (shear per metre in the
first and the second cycle at each drift, and at zero drift) and wall_cycles.png.
"""
import json
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.append(str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from measured_walls import WALLS
from rack import Rack
from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.table import csv_text
from timber_houses.house import load_house
from timber_houses.study.options import Parser, results_folder, run_script

TYPES = ("plywood", "mud", "mortar", "gypsum", "lath_plaster", "siding")
KEYS = ("multiplier", "envelope", "residual_share")
SAWS = {"F0": 8000, "FI": 1200, "DU": 0.015, "S0": 5e6, "R1": 0.058, "R2": -0.05, "R3": 1, "R4": 0.02, "alpha": 0.6,
        "beta": 1.1, "length": 0.91, "height": 2.73}
"""Of OpenSees' example; lengths are those of the bay."""
DRIFTS = tuple(1 / n for n in (300, 150, 100, 75, 50, 30))
CYCLES, STEP, END = 2, 2e-4, 0.1
"""At each drift; of the imposed drift, and its end [rad]."""
LENGTH = 0.91
"""[m]"""
ALLOWABLE = 1.96
"""Of a multiplier of 1. [kN/m]"""


def mud_tests():
    """[(drift, shear)] of the tested mud walls, whose multiplier is 1.6, scaled to that of the type, 1."""
    wall = next(wall for wall in WALLS if wall.name == "mud on bamboo")
    scale = 1 / wall.length / wall.mean("multiplier")
    tops = [(test.largest_drift, test.largest) for test in wall.tests]
    return [(drift, scale * load) for drift, load in [(wall.code_drift, wall.mean("code")), *tops]]


MEASURED = {
    "plywood": [(1 / 120, 2.5 * 1.40 * ALLOWABLE), (1 / 30, 2.5 * 2.8 * ALLOWABLE), (1 / 20, 2.5 * 2.24 * ALLOWABLE)],
    "mud": mud_tests(),
    "mortar": [(0.0008, 2.7), (0.0072, 7.7), (0.015, 9.0), (0.054, 2.6), (1 / 50, 11.0)],
    "gypsum": [(0.0012, 1.53), (0.0036, 2.70), (0.008, 3.06), (0.0565, 0.92)],
    "siding": [(1 / 120, 1.7)],
}
"""Drift [rad], shear [kN/m]: of plywood mean ratios of tested boards to the allowable shear (docs/house_files.md), of
mud three tests, of mortar also the largest shear of Japanese tests, whose drift is not given."""


def models():
    """{name: wall type in JSON}."""
    types = load_house("tiled_house").data["wall_types"]
    found = {name: {key: types[name][key] for key in KEYS if types[name][key] is not None} for name in TYPES}
    return {name: json.dumps(table) for name, table in (found | {"SAWS set A": {"saws": SAWS}}).items()}


def cycles(type):
    """[(drift, shear [kN/m])] of the test of a wall type."""
    turns = [sign * drift for drift in DRIFTS for _ in range(CYCLES) for sign in (1, -1)]
    with tempfile.TemporaryDirectory() as folder:
        rows = Rack(folder, type, length=LENGTH).path(0.0, *turns, END, step=STEP)
    return np.array([(theta, shear / 1e3 / LENGTH) for theta, shear in rows])


def table_of(name, rows):
    """Rows of the table: drift, shear in the first and the second cycle, shear at zero drift after them."""
    drift, shear = rows.T
    for wanted in DRIFTS:
        first, second = np.flatnonzero(np.isclose(drift, wanted))[[0, 2]]  # each turn ends and begins a path
        zero = second + np.argmax(drift[second:] <= 0)
        yield [name, f"1/{1 / wanted:.0f}", f"{shear[first]:.3f}", f"{shear[second]:.3f}", f"{-shear[zero]:.3f}"]


def figure(results):
    page, fields = plt.subplots(2, 4, figsize=(13, 6.4), constrained_layout=True)
    for axes, (name, rows) in zip(fields.flat, results.items()):
        axes.plot(*rows.T, color="#0072B2", linewidth=0.7)
        for drift, shear in MEASURED.get(name, ()):
            axes.plot(drift, shear, "k.")
        axes.axhline(0, color="0.5", linewidth=0.4)
        axes.set(title=name, xlim=(-0.04, END), xlabel="drift [rad]", ylabel="shear [kN/m]")
    for axes in fields.flat[len(results):]:
        axes.set_visible(False)
    page.suptitle("Cycles of wall types (level mean); dots: tests, of mud scaled to the multiplier 1; none of lath")
    return page


def main():
    options = Parser(__doc__)
    options.add_argument("--out", type=results_folder, default="results/wall_cycles",
                         help="folder of the results (default %(default)s)")
    out = Path(options.parse_args().out)
    out.mkdir(parents=True, exist_ok=True)
    results = {name: cycles(type) for name, type in models().items()}
    heads = ("wall", "drift", "first cycle [kN/m]", "second cycle [kN/m]", "at zero drift [kN/m]")
    write_text(out / "wall_cycles.csv", csv_text(heads, [row for item in results.items() for row in table_of(*item)]))
    with written_whole(out / "wall_cycles.png") as path:
        figure(results).savefig(path, dpi=110, format="png")


if __name__ == "__main__":
    run_script(main)
