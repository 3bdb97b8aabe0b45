# SPDX-License-Identifier: GPL-2.0-or-later
"""Lots of a town from a table (CSV) or a map (GeoJSON, RFC 7946)."""
import csv
import json
import math

from .errors import HouseError
from .loader import text_of
from .parser import Table, parse_value

KEYS = ("house", "x", "y", "rotation", "snow")
MAJOR, ECCENTRICITY = 6_378_137.0, 0.081_819_190_842_6
"""Of the ellipsoid of WGS 84: half of its major axis [m], first eccentricity [-]."""


def read_lots(path):
    """Table {name: Table of a lot} of a file; houses are looked for beside it. Raises HouseError (file:line)."""
    lots = Table()
    for name, entry in _of_table(path) if path.suffix.lower() == ".csv" else _of_map(path):
        if name in lots:
            raise HouseError(f"{entry.where}: lot {name}: the name stands at {lots[name].where} already")
        lots[name], lots.entries[name] = entry, entry.where
    return lots


def _of_table(path):
    """[(name, Table)]: a row for each lot, a head with `lot` and KEYS; a unit in brackets is ignored."""
    lines = csv.reader(text_of(path).removeprefix("\ufeff").splitlines())
    try:
        head, *rows = [*lines] or [[]]
    except csv.Error as problem:
        raise HouseError(f"{path.name}:{lines.line_num}: {problem}") from None
    heads = [name.partition("[")[0].strip() for name in head]
    missing = [key for key in ("lot", "house", "x", "y") if key not in heads]
    if missing:
        raise HouseError(f"{path.name}:1: no column {missing[0]}; a table of lots has lot, {', '.join(KEYS)}")
    lots = []
    for number, row in enumerate(rows, 2):
        cells, where = dict(zip(heads, map(str.strip, row))), f"{path.name}:{number}"
        values = {key: text if key == "house" else parse_value(text, where)
                  for key, text in cells.items() if text and key != "lot"}
        if any(map(str.strip, row)):
            lots.append((cells["lot"], Table(values, where, dict.fromkeys(values, where))))
    return lots


def _of_map(path):
    """[(name, Table)]: a feature for each lot: a point, or a polygon with the house in the mean of its corners; in its
    properties `name` and KEYS but x and y; others are ignored."""
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
        values = {key: feature["properties"][key] for key in KEYS if feature["properties"].get(key) is not None}
        values |= dict(zip("xy", _metres(place, origin)))
        lots.append((name, Table(values, where := f"{path.name}: feature {number}", dict.fromkeys(values, where))))
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
