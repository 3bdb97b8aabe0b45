# SPDX-License-Identifier: GPL-2.0-or-later
"""The file formats: each reader turns the lines of one file into channels.

K-NET and KiK-net ASCII: NIED, "About K-NET ASCII format" (17 header lines, whole counts, scale factor). Its Record
Time includes the logger's trigger delay: the first sample is 15 s earlier (KNET_DELAY). All samples are read.
PEER AT2: four header lines whose fourth has changed its form over the years, values in g.
Peknold's El Centro: prose header ("1559 points at equal spacing of 0.02 sec"), values in g.
JMA CSV: six "KEY = value" lines, a row with the names of the columns, values in gal.
Plain CSV: '#' comments with "key: value", a row with the names of the columns, rows.
"""

from __future__ import annotations

import re
import warnings
from datetime import timedelta

import numpy as np

from .record import GAL, RecordError, RecordWarning, unit_factor
from .text import (
    UP,
    Channel,
    clock,
    direction_of,
    finite,
    numbers,
    require_count,
    require_step,
    table,
)

KNET_HEADER_LINES = 17
KIK_DIRECTIONS = {"1": 0.0, "2": 90.0, "3": UP, "4": 0.0, "5": 90.0, "6": UP}
"""Channel numbers of KiK-net: 1-3 borehole, 4-6 surface, each north, east, up."""

KNET_DELAY = timedelta(seconds=15)
"""Record Time of a K-NET or KiK-net file is this much after its first sample (NIED, on the loggers' trigger delay)."""

KNET_MAX_TOLERANCE = 0.02
"""Relative difference from the header's Max. Acc. above which a warning is given.

Headers print 3 to 6 digits; a damaged sample moves the peak by far more.
"""

SPACING_TOLERANCE = 0.1
"""Largest deviation of a time column from equal spacing, in steps: room for printed rounding, none for a gap."""


def sniff(lines):
    """Name of the format that the lines are in, or None."""
    head = "\n".join(lines[:20])
    if re.match(r"\s*Origin Time", lines[0]):
        return "knet"
    if re.match(r'\s*"?SITE CODE', lines[0], re.I):
        return "jma"
    if re.search(r"\bNPTS\b", head) or re.search(r"points at equal spacing of", head, re.I):
        return "at2"
    if _csv_columns(lines) is not None:
        return "csv"
    return None


def parse(path, lines, units=None, stated=False):
    """Channels of one file. `units` states the unit where the file does not; stated: directions are given, those in the file do not matter. Raises RecordError."""
    kind = sniff(lines)
    if kind is None:
        raise RecordError(
            f"{path}: unknown record format; admissible: K-NET or KiK-net ASCII, PEER AT2, JMA CSV, "
            "CSV with named columns (ns, ew, ud, optionally time)"
        )
    if kind == "at2":
        return _at2(path, lines, units, stated)
    reader = {"knet": _knet, "jma": _jma, "csv": _plain_csv}[kind]
    return reader(path, lines, units)


# --- K-NET and KiK-net --------------------------------------------------------------------------

_KNET_FIELDS = {
    "time": r"Record Time\s*(\S+\s+\S+)",
    "sampling": r"Sampling Freq\.?\s*\(Hz\)\s*(\S+?)\s*Hz",
    "duration": r"Duration Time\s*\(s\)\s*(\S+)",
    "direction": r"Dir\.\s*(\S+)",
    "scale": r"Scale Factor\s*(\S+)",
    "peak": r"Max\.? Acc\.?\s*\(gal\)\s*(\S+)",
}
"""Both spellings of the header: 'Long.' or 'Lon.', 'Max. Acc.' or 'Max Acc.'."""


def _knet(path, lines, units):
    """K-NET or KiK-net: counts times scale factor, mean of the whole record removed."""
    if units is not None:
        raise RecordError(f"{path}: K-NET files state their scale factor; give no unit")
    field = _knet_fields(path, lines)
    rate = finite(field["sampling"], f"{path}, Sampling Freq")
    if rate <= 0.0:
        raise RecordError(f"{path}, Sampling Freq: {rate:g} Hz; it must be > 0")
    counts = numbers(path, lines[KNET_HEADER_LINES:], KNET_HEADER_LINES + 1)
    stated = finite(field["duration"], f"{path}, Duration Time") * rate
    require_count(path, len(counts), round(stated), "Duration Time x Sampling Freq")
    values = (counts - counts.mean()) * _knet_scale(path, field["scale"])
    _compare_peak(path, values, finite(field["peak"], f"{path}, Max. Acc."))
    direction = KIK_DIRECTIONS.get(field["direction"], direction_of(field["direction"]))
    begins = clock(field["time"], f"{path}, Record Time") - KNET_DELAY
    return [Channel(path, require_step(1.0 / rate, path), values, direction, begins)]


def _knet_fields(path, lines):
    header = "\n".join(lines[:KNET_HEADER_LINES])
    fields = {}
    for name, pattern in _KNET_FIELDS.items():
        match = re.search(r"^\s*" + pattern, header, re.M)
        if match is None:
            raise RecordError(f"{path}: K-NET header without '{name}' in its {KNET_HEADER_LINES} lines")
        fields[name] = match.group(1)
    return fields


def _knet_scale(path, text):
    """'3920(gal)/6182761' -> m/s2 per count."""
    match = re.fullmatch(r"([\d.]+)\(gal\)/([\d.]+)", text)
    if match is None or finite(match.group(2), path) == 0.0:
        raise RecordError(f"{path}, Scale Factor: '{text}'; it must be like 3920(gal)/6182761")
    return GAL * float(match.group(1)) / float(match.group(2))


def _compare_peak(path, values, stated_gal):
    got = np.abs(values).max() / GAL
    if abs(got - stated_gal) > KNET_MAX_TOLERANCE * stated_gal + 0.01:
        warnings.warn(
            f"{path}: largest acceleration {got:.3f} gal, the header says {stated_gal:g} gal",
            RecordWarning,
            stacklevel=2,
        )


# --- PEER AT2 -----------------------------------------------------------------------------------

_AT2_COUNT = (
    re.compile(r"NPTS\s*[=:]\s*(?P<n>\d+).*?DT\s*[=:]\s*(?P<dt>[-+\d.eE]+)", re.I),
    re.compile(r"^\s*(?P<n>\d+)\s*,?\s+(?P<dt>[-+\d.eE]+)\s*,?\s*NPTS\s*,\s*DT", re.I),
)
_PEKNOLD_COUNT = re.compile(r"(?P<n>\d+)\s+points at equal spacing of\s+(?P<dt>[-+\d.eE]+)\s*sec", re.I)
_UNIT = re.compile(r"(?:in|^|the)\s*units?\s*(?:of|are|is|in|:|=)?\s*\(?\s*([a-z][\w/^]*)", re.I)
_NUMERIC_LINE = re.compile(r"^[\s\d.eEdD+-]*\d[\s\d.eE+-]*$")


def _at2(path, lines, units, stated):
    """PEER AT2 and Peknold's variant: one channel, in g unless the header states another unit."""
    count, first = _at2_header(path, lines)
    header = lines[:first]
    _refuse_other_quantity(path, header)
    factor = _stated_unit(path, [m.group(1) for m in map(_UNIT.search, header) if m], units)
    values = numbers(path, lines[first:], first + 1)
    require_count(path, len(values), int(count["n"]), "NPTS")
    dt = require_step(finite(count["dt"], f"{path}, DT"), f"{path}, DT")
    return [Channel(path, dt, values * factor, None if stated else _at2_direction(path, header))]


def _at2_header(path, lines):
    """Match with groups n and dt, and the index of the first line of data."""
    for index, line in enumerate(lines[:20]):
        for pattern in _AT2_COUNT:
            if match := pattern.search(line):
                return match, index + 1
    for line in lines[:20]:
        if match := _PEKNOLD_COUNT.search(line):
            first = next((i for i, row in enumerate(lines) if _NUMERIC_LINE.match(row)), len(lines))
            return match, first
    raise RecordError(f"{path}: AT2 header without a readable 'NPTS= n, DT= s' or 'n s NPTS, DT' in 20 lines")


def _refuse_other_quantity(path, header):
    for number, line in enumerate(header, 1):
        match = re.match(r"\s*(VELOCITY|DISPLACEMENT) TIME", line, re.I)
        if match:
            raise RecordError(f"{path}, line {number}: {match.group(1).lower()} record; it must be acceleration")


def _stated_unit(path, in_file, stated):
    """m/s2 per unit, from what the file states and the caller states; refuses none and contradiction."""
    given = list(in_file) + ([stated] if stated is not None else [])
    if not given:
        raise RecordError(f"{path}: no unit stated; state it in the file or as units= (gal, m/s2 or g)")
    factors = {unit_factor(unit, path) for unit in given}
    if len(factors) > 1:
        raise RecordError(f"{path}: units contradict each other ({', '.join(given)}); state one")
    return factors.pop()


def _at2_direction(path, header):
    """Direction from the title ('..., KJMA, 090') or the file's name (KJM090.AT2), None if unknown."""
    title = next((line for line in header[1:2] if "," in line), "")
    word = title.rsplit(",", 1)[-1].strip().split(" ")[0]
    in_title = direction_of(word) if word else None
    if "north south component" in header[0].lower():
        in_title = 0.0
    match = re.search(r"(\d{3}|[-_.](?:up|dwn|ud|ver|vert|v|ns|ew)|(?<=\d)(?:ud|ns|ew))$", path.stem, re.I)
    in_name = direction_of(match.group(1)) if match else None
    if None not in (in_title, in_name) and in_title != in_name:
        raise RecordError(
            f"{path}: direction is {in_title} in the title but {in_name} in the file name; state component="
        )
    return in_title if in_title is not None else in_name


# --- JMA CSV ------------------------------------------------------------------------------------


def _jma(path, lines, units):
    """JMA CSV, old and new headers: the keys in any order, then NS, EW, UD (and time) by name."""
    keys, names, first = _jma_header(path, lines)
    sampling = keys.get("SAMPLING RATE", keys.get("SAMPLING FREQ"))
    if sampling is None:
        raise RecordError(f"{path}: JMA header without SAMPLING RATE")
    rate = finite(re.sub(r"\s*Hz.*$", "", sampling, flags=re.I), f"{path}, SAMPLING RATE")
    if rate <= 0.0:
        raise RecordError(f"{path}, SAMPLING RATE: {rate:g} Hz; it must be > 0")
    factor = _stated_unit(path, [keys["UNIT"].split("(")[0]] if "UNIT" in keys else [], units)
    rows = table(path, lines[first:], first + 1, len(names), ",")
    step = require_step(1.0 / rate, f"{path}, SAMPLING RATE")
    begins = clock(keys["INITIAL TIME"], f"{path}, INITIAL TIME") if "INITIAL TIME" in keys else None
    return _columns_to_channels(path, names, rows, factor, step, begins)


def _jma_header(path, lines):
    """({key: value}, [column names], index of the first row); cells after the first are ignored in key lines."""
    keys = {}
    for index, line in enumerate(lines[:30]):
        cells = [cell.strip().strip('"') for cell in line.split(",")]
        names = [_column_name(cell)[0] for cell in cells if cell]
        if {"ns", "ew", "ud"} <= set(names):
            return keys, names, index + 1
        key, _, value = cells[0].partition("=")
        if not value.strip() and len(cells) > 1:
            value = cells[1]
        keys[key.strip().upper().rstrip(".")] = value.strip()
    raise RecordError(f"{path}: JMA header without a row that names NS, EW and UD in its first 30 lines")


# --- plain CSV ----------------------------------------------------------------------------------

_CSV_DIRECTIONS = {"ns": 0.0, "ew": 90.0, "ud": UP}
_SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, None: 1.0}
_CSV_ALIASES = {"n-s": "ns", "e-w": "ew", "u-d": "ud", "north": "ns", "east": "ew", "up": "ud", "t": "time"}


def _plain_csv(path, lines, units):
    """CSV with named columns: ns, ew, ud (one or more), optionally time [s] or [ms], and a stated unit."""
    header_index, names, units_of, delimiter = _csv_columns(lines)
    comments = _csv_comments(lines[:header_index])
    in_file = [comments[key] for key in ("units", "unit") if key in comments] + [units_of[name] for name in names if units_of[name] and name != "time"]
    factor = _stated_unit(path, in_file, units)
    first = header_index + 1
    rows = table(path, lines[first:], first + 1, len(names), delimiter)
    step = _csv_step(path, comments, _times(path, rows[:, names.index("time")], units_of["time"]) if "time" in names else None)
    if "samples" in comments:
        require_count(path, len(rows), int(finite(comments["samples"], path)), "'# samples:'")
    return _columns_to_channels(path, names, rows, factor, step)


def _csv_columns(lines):
    """(index of the row of names, names, {name: unit stated with it or None}, delimiter), or None if there is no such row."""
    for index, line in enumerate(lines):
        if line.startswith("#") or not line.strip():
            continue
        delimiter = next((d for d in (",", ";", "\t") if d in line), ",")
        cells = [_column_name(cell) for cell in line.split(delimiter)]
        names = [name for name, _ in cells]
        known = set(names) <= {"ns", "ew", "ud", "time"} and len(set(names)) == len(names)
        if not known or set(names) <= {"time"}:
            return None
        return index, names, dict(cells), delimiter
    return None


def _times(path, values, unit):
    """A column of times in s."""
    if unit not in _SECONDS:
        raise RecordError(f"{path}: time in '{unit}'; s or ms")
    return values * _SECONDS[unit]


def _column_name(cell):
    """'NS [gal]', 'ns_gal', 'N-S(gal)' -> ('ns', 'gal'); 'time' -> ('time', None)."""
    match = re.fullmatch(r'\s*"?([A-Za-z-]+)(?:[\s_]*[\[(_]\s*([^\])"]+?)\s*[\])]?)?"?\s*', cell)
    if match is None:
        return cell.strip().lower(), None
    name = match.group(1).lower()
    return _CSV_ALIASES.get(name, name), match.group(2)


def _csv_comments(lines):
    """{key: value} of the lines '# key: value' before the row of names."""
    pairs = (re.match(r"#\s*([A-Za-z ]+?)\s*[:=]\s*(.+?)\s*$", line) for line in lines)
    return {match.group(1).lower(): match.group(2) for match in pairs if match}


def _csv_step(path, comments, times):
    """Time step [s] from '# dt: 0.01', '# sampling: 100 Hz' or the time column."""
    if "dt" in comments:
        step = finite(re.sub(r"\s*s$", "", comments["dt"]), f"{path}, dt")
    elif "sampling" in comments:
        rate = finite(re.sub(r"\s*Hz$", "", comments["sampling"], flags=re.I), f"{path}, sampling")
        step = 1.0 / rate if rate > 0.0 else 0.0
    elif times is not None:
        step = (times[-1] - times[0]) / (len(times) - 1)
    else:
        raise RecordError(f"{path}: no time step; give a time column [s] or a comment '# dt: 0.01' [s]")
    require_step(step, path)
    if times is not None:
        late = np.abs(times - times[0] - step * np.arange(len(times))) / step
        if late.max() > SPACING_TOLERANCE:
            raise RecordError(f"{path}, sample {late.argmax()}: times are not {step:g} s apart; equal steps needed")
    return step


def _columns_to_channels(path, names, rows, factor, step, begins=None):
    return [
        Channel(path, step, rows[:, index] * factor, _CSV_DIRECTIONS[name], begins)
        for index, name in enumerate(names)
        if name in _CSV_DIRECTIONS
    ]
