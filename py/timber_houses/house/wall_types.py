# SPDX-License-Identifier: GPL-2.0-or-later
"""Types of sheathing -> envelopes: shear per metre of wall [N/m] over the drift [rad] at first loading; and cycles."""
from dataclasses import dataclass

import numpy as np

from . import saws
from .layout import OPENINGS, SAWS_STATES
from .model import WallCycles
from .nails import nailed_wall
from .schema import fail

ALLOWABLE = 1960.0
"""Allowable shear of a wall of multiplier 1. [N per m of wall] (Order of the Building Standard Law, Article 46)"""
RATED_DRIFT = 1 / 120  # drift at which walls with pinned feet are rated. [rad]


@dataclass(frozen=True)
class Level:
    """Envelope of walls of a rated multiplier over their allowable shear: points (drift, ratio) before the largest
    shear, the ratio of the largest shear, the drift from which it falls, and the drift without any."""

    points: tuple
    ratio: float
    softening_drift: float
    ultimate_drift: float

    @property
    def stiffness(self):
        """Over the allowable shear. [1/rad]"""
        drift, ratio = self.points[0]
        return ratio / drift


LEVELS = {"design": Level(((0.01, 1.5),), 1.5, 0.05, 0.103),
          "mean": Level(((1 / 120, 1.4), (1 / 80, 1.8)), 2.8, 1 / 30, 0.115)}
"""`design`: just passes the test of its multiplier; `mean`: mean of tested walls (sources: docs/house_files.md)."""
TAIL = LEVELS["mean"].ultimate_drift / 0.0497
"""Drift without shear over the drift at 80 % of the largest shear, the end of tests: that of `mean`. [-]"""
SLIP_TOLERANCE = 0.1  # of the nails' Pv = k dv. [-]
ROUNDING = 1e-9  # of shears. [-]
LEAST_SHEAR = 100.0  # of the largest shear of an envelope, below which it is taken to be in kN. [N/m]
LEAST_FRICTION = 1e-3  # of the largest shear: a friction force between zero and this is taken to be in kN. [-]
QUASI_LIMIT = 1.5
"""Largest multiplier of a quasi-bearing wall. [-] (Notification 1100 as of 2025; compared: kenchiku-spec of
wall_quantity.py)"""
FORMS = ("envelope", "nails", "saws")  # of a type's shear, in place of that of its multiplier
FRICTION = 0.1
"""Friction force over the largest shear. [-] (SAWS set of a wall of OpenSees' example; docs/theory.md, walls)"""
RELOAD_SHARE = 0.65  # share of the slack from which walls reload. [-] (likewise)
RELOAD_TARGET = 1.1  # drift at which reloading meets the envelope, over the largest one so far. [-] (likewise)


def check_wall_types(types):
    """HouseError for none or several descriptions of a type's shear, and for points or drifts that do not ascend."""
    for name, table in types.items():
        if name in OPENINGS:
            table.refuse(None, "the name of an opening; choose another one")
        forms = [key for key in FORMS if table[key] is not None]
        if len(forms) > 1:
            fail(table.at(forms[1]), table.path, f"give one of {', '.join(FORMS)}; got {' and '.join(forms)}")
        if forms:
            _refuse(table, ("strength", "stiffness"), forms[0])
            _CHECKS[forms[0]](table)
        else:
            _check_rated(table)
        _check_cycles(table)


def _points(table):
    """[(drift, shear)] of an envelope without the origin."""
    points = [tuple(point) for point in table["envelope"]]
    return points[1:] if points[:1] == [(0, 0)] else points


def _refuse(table, keys, form):
    for key in keys:
        if table[key] is not None:
            fail(table.at(key), table.path,
                 f"'{key}' does not go with {form}, from which it follows; remove one of them")


def _check_rated(table):
    for key in ("strength", "stiffness"):
        if not table["multiplier"] and table[key] is None:
            table.refuse(None, f"give multiplier or {key}, or envelope, or nails, or saws")
    for level in LEVELS:
        points = envelope(table, level)
        drifts = [drift for drift, _ in points]
        if drifts != sorted(set(drifts)):
            ends = f"softening_drift {drifts[-2]:g} and ultimate_drift {drifts[-1]:g} must ascend"
            fail(table.at("softening_drift"), table.path,
                 f"strength / stiffness = {drifts[0]:.3g}, {ends}" if len(points) > 2 else ends)


def _check_envelope(table):
    _refuse(table, ("softening_drift",), "envelope")
    points = _points(table)
    drifts = [drift for drift, _ in points]
    if not points or drifts[0] <= 0:
        table.refuse("envelope", "needs points [drift, shear] with drifts > 0; the origin may be left out")
    if drifts != sorted(set(drifts)):
        table.refuse("envelope", f"the drifts must ascend, got {', '.join(f'{drift:.4g}' for drift in drifts)}")
    if any(shear == 0 for _, shear in points[:-1]):
        table.refuse("envelope", "only the last point may have no shear")
    largest = max(shear for _, shear in points)
    if largest < LEAST_SHEAR:
        table.refuse("envelope", f"the largest shear is {largest:g} N per m of wall, at least {LEAST_SHEAR:g}; kN are"
                     " 1000 N")
    if table["ultimate_drift"] is None and points[-1][1] == largest:
        table.refuse("envelope", "the last point has the largest shear; add points beyond it, or ultimate_drift, at"
                     " which there is no shear left")
    if points[-1][1] == 0 and table["ultimate_drift"] is not None:
        table.refuse("ultimate_drift", "the last point of envelope has no shear already; remove one of them")
    _check_end(table, drifts[-1], "the last drift of envelope")


def _check_nails(table):
    _refuse(table, ("softening_drift",), "nails")
    nails = table["nails"]
    board, slip = nails["board"], nails["Pv"] / nails["k"]
    if not nails["du"] > slip:
        nails.refuse("du", f"must be greater than Pv / k = {slip:g} m, got {nails['du']:g}")
    if nails["dv"] is not None and abs(nails["dv"] / slip - 1) > SLIP_TOLERANCE:
        nails.refuse("dv", f"must be Pv / k = {slip:g} m within 10 %, got {nails['dv']:g}")
    if 2 * board["edge"] >= min(board["width"], *board["heights"]):
        board.refuse("edge", f"{board['edge']:g} m from the edge leaves no place for nails")
    if nails["height"] is not None and nails["height"] < sum(board["heights"]):
        nails.refuse("height",
                     f"{nails['height']:g} m is less than the boards' heights, {sum(board['heights']):g} m")
    wall = nailed_wall(nails)
    if wall.ultimate_drift > 1:
        nails.refuse(None, f"the wall fails at a drift of {wall.ultimate_drift:.3g}; at most 1: check du")
    _check_end(table, wall.ultimate_drift, "the drift at which the nails fail")


def _check_end(table, last, name):
    if table["ultimate_drift"] is not None and not table["ultimate_drift"] > last:
        table.refuse("ultimate_drift", f"must be greater than {name}, {last:.4g}, got {table['ultimate_drift']:g}")


def _check_saws(table):
    _refuse(table, (*SAWS_STATES, "friction_share", "softening_drift", "ultimate_drift"), "saws")
    problem = saws.unmet_by(table["saws"])
    if problem:
        table.refuse("saws", problem)


def _check_cycles(table):
    for key in (*SAWS_STATES, "residual_share") if table["friction_share"] is not None else ():
        if table[key] if key == "residual_share" else table[key] is not None:
            table.refuse(key, "does not go with friction_share, the law slip; remove one of them")
    if (table["reload_power"] is None) != (table["reload_drift"] is None):
        table.refuse(None, "reload_drift and reload_power go together; give both or none")
    if table["reload_power"] is not None and table["reload_share"] is not None:
        table.refuse("reload_share", "does not go with reload_power; remove one of them")
    for level in LEVELS:
        points = envelope(table, level)
        drift, largest = max(points, key=lambda point: point[1])
        friction = table["friction_force"]
        if friction is not None and not friction < largest:
            table.refuse("friction_force", f"must be below the largest shear, {largest:.4g} N/m, got {friction:g}")
        if friction and friction < LEAST_FRICTION * largest:
            table.refuse("friction_force", f"{friction:g} N/m is below {LEAST_FRICTION:g} of the largest shear,"
                         f" {largest:.4g} N/m; kN are 1000 N")
        if table["pinched_share"]:
            left = largest - cycles(table, level)[0].friction_force
            share = left / drift / steepest(points)
            if not table["pinched_share"] < share:
                table.refuse("pinched_share", "the pinched line must stay below the largest shear: less than"
                             f" {share:.3g}, got {table['pinched_share']:g}")


_CHECKS = {"envelope": _check_envelope, "nails": _check_nails, "saws": _check_saws}


def has_rated_walls(data):
    """Whether a house (data of its file) has walls whose envelope depends on the level."""
    used = {name for structure in data["structures"].values() for line in structure["walls"] for name in line["type"]}
    tables = [data["wall_types"][name] for name in used]
    return any(all(table[form] is None for form in FORMS) and None in (table["strength"], table["stiffness"])
               for table in tables)


def envelope(table, level):
    """[(drift, shear)] of a wall type from its first point to zero or residual shear. level: of LEVELS, for rated types
    """
    if table["envelope"] is not None:
        points = _tested(table)
    elif table["nails"] is not None:
        points = _nailed(table)
    else:
        points = _rated(table, LEVELS[level]) if table["saws"] is None else saws.envelope(table["saws"])
    residual = table["residual_share"] * max(shear for _, shear in points)
    kept = list(points)
    while len(kept) > 1 and kept[-2][1] <= residual * (1 + ROUNDING):
        kept.pop()
    (d0, f0), (d1, f1) = kept[-2:]
    return [*kept[:-1], (d0 + (f0 - residual) / (f0 - f1) * (d1 - d0), residual)] if residual > 0 else points


def cycles(table, level):
    """(WallCycles, unloading stiffness over the steepest slope of the envelope [-]) of a wall type."""
    if table["saws"] is not None:
        return saws.cycles(table["saws"])
    points = envelope(table, level)
    given = {key: default if table[key] is None else table[key]
             for key, default in (("friction_force", FRICTION * max(shear for _, shear in points)),
                                  ("reload_share", RELOAD_SHARE), ("reload_target", RELOAD_TARGET))}
    if table["pinched_share"]:
        given["pinched_stiffness"] = table["pinched_share"] * steepest(points)
    if table["reload_power"] is not None:
        given |= {"reload_share": 0.0, "reload_stiffness": steepest(points), "reload_stretch": table["reload_drift"],
                  "reload_power": table["reload_power"]}
    return WallCycles(**given), 1.0


def steepest(points):
    """Slope of the steepest line of an envelope from the origin on. [force per drift or stretch]"""
    return max(_slope(a, b) for a, b in zip([(0.0, 0.0), *points], points))


def multiplier(table):
    """Wall multiplier of a type: its own, else its allowable shear over that of 1. [-] Allowable: of nails as in
    nails.py, else the lesser of the shear at 1/120 and two thirds of the largest one."""
    if table["multiplier"] is not None:
        return table["multiplier"]
    if table["nails"] is not None:
        return nailed_wall(table["nails"]).allowable / table["nails"]["board"]["width"] / ALLOWABLE
    drifts, shears = np.transpose([(0.0, 0.0), *envelope(table, "design")])
    return float(min(np.interp(RATED_DRIFT, drifts, shears), 2 / 3 * shears.max())) / ALLOWABLE


def quasi_multiplier(table, panel):
    """By which panels count as quasi-bearing wall. panel: their height over the clear height [-]

    `panel_share` (boards 0.6, wood lath 1) times the multiplier times the share of the height; a lining has a
    `quasi_multiplier`, as it counts as nothing else. (Notification 1100 as of 2025; compared: stmaki.com, page 2775:
    gypsum 0.9 x 0.6 x 240 cm / 284.4 cm = 0.45)"""
    base = multiplier(table) if table["quasi_multiplier"] is None else table["quasi_multiplier"]
    return min(QUASI_LIMIT, table["panel_share"] * base * panel)


def _rated(table, level):
    """Of a multiplier; with an own strength or stiffness: bilinear."""
    allowable = ALLOWABLE * (table["multiplier"] or 0.0)
    softening, ultimate = (getattr(level, key) if table[key] is None else table[key]
                           for key in ("softening_drift", "ultimate_drift"))
    if table["strength"] is None and table["stiffness"] is None:
        rising = [(drift, ratio * allowable) for drift, ratio in level.points]
        return [*_concave(rising, (softening, level.ratio * allowable)), (ultimate, 0.0)]
    strength = level.ratio * allowable if table["strength"] is None else table["strength"]
    stiffness = level.stiffness * allowable if table["stiffness"] is None else table["stiffness"]
    return [(strength / stiffness, strength), (softening, strength), (ultimate, 0.0)]


def _concave(rising, peak):
    """The points up to the peak without those below a line between two others: early strength makes it stiffer."""
    kept = [(0.0, 0.0)]
    for drift, shear in [*(point for point in rising if point[1] == peak[1] or point[0] < peak[0]), peak]:
        while len(kept) > 1 and _slope(kept[-2], kept[-1]) <= _slope(kept[-1], (drift, shear)):
            kept.pop()
        kept.append((drift, shear))
    return kept[1:]


def _slope(a, b):
    return (b[1] - a[1]) / (b[0] - a[0]) if b[0] != a[0] else float("-inf")


def _tested(table):
    """Points of a test; beyond them the line from the largest shear, unless `ultimate_drift` says otherwise."""
    points = _points(table)
    (drift, shear), peak = points[-1], max(points, key=lambda point: point[1])
    if shear == 0:
        return points
    end = table["ultimate_drift"]
    return [*points, (drift + shear * (drift - peak[0]) / (peak[1] - shear) if end is None else end, 0.0)]


def _nailed(table):
    """Elastic and plastic up to the nails' failure; then as the mean of tested walls."""
    wall, width = nailed_wall(table["nails"]), table["nails"]["board"]["width"]
    strength = wall.strength / width
    end = TAIL * wall.ultimate_drift if table["ultimate_drift"] is None else table["ultimate_drift"]
    return [(wall.yield_drift, strength), (wall.ultimate_drift, strength), (end, 0.0)]
