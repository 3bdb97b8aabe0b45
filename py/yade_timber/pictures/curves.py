# SPDX-License-Identifier: GPL-2.0-or-later
"""One page of curves for a run: ground motion, storey drifts, broken joints, energy balance. Needs no YADE."""
from itertools import cycle

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import colors as palette
from .sheets import heading, save
from ..recording.sentences import DRIFT_LINES

PAPER = (8.27, 11.69)
"""A4, upright. [inch]"""
DPI = 200
DRIFT_RANGE = 0.16
"""Largest drift shown: beyond it a storey falls. [-]"""
STOREYS = ((palette.BLUE, "-"), (palette.ORANGE, "--"), (palette.GREEN, "-."))
JOINT_KINDS = {"column_beam": palette.ORANGE, "brace_beam": palette.BLUE, "floor_beam": palette.AMBER, "roof_beam": palette.PURPLE, "roof_roof": palette.GREEN}
DISSIPATED = {
    "dashpot_normal": ("contact dashpots,\nnormal", palette.SKY_BLUE),
    "dashpot_shear": ("contact dashpots,\ntangential", palette.BLUE),
    "friction": ("friction", palette.AMBER),
    "broken_springs": ("broken joints", palette.ORANGE),
    "lost_contacts": ("contacts lost\nunder load", palette.PURPLE),
}


def write(stem, frames):
    """Write the page of an ended run as `stem`.png and `stem`.pdf; returns the paths. Raises OSError."""
    return save(page(frames), stem, ("png", "pdf"), DPI)


def page(frames):
    """Figure with the curves of an ended run."""
    values = dict(zip(frames.history[0], np.asarray(frames.history[1], float).T))
    shaken = frames.motion is not None
    figure = Figure(figsize=PAPER, facecolor="white")
    FigureCanvasAgg(figure)
    axes = list(figure.subplots(5 if shaken else 4, 1, sharex=True))
    figure.subplots_adjust(left=0.11, right=0.77, top=1 - 0.95 / PAPER[1], bottom=0.06, hspace=0.18)
    if shaken:
        draw_motion(axes.pop(0), frames.motion)
    for axis, key, name in zip(axes, ("ns", "ew"), ("N-S", "E-W")):
        draw_drifts(axis, values, key, name)
    draw_breaks(axes[2], frames)
    draw_energy(axes[3], values)
    draw_events(figure.axes, frames.summary)
    for axis in figure.axes:
        axis.grid(alpha=0.25)
        axis.tick_params(labelsize=8)
        axis.set_xlim(0, frames.time[-1])
    figure.axes[-1].set_xlabel("time [s]", fontsize=9)
    figure.align_ylabels()
    heading(figure, frames, "History")
    return figure


def draw_events(axes, found):
    """Lines through all axes when the house leans by 1/10 and when a floor has come down by half a storey, with words on top."""
    for key, text, side in (("tilt_time_s", "leans", "right"), ("collapse_time_s", "collapses", "left")):
        if found[key] is not None:
            for axis in axes:
                axis.axvline(found[key], color="black", lw=0.7, ls="--")
            axes[0].annotate(text, (found[key], 1), (0, 2), ("data", "axes fraction"), "offset points", fontsize=8, ha=side)


def legend(axis):
    """Legend beside the axes, where it hides no curve."""
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), frameon=False, fontsize=8, borderaxespad=0)


def label(axis, text):
    axis.set_ylabel(text, fontsize=9)


def draw_motion(axis, motion):
    """Ground acceleration."""
    for k, key, name in ((2, "ud", "up-down"), (0, "ew", "E-W"), (1, "ns", "N-S")):
        axis.plot(motion.time, motion.acceleration[:, k], color=palette.DIRECTIONS[key], lw=0.6, label=name)
    label(axis, "ground acceleration\n[m/s²]")
    legend(axis)


def draw_drifts(axis, values, key, name):
    """Storey drifts in one direction with the lines that engineers know, as far as the drifts reach."""
    curves = [values[column] for column in values if column.startswith(f"drift_{key}")]
    for k, (curve, (color, dashes)) in enumerate(zip(curves, cycle(STOREYS)), 1):
        axis.plot(values["time [s]"], curve, color=color, ls=dashes, lw=0.9, label=f"storey {k}")
    reach = min(DRIFT_RANGE, max(1.2 * np.nanmax(np.abs(curves)), 1.25 * DRIFT_LINES[0][0]))
    for level, text in DRIFT_LINES:
        if level < reach:
            for sign in (-1, 1):
                axis.axhline(sign * level, color="black", lw=0.7, ls=":")
            axis.annotate(text, (1, level), (4, 0), ("axes fraction", "data"), "offset points", va="center", fontsize=8)
    axis.set_ylim(-reach, reach)
    label(axis, f"storey drift {name} [-]")
    axis.legend(loc="lower left", bbox_to_anchor=(1.01, -0.02), frameon=False, fontsize=8, borderaxespad=0)


def draw_breaks(axis, frames):
    """Joints broken during the run by kind, and those of which some springs are broken."""
    kinds = np.array(frames.joints.kind)
    states = np.array([frames.joint_states(k) for k in range(len(frames.time))])
    for kind in dict.fromkeys(kinds):
        broken = (states[:, kinds == kind] == "broken").sum(1)
        axis.step(frames.time, broken, where="post", lw=1.3, color=JOINT_KINDS.get(kind, palette.GREY), label=kind.replace("_", "-"))
    axis.step(frames.time, (states == "partly").sum(1), where="post", color="black", lw=0.9, ls=":", label="partly broken,\nall kinds")
    axis.yaxis.get_major_locator().set_params(integer=True)
    axis.set_ylim(0, max(1, axis.get_ylim()[1]))
    label(axis, "broken joints")
    legend(axis)


def draw_energy(axis, values):
    """What came in, and where it went; what is left over is printed."""
    came = values["ground_motion [J]"] - values["gravity [J]"]
    parts = [values[f"{name} [J]"] for name in DISSIPATED] + [values["elastic_contacts [J]"] + values["elastic_joints [J]"], values["kinetic [J]"]]
    names = [name for name, _ in DISSIPATED.values()] + ["elastic", "moving"]
    colors = [color for _, color in DISSIPATED.values()] + [palette.GREEN, palette.YELLOW]
    axis.stackplot(values["time [s]"], [part / 1e3 for part in parts], labels=names, colors=colors, lw=0)
    axis.plot(values["time [s]"], came / 1e3, "k--", lw=1, label="came in: ground\nmotion and gravity")
    left = abs(sum(parts) - came).max()
    share = 100 * left / max(abs(came).max(), 1e-300)
    axis.set_title(f"not accounted for: at most {left / 1e3:.2g} kJ, {share:.2g} %", fontsize=8, loc="left", pad=3)
    label(axis, "energy [kJ]")
    legend(axis)
