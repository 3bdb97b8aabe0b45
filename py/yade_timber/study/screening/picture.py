# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects of a screening as a picture: a column for each response, a row for each factor and each string of interactions."""
import textwrap

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ...base.atomic_write import written_whole
from ...base.colors import BLUE, GREY, ORANGE
from ..factors import FACTORS
from .effects import EMPTY, INTERACTION, MAIN, SIGNIFICANT, columns
from .responses import LOG, RESPONSES, SHARE

SHOWN = ("drift_A", "drift_B", "drift_C", "falls_A", "falls_B1", "falls_B2", "across_B1", "across_B2", "C_over_B", "C1_over_B1", "C2_over_B2",
         "column_beam_west_B1", "snow_damage_B1", "claims")  # fmt: skip
"""Responses in the picture."""


def draw(results, path):
    """Write the picture; returns its path. Raises OSError."""
    wanted = columns(len(FACTORS))
    rows = {column[:2]: y for y, column in zip(_heights(wanted), wanted)}
    figure = Figure(figsize=(4.5 + 1.25 * len(SHOWN), 10.5), layout="constrained")
    axes = figure.subplots(1, len(SHOWN), sharey=True)
    for axis, name in zip(axes, SHOWN):
        _column(axis, name, results.effects(name), rows)
    axes[0].set_yticks(list(rows.values()), [row_label(column) for column in wanted], fontsize=8)
    axes[0].set_ylim(max(rows.values()) + 0.8, -0.8)
    figure.suptitle(f"Effects of the second level of each choice: {len(results.cells)} cells, medians of {len(results.motions)} motions. "
                    f"Bars: {SIGNIFICANT:g} standard errors; coloured: beyond them", fontsize=11)  # fmt: skip
    with written_whole(path) as part:
        figure.savefig(part, dpi=120, format="png")
    return path


def _heights(wanted):
    """Vertical positions of the rows, with a gap between the kinds."""
    gaps = {MAIN: 0.0, INTERACTION: 1.0, EMPTY: 2.0}
    return [k + gaps[kind] for k, (kind, _, _) in enumerate(wanted)]


def row_label(column):
    kind, word, factors = column
    if kind == MAIN:
        return f"{FACTORS[factors[0]].title}  {factors[0] + 1}"
    return "  ".join(f"{i + 1}×{j + 1}" for i, j in factors) or "no factor"


def _column(axis, name, effects, rows):
    """Effects on one response, as points with bars."""
    kind = RESPONSES[name].kind
    for effect in effects:
        colour = GREY if not effect.stands_out else ORANGE if effect.value > 0 else BLUE
        bar = 0.0 if np.isnan(effect.error) else SIGNIFICANT * effect.error
        axis.errorbar(effect.value, rows[effect.kind, effect.word], xerr=bar, fmt="o", color=colour, ms=5 if effect.kind == MAIN else 3, lw=1.3)
    axis.axvline(0, color="black", lw=0.6, zorder=0)
    reach = max(map(abs, axis.get_xlim()))
    axis.set_xlim(-reach, reach)
    axis.set_title(textwrap.fill(RESPONSES[name].title, 16), fontsize=8.5)
    axis.xaxis.set_major_locator(MaxNLocator(3, symmetric=True))
    if kind == LOG:
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"×{10 ** value:.2g}"))
    elif kind == SHARE:
        axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:+.0f} %"))
    axis.tick_params(axis="x", labelsize=7.5)
    axis.tick_params(axis="y", length=0)
    axis.grid(axis="y", alpha=0.25)
