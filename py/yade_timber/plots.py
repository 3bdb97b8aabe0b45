# SPDX-License-Identifier: GPL-2.0-or-later
"""One page of curves for a run: ground motion, storey drifts, broken joints, energy balance. Needs no YADE."""
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .files import written_whole

DRIFT_LINES = ((1 / 120, "1/120 damage begins"), (1 / 30, "1/30 heavy damage"), (1 / 10, "1/10 tilted"))
"""Storey drifts that engineers know. [-]"""
COLORS = {"ns": "#0072B2", "ew": "#D55E00", "ud": "#999999"}  # Okabe and Ito 2008
DISSIPATED = {
    "dashpot_normal": ("contact dashpots, normal", "#56B4E9"),
    "dashpot_shear": ("contact dashpots, tangential", "#0072B2"),
    "friction": ("friction", "#E69F00"),
    "broken_springs": ("broken joints", "#D55E00"),
    "lost_contacts": ("contacts lost under load", "#CC79A7"),
}


def history(path, header, rows, title, motion=None):
    """Write the page as PNG.

    header  column names with units, as in history.csv; rows (n, columns)
    title   heading
    motion  (t (m,), acceleration (m, 3)) [s, m/s2] in the order ew, ns, ud, or None
    """
    values = dict(zip(header, np.asarray(rows, float).T))
    figure = Figure(figsize=(10, 11 if motion is not None else 9), layout="constrained")
    FigureCanvasAgg(figure)
    axes = list(figure.subplots(4 if motion is not None else 3, 1, sharex=True))
    figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    if motion is not None:
        draw_motion(axes.pop(0), *motion)
    draw_drifts(axes[0], values)
    draw_breaks(axes[1], values)
    draw_energy(axes[2], values)
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        axis.margins(x=0)
    figure.axes[-1].set_xlabel("time [s]")
    figure.axes[-1].set_xlim(0, values["time [s]"][-1])
    with written_whole(path) as part:
        figure.savefig(part, dpi=100, format="png")


def legend(axis):
    """Legend beside the axes, where it hides no curve."""
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False, fontsize="small")


def draw_motion(axis, time, acceleration):
    """Ground acceleration."""
    for k, (key, name) in enumerate((("ew", "E-W"), ("ns", "N-S"), ("ud", "up-down"))):
        axis.plot(time, acceleration[:, k], color=COLORS[key], lw=0.6, label=name)
    axis.set_ylabel("ground acceleration\n[m/s²]")
    legend(axis)


def draw_drifts(axis, values):
    """Storey drifts with the lines that engineers know, as far as the drifts reach."""
    storeys = sum(name.startswith("drift_ns") for name in values)
    largest = max(abs(values[f"drift_{key}{k + 1} [-]"]).max() for key in ("ns", "ew") for k in range(storeys))
    for k in range(storeys):
        for key, name in (("ns", "N-S"), ("ew", "E-W")):
            axis.plot(values["time [s]"], values[f"drift_{key}{k + 1} [-]"], color=COLORS[key], ls=("-", "--")[k % 2], lw=0.9, label=f"storey {k + 1}, {name}")
    for level, name in DRIFT_LINES:
        if level < 2 * max(largest, DRIFT_LINES[0][0]):
            for sign in (-1, 1):
                axis.axhline(sign * level, color="k", lw=0.6, ls=":")
            axis.annotate(name, (0.005, level), xycoords=("axes fraction", "data"), va="bottom", fontsize="x-small")
    axis.set_ylabel("storey drift [-]")
    legend(axis)


def draw_breaks(axis, values):
    """Broken joints and springs."""
    axis.step(values["time [s]"], values["broken_springs [-]"], where="post", color=COLORS["ew"], label="springs")
    axis.step(values["time [s]"], values["broken_joints [-]"], where="post", color=COLORS["ns"], label="joints, those\nfrom the start too")
    axis.set_ylabel("broken")
    legend(axis)


def draw_energy(axis, values):
    """What came in, and where it went; what is left over is printed."""
    came = values["ground_motion [J]"] - values["gravity [J]"]
    parts = [values[f"{name} [J]"] for name in DISSIPATED] + [values["elastic_contacts [J]"] + values["elastic_joints [J]"], values["kinetic [J]"]]
    names = [name for name, _ in DISSIPATED.values()] + ["elastic", "kinetic"]
    colors = [color for _, color in DISSIPATED.values()] + ["#009E73", "#F0E442"]
    axis.stackplot(values["time [s]"], [part / 1e3 for part in parts], labels=names, colors=colors, lw=0)
    axis.plot(values["time [s]"], came / 1e3, "k--", lw=1, label="ground motion and gravity")
    left = abs(sum(parts) - came).max()
    axis.set_title(f"largest difference {left:.3g} J, {100 * left / max(abs(came).max(), 1e-300):.2g} % of the largest input", fontsize="small", loc="left")
    axis.set_ylabel("energy [kJ]")
    legend(axis)
