# SPDX-License-Identifier: GPL-2.0-or-later
"""Published parameter sets of the law SAWS (Folz and Filiatrault 2001) -> envelope and cycles of a wall type.

The backbone (F0 + R1 S0 d) (1 - exp(-S0 d / F0)) up to DU, then a line of slope R2 S0, in points: with x = S0 d / F0
they lie at equal steps of exp(-x / 2), by which the lines between them miss the curve by the same force everywhere."""
import math

from .model import WallCycles

POINTS = 256  # up to DU: the lines miss the curve by at most F0 / 65536


def _force(table, d):
    """Backbone at a displacement up to DU [m]. [N]"""
    return (table["F0"] + table["R1"] * table["S0"] * d) * -math.expm1(-table["S0"] * d / table["F0"])


def unmet_by(table):
    """Problem of a checked table, or ''."""
    pinched = table["FI"] + table["R4"] * table["S0"] * table["DU"]
    if not table["FI"] < table["F0"]:
        return f"FI must be below F0 = {table['F0']:g} N, got {table['FI']:g}"
    if not pinched < _force(table, table["DU"]):
        return f"the pinched line has {pinched:.4g} N at DU, more than the backbone, {_force(table, table['DU']):.4g} N"
    if not table["S0"] * table["DU"] > table["F0"]:
        return f"DU must be greater than F0 / S0 = {table['F0'] / table['S0']:g} m, got {table['DU']:g}; S0 is in N/m"
    return ""


def envelope(table):
    """[(drift [rad], shear [N per m of wall])] behind the origin."""
    scale = table["F0"] / table["S0"]
    whole = -math.expm1(-table["DU"] / scale / 2)
    rising = [-2 * scale * math.log1p(-whole * k / POINTS) for k in range(1, POINTS)] + [table["DU"]]
    points = [(d, _force(table, d)) for d in rising]
    end = table["DU"] - points[-1][1] / (table["R2"] * table["S0"])
    return [(d / table["height"], force / table["length"]) for d, force in [*points, (end, 0.0)]]


def cycles(table):
    """As `wall_types.cycles`."""
    rate = table["S0"] * table["height"] / table["length"]
    first = envelope(table)[0]
    return (WallCycles(table["FI"] / table["length"], table["beta"], pinched_stiffness=table["R4"] * rate,
                       reload_stiffness=rate, reload_stretch=table["F0"] / table["S0"] / table["height"],
                       reload_power=table["alpha"]), table["R3"] * rate / (first[1] / first[0]))
