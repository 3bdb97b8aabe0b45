# SPDX-License-Identifier: GPL-2.0-or-later
"""Pushover curves of the storeys of a structure, with the demand of the wall quantity's rule."""
from ..base import colors
from ..recording.verdict import DAMAGE, SAFETY, TILT
from ..text.english import direction_name, ratio
from .figures import new_figure
from .style import default_style

DPI = 170
PANEL = 2.3, 1.9
"""Of one storey. [inch]"""
TICKS = SAFETY.drift, 2 * SAFETY.drift, TILT.drift
"""Drifts. [-]"""


@default_style()
def figure(name, structure):
    """Figure of a structure's part of `diagnosis`; None without walls and braces. name: of the structure"""
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
        _demand(axis, next(iter(sides.values())))
        axis.set(xlim=0, ylim=0)
        axis.set_xticks([0, *TICKS], ["0", *map(ratio, TICKS)])
        axis.axvline(DAMAGE.drift, color="#999999", lw=0.6, ls=":")
        axis.set_title(f"{name}, storey {storey}: shear [kN] over drift", fontsize=6.5, loc="left", pad=2, y=1)
        axis.tick_params(labelsize=6, pad=1.5, length=2)
        axis.grid(alpha=0.25)
        axis.legend(fontsize=6, frameon=False, handlelength=1.2)
    drawn.subplots_adjust(left=0.3 / len(storeys) / PANEL[0], right=0.98, top=0.9, bottom=0.12, wspace=0.22)
    return drawn


def _demand(axis, side):
    if side["required_quantity_m"]:
        axis.axhline(side["demand_kn"], color="#555555", lw=0.8, ls="--", label="required by the rule")
