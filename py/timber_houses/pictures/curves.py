# SPDX-License-Identifier: GPL-2.0-or-later
"""One page of curves of a run: ground motion, storey drifts, broken joints, energy balance. One page of an ensemble:
storey drifts as bands, with the run that is shown as a line."""
from itertools import cycle

import numpy as np
from yade_timber.energy_terms import DISSIPATED, ELASTIC

from ..base import colors
from ..recording.verdict import TILT
from ..text.english import DRIFT_LINES, direction_name
from .figures import A4, default_style, drawable, footer, heading, heading_height, new_figure
from .key_times import first_shown, last_shown
from .provenance import provenance
from .sheets import result

DPI = 200
DRIFT_RANGE = 0.16
"""Largest drift shown: beyond it a storey falls. [-]"""
LABEL_GAP = 10
"""Between the baselines of two labels of drifts. [pt]"""
LABEL_PLACE = -0.108
"""Of the labels of y axes, as a part of the axes' width."""
STOREYS = ((colors.BLUE, "-"), (colors.ORANGE, "--"), (colors.GREEN, "-."))
JOINT_KINDS = {"column_beam": colors.ORANGE, "brace_beam": colors.BLUE, "brace_column": colors.SKY_BLUE,
               "floor_beam": colors.AMBER, "roof_beam": colors.PURPLE, "roof_roof": colors.GREEN}
DISSIPATION = dict(zip(DISSIPATED, (
    ("contact dashpots,\nnormal", colors.SKY_BLUE), ("contact dashpots,\ntangential", colors.BLUE),
    ("friction", colors.AMBER), ("crushed timber", colors.WINE), ("broken joints", colors.ORANGE),
    ("contacts lost\nunder load", colors.PURPLE), ("joint dashpots", colors.INDIGO), ("yielding joints", colors.GREY)),
    strict=True))
"""{dissipated term: (label, colour)}"""
QUANTILES = (0.0, 0.25, 0.5, 0.75, 1.0)
LEGEND_HEIGHT = 0.42
"""Of the legend of bands and of the labels of events above the axes. [inch]"""


@default_style()
def page(frames, dpi):
    """Figure with the curves of an ended run."""
    history, shaken, states = frames.history, frames.motion is not None, frames.joint_states(slice(None))
    breaks = np.isin(states, ("broken", "partly")).any()
    figure = new_figure(*A4, dpi)
    axes = list(figure.subplots(3 + shaken + breaks, 1, sharex=True))
    head = heading_height(A4[0], result(frames)) + 0.2
    figure.subplots_adjust(left=0.12, right=0.77, top=1 - head / A4[1], bottom=0.06, hspace=0.18)
    if shaken:
        draw_motion(axes.pop(0), frames.motion)
    for axis, direction, name in zip(axes, ("ns", "ew"), ("N-S", "E-W")):
        draw_drifts(axis, history, direction, name)
    if breaks:
        draw_breaks(axes[2], frames, states)
    draw_energy(axes[-1], history)
    draw_events(figure.axes, frames.summary)
    start, end = first_shown(frames), last_shown(frames)
    for axis in figure.axes:
        axis.grid(alpha=0.25)
        axis.tick_params(labelsize=8)
        axis.set_xlim(start, end)
        axis.yaxis.set_label_coords(LABEL_PLACE, 0.5)  # to align them otherwise, all ticks are drawn once more
        axis.set_title("", pad=3, y=1)  # to place it otherwise, three times more
    rest = f"; ground and house are at rest before {start:.1f} s" if start else ""
    figure.axes[-1].set_xlabel(f"time [s]{rest}", fontsize=9)
    heading(figure, f"{frames.title}. History", result(frames))
    footer(figure, provenance(frames))
    return figure


def draw_events(axes, summary):
    """Lines through all axes where a storey drift passes the tilt and where the house collapses, with labels above."""
    for time, text, side in ((summary.tilt_time_s, f"drift {TILT.ratio}", "right"),
                             (summary.collapse_time_s, "collapses", "left")):
        if time is not None:
            for axis in axes:
                axis.axvline(time, color="black", lw=0.7, ls="--")
            axes[0].annotate(text, (time, 1), (0, 2), ("data", "axes fraction"), "offset points", fontsize=8, ha=side)


def legend(axis):
    axis.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), frameon=False, fontsize=8, borderaxespad=0)


def label(axis, text):
    axis.set_ylabel(text, fontsize=9)


def draw_motion(axis, motion):
    for k, key, name in ((2, "ud", "up-down"), (0, "ew", "E-W"), (1, "ns", "N-S")):
        axis.plot(motion.time, motion.acceleration[:, k], color=colors.DIRECTIONS[key], lw=0.6, label=name)
    label(axis, "ground acceleration\n[m/s²]")
    legend(axis)


def draw_drifts(axis, history, direction, name):
    """Storey drifts in one direction, with the drift levels within reach of them."""
    curves = [history.drift(storey, direction) for storey in history.storeys]
    for storey, curve, (color, dashes) in zip(history.storeys, curves, cycle(STOREYS)):
        axis.plot(history.time, curve, color=color, ls=dashes, lw=0.9, label=f"storey {storey}")
    draw_levels(axis, np.nanmax(np.abs(curves)))
    label(axis, f"storey drift {name} [-]")
    axis.legend(loc="lower left", bbox_to_anchor=(1.01, -0.02), frameon=False, fontsize=8, borderaxespad=0)


def draw_levels(axis, largest):
    """Limits for drifts up to the largest one [-], dotted lines at the drift levels, their labels moved apart."""
    reach = min(DRIFT_RANGE, max(1.2 * largest, 1.25 * DRIFT_LINES[0][0]))
    axis.set_ylim(-reach, reach)
    points = axis.get_position().height * axis.figure.get_size_inches()[1] * 72 / (2 * reach)  # [pt] per drift
    lowest = -np.inf
    for level, text in (line for line in DRIFT_LINES if line[0] < reach):
        for sign in (-1, 1):
            axis.axhline(sign * level, color="black", lw=0.7, ls=":")
        lowest = max(lowest + LABEL_GAP, level * points)
        axis.annotate(text, (1, level), (4, lowest - level * points), ("axes fraction", "data"), "offset points",
                      va="center", fontsize=8)


def draw_breaks(axis, frames, states):
    """Numbers of joints broken during the run by kind, of broken wall sheets, of partly broken ones. states (F, J)"""
    kinds = np.array(frames.joints.kind)
    sheets = frames.joints.sheet_states(states == "broken")
    for kind in dict.fromkeys(kinds[~frames.joints.of_walls]):
        broken = (states[:, kinds == kind] == "broken").sum(1)
        name = drawable(kind.replace("_", "-"), 20)
        axis.step(frames.time, broken, where="post", lw=1.3, color=JOINT_KINDS.get(kind, colors.GREY), label=name)
    if sheets.size:
        axis.step(frames.time, (sheets == "broken").sum(1), where="post", lw=1.3, color="black", label="wall sheets")
    partly = (states == "partly").sum(1) + (sheets == "partly").sum(1)
    axis.step(frames.time, partly, where="post", color="black", lw=0.9, ls=":", label="partly broken,\nall kinds")
    axis.yaxis.get_major_locator().set_params(integer=True)
    axis.set_ylim(0, max(1, axis.get_ylim()[1]))
    label(axis, "broken joints\nand wall sheets" if sheets.size else "broken joints")
    legend(axis)


def draw_energy(axis, history):
    """Energy input and its parts, without dissipated terms that are zero; the remainder is printed above."""
    supplied = history.energy("ground_motion") - history.energy("gravity")
    shown = {name: look for name, look in DISSIPATION.items()
             if f"{name} [J]" in history.columns and history.energy(name).any()}
    parts = [*map(history.energy, shown), sum(map(history.energy, ELASTIC)), history.energy("kinetic")]
    names, fills = zip(*shown.values(), ("elastic", colors.GREEN), ("kinetic", colors.YELLOW))
    axis.stackplot(history.time, [part / 1e3 for part in parts], labels=names, colors=fills, lw=0)
    axis.plot(history.time, supplied / 1e3, "k--", lw=1, label="input: ground\nmotion and gravity")
    residual = abs(sum(parts) - supplied).max()
    share = 100 * residual / max(abs(supplied).max(), 1e-300)
    axis.set_title(f"largest error of the energy balance: {residual / 1e3:.2g} kJ, {share:.2g} %", fontsize=8,
                   loc="left")
    label(axis, "energy [kJ]")
    legend(axis)


# --- ensembles --------------------------------------------------------------------------------------------------------


@default_style()
def bands(frames, histories, dpi):
    """Figure of an ensemble. frames: of the run that is shown; histories: {number: History} of all runs"""
    time = max((history.time for history in histories.values()), key=lambda time: time[-1])  # runs may end early
    shown = frames.history
    drifts = shown.drifts()
    figure = new_figure(*A4, dpi)
    axes = list(figure.subplots(len(drifts), 1, sharex=True, squeeze=False)[:, 0])
    head = heading_height(A4[0], result(frames)) + LEGEND_HEIGHT
    figure.subplots_adjust(left=0.11, right=0.84, top=1 - head / A4[1], bottom=0.06, hspace=0.12)
    for axis, (storey, direction, curve) in zip(axes, drifts):
        draw_band(axis, time, quantiles(histories.values(), time, storey, direction))
        axis.plot(shown.time, curve, color="black", lw=0.8, label=f"run {frames.summary.ensemble.run}, which is shown")
        label(axis, f"drift {direction_name(direction)}, storey {storey} [-]")
    draw_events(axes, frames.summary)
    axes[-1].set_xlim(first_shown(frames), time[-1])
    axes[-1].set_xlabel("time [s]", fontsize=9)
    handles, names = axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="upper left", bbox_to_anchor=(0.1, 1 - (head - LEGEND_HEIGHT + 0.02) / A4[1]),
                  ncols=4, frameon=False, fontsize=8)
    figure.align_ylabels()
    heading(figure, f"{frames.title}. {len(histories)} runs", result(frames))
    footer(figure, provenance(frames))
    return figure


def quantiles(histories, time, storey, direction):
    """(5, F) QUANTILES of a drift over the runs at times (F,) [s]; a run that has ended keeps its last drift. [-]"""
    values = [np.interp(time, history.time, history.drift(storey, direction)) for history in histories]
    return np.quantile(values, QUANTILES, axis=0)


def draw_band(axis, time, values):
    """Range, middle half and median of a drift, with the drift levels within reach of them. values: (5, F) [-]"""
    low, quarter, middle, three_quarters, high = values
    axis.fill_between(time, low, high, color=colors.SKY_BLUE, alpha=0.35, lw=0, label="range")
    axis.fill_between(time, quarter, three_quarters, color=colors.BLUE, alpha=0.45, lw=0, label="middle half")
    axis.plot(time, middle, color=colors.ORANGE, lw=0.7, label="median")
    draw_levels(axis, np.abs(values).max())
    axis.grid(alpha=0.25)
    axis.tick_params(labelsize=8)
