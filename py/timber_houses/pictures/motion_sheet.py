# SPDX-License-Identifier: GPL-2.0-or-later
"""One page about a ground motion (paper, Fig. 9): accelerations, velocities, displacements and response spectra."""
import numpy as np
from matplotlib.ticker import FuncFormatter

from ..base.colors import DIRECTIONS
from ..motion import GAL, constant_note, displacement, pga, pgv, response_spectrum, shaking_window, velocity
from ..motion.measures import stated_intensity
from .figures import A4, default_style, heading, heading_height, new_figure, save, stem_and_endings

DPI = 150
LEGEND_HEIGHT = 0.32
"""Between the heading and the diagrams. [inch]"""
QUIET = 0.01
"""Motion before the first and after the last acceleration of this share of the PGA is not shown. [-]"""
PERIODS = np.geomspace(0.05, 10.0, 120)
ROWS = (("ns", 1, "N-S", "-"), ("ew", 0, "E-W", "--"), ("ud", 2, "up-down", ":"))
"""Key, column, name, line style of the components."""


def write(path, motion, corner):
    """Write a motion, as PDF if the path ends so; corner as in `page`. Returns the paths. Raises OSError."""
    return save(page(motion, corner, DPI), *stem_and_endings(path))


@default_style()
def page(motion, corner, dpi):
    """Figure with the motion. corner: high-pass of velocities and displacements [Hz], or None."""
    figure = new_figure(A4[1], A4[0], dpi)
    axes = figure.subplots(3, 2, width_ratios=(1.25, 1))
    about = describe(motion)
    top = 1 - (heading_height(A4[1], about) + LEGEND_HEIGHT) / A4[0]
    figure.subplots_adjust(left=0.07, right=0.985, top=top, bottom=0.07, hspace=0.28, wspace=0.17)
    heading(figure, f"Ground motion {motion.name}", about)
    draw_accelerations(axes[:, 0], motion)
    draw_curves(axes[0, 1], motion.time, 100 * velocity(motion, corner), "velocity [cm/s]")
    draw_curves(axes[1, 1], motion.time, 100 * displacement(motion, corner), "displacement [cm]")
    axes[1, 1].set_xlabel("time [s]", fontsize=8)
    draw_spectra(axes[2, 1], motion)
    first, last = shaking_window(motion, QUIET * pga(motion))
    for axis in (*axes[:, 0], *axes[:2, 1]):
        axis.set_xlim(max(0.0, first - 2), min(motion.duration, last + 2))
    for axis in axes.flat:
        axis.grid(alpha=0.25)
        axis.tick_params(labelsize=8)
    return figure


def describe(motion):
    """Source, JMA intensity and horizontal peaks."""
    intensity = stated_intensity(motion)
    intensity = "none" if intensity is None else f"{intensity:.1f}"
    peaks = (f"{motion.source}; JMA intensity {intensity}, horizontal vector {pga(motion, 'h'):.0f} gal"
             f" and {pgv(motion):.0f} cm/s")
    return "\n".join(filter(None, (peaks, constant_note(motion))))


def draw_accelerations(axes, motion):
    """The components below each other on one scale, each with its peak."""
    reach = 1.1 * pga(motion)
    for axis, (key, column, name, _) in zip(axes, ROWS):
        values = motion.acceleration[:, column] / GAL
        peak = np.argmax(np.abs(values))
        axis.plot(motion.time, values, color=DIRECTIONS[key], lw=0.6)
        axis.plot(motion.time[peak], values[peak], "o", markersize=4, markerfacecolor="none", color="black")
        text = f"{abs(values[peak]):.0f} gal at {motion.time[peak]:.2f} s"
        axis.annotate(text, (motion.time[peak], values[peak]), (7, 0), textcoords="offset points", fontsize=8,
                      va="center")
        axis.set_ylim(-reach, reach)
        axis.set_ylabel(f"acceleration {name} [gal]", fontsize=8)
    axes[-1].set_xlabel("time [s]", fontsize=8)


def draw_curves(axis, time, values, label):
    for key, column, name, dashes in reversed(ROWS):
        axis.plot(time, values[:, column], color=DIRECTIONS[key], ls=dashes, lw=0.9, label=name)
    axis.set_ylabel(label, fontsize=8)
    axis.legend(
        loc="lower right", bbox_to_anchor=(1, 1), ncols=3, fontsize=8, frameon=False, borderaxespad=0
    )  # above: it hides no peak


def draw_spectra(axis, motion):
    """Pseudo-velocity of oscillators with 5 % of critical damping."""
    for key, column, name, dashes in ROWS:
        if not motion.acceleration[:, column].any():
            continue
        spectrum = response_spectrum(motion.acceleration[:, column], motion.dt, PERIODS)
        axis.loglog(PERIODS, spectrum.psv, color=DIRECTIONS[key], ls=dashes, lw=1.2, label=name)
    for direction in (axis.xaxis, axis.yaxis):
        direction.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_xlim(PERIODS[0], PERIODS[-1])
    axis.set_xlabel("period [s]", fontsize=8)
    axis.set_ylabel("5 % pseudo-velocity [cm/s]", fontsize=8)
    axis.legend(loc="upper left", fontsize=8, framealpha=0.9)
