# SPDX-License-Identifier: GPL-2.0-or-later
"""Diagnosis of a house by the published rules: wall quantity, its balance, uplift of columns, seismic index Iw = Qu
eKfl dK / Qr.

Each structure is judged alone. Directions: ew, ns - of the walls that resist. Coefficients, sources:
diagnosis_tables.py."""
from collections import Counter
from dataclasses import dataclass

import numpy as np

from . import diagnosis_tables as rules
from .loads import bay_length
from .pushover import pushover, secant_periods
from .wall_quantity import requirement
from .wall_types import RATED_DRIFT

DIRECTIONS = {"ew": 0, "ns": 1}  # direction and the index of its axis


@dataclass(frozen=True)
class RatedBay:
    """A bay with braces, sheets without openings or panels: its columns (elements), the sum of its multipliers of
    bearing walls [-], index of its axis, effective lengths of bearing and quasi-bearing wall [m], centre (2,) [m]."""

    columns: tuple
    multiplier: float
    axis: int
    quantity: float
    quasi: float
    centre: np.ndarray


def diagnose(model):
    """The part `diagnosis` of summaries: the least iw and wall quantity ratio, where they are, and of each structure.
    None for what the rules do not give: a main structure of more than three storeys, or without floor area."""
    structures = {group: _structure(model, group) for group, storeys in model.storey_levels.items() if storeys}
    is_rated = _least(dict(list(structures.items())[:1]), "iw")[0] is not None  # the main structure
    rated = structures if is_rated else {}
    (iw, iw_at), (ratio, ratio_at) = _least(rated, "iw"), _least(rated, "wall_quantity_ratio")
    rule = next(iter(rated.values()))["rule_name"] if rated else None
    totals = {"rule": rule, "iw": iw, "iw_at": iw_at, "judgement": judgement(iw), "wall_quantity_ratio": ratio,
             "wall_quantity_at": ratio_at, "broken_from_start": sum(joint.broken for joint in model.joints),
             "structures": structures}
    return {**totals, "sentence": sentence(totals)}


def _least(structures, key):
    """(least value of a key, 'side, storey 1, N-S') over structures, storeys, directions; (None, None) without any."""
    values = [(side[key], f"{group}, storey {storey}, {rules.DIRECTION_NAMES[name]}")
              for group, structure in structures.items() for storey, table in structure["storeys"].items()
              for name, side in table["directions"].items() if side[key] is not None]
    return min(values, key=lambda value: value[0], default=(None, None))


def judgement(iw):
    """Of a seismic index, or None."""
    return None if iw is None else next(word for least, word in rules.BANDS if iw >= least)


def sentence(diagnosis):
    """'seismic index Iw 0.54 (main, storey 1, E-W): likely to collapse under a very rare earthquake; ...; natural
    periods at a drift of 1/120: N-S 0.60 s, E-W 0.59 s'."""
    if diagnosis["iw"] is None:
        index = "no seismic index: the rules are for one to three storeys with a floor area"
    else:
        ratio = 100 * diagnosis["wall_quantity_ratio"]
        index = (f"seismic index Iw {diagnosis['iw']:.2f} ({diagnosis['iw_at']}): {diagnosis['judgement']} under a very"
                 f" rare earthquake; least wall quantity {ratio:.0f} % of the required one by the {diagnosis['rule']}"
                 f" ({diagnosis['wall_quantity_at']})")
    structure = next(iter(diagnosis["structures"].values()), None)  # the main one
    periods = {name: period for name in ("ns", "ew") if structure and (period := structure["periods_s"][name])}
    if not periods:
        return index
    values = ", ".join(f"{rules.DIRECTION_NAMES[name]} {period:.2f} s" for name, period in periods.items())
    return f"{index}; natural periods at a drift of 1/{1 / structure['periods_s']['drift']:.0f}: {values}"


def comparison(summary):
    """Sentence on the first structure of a Summary whose index and outcome disagree; '' if none does. A structure that
    stands without an earthquake, or at the end of a run that left strong shaking out, agrees with every index."""
    for name, facts in summary.structures.items():
        iw = _least({name: summary.diagnosis.structures.get(name, {"storeys": {}})}, "iw")[0]
        stands_untested = not facts.collapsed and (not summary.earthquake or summary.missed_shaking is not None)
        if iw is None or facts.collapsed == (iw < 1.0) or stands_untested:
            continue
        outcome = "collapsed" if facts.collapsed else "stands"
        return f"{name.capitalize()} {outcome} although its Iw is {iw:.2f}; this run: {_circumstances(summary)}."
    return ""


def _circumstances(summary):
    """'peak acceleration 9.1 m/s2, stronger than the 4 m/s2 of the index's earthquake; snow 1 m; ...'."""
    parts = ["no earthquake"]
    if summary.earthquake:
        peak = max(summary.record.pga_gal[axis] for axis in DIRECTIONS) / 100
        than = "stronger" if peak > rules.VERY_RARE_PEAK else "weaker"
        parts = [f"peak acceleration {peak:.1f} m/s2, {than} than the {rules.VERY_RARE_PEAK:g} m/s2 of the index's"
                 " earthquake"]
    if summary.snow_depth_m:
        parts.append(f"snow {summary.snow_depth_m:g} m")
    if summary.diagnosis.broken_from_start:
        parts.append(f"{summary.diagnosis.broken_from_start} joints broken from the start")
    return "; ".join(parts)


def _structure(model, group):
    storeys, needs = sorted(model.storey_levels[group]), requirement(model, group)
    bays = _bays(model, group, needs.rule.largest_multiplier)
    first, last = rules.SNOW_DEPTHS
    addition = rules.SNOW_STRENGTH * min(model.snow_depth, last) if model.snow_depth >= first else 0.0
    strengths = {k: strength + addition for k, strength  # Qr [kN/m2], empty beyond three storeys
                 in enumerate(rules.REQUIRED_STRENGTH[needs.roof_class].get(len(storeys), ()), 1)}
    curves = pushover(model, group)
    return {"roof": needs.roof_class, **needs.table(),
            "periods_s": {"drift": RATED_DRIFT, **secant_periods(model, group, curves, RATED_DRIFT)},
            "storeys": {str(storey): _storey(model, group, storey, needs, strengths.get(storey), bays, curves)
                        for storey in storeys},
            "uplift": _uplift(model, group, bays)}


def _storey(model, group, storey, needs, strength, bays, curves):
    """strength: Qr [kN/m2], None beyond three storeys"""
    here, plans = [bay for bay in bays if bay.columns[0].storey == storey], model.plans[group]
    area, eccentricities = plans[storey].area, _eccentricities(here, _mass_centre(model, group, storey))
    is_rated = bool(needs.quantities_of_all) and area > 0
    quantity = needs.quantities_of_all[storey - 1] if is_rated else None
    return {"floor_area_m2": round(area, 3), "required_cm_m2": quantity,
            "directions": {name: _direction(here, axis, eccentricities[axis],
                                            quantity * area / 100 if is_rated else None,
                                            strength * area if strength and area > 0 else None,
                                            _quarters(here, axis, plans, storey, needs) if is_rated else None,
                                            needs.rule) | {"pushover": curves[storey, name]}
                           for name, axis in DIRECTIONS.items()}}


def _direction(bays, axis, eccentricity, needed, qr, quarters, rule):
    """needed: wall quantity [m], qr [kN], quarters: None where the rules give none"""
    mine = [bay for bay in bays if bay.axis == axis]
    bearing, quasi = sum((bay.quantity for bay in mine), 0.0), sum((bay.quasi for bay in mine), 0.0)
    existing = bearing + min(quasi, rule.quasi_share * (needed or 0.0))
    qu = rules.ALLOWABLE_KN_M * rules.FITTINGS * bearing + (rules.OTHER_ELEMENTS * qr if qr else 0.0)
    factor = eccentricity_factor(eccentricity)
    return {"wall_quantity_m": round(existing, 3), "bearing_m": round(bearing, 3), "quasi_bearing_m": round(quasi, 3),
            "required_quantity_m": _rounded(needed),
            "demand_kn": _rounded(rules.ALLOWABLE_KN_M * needed if needed else None),
            "wall_quantity_ratio": _rounded(existing / needed if needed else None), "quarters": quarters,
            "balanced": None if quarters is None else is_balanced(quarters[0], quarters[1], eccentricity),
            "eccentricity": _rounded(eccentricity), "qu_kn": round(qu, 3), "qr_kn": _rounded(qr),
            "ekfl": round(factor, 3), "dk": rules.DETERIORATION,
            "iw": _rounded(qu * factor * rules.DETERIORATION / qr if qr else None)}


def _rounded(value):
    return None if value is None else round(value, 3)


def eccentricity_factor(eccentricity):
    """eKfl. eccentricity: None without walls in either direction, which counts as the largest. [-]"""
    if eccentricity is None or eccentricity >= rules.ECCENTRICITY_END:
        return 0.5
    return 1.0 if eccentricity < rules.ECCENTRICITY_START else min(1.0, 1 / (3.33 * eccentricity + 0.5))


def is_balanced(low, high, eccentricity):
    """By Notification 1352: both quarters fulfilled, or not too different; or the eccentricity within its limit."""
    least, most = sorted((low, high))
    return bool(least > 1 or (most > 0 and least / most >= rules.QUARTER_RATIO)
                or (eccentricity is not None and eccentricity <= rules.ECCENTRICITY_LIMIT))


def _quarters(bays, axis, plans, storey, needs):
    """[low, high] existing bearing walls over the required quantity of the outer quarters of a storey's extent across
    an axis, for the floor within each. plans: {storey: FloorPlan}

    The extent is the largest one (Notification 1352; compared: fukuicompu.co.jp, manual of ZERO, side parts)."""
    across = 1 - axis
    low, high = plans[storey].bounds[:, across]
    quarter = (high - low) / 4
    ratios = []
    for start, end in ((low, low + quarter), (high - quarter, high)):
        existing = sum(bay.quantity for bay in bays
                       if bay.axis == axis and start - 1e-6 <= bay.centre[across] <= end + 1e-6)
        areas = [plan.area_between(across, start, end) for _, plan in sorted(plans.items())]
        ratios.append(round(existing / (needs.quantities(areas)[storey - 1] / 100 * areas[storey - 1]), 3))
    return ratios


def _eccentricities(bays, mass):
    """[Re of each axis]: distance of the centres of mass and rigidity over the elastic radius; None without walls. The
    rigidity of a bay is its wall quantity: bays of a storey have one height."""
    sides = {axis: [bay for bay in bays if bay.axis == axis] for axis in (0, 1)}
    sums = {axis: sum(bay.quantity for bay in mine) for axis, mine in sides.items()}
    centre = {axis: sum(bay.quantity * bay.centre[1 - axis] for bay in mine) / sums[axis]
              for axis, mine in sides.items() if sums[axis] > 0}
    torsion = sum(bay.quantity * (bay.centre[1 - axis] - centre[axis]) ** 2 for axis in centre for bay in sides[axis])
    return [abs(mass[1 - axis] - centre[axis]) / np.sqrt(torsion / sums[axis]) if axis in centre and torsion > 0
            else None for axis in (0, 1)]


def _mass_centre(model, group, storey):
    """(2,) of what the storey carries, without snow: higher storeys, and its own members above the columns. [m]"""
    carried = [e for e in model.elements if e.group == group and not e.fixed and e.kind != "snow"
               and (e.storey > storey or (e.storey == storey and e.kind not in ("column", "brace")))]
    total = sum(e.mass for e in carried)
    return sum(e.mass * e.solid.centroid[:2] for e in carried) / total if total > 0 else np.zeros(2)


# --- bays -------------------------------------------------------------------------------------------------------------


def _bays(model, group, largest):
    """RatedBays of a structure. largest: sum of the multipliers of a bay [-]"""
    totals, quasi = Counter(), Counter()
    sheets = dict.fromkeys(joint.sheet for joint in model.joints
                           if joint.sheet and joint.group == group and not joint.broken)
    walls = [(model.element(sheet.low), model.element(sheet.high), sheet.multiplier, sheet.quasi_multiplier)
             for sheet in sheets]
    for low, high, multiplier, panels in [*walls, *_braces(model, group)]:
        columns = tuple(sorted((low, high), key=lambda column: column.name))
        totals[columns] += multiplier
        quasi[columns] += panels
    bays = []
    for columns, total in totals.items():
        low, high = (column.solid.centroid[:2] for column in columns)
        multiplier, length = min(total, largest), bay_length(*columns)
        bays.append(RatedBay(columns, multiplier, int(np.argmax(np.abs(high - low))), multiplier * length,
                             min(quasi[columns], largest - multiplier) * length, (low + high) / 2))
    return bays


def _braces(model, group):
    """(column, column, multiplier, 0) of braces whose ends are joined: the columns nearest to foot and head."""
    columns = model.of_kind("column", group=group)
    torn = {joint.a for joint in model.joints if joint.broken and model.element(joint.b).kind != "column"}
    for brace in (brace for brace in model.of_kind("brace", group=group) if brace.name not in torn):
        ends = [brace.vertices[pick(brace.vertices[:, 2])][:2] for pick in (np.argmin, np.argmax)]
        here = [column for column in columns if column.storey == brace.storey]
        foot, head = (min(here, key=lambda column: np.hypot(*(column.solid.centroid[:2] - end))) for end in ends)
        if foot is not head:
            yield foot, head, brace_multiplier(brace.section), 0.0


def brace_multiplier(section):
    """Of a brace of this section [m]; 0 below the sections of the law. [-]"""
    thin, wide = sorted(section)
    if wide < rules.BRACE_WIDTH - 1e-9:
        return 0.0
    return next((value for least, value in rules.BRACES if thin >= least - 1e-9), 0.0)


# --- uplift -----------------------------------------------------------------------------------------------------------


def _uplift(model, group, bays):
    """Columns whose feet need more tension by the N-value method than their joint has, and the largest need [kN]. The
    corrections for the direction of braces are left out."""
    columns = {(storey, place): model.element(name) for storey, plan in model.plans[group].items()
               for place, name in plan.columns.items()}
    strengths = _foot_strengths(model)
    rows = [(max(0.0, n_value(columns, key, bays, model.plans[group])) * rules.UPLIFT_KN,
             strengths.get(column.name, 0.0), column.name) for key, column in columns.items()]
    if not rows:
        return None
    need, strength, name = max(rows, key=lambda row: row[0])
    return {"columns": len(rows), "too_weak": sum(row[0] > row[1] + 1e-9 for row in rows), "largest_kn": round(need, 3),
            "fitting_kn": round(strength, 3) if np.isfinite(strength) else None, "column": name}


def n_value(columns, key, bays, plans):
    """N = sum of A B over a column and those above, less L; the larger direction. columns: {(storey, (x, y) as laid):
    ...}; plans: {storey: FloorPlan}"""
    storey, node = key
    stack = [columns[level, node] for level in sorted(plans) if level >= storey and (level, node) in columns]
    corner = [plans[column.storey].is_corner(*column.solid.centroid[:2]) for column in stack]
    vertical = rules.VERTICAL["lower" if len(stack) > 1 else "top"][corner[0]]
    sums = [sum(rules.RESTRAINT[outer] * _difference(column, bays, axis) for column, outer in zip(stack, corner))
            for axis in (0, 1)]
    return max(sums) - vertical


def _difference(column, bays, axis):
    """A: difference of the multipliers on either side of a column. [-]"""
    sides = [0.0, 0.0]
    for bay in bays:
        if bay.axis == axis and column in bay.columns:
            sides[int(bay.centre[axis] > column.solid.centroid[axis])] += bay.multiplier
    return abs(sides[1] - sides[0])


def _foot_strengths(model):
    """{column: allowable tension of its joints at the foot [kN]}; broken joints have none."""
    strengths = {}
    for joint in model.joints:
        if joint.end == "bottom" and joint.sheet is None and model.element(joint.a).kind == "column":
            allowable = joint.whole(joint.strength) * (rules.ALLOWABLE_YIELD if joint.law == "slip" else 1.0)
            strengths[joint.a] = strengths.get(joint.a, 0.0) + (0.0 if joint.broken else allowable / 1000)
    return strengths
