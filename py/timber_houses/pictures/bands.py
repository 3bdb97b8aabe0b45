# SPDX-License-Identifier: GPL-2.0-or-later
"""One page about an ensemble: storey drifts over time as bands, with the run that is shown as a line."""
import numpy as np

from ..base import colors
from ..text.english import direction_name
from .curves import draw_events, draw_levels, label
from .figures import A4, footer, heading, heading_height, new_figure
from .key_times import first_shown
from .provenance import provenance
from .sheets import result
from .style import default_style

DPI = 200
QUANTILES = (0.0, 0.25, 0.5, 0.75, 1.0)
LEGEND_HEIGHT = 0.42
"""Of the legend and of the labels of events above the axes. [inch]"""


@default_style()
def page(frames, histories, dpi):
    """Figure with the bands. frames: of the run that is shown; histories: {number: History} of all runs"""
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
