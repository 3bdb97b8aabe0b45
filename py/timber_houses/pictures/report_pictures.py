# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of the report: plans of the house, pushover curves, the motion with its spectrum, key times of the run."""
import numpy as np
from matplotlib.patches import Polygon, Rectangle

from ..base import colors
from ..motion import GAL, response_spectrum
from ..recording.history import DIRECTIONS
from ..recording.verdict import DAMAGE, SAFETY, TILT
from ..text.english import direction_name, ratio
from .figures import default_style, heading_height, new_figure
from .key_times import first_shown, last_shown
from .sheets import Format, result
from .views import FRONT, SIDE

DPI = 170
SHOTS = Format(7.6, 4.0, DPI, 6)
"""Six key times across an A4 page, in the height that its text leaves, and a heading that is cut off."""
PERIODS = np.geomspace(0.05, 5.0, 80)
EDGE = 0.3
"""Between the outermost columns and the edge of a plan. [m]"""
THICK = 0.11
"""Columns at least this thick are black in the plan. [m]"""
PANEL = 2.3, 1.9
"""Of one storey. [inch]"""
TICKS = SAFETY.drift, 2 * SAFETY.drift, TILT.drift
"""Drifts. [-]"""


@default_style()
def plans(frames, failures=()):
    """Figure with a plan of each storey at the start: columns, braces, walls, broken joints, numbered failures."""
    e = frames.elements
    columns = [k for k, kind in enumerate(e.kind) if kind == "column"]
    storeys = sorted({int(e.storey[k]) for k in columns})
    figure = new_figure(1.75 * max(len(storeys), 1), 1.85, DPI)
    axes = figure.subplots(1, max(len(storeys), 1), squeeze=False)[0]
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.88, 0.06)
    for axis, storey in zip(axes, storeys):
        draw_plan(axis, frames, storey)
        draw_failures(axis, frames, storey, failures)
        if columns:
            low, high = e.position[columns].min(0), e.position[columns].max(0)
            axis.set(xlim=(low[0] - EDGE, high[0] + EDGE), ylim=(low[1] - EDGE, high[1] + EDGE))
    return figure


def draw_plan(axis, frames, storey):
    e = frames.elements
    for kind, corners, place in zip(e.kind, frames.all_corners(), e.storey):
        if place != storey or kind not in ("column", "brace"):
            continue
        (x0, y0), (x1, y1) = corners[:, :2].min(0), corners[:, :2].max(0)
        if kind == "column":
            thick = max(x1 - x0, y1 - y0) >= THICK
            axis.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="black" if thick else "white",
                                     edgecolor="black", lw=0.5, zorder=3))
        else:
            axis.add_patch(wedge(corners))
    sheets = frames.sheets
    for low, high, opening in zip(sheets.low, sheets.high, sheets.opening):
        if e.storey[low] == storey:
            axis.plot(*e.position[[low, high], :2].T, color=colors.GREEN, lw=2.2, ls="-" if opening == "none" else ":",
                      solid_capstyle="butt", zorder=1.5)
    damaged = frames.joint_places(0)[np.asarray(frames.joints.damaged, bool) & (e.storey[frames.joints.a] == storey)]
    axis.plot(*damaged[:, :2].T, "o", ms=2.5, mfc="white", mec=colors.ORANGE, mew=0.8, zorder=4)
    axis.set_title(f"storey {storey}", fontsize=7, pad=2, y=1)
    axis.set_aspect("equal")
    axis.axis("off")


def draw_failures(axis, frames, storey, failures):
    """Numbers of the failures in a storey at the first of their joints, those at one place in a row."""
    places = frames.joint_places(0)
    rows = {}
    for number, failure in enumerate(failures, 1):
        joint = failure.joints[0]
        if frames.elements.storey[frames.joints.a[joint]] == storey:
            rows.setdefault(tuple(places[joint][:2].round(0)), {})[number] = places[joint][:2]
    for row in rows.values():
        at = np.mean(list(row.values()), axis=0)
        text = " ".join(map(str, row))
        axis.text(*at, text, fontsize=6.5, fontweight="bold", color="white", ha="center", va="center", zorder=6,
                  bbox={"boxstyle": "round,pad=0.18", "facecolor": colors.ORANGE, "edgecolor": "white", "lw": 0.5})


def wedge(corners):
    """A brace seen from above: thin at the foot, thick at the head. corners (n, 3) [m]"""
    z = corners[:, 2]
    middle = (z.min() + z.max()) / 2
    foot, head = corners[z < middle, :2].mean(0), corners[z >= middle, :2].mean(0)
    along = (head - foot) / max(np.linalg.norm(head - foot), 1e-9)
    aside = 0.11 * np.array([-along[1], along[0]])
    return Polygon([foot, head + aside, head - aside], closed=True, facecolor=colors.BLUE, edgecolor="none", zorder=2)


@default_style()
def pushover(name, structure):
    """Figure with the pushover curves of the storeys and the demand of the wall quantity's rule; None without walls and
    braces. name: of the structure; structure: its part of `diagnosis`"""
    storeys = {storey: table["directions"] for storey, table in structure["storeys"].items()
               if any(side.get("pushover") for side in table["directions"].values())}
    if not storeys:
        return None
    drawn = new_figure(PANEL[0] * len(storeys), PANEL[1], DPI)
    for axis, (storey, sides) in zip(drawn.subplots(1, len(storeys), squeeze=False)[0], storeys.items()):
        for direction, side in sides.items():
            drifts, shears = zip(*side["pushover"] or [(0.0, 0.0)])
            color = colors.DIRECTIONS[direction]
            axis.plot(drifts, shears, color=color, lw=1, label=direction_name(direction))
        rule = next(iter(sides.values()))
        if rule["required_quantity_m"]:
            axis.axhline(rule["demand_kn"], color="#555555", lw=0.8, ls="--", label="required by the rule")
        axis.set(xlim=0, ylim=0)
        axis.set_xticks([0, *TICKS], ["0", *map(ratio, TICKS)])
        axis.axvline(DAMAGE.drift, color="#999999", lw=0.6, ls=":")
        axis.set_title(f"{name}, storey {storey}: shear [kN] over drift", fontsize=6.5, loc="left", pad=2, y=1)
        axis.tick_params(labelsize=6, pad=1.5, length=2)
        axis.grid(alpha=0.25)
        axis.legend(fontsize=6, frameon=False, handlelength=1.2)
    drawn.subplots_adjust(left=0.3 / len(storeys) / PANEL[0], right=0.98, top=0.9, bottom=0.12, wspace=0.22)
    return drawn


@default_style()
def motion(frames):
    """Figure with the horizontal accelerations, and the 5 % spectra with lines at the natural periods."""
    figure = new_figure(3.9, 1.85, DPI)
    left, right = figure.subplots(1, 2, width_ratios=(1.2, 1))
    figure.subplots_adjust(left=0.11, right=0.985, top=0.9, bottom=0.2, wspace=0.34)
    recorded = frames.motion
    start, end = first_shown(frames), last_shown(frames)
    shown = (recorded.time >= start) & (recorded.time <= end)
    for direction, column in (("ew", 0), ("ns", 1)):
        values = np.asarray(recorded.acceleration)[:, column]
        left.plot(recorded.time[shown], values[shown] / GAL, color=colors.DIRECTIONS[direction], lw=0.4,
                  label=direction_name(direction))
        spectrum = response_spectrum(values, recorded.dt, PERIODS)
        right.semilogx(PERIODS, spectrum.psv * 0.01 * 2 * np.pi / PERIODS, color=colors.DIRECTIONS[direction], lw=1)
    draw_periods(right, frames.summary)
    style(left, "ground acceleration [gal]", "time [s]")
    style(right, "5 % spectrum [m/s²]", "period [s]")
    right.set_xticks([0.1, 0.5, 1, 5], ["0.1", "0.5", "1", "5"])
    left.legend(fontsize=6, frameon=False, loc="upper left", handlelength=1)
    return figure


def draw_periods(axis, summary):
    """Lines at the natural periods before the run."""
    for direction in DIRECTIONS:
        mode = summary.main_mode("before", direction)
        if mode and mode.period_s:
            axis.axvline(mode.period_s, color=colors.DIRECTIONS[direction], lw=0.8, ls=":")


def style(axis, title, x):
    axis.set_title(title, fontsize=7, loc="left", pad=2, y=1)
    axis.set_xlabel(x, fontsize=6.5, labelpad=0)
    axis.tick_params(labelsize=6, pad=1.5, length=2)
    axis.grid(alpha=0.25)


def shots(stills):
    """(figure with up to six key times in the view of the largest motion; height of its heading [inch])."""
    summary = stills.frames.summary
    direction = summary.tilt_direction or summary.largest_drift()[2]
    figure = stills.sheet(FRONT if direction == "ns" else SIDE, SHOTS)
    return figure, heading_height(figure.get_size_inches()[0], result(stills.frames)) + 0.12
