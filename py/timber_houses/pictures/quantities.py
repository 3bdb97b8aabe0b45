# SPDX-License-Identifier: GPL-2.0-or-later
"""One page of engineering quantities of a run: storey shears, accelerations, modes, joints, uplift."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base import colors
from ..base.gravity import weight_of
from ..recording.history import DIRECTIONS, History
from ..recording.history import NAME as HISTORY
from ..recording.peaks import COLUMNS, JOINTS, rows
from ..recording.quantities import BAND_TEXT, Storeys
from ..recording.quantities import NAME as STOREYS
from ..recording.summary import Summary
from ..text.english import direction_name, mode_name, period_text, ratio, sentence
from ..text.lines import before
from .figures import A4, drawable, fitting_size, heading, heading_height, new_figure
from .style import default_style

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


@dataclass(frozen=True)
class Results:
    """Files of a run's folder. joints, columns: a dictionary for each row, with texts."""

    summary: Summary
    history: History
    storeys: Storeys
    joints: list
    columns: list


def read(folder):
    """Results of a run's folder. Raises RunError when a file is missing or of an earlier version of the package."""
    folder = Path(folder)
    tables = (rows(folder / name) for name in (JOINTS, COLUMNS))
    return Results(Summary.read(folder), History.read(folder / HISTORY), Storeys.read(folder / STOREYS), *tables)


@default_style()
def page(results, dpi):
    """Figure with all quantities. results: Results"""
    figure = new_figure(*A4, dpi)
    text = sentence(results.summary)
    storeys = max(1, results.storeys.count)
    top = 1 - (heading_height(A4[0], text) + 0.25) / A4[1]
    rows = figure.add_gridspec(4, 2, left=0.1, right=0.975, top=top, bottom=0.05, hspace=0.36, wspace=0.36,
                               height_ratios=(1.1, 0.9, 1.25, 0.9))
    loops = rows[0, :].subgridspec(1, 2 * min(storeys, 2), wspace=0.42)
    lower = rows[2, :].subgridspec(1, 2, wspace=0.2, width_ratios=(1, 1.1))
    for k, (storey, direction) in enumerate((s, d) for s in range(1, min(storeys, 2) + 1) for d in DIRECTIONS):
        draw_loop(figure.add_subplot(loops[k]), results, storey, direction)
    draw_shears(figure.add_subplot(rows[1, 0]), results)
    draw_accelerations(figure.add_subplot(rows[1, 1]), results)
    draw_joints(figure.add_subplot(lower[0]), results)
    draw_uplift(figure.add_subplot(lower[1]), results)
    draw_modes(figure.add_subplot(rows[3, 0]), results)
    heading(figure, f"House {results.summary.model}. Quantities{before(results.summary.quantities)}", text)
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


def draw_loop(axis, results, storey, direction):
    """Storey shear against storey drift, without impacts; a collapsing storey is cut at a drift of 1/5."""
    table, history = results.storeys, results.history
    drift = 100 * np.interp(table.time, history.time, history.drift(storey, direction))
    shear = np.where(np.abs(drift) < 20, table.column(f"shear_{direction}{storey}") / 1e3, np.nan)
    axis.plot(drift, shear, lw=0.5, color=colors.DIRECTIONS[direction])
    cut_impacts(axis, results.summary.quantities.storeys[f"storey{storey}"].shear.sustained[direction])
    style(axis, f"storey {storey}, {direction_name(direction)}{at_column(results.summary, storey, direction)}",
          "drift [%]", "shear [kN]")


def at_column(summary, storey, direction):
    """', column 1/45': the largest drift at a column of a house that stands; empty where none is recorded."""
    drift = summary.column_drift and summary.column_drift.largest[f"storey{storey}"][direction]
    return "" if drift is None or summary.collapsed else f", column {ratio(drift)}"


def cut_impacts(axis, sustained):
    """Limit the shears [kN] of a diagram. sustained [N]"""
    if sustained > 0:
        axis.set_ylim(-IMPACTS_CUT * sustained / 1e3, IMPACTS_CUT * sustained / 1e3)


def draw_shears(axis, results):
    """Base shear over time, without impacts."""
    table = results.storeys
    for direction in DIRECTIONS:
        axis.plot(table.time, table.column(f"base_shear_{direction}") / 1e3, lw=0.5, color=colors.DIRECTIONS[direction],
                  label=direction_name(direction))
    peaks = results.summary.quantities.base_shear.sustained
    weight = weight_of(results.summary.quantities.mass_kg)
    text = ", ".join(f"{direction_name(d)} {peaks[d] / 1e3:.0f} kN" for d in DIRECTIONS)
    cut_impacts(axis, max(peaks.values()))
    style(axis, f"base shear: {text} sustained; weight {weight:.0f} kN", "time [s]", "[kN]")
    axis.legend(fontsize=7, frameon=False, loc="lower left", ncols=2)


def draw_accelerations(axis, results):
    """Largest absolute acceleration of the ground and of each level, in one band."""
    storeys, ground = results.summary.quantities.storeys, results.summary.quantities.ground_acceleration
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


def nearest_to_failure(rows, most):
    """Rows of joints.csv with the largest utilisation below 1.00: all others have reached their strength. [-]"""
    return [row for row in rows if float(row["utilisation [-]"]) < FULL][:most]


def draw_joints(axis, results):
    """Joints nearest to failure; no bars where all have reached their strength."""
    rows = nearest_to_failure(results.joints, SHOWN_JOINTS)
    fills = [STATES.get(row["state"], colors.GREY) for row in rows]
    axis.barh(range(len(rows)), [float(row["utilisation [-]"]) for row in rows], color=fills, height=0.7, alpha=0.5)
    axis.set_yticks([])
    for k, row in enumerate(rows):
        axis.text(0.02, k, drawable(row["joint"].replace("|", " | "), 46), fontsize=6, va="center")
    axis.invert_yaxis()
    axis.set_xlim(0, 1.05)
    axis.axvline(1, color="black", lw=0.7, ls=":")
    reached = sum(float(row["utilisation [-]"]) >= FULL for row in results.joints)
    style(axis, f"utilisation of joints [-]; {reached} more have reached 1")


def draw_uplift(axis, results):
    """Plan of the first storey's columns with the largest uplift of their feet [mm]; grey: lost at the end."""
    rows = [row for row in results.columns if row["storey"] == "1"]
    keys = ("east [m]", "north [m]", "uplift [m]")
    places = np.array([[float(row[key]) for key in keys] for row in rows]).reshape(-1, 3)
    stands = np.array([row["state"] == "standing" for row in rows], bool)
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


def draw_modes(axis, results):
    """Periods and shapes of the main modes before (thin) and after (thick) the run."""
    lines = []
    for when, width in (("before", 1), ("after", 2.2)):
        for direction in DIRECTIONS:
            mode = results.summary.main_mode(when, direction)
            if mode is None:
                continue
            shape = [0.0, *(storey[direction] for storey in mode.shape.values())]
            sign = 1 if shape[-1] >= 0 else -1
            axis.plot([sign * value for value in shape], range(len(shape)), "o-", ms=3, lw=width,
                      color=colors.DIRECTIONS[direction])
            lines.append(f"{mode_name(mode)} {when}: {period_text(mode)},"
                         f" {100 * mode.mass_share[direction]:.0f} % of the mass")
    if results.summary.collapsed:
        lines.append("after: none, the house has collapsed")
    early = results.summary.quantities.modes.before is None
    nothing = "not computed: the run ends before 1 s" if early else "no mode found"
    axis.text(0.97, 0.04, "\n".join(lines) or nothing, transform=axis.transAxes, va="bottom", ha="right",
              fontsize=7)
    axis.set_xlim(right=max(2.2, axis.get_xlim()[1]))
    levels = len(results.summary.quantities.storeys)
    axis.set_yticks(range(levels + 1), ["ground", *(f"level {k}" for k in range(1, levels + 1))])
    style(axis, "natural modes: thin before, thick after the run")
