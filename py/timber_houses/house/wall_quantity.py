# SPDX-License-Identifier: GPL-2.0-or-later
"""Required wall quantity of the storeys of a wooden house, by two rules of Article 46 of the Enforcement Order.

weights_2025    in force since 1 April 2025. Lw = Ai C0 W / (0.0196 A) [cm per m2 of floor], rounded up: W [kN] is the
                weight that the storey carries with half of its own walls, A [m2] its floor area.
table_1981      until 31 March 2025: a table by the weight of the roof and the number of storeys.

Weights are those of the sheet that the ministry admits (Howtec, post-and-beam houses, 2025), by kind of roof and outer
wall. Outer walls weigh per m2 of wall; the sheet converts that to floor area with a house of 6.0 x 16.5 m: 45 m of
outer walls on 99 m2, 9 % of them windows. Its inner walls of 200 N per m2 of floor assume a storey height of 2.8 m. The
storeys' own heights scale both. Compared: github.com/you0810jmsdf/pascal-editor, kenchiku-spec, which repeats numbers
and formulas; of the conversion collaboplaza.com, page 8737."""
import math
from dataclasses import dataclass

import numpy as np

from ..base.gravity import weight_of
from . import diagnosis_tables as tables
from .loads import upper_area


@dataclass(frozen=True)
class Rule:
    """name: in words, with its date; largest sum of the multipliers of a bay [-]; largest share of the required
    quantity that quasi-bearing walls may have [-]"""

    name: str
    largest_multiplier: float
    quasi_share: float


RULES = {"weights_2025": Rule("rule of 1 April 2025", 7.0, 0.5),
         "table_1981": Rule("table of 1981, until 31 March 2025", 5.0, 0.0)}
"""Largest multiplier: Order, Article 46, and Notification 1100 (compared: kenchikuyogo.com 5; fukuicompu.co.jp 7).
Share: Notification 1100 as of 2025 (compared: stmaki.com, page 2775)."""
ROOFS = {"metal": 500, "slates": 740, "tiles": 990}  # per m2 of roof surface, with ceiling. [N/m2]
WALLS = {"boards": 350, "metal": 500, "siding": 600, "mortar": 890, "mud": 1000}
"""Per m2 of outer wall, with frame and lining. [N/m2]"""
FRAME = 150  # of WALLS, for the frame, which `loads.wall` leaves out. [N/m2] (Order, Article 84)
CEILING_INSULATION, FLOOR, LIVE = 100, 610, 600
"""Per m2 of floor; live load of a dwelling, for earthquakes (Order, Article 85). [N/m2]"""
WALL_INSULATION, WINDOW, WINDOWS = 70, 400, 0.09
"""Per m2 of outer wall, of window [N/m2]; windows over outer walls [-]."""
INNER_WALL, INNER_HEIGHT = 200, 2.8  # per m2 of floor at this storey height. [N/m2], [m]
PERIMETER, FLOOR_AREA = 2 * (6.0 + 16.5), 6.0 * 16.5  # of the sheet's house. [m], [m2]
UNIT_SHEAR = 0.0196  # allowable shear of 1 cm of a wall of multiplier 1. [kN]
SNOW_UNIT, SNOW_SHARE = 3.0, 0.35
"""Of snow in regions with much of it, 30 N/m2 per cm [kN/m3], and its share beside an earthquake [-] (Order, Article 86
and Article 82). Article 46 has no addition for snow; ordinances of such regions do (Hokkaido; compared:
faq.homeskun.jp, kz/515)."""


@dataclass(frozen=True)
class Storeys:
    """Of a house or of a part of it, from the first storey: floor areas [m2], heights [m]; and the height of the
    building at the middle of its roof [m]."""

    areas: tuple
    heights: tuple
    height: float


@dataclass(frozen=True)
class Loads:
    """Roof and outer wall by kind [N/m2], solar panels [N per m2 of roof], snow [kN per m2 of ground]; roof surface and
    its projection over the floor below [-]; standard shear coefficient [-]"""

    roof: float
    wall: float
    solar: float = 0.0
    snow: float = 0.0
    roof_share: float = 1.0
    cover_share: float = 1.0
    c0: float = 0.2


def carried(storeys, loads):
    """[Weight that each storey carries [kN]]: all above, and half of its own walls."""
    areas = (*storeys.areas, 0.0)
    roof = (loads.roof_share * (loads.roof + loads.solar) + CEILING_INSULATION) / 1000
    roof += loads.cover_share * SNOW_SHARE * loads.snow
    walls = [wall_load(loads.wall, height) * area for area, height in zip(areas, storeys.heights)]
    weights, above = [], 0.0
    for k in reversed(range(len(walls))):
        above += roof * max(0.0, areas[k] - areas[k + 1]) + (FLOOR + LIVE) / 1000 * areas[k + 1]
        weights.append(above + walls[k] / 2)
        above += walls[k]
    return weights[::-1]


def wall_load(wall, height):
    """Outer and inner walls of a storey per floor area [kN/m2]. wall: of outer ones [N/m2]; height: of the storey [m]
    The sheet rounds each part up to 10 N/m2."""
    whole = PERIMETER * height / FLOOR_AREA
    parts = [(1 - WINDOWS) * whole * wall, (1 - WINDOWS) * whole * WALL_INSULATION, WINDOWS * whole * WINDOW]
    return (sum(10 * _rounded_up(part / 10) for part in parts) + INNER_WALL * height / INNER_HEIGHT) / 1000


def shear_factors(weights, height):
    """[Ai] of the storeys. weights: that each carries [kN]; height: of the building [m] (Notification 1793 of 1980)"""
    period = 0.03 * height
    shares = [weight / weights[0] for weight in weights]
    return [1 + (share**-0.5 - share) * 2 * period / (1 + 3 * period) for share in shares]


def required_2025(storeys, loads):
    """[Lw [cm per m2 of floor]] of the storeys."""
    weights = carried(storeys, loads)
    return [_rounded_up(factor * loads.c0 * weight / (UNIT_SHEAR * area)) for factor, weight, area
            in zip(shear_factors(weights, storeys.height), weights, storeys.areas)]


def required_1981(roof, count):
    """[Wall quantity [cm per m2 of floor]] of the storeys of a house of so many. roof: a class of ROOF_CLASSES"""
    return tables.WALL_QUANTITY["light" if roof == "light" else "heavy"][count]


def _rounded_up(value):
    """The next whole number; rounding errors do not count."""
    return math.ceil(round(value, 9))


@dataclass(frozen=True)
class Requirement:
    """Of a structure by a rule: its storeys and loads, the class of its roof, kinds of the loads."""

    rule: Rule
    key: str
    storeys: Storeys
    loads: Loads
    roof_class: str
    kinds: dict

    def quantities(self, areas):
        """[Wall quantity [cm per m2 of floor]] of the storeys of a part of these floor areas [m2].

        A part of fewer storeys than the house is a house of its own (Notification 1352; compared: fukuicompu.co.jp,
        manual of ZERO, side parts). None beyond three storeys."""
        count = next((k for k, area in enumerate(areas) if area <= 0), len(areas))
        if not count or len(self.storeys.areas) > 3:
            return []
        if self.key == "table_1981":
            return list(required_1981(self.roof_class, count))
        whole = count == len(self.storeys.areas)
        return required_2025(self.storeys if whole else Storeys(
            tuple(areas[:count]), self.storeys.heights, self.storeys.height - sum(self.storeys.heights[count:])),
            self.loads)

    @property
    def quantities_of_all(self):
        return self.quantities(self.storeys.areas)

    def table(self):
        """For the summary: rule, kinds, and of each storey weight [kN] and Ai of the rule of 2025."""
        found: dict = {"rule": self.key, "rule_name": self.rule.name}
        if self.key == "weights_2025" and self.quantities_of_all:
            weights = carried(self.storeys, self.loads)
            factors = shear_factors(weights, self.storeys.height)
            found |= {"kinds": self.kinds, "c0": self.loads.c0, "snow_counted": self.loads.snow > 0,
                      "weights": {str(k): {"height_m": round(height, 3), "carried_kn": round(weight, 3),
                                           "ai": round(factor, 4)}
                                  for k, (height, weight, factor)
                                  in enumerate(zip(self.storeys.heights, weights, factors), 1)}}
        return found


def requirement(model, group):
    code, levels = model.code[group], model.storey_levels[group]
    roofs = model.of_kind("roof", group=group)
    areas = tuple(model.plans[group][storey].area for storey in sorted(levels))
    covered = sum(max(0.0, low - high) for low, high in zip(areas, (*areas[1:], 0.0)))
    surface, cover = (sum(upper_area(roof, projected) for roof in roofs) for projected in (False, True))
    top = max((e.vertices[:, 2].max() for e in model.of_kind("beam", group=group)), default=levels[max(levels)][1])
    rise = max((roof.vertices[:, 2].max() for roof in roofs), default=top) - top
    weight = weight_of(sum(roof.mass for roof in roofs))
    own, own_load = (weight / surface, 1000 * weight / surface) if surface > 0 else (0.0, 0.0)
    roof_class = next(name for least, name in tables.ROOF_CLASSES if own >= least)
    roof, roof_load = _kind(ROOFS, code["roof"], own_load)
    wall, wall_load_ = _kind(WALLS, code["wall"], 1000 * (code["wall_load"] or 0.0) + FRAME)
    loads = Loads(roof_load, wall_load_, 1000 * code["solar"], SNOW_UNIT * model.snow_depth * code["snow"],
                  *((surface / covered, cover / covered) if covered > 0 and roofs else (1.0, 1.0)), code["c0"])
    feet = [levels[storey][0] for storey in sorted(levels)]
    storeys = Storeys(areas, tuple(float(h) for h in np.diff([*feet, top])), float(top + rise / 2))
    return Requirement(RULES[code["rule"]], code["rule"], storeys, loads, roof_class, {"roof": roof, "wall": wall})


def _kind(kinds, chosen, load):
    """(name, load [N/m2]) of the chosen kind; of none: the lightest kind that weighs as much as the modelled one. What
    is heavier than all of them counts with its own weight."""
    name = chosen or next((name for name, least in kinds.items() if least >= load - 1e-6), "own")
    return name, float(kinds.get(name, load))
