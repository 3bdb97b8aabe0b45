# SPDX-License-Identifier: GPL-2.0-or-later
"""One page of engineering quantities of a run: storey shears, accelerations, modes, joints, uplift."""
import numpy as np

from ..base import colors
from ..base.gravity import weight_of
from ..recording.history import DIRECTIONS
from ..recording.quantities import BAND_TEXT
from ..text.english import direction_name, mode_name, period_text, ratio, sentence
from ..text.lines import before
from .figures import A4, default_style, drawable, fitting_size, heading, heading_height, new_figure

DPI = 150
TITLE_SIZE = 8.5
"""Of diagrams, made smaller to fit them. [pt]"""
SHOWN_JOINTS = 12
"""Number of joints in the diagram of utilisations."""
STATES = {"whole": colors.BLUE, "partly": colors.AMBER, "broken": colors.ORANGE, "before": colors.GREY}
"""Colours of joints by their state at the end."""
IMPACTS_CUT = 2.0
"""Largest shear in a diagram over the sustained one: beyond lie impacts of a few ms, and the fall of a house. [-]"""
NEAR = 0.3
"""Distance of columns whose numbers are written side by side. [m]"""
VISIBLE_UPLIFT = 1e-4
"""Smaller uplifts have no number in the plan. [m]"""


@default_style()
def page(frames, dpi):
    """Figure with all quantities of an ended run."""
    figure = new_figure(*A4, dpi)
    text = sentence(frames.summary)
    storeys = max(1, frames.storeys.count)
    top = 1 - (heading_height(A4[0], text) + 0.25) / A4[1]
    rows = figure.add_gridspec(4, 2, left=0.1, right=0.975, top=top, bottom=0.05, hspace=0.36, wspace=0.36,
                               height_ratios=(1.1, 0.9, 1.25, 0.9))
    loops = rows[0, :].subgridspec(1, 2 * min(storeys, 2), wspace=0.42)
    lower = rows[2, :].subgridspec(1, 2, wspace=0.2, width_ratios=(1, 1.1))
    for k, (storey, direction) in enumerate((s, d) for s in range(1, min(storeys, 2) + 1) for d in DIRECTIONS):
        draw_loop(figure.add_subplot(loops[k]), frames, storey, direction)
    draw_shears(figure.add_subplot(rows[1, 0]), frames)
    draw_accelerations(figure.add_subplot(rows[1, 1]), frames)
    draw_joints(figure.add_subplot(lower[0]), frames)
    draw_uplift(figure.add_subplot(lower[1]), frames)
    draw_modes(figure.add_subplot(rows[3, 0]), frames)
    heading(figure, f"House {frames.summary.model}. Quantities{before(frames.summary.quantities)}", text)
    return figure


def style(axis, title, x="", y=""):
    width = axis.get_position(original=True).width * axis.figure.get_size_inches()[0]
    axis.set_title(title, fontsize=fitting_size(title, width, TITLE_SIZE), loc="left", y=1)
    axis.set_xlabel(x, fontsize=7.5, labelpad=1)
    axis.set_ylabel(y, fontsize=7.5, labelpad=1)
    axis.tick_params(labelsize=7)
    axis.yaxis.set_offset_position("right")  # the title is on the left
    axis.yaxis.get_offset_text().set_fontsize(6)
    axis.grid(alpha=0.25)


def draw_loop(axis, frames, storey, direction):
    """Storey shear against storey drift, without impacts; a collapsing storey is cut at a drift of 1/5."""
    table, history = frames.storeys, frames.history
    drift = 100 * np.interp(table.time, history.time, history.drift(storey, direction))
    shear = np.where(np.abs(drift) < 20, table.column(f"shear_{direction}{storey}") / 1e3, np.nan)
    axis.plot(drift, shear, lw=0.5, color=colors.DIRECTIONS[direction])
    cut_impacts(axis, frames.summary.quantities.storeys[f"storey{storey}"].shear.sustained[direction])
    style(axis, f"storey {storey}, {direction_name(direction)}{at_column(frames.summary, storey, direction)}",
          "drift [%]", "shear [kN]")


def at_column(summary, storey, direction):
    """', column 1/45': the largest drift at a column of a house that stands; empty where none is recorded."""
    drift = summary.column_drift and summary.column_drift.largest[f"storey{storey}"][direction]
    return "" if drift is None or summary.collapsed else f", column {ratio(drift)}"


def cut_impacts(axis, sustained):
    """Limit the shears [kN] of a diagram. sustained [N]"""
    if sustained > 0:
        axis.set_ylim(-IMPACTS_CUT * sustained / 1e3, IMPACTS_CUT * sustained / 1e3)


def draw_shears(axis, frames):
    """Base shear over time, without impacts."""
    table = frames.storeys
    for direction in DIRECTIONS:
        axis.plot(table.time, table.column(f"base_shear_{direction}") / 1e3, lw=0.5, color=colors.DIRECTIONS[direction],
                  label=direction_name(direction))
    peaks = frames.summary.quantities.base_shear.sustained
    weight = weight_of(frames.summary.quantities.mass_kg)
    text = ", ".join(f"{direction_name(d)} {peaks[d] / 1e3:.0f} kN" for d in DIRECTIONS)
    cut_impacts(axis, max(peaks.values()))
    style(axis, f"base shear: {text} sustained; weight {weight:.0f} kN", "time [s]", "[kN]")
    axis.legend(fontsize=7, frameon=False, loc="lower left", ncols=2)


def draw_accelerations(axis, frames):
    """Largest absolute acceleration of the ground and of each level, in one band."""
    storeys, ground = frames.summary.quantities.storeys, frames.summary.quantities.ground_acceleration
    for axis_name in ("ns", "ew", "ud"):
        values = [ground[axis_name], *(storey.acceleration[axis_name] for storey in storeys.values())]
        axis.plot(values, range(len(values)), "o-", ms=3.5, lw=1, color=colors.DIRECTIONS[axis_name],
                  label=direction_name(axis_name).replace("ud", "up-down"))
    axis.set_yticks(range(len(storeys) + 1), ["ground", *(f"level {k}" for k in range(1, len(storeys) + 1))])
    axis.set_xlim(0)
    style(axis, f"largest accelerations, {BAND_TEXT}", "[m/s²]")
    axis.legend(fontsize=7, frameon=False, loc="lower right")


FULL = 0.995
"""Utilisation that is printed as 1.00. [-]"""


def by_load(frames):
    """Numbers of the joints, the largest utilisation first."""
    return np.argsort(-frames.peaks["load"], kind="stable")


def nearest_to_failure(frames, most):
    """Numbers of the joints with the largest utilisation below 1.00: all others have reached their strength."""
    return [k for k in by_load(frames) if frames.peaks["load"][k] < FULL][:most]


def draw_joints(axis, frames):
    """Joints nearest to failure; a line alone where all have reached their strength."""
    shown, states, load = nearest_to_failure(frames, SHOWN_JOINTS), frames.joint_states(-1), frames.peaks["load"]
    axis.barh(range(len(shown)), load[shown], color=[STATES[states[k]] for k in shown], height=0.7, alpha=0.5)
    axis.set_yticks([])
    for row, k in enumerate(shown):
        axis.text(0.02, row, drawable(frames.joints.name[k].replace("|", " | "), 46), fontsize=6, va="center")
    axis.invert_yaxis()
    axis.set_xlim(0, 1.05)
    axis.axvline(1, color="black", lw=0.7, ls=":")
    if not shown:
        axis.axis("off")
    style(axis, f"utilisation of joints [-]; {(load >= FULL).sum()} more have reached 1")


def draw_uplift(axis, frames):
    """Plan of the first storey's columns with the largest uplift of their feet [mm]; grey: lost at the end."""
    elements, table = frames.elements, frames.columns
    first = elements.storey[table["element"]] == 1
    places = np.column_stack([elements.position[table["element"], :2], table["uplift"]])[first]
    stands = np.array(table["state"])[first] == "standing"
    for shown, color in ((stands, colors.BLUE), (~stands, colors.GREY)):
        axis.plot(*places[shown, :2].T, "s", ms=3, color=color)
    numbered = places[stands & (places[:, 2] >= VISIBLE_UPLIFT)]
    for x, y, uplift in numbered:
        number = f"{1000 * uplift:.{1 if uplift < 0.01 else 0}f}"
        beside = [other - x for other, north, _ in numbered if 0 < abs(other - x) < NEAR and abs(north - y) < NEAR]
        side = "center" if not beside else "right" if min(beside) > 0 else "left"
        axis.annotate(number, (x, y), (0, 3), textcoords="offset points", fontsize=5.5, ha=side)
    axis.set_aspect("equal", anchor="W")
    axis.margins(0.1)
    style(axis, "uplift of column feet, storey 1 [mm]; grey: lost", "east [m]", "north [m]")


def draw_modes(axis, frames):
    """Periods and shapes of the main modes before (thin) and after (thick) the run."""
    lines = []
    for when, width in (("before", 1), ("after", 2.2)):
        for direction in DIRECTIONS:
            mode = frames.summary.main_mode(when, direction)
            if mode is None:
                continue
            shape = [0.0, *(storey[direction] for storey in mode.shape.values())]
            sign = 1 if shape[-1] >= 0 else -1
            axis.plot([sign * value for value in shape], range(len(shape)), "o-", ms=3, lw=width,
                      color=colors.DIRECTIONS[direction])
            lines.append(f"{mode_name(mode)} {when}: {period_text(mode)},"
                         f" {100 * mode.mass_share[direction]:.0f} % of the mass")
    if frames.summary.collapsed:
        lines.append("after: none, the house has collapsed")
    early = frames.summary.quantities.modes.before is None
    nothing = "not computed: the run ends before 1 s" if early else "no mode found"
    axis.text(0.97, 0.04, "\n".join(lines) or nothing, transform=axis.transAxes, va="bottom", ha="right",
              fontsize=7)
    axis.set_xlim(right=max(2.2, axis.get_xlim()[1]))
    levels = len(frames.summary.quantities.storeys)
    axis.set_yticks(range(levels + 1), ["ground", *(f"level {k}" for k in range(1, levels + 1))])
    style(axis, "natural modes: thin before, thick after the run")
