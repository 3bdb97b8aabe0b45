# SPDX-License-Identifier: GPL-2.0-or-later
"""Town files: houses at places under one ground motion, which reaches them as a wave."""
import math
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
import scipy  # submodules load on first use; pictures need none

from ..base.errors import located, one_line
from ..base.input_file import is_file, shown
from .description import house_path, require_snow_depth
from .errors import HouseError
from .geometry import clip_convex
from .layout import MAX_SNOW, word
from .limits import MAX_LOTS, MAX_NODES
from .loader import require_house_file, text_of
from .lots import read_lots
from .parser import Table, parse_table
from .plan import ROUNDING
from .schema import MapOf, Number, Record, fail

LOT_FILES = (".csv", ".geojson", ".json")
FAR = 20_000.0  # largest coordinate of a lot. [m]
LOT = Record({"house": word(), "x": Number("m", -FAR, FAR), "y": Number("m", -FAR, FAR),
              "rotation": Number("degrees", -360, 360, default=0.0), "snow": Number("m", 0, MAX_SNOW, default=None)})
WAVE = Record({"velocity": Number("m/s", 50, 20_000), "direction": Number("degrees", 0, 360)}, default=None)
TOWN = Record({"name": word(None), "wave": WAVE, "lots": MapOf(LOT, most=MAX_LOTS)})


@dataclass(frozen=True)
class Lot:
    """A house at a place. house: file or name of a shipped house; x, y: of the middle of its plan, east and north [m];
    rotation: of the house, counter-clockwise seen from above [degrees]; snow: depth [m], None: the house file's; where:
    file and line."""

    name: str
    house: str
    x: float
    y: float
    rotation: float = 0.0
    snow: float | None = None
    where: str = ""

    @property
    def axes(self):
        """(3, 3) directions of the house's axes as columns, exact for multiples of 90 degrees."""
        quarters, rest = divmod(self.rotation, 90)
        turn = {0: (1, 0), 1: (0, 1), 2: (-1, 0), 3: (0, -1)}
        angle = math.radians(self.rotation)
        c, s = turn[quarters % 4] if rest == 0 else (math.cos(angle), math.sin(angle))
        return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], float)

    def located(self):
        """Context in which an InputError gets the lot's name before its message, unless it begins with file and line.
        """
        return located(f"lot {self.name}", known=self.where.rpartition(": ")[0])

    def outlines(self, model):
        """[(n, 2) corners in the town] of the convex parts of the plan of its HouseModel [m]."""
        origin = self.origin(model)[:2]
        return [part @ self.axes[:2, :2].T + origin for part in parts(model)]

    def origin(self, model):
        """(3,) place of the origin of its HouseModel in the town [m]: the middle of the plan is at x, y."""
        points = np.concatenate(parts(model))
        return np.array([self.x, self.y, 0]) - self.axes @ [*(points.min(0) + points.max(0)) / 2, 0]


def parts(model):
    """[(n, 2) corners, counter-clockwise] of the elements of a HouseModel in plan, without its ground and what lies
    within another one. [m]"""
    plans = [element.vertices[:, :2] for element in model.elements if element.kind != "ground"]
    found: list = []
    for hull in sorted(map(scipy.spatial.ConvexHull, plans), key=lambda hull: -hull.volume):  # volume: the area
        corners = hull.points[hull.vertices]
        if not any((corners @ other.equations[:, :2].T + other.equations[:, 2] <= ROUNDING).all() for other in found):
            found.append(hull)
    return [hull.points[hull.vertices] for hull in found]


@dataclass(frozen=True)
class Town:
    """Lots in the order of the file. velocity of the wave [m/s], infinite without one; direction: azimuth [degrees]."""

    name: str
    path: Path
    lots: tuple
    velocity: float = math.inf
    direction: float = 0.0

    def delays(self):
        """Time after which the motion reaches each lot, to the nanosecond; 0 for the first one. [s]"""
        azimuth = math.radians(self.direction)
        along = np.array([lot.x * math.sin(azimuth) + lot.y * math.cos(azimuth) for lot in self.lots])
        return [round(float(delay), 9) for delay in (along - along.min()) / self.velocity]


def load_town(path):
    """Town of a YAML file, whose `lots` may be in a CSV or GeoJSON file, or of such a file alone; house files are
    looked for beside it, too. Raises HouseError (one line, file:line)."""
    path = Path(path)
    if not is_file(path):
        raise HouseError(f"{path}: no such regular file; give a town file")
    table = (Table({"lots": read_lots(path)}, f"{path.name}:1") if path.suffix.lower() in LOT_FILES
             else parse_table(text_of(path), path.name, MAX_NODES)[0])
    if isinstance(table.get("lots"), str):
        beside = path.parent / table["lots"]
        if beside.suffix.lower() not in LOT_FILES or not is_file(beside):
            fail(table.at("lots"), "town.lots", f"no file {shown(table['lots'])} beside it that ends in"
                 f" {', '.join(LOT_FILES)}")
        table["lots"] = read_lots(beside)
    data = TOWN.check(table, f"{path.name}:1", "town")
    if not data["lots"]:
        fail(data.at("lots"), "town.lots", "a town needs at least one lot")
    wave = data["wave"] or {}
    return Town(data["name"] or one_line(path.stem), path,
                tuple(_lot(name, lot, path) for name, lot in data["lots"].items()), **wave)


def _lot(name, entry, path):
    where = f"{entry.at('house')}: town.lots.{name}.house"
    if entry["snow"] is not None:
        require_snow_depth(entry["snow"], f"{entry.at('snow')}: town.lots.{name}.snow")
    beside = path.parent / entry["house"]
    try:
        file = beside if is_file(beside) else house_path(entry["house"])
    except HouseError as problem:
        raise HouseError(f"{where}: {problem}") from None
    require_house_file(file, where)
    return Lot(name, str(file), entry["x"], entry["y"], entry["rotation"], entry["snow"], where)


def check_places(placed):
    """Raise HouseError when two houses overlap in plan. placed: list of (Lot, HouseModel)"""
    outlines = [(lot, lot.outlines(model)) for lot, model in placed]
    bounds = [(np.min(corners, axis=0), np.max(corners, axis=0)) for corners in
              (np.concatenate(outline) for _, outline in outlines)]
    for k, (lot, outline) in enumerate(outlines):
        for (other, others), (low, high) in zip(outlines[:k], bounds):
            near = (bounds[k][0] < high).all() and (low < bounds[k][1]).all()
            if near and any(len(clip_convex(a, b)) for a, b in product(outline, others)):
                raise HouseError(f"{lot.where.removesuffix('.house')}: the house overlaps that of lot {other.name}:"
                                 " move it by x or y, or turn it")
