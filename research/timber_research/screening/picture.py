# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects of a screening as a picture: a column for each response, a row for each factor and each string of
interactions.
"""
import textwrap

import numpy as np
from matplotlib.figure import Figure
from timber_houses.base.atomic_write import written_whole
from timber_houses.base.colors import BLUE, GREY, ORANGE
from timber_houses.pictures.fonts import default_style

from .. import design
from ..factors import FACTORS
from .effects import EMPTY, INTERACTION, MAIN, SIGNIFICANT, columns
from .responses import COUNT, LOG, RESPONSES, SHARE

SHOWN = ("falls_A", "falls_B", "drift_B", "drift_C", "falls_B1", "falls_B2", "across_B1", "across_B2", "C_over_B",
         "C1_over_B1", "C2_over_B2", "column_beam_west_B1", "snow_damage_B1", "claims")
"""Responses in the picture."""
GROUPS = {MAIN: "effect of a choice", INTERACTION: "interactions (sum of those in a row)",
          EMPTY: "columns without a choice: chance"}
ROW_HEIGHT = 0.25
"""[inch]"""
SMALLEST_REACH = {LOG: 0.1, SHARE: 0.2, COUNT: 1.0}
"""Smallest half-width of an axis. [of the response]"""
TICKS = {LOG: (1.1, 1.2, 1.5, 2, 3, 5, 10, 20, 50, 100, 1000), SHARE: (10, 20, 50, 80),
         COUNT: (0.5, 1, 2, 5, 10, 20, 50)}
"""Admissible ticks: factors, per cent, numbers."""


@default_style()
def draw(results, path):
    """Write the picture; returns its path. Raises OSError."""
    effects = {name: results.effects(name) for name in SHOWN}
    kinds = {MAIN} | {effect.kind for some in effects.values() for effect in some}
    wanted = [column for column in columns(len(FACTORS)) if column[0] in kinds]
    rows = {column[:2]: y for y, column in zip(_heights(wanted), wanted)}
    figure = Figure(figsize=(4.2 + 1.2 * len(SHOWN), 1.8 + ROW_HEIGHT * (max(rows.values()) + 2.6)),
                    layout="constrained")
    axes = figure.subplots(1, len(SHOWN), sharey=True)
    for axis, name in zip(axes, SHOWN):
        _column(axis, RESPONSES[name], effects[name], rows)
    axes[0].set_yticks(list(rows.values()), [_row_label(column) for column in wanted], fontsize=9)
    axes[0].set_ylim(max(rows.values()) + 0.8, -1.8)
    for kind in kinds:
        top = min(y for (other, _), y in rows.items() if other == kind)
        axes[0].text(0, top - 0.95, GROUPS[kind] + "  ", transform=axes[0].get_yaxis_transform(), ha="right",
                     va="center", fontsize=9, weight="bold")
    figure.suptitle(_title(results, EMPTY in kinds), fontsize=11)
    with written_whole(path) as part:
        figure.savefig(part, dpi=130, format="png")
    return path


def _title(results, has_empty):
    """has_empty: whether there are columns without a choice."""
    cells = ("all 32 cells" if len(results.cells) == design.RUNS
             else f"{len(results.cells)} of {design.RUNS} cells (main effects confounded with interactions)")
    band = (f"grey band: {SIGNIFICANT:g} times the size of effects without a choice; coloured: beyond both" if has_empty
            else "coloured: beyond them")
    return (f"What the second level of each choice changes: {cells}, {len(results.motions)} motions.  "
            f"Bars: {SIGNIFICANT:g} standard errors from the motions; {band}")


def _heights(wanted):
    """Vertical positions of the rows, with a gap between the kinds."""
    gaps = {MAIN: 0.0, INTERACTION: 1.6, EMPTY: 3.2}
    return [k + gaps[kind] for k, (kind, _, _) in enumerate(wanted)]


def _row_label(column):
    kind, word, factors = column
    if kind == MAIN:
        return f"{FACTORS[factors[0]].title}  {factors[0] + 1:2d}"
    return "  ".join(f"{i + 1}×{j + 1}" for i, j in factors) or word


def _column(axis, response, effects, rows):
    """Effects on one response, as points with bars."""
    for effect in effects:
        colour = GREY if not effect.stands_out else ORANGE if effect.value > 0 else BLUE
        bar = 0.0 if np.isnan(effect.error) else SIGNIFICANT * effect.error
        axis.errorbar(effect.value, rows[effect.kind, effect.word], xerr=bar, fmt="o", color=colour,
                      ms=6 if effect.kind == MAIN else 4, lw=1.6)
    if effects and not np.isnan(effects[0].chance):
        axis.axvspan(-SIGNIFICANT * effects[0].chance, SIGNIFICANT * effects[0].chance, color=GREY, alpha=0.2, lw=0)
    _scale(axis, response.kind)
    axis.axvline(0, color="black", lw=0.7, zorder=0)
    axis.set_title(textwrap.fill(response.title, 15), fontsize=9)
    axis.tick_params(axis="x", labelsize=8)
    axis.tick_params(axis="y", length=0)
    axis.grid(axis="y", alpha=0.25)


def _scale(axis, kind):
    """Symmetric axis with a tick to each side: factors for logarithms, per cent for shares."""
    reach = max(*map(abs, axis.get_xlim()), SMALLEST_REACH[kind])
    units = {LOG: np.log10(TICKS[LOG]), SHARE: np.divide(TICKS[SHARE], 100), COUNT: TICKS[COUNT]}[kind]
    number = max(np.searchsorted(units, 0.9 * reach), 1) - 1
    tick, text = units[number], f"{TICKS[kind][number]:g}"
    below, above = (f"÷{text}", f"×{text}") if kind == LOG else (f"−{text}", f"+{text}")
    axis.set_xticks([-tick, 0, tick], [below, "1" if kind == LOG else "0", above])
    axis.set_xlim(-reach, reach)
    axis.set_xlabel({LOG: "factor", SHARE: "percentage points", COUNT: "number"}[kind], fontsize=8)
