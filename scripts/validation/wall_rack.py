# SPDX-License-Identifier: GPL-2.0-or-later
"""The wall rack: one bay under the drifts of the usual test, with the package's own joints, beside measured walls.

    yade -j1 -n -x scripts/validation/wall_rack.py [--only NAME ...] [--out FOLDER]

Writes walls.csv (loads and drifts of the usual evaluation, measured and of the model) and walls.png (loops and
envelopes over the measured points) to FOLDER (default results/wall_rack). Each wall is modelled by its measured points,
and by its multiplier at both levels.
"""
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.append(str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from evaluation import evaluate
from measured_walls import HEIGHT, WALLS
from rack import Rack, envelope
from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.table import csv_text
from timber_houses.study.options import Parser, results_folder, run_script

MODELS = {"points": "#0072B2", "mean": "#009E73", "design": "#D55E00"}
HEADS = ("wall", "case", "tests", "multiplier", "P at the code's drift [kN]", "code's drift", "Py [kN]", "Pu [kN]",
         "Pmax [kN]", "Pmax / allowable", "drift of Pmax", "drift at 0.8 Pmax", "source")


def arguments():
    parser = Parser(__doc__)
    parser.add_argument("--only", nargs="+", default=[], metavar="NAME",
                        help="walls whose names contain one of these texts")
    parser.add_argument("--out", type=results_folder, default="results/wall_rack",
                        help="folder of the results (default %(default)s)")
    return parser.parse_args()


def models(wall):
    """{name of the model: (wall type in YAML, level)}."""
    points = ", ".join(f"[{drift:.6f}, {shear:.1f}]" for drift, shear in wall.envelope())
    found = {"points": (f"{{envelope: [{points}]}}", None)}
    if np.isfinite(wall.mean("multiplier")):
        found |= {level: (f"{{multiplier: {wall.mean('multiplier'):.4f}}}", level) for level in ("mean", "design")}
    return found


def loops(wall, type, level):
    """[(drift, load [kN])] of the test of a model."""
    with tempfile.TemporaryDirectory() as folder:
        rows = Rack(folder, type, length=wall.length, height=HEIGHT, level=level).test()
    return [(theta, shear / 1e3) for theta, shear in rows]


def measured_row(wall):
    return _row(
        wall, "measured, mean",
        [wall.mean(name) for name in ("code", "yielding", "ultimate", "largest", "largest_drift", "ultimate_drift")]
    )


def model_row(wall, name, curve):
    found = evaluate(curve)
    code = float(np.interp(wall.code_drift, *curve.T))
    return _row(wall, name, [code, found.yield_load, found.ultimate_load, found.largest_load, found.largest_drift,
                             found.ultimate_drift])


def _row(wall, case, values):
    code, yielding, ultimate, largest, top, end = values
    multiplier = wall.mean("multiplier")
    ratio = largest / (1.96 * wall.length * multiplier)
    return [wall.name, case, len(wall.tests) if case.startswith("measured") else "", _number(multiplier), _number(code),
            f"1/{1 / wall.code_drift:.0f}", _number(yielding), _number(ultimate), _number(largest), _number(ratio),
            _fraction(top), _fraction(end), wall.source]


def _number(value):
    return "" if np.isnan(value) else f"{value:.3g}"


def _fraction(drift):
    return "" if np.isnan(drift) else f"1/{1 / drift:.0f}"


def draw(axes, wall, curves):
    """Loops of the model `points`, envelopes of all, measured points with their spread. curves: {model: [(drift,
    load)]}
    """
    axes.plot(*np.array(curves["points"]).T, color="0.75", linewidth=0.5)
    for name, rows in curves.items():
        axes.plot(*envelope(rows).T, color=MODELS[name], label=name)
    for value, drift in (("code", wall.code_drift), ("largest", wall.mean("largest_drift"))):
        for test in wall.tests:
            own = test.largest_drift if value == "largest" else drift
            axes.plot(1 / 30 if np.isnan(own) else own, getattr(test, value), "k." if np.isfinite(own) else "kx")
    for test in wall.tests:
        if wall.is_tail_known:
            axes.plot(test.ultimate_drift, 0.8 * test.largest, "k.")
        axes.plot(1 / 80, test.yielding, "kx")
    axes.axhline(0, color="0.5", linewidth=0.4)
    axes.set(title=f"{wall.name}, {wall.length:g} m", xlim=(-0.07, 0.12), xlabel="drift [rad]", ylabel="load [kN]")


def figure(results):
    """results: {wall: curves}"""
    page, fields = plt.subplots(-(-len(results) // 3), min(3, len(results)), figsize=(12, 3.6 * -(-len(results) // 3)),
                                squeeze=False, constrained_layout=True)
    for axes, (wall, curves) in zip(fields.flat, results.items()):
        draw(axes, wall, curves)
    fields.flat[0].legend(loc="lower right")
    page.suptitle("Loops (grey) and envelopes of the model; measured: dots, crosses where the sheet gives no drift")
    return page


def main():
    options = arguments()
    walls = [wall for wall in WALLS if not options.only or any(text in wall.name for text in options.only)]
    results, rows = {}, []
    for wall in walls:
        results[wall] = {name: loops(wall, *model) for name, model in models(wall).items()}
        rows += [measured_row(wall), *(model_row(wall, name, envelope(curve)) for name, curve in results[wall].items())]
    options.out.mkdir(parents=True, exist_ok=True)
    write_text(options.out / "walls.csv", csv_text(HEADS, rows))
    with written_whole(options.out / "walls.png") as part:
        figure(results).savefig(part, dpi=110, format="png", metadata={"Software": None})
    print(csv_text(HEADS[:-1], [row[:-1] for row in rows]))


run_script(main)
