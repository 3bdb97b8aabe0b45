# SPDX-License-Identifier: GPL-2.0-or-later
"""Town files: houses at places under one ground motion, which reaches them as a wave; lots also from a table (CSV) or a
map (GeoJSON, RFC 7946)."""
import csv
import json
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
from .parser import Table, parse_table, parse_value
from .plan import ROUNDING
from .schema import MapOf, Number, Record, fail

LOT_FILES = (".csv", ".geojson", ".json")
COLUMNS = ("house", "x", "y", "rotation", "snow")
MAJOR, ECCENTRICITY = 6_378_137.0, 0.081_819_190_842_6
"""Of the ellipsoid of WGS 84: half of its major axis [m], first eccentricity [-]."""
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


# --- tables and maps of lots ------------------------------------------------------------------------------------------


def read_lots(path):
    """Table {name: Table of a lot} of a file; houses are looked for beside it. Raises HouseError (file:line)."""
    lots = Table()
    for name, entry in _of_table(path) if path.suffix.lower() == ".csv" else _of_map(path):
        if name in lots:
            raise HouseError(f"{entry.where}: lot {name}: the name stands at {lots[name].where} already")
        lots[name], lots.entries[name] = entry, entry.where
    return lots


def _of_table(path):
    """[(name, Table)]: a row for each lot, a head with `lot` and COLUMNS; a unit in brackets is ignored."""
    lines = csv.reader(text_of(path).removeprefix("\ufeff").splitlines())
    try:
        head, *rows = [*lines] or [[]]
    except csv.Error as problem:
        raise HouseError(f"{path.name}:{lines.line_num}: {problem}") from None
    heads = [name.partition("[")[0].strip() for name in head]
    missing = [key for key in ("lot", "house", "x", "y") if key not in heads]
    if missing:
        raise HouseError(f"{path.name}:1: no column {missing[0]}; a table of lots has lot, {', '.join(COLUMNS)}")
    lots = []
    for number, row in enumerate(rows, 2):
        cells, where = dict(zip(heads, map(str.strip, row))), f"{path.name}:{number}"
        values = {key: text if key == "house" else parse_value(text, where)
                  for key, text in cells.items() if text and key != "lot"}
        if any(map(str.strip, row)):
            lots.append((cells["lot"], Table(values, where)))
    return lots


def _of_map(path):
    """[(name, Table)]: a feature for each lot: a point, or a polygon with the house in the mean of its corners; in its
    properties `name` and COLUMNS but x and y; others are ignored."""
    try:
        features = json.loads(text_of(path), parse_int=lambda text: parse_value(text, path.name))["features"]
        places = [_place(feature["geometry"]) for feature in features]
        names = [str(feature["properties"]["name"]) for feature in features]
    except HouseError:
        raise
    except (ValueError, LookupError, TypeError, RecursionError) as problem:
        raise HouseError(f"{path.name}: no GeoJSON of points or polygons with a name ({type(problem).__name__}:"
                         f" {' '.join(str(problem).split())[:80]})") from None
    if not all(abs(longitude) <= 180 and abs(latitude) < 90 for longitude, latitude in places):
        raise HouseError(f"{path.name}: coordinates must be longitude and latitude in degrees (WGS 84)")
    origin = [sum(values) / len(places) for values in zip(*places)]
    lots = []
    for number, (name, feature, place) in enumerate(zip(names, features, places), 1):
        values = {key: feature["properties"][key] for key in COLUMNS if feature["properties"].get(key) is not None}
        values |= dict(zip("xy", _metres(place, origin)))
        lots.append((name, Table(values, f"{path.name}: feature {number}")))
    return lots


def _place(geometry):
    """(longitude, latitude) of a point, or of the mean of a polygon's corners. [degrees]"""
    corners = {"Point": lambda c: [c], "Polygon": lambda c: c[0][:-1]}[geometry["type"]](geometry["coordinates"])
    return [sum(float(corner[axis]) for corner in corners) / len(corners) for axis in (0, 1)]


def _metres(place, origin):
    """(x, y) to the east and north of an origin, in the plane that touches the ellipsoid there, to the millimetre."""
    longitude, latitude = (math.radians(a - b) for a, b in zip(place, origin))
    sine, cosine = math.sin(math.radians(origin[1])), math.cos(math.radians(origin[1]))
    curved = 1 - (ECCENTRICITY * sine) ** 2
    across, along = MAJOR / math.sqrt(curved), MAJOR * (1 - ECCENTRICITY**2) / curved**1.5
    return round(across * cosine * longitude, 3), round(along * latitude, 3)


# --- places -----------------------------------------------------------------------------------------------------------


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
