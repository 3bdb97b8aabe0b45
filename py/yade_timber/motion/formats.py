# SPDX-License-Identifier: GPL-2.0-or-later
"""The file formats: each reader converts the lines of one file into channels.

K-NET and KiK-net ASCII: NIED, "About K-NET ASCII format" (17 header lines, whole counts, scale factor). Its Record
Time includes the logger's trigger delay: the first sample is 15 s earlier (KNET_DELAY). All samples are read.
PEER AT2: four header lines, the fourth in several forms, values in g.
Peknold's El Centro: prose header ("1559 points at equal spacing of 0.02 sec"), values in g.
JMA CSV: six "KEY = value" lines, a row with the names of the columns, values in gal.
Plain CSV: '#' comments with "key: value", a row with the names of the columns, rows.
"""

from __future__ import annotations

import re
import warnings
from datetime import timedelta

import numpy as np

from ..base.input_file import shown
from .record import GAL, RecordError, RecordWarning, unit_factor
from .text import (
    UP,
    Channel,
    clock,
    direction_of,
    finite,
    numbers,
    positive,
    require_count,
    require_step,
    table,
    whole,
)

KNET_HEADER_LINES = 17
AT2_HEADER_LINES = 20
"""Lines in which the number of samples of an AT2 file is searched."""
JMA_HEADER_LINES = 30
"""Lines in which the row of column names of a JMA file is searched."""

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

_PEKNOLD = "points at equal spacing of"


def sniff(lines):
    """Name of the format of the lines, or None."""
    head = "\n".join(lines[:AT2_HEADER_LINES])
    start = lines[0].strip().strip('"')
    if start.startswith("Origin Time"):
        return "knet"
    if start.upper().startswith("SITE CODE"):
        return "jma"
    if "NPTS" in head or _PEKNOLD in head.lower():
        return "at2"
    if _csv_columns(lines) is not None:
        return "csv"
    return None


def parse(path, lines, units=None, stated=False):
    """Channels of one file. Raises RecordError.

    units   unit where the file does not state one
    stated  True: the caller states the directions, those in the file are ignored
    """
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
    "Record Time": "",
    "Sampling Freq": "(Hz)",
    "Duration Time": "(s)",
    "Dir.": "",
    "Scale Factor": "",
    "Max": "(gal)",
}
"""Beginning of a header line -> unit before its value. There are two spellings: 'Max. Acc. (gal)' and 'Max Acc. (gal)'."""


def _knet(path, lines, units):
    """K-NET or KiK-net: counts times scale factor, mean of the whole record removed."""
    if units is not None:
        raise RecordError(f"{path}: K-NET files state their scale factor; give no unit")
    fields = _knet_fields(path, lines)
    sampling, where = fields["Sampling Freq"]
    rate = positive(sampling.removesuffix("Hz"), where)
    counts = numbers(path, lines[KNET_HEADER_LINES:], KNET_HEADER_LINES + 1)
    require_count(path, len(counts), round(finite(*fields["Duration Time"]) * rate), "Duration Time x Sampling Freq")
    values = (counts - counts.mean()) * _knet_scale(*fields["Scale Factor"])
    _compare_peak(path, values, finite(*fields["Max"]))
    direction = fields["Dir."][0]
    begins = clock(*fields["Record Time"]) - KNET_DELAY
    return [Channel(path, require_step(1.0 / rate, where), values, KIK_DIRECTIONS.get(direction, direction_of(direction)), begins)]


def _knet_fields(path, lines):
    """{beginning of a header line: (value, file:line: beginning)}."""
    fields = {}
    for number, line in enumerate(lines[:KNET_HEADER_LINES], 1):
        text = line.strip()
        for label, unit in _KNET_FIELDS.items():
            value = text.removeprefix(label).partition(unit)[2] if unit else text.removeprefix(label)
            if text.startswith(label) and value.strip() and label not in fields:
                fields[label] = " ".join(value.split()[: 2 if label == "Record Time" else 1]), f"{path}:{number}: {label}"
    for label in _KNET_FIELDS:
        if label not in fields:
            raise RecordError(f"{path}: K-NET header without '{label}' in its {KNET_HEADER_LINES} lines")
    return fields


def _knet_scale(text, where):
    """'3920(gal)/6182761' -> m/s2 per count."""
    gal, form, counts = text.partition("(gal)/")
    if not form:
        raise RecordError(f"{where}: {shown(text)}; it must be like 3920(gal)/6182761")
    return GAL * positive(gal, where) / positive(counts, where)


def _compare_peak(path, values, stated_gal):
    got = np.abs(values).max() / GAL
    if abs(got - stated_gal) > KNET_MAX_TOLERANCE * stated_gal + 0.01:
        warnings.warn(
            f"{path}: largest acceleration {got:.3f} gal, the header says {stated_gal:g} gal",
            RecordWarning,
            stacklevel=2,
        )


# --- PEER AT2 -----------------------------------------------------------------------------------


def _at2(path, lines, units, stated):
    """PEER AT2 and Peknold's variant: one channel, in g unless the header states another unit."""
    count, dt, first, where = _at2_header(path, lines)
    header = lines[:first]
    _refuse_other_quantity(path, header)
    factor = _stated_unit(path, [unit for unit in map(_unit_in, header) if unit], units)
    values = numbers(path, lines[first:], first + 1)
    require_count(path, len(values), whole(count, f"{where}: NPTS"), "NPTS")
    step = require_step(finite(dt, f"{where}: DT"), f"{where}: DT")
    return [Channel(path, step, values * factor, None if stated else _at2_direction(path, header))]


def _at2_header(path, lines):
    """(number of samples and time step as text, index of the first line of data, file:line of both)."""
    head = list(enumerate(lines[:AT2_HEADER_LINES], 1))
    for number, line in head:
        if found := _count_and_step(line):
            return *found, number, f"{path}:{number}"
    for number, line in head:
        if found := _peknold_count_and_step(line):
            first = next((i for i, row in enumerate(lines) if _is_numeric(row)), len(lines))
            return *found, first, f"{path}:{number}"
    raise RecordError(f"{path}: AT2 header without a readable 'NPTS= n, DT= s' or 'n s NPTS, DT' in {AT2_HEADER_LINES} lines")


def _words(line, separators):
    """Lower-case words of a line, separated by blanks and the characters of `separators`."""
    return line.lower().translate(dict.fromkeys(map(ord, separators), " ")).split()


def _count_and_step(line):
    """(n, dt) as text from 'NPTS= n, DT= s SEC' or 'n s NPTS, DT', else None."""
    words = _words(line, ",=:")
    if "npts" not in words or "dt" not in words:
        return None
    npts, dt = words.index("npts"), words.index("dt")
    if npts == 2 and dt == 3:
        return words[0], words[1]
    return (words[npts + 1], words[dt + 1].rstrip("second")) if dt >= npts + 2 and dt + 1 < len(words) else None


def _peknold_count_and_step(line):
    """(n, dt) as text from 'n points at equal spacing of s sec', else None."""
    before, found, after = line.lower().partition(_PEKNOLD)
    return (before.split()[-1], after.split()[0]) if found and before.strip() and after.strip() else None


def _is_numeric(line):
    try:
        return bool([float(word) for word in line.split()])
    except ValueError:
        return False


def _unit_in(line):
    """'... in units of G', 'The units are (g)', 'units: gal' -> the unit, else None."""
    words = _words(line, "()=:,")
    for i, word in enumerate(words):
        if word in ("unit", "units") and (i == 0 or words[i - 1] in ("in", "the")):
            rest = words[i + 2 :] if words[i + 1 : i + 2] and words[i + 1] in ("of", "are", "is", "in") else words[i + 1 :]
            return rest[0].rstrip(".") if rest and rest[0][0].isalpha() else None
    return None


def _refuse_other_quantity(path, header):
    for number, line in enumerate(header, 1):
        for quantity in ("velocity", "displacement"):
            if line.strip().lower().startswith(f"{quantity} time"):
                raise RecordError(f"{path}:{number}: {quantity} record; it must be acceleration")


def _stated_unit(path, in_file, stated):
    """m/s2 per unit, from the units in the file and the caller's; refuses none and contradiction."""
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
    rate, where = positive(sampling[0].lower().partition("hz")[0], sampling[1]), sampling[1]
    factor = _stated_unit(path, [keys["UNIT"][0].partition("(")[0]] if "UNIT" in keys else [], units)
    rows = table(path, lines[first:], first + 1, len(names), ",")
    begins = clock(*keys["INITIAL TIME"]) if "INITIAL TIME" in keys else None
    return _columns_to_channels(path, names, rows * factor, require_step(1.0 / rate, where), begins)


def _jma_header(path, lines):
    """({key: (value, file:line: key)}, [column names], index of the first row); cells after the first are ignored in key lines."""
    keys = {}
    for index, line in enumerate(lines[:JMA_HEADER_LINES]):
        cells = [cell.strip().strip('"') for cell in line.split(",")]
        names = [_column_name(cell)[0] for cell in cells if cell]
        if {"ns", "ew", "ud"} <= set(names):
            return keys, names, index + 1
        key, _, value = cells[0].partition("=")
        if not value.strip() and len(cells) > 1:
            value = cells[1]
        key = key.strip().upper().rstrip(".")
        keys[key] = value.strip(), f"{path}:{index + 1}: {shown(key)}"
    raise RecordError(f"{path}: JMA header without a row that names NS, EW and UD in its first {JMA_HEADER_LINES} lines")


# --- plain CSV ----------------------------------------------------------------------------------

_CSV_DIRECTIONS = {"ns": 0.0, "ew": 90.0, "ud": UP}
_SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, None: 1.0}
_CSV_ALIASES = {"n-s": "ns", "e-w": "ew", "u-d": "ud", "north": "ns", "east": "ew", "up": "ud", "t": "time"}


def _plain_csv(path, lines, units):
    """CSV with named columns: ns, ew, ud (one or more), optionally time [s] or [ms], and a stated unit."""
    header_index, names, units_of, delimiter = _csv_columns(lines)
    comments = _csv_comments(path, lines[:header_index])
    in_file = [comments[key][0] for key in ("units", "unit") if key in comments] + [units_of[name] for name in names if units_of[name] and name != "time"]
    factor = _stated_unit(path, in_file, units)
    first = header_index + 1
    rows = table(path, lines[first:], first + 1, len(names), delimiter)
    step = _csv_step(path, comments, _times(path, rows[:, names.index("time")], units_of["time"]) if "time" in names else None)
    if "samples" in comments:
        require_count(path, len(rows), whole(*comments["samples"]), "'# samples:'")
    return _columns_to_channels(path, names, rows * factor, step)


COMMENT = ("#", '"#')
"""Beginnings of a comment; a spreadsheet quotes it."""
FILLING = ",; \t"
"""What a spreadsheet adds to short rows."""


def _csv_columns(lines):
    """(index of the row of names, names, {name: unit stated with it or None}, delimiter), or None if there is no such row."""
    for index, line in enumerate(lines):
        if line.startswith(COMMENT) or not line.strip(FILLING):
            continue
        delimiter = next((d for d in (",", ";", "\t") if d in line), ",")
        cells = [_column_name(cell) for cell in line.rstrip(FILLING).split(delimiter)]
        names = [name for name, _ in cells]
        known = set(names) <= {"ns", "ew", "ud", "time"} and len(set(names)) == len(names)
        if not known or set(names) <= {"time"}:
            return None
        return index, names, dict(cells), delimiter
    return None


def _times(path, values, unit):
    """A column of times in s."""
    if unit not in _SECONDS:
        raise RecordError(f"{path}: time in {shown(unit)}; s or ms")
    return values * _SECONDS[unit]


def _column_name(cell):
    """'NS [gal]', 'ns_gal', 'N-S(gal)' -> ('ns', 'gal'); 'time' -> ('time', None)."""
    text = cell.strip().strip('"').strip()
    name = text[: next((i for i, c in enumerate(text) if not (c.isalpha() or c == "-")), len(text))]
    rest = text[len(name) :].strip()
    unit = rest.strip("_[]() \t")
    if rest and not (rest[0] in "[(_" and unit):
        return text.lower(), None
    return _CSV_ALIASES.get(name.lower(), name.lower()), unit or None


def _csv_comments(path, lines):
    """{key: (value, file:line: key)} of the lines '# key: value' or '# key = value' before the row of names."""
    pairs = {}
    for number, line in enumerate(lines, 1):
        if not line.startswith(COMMENT):
            continue
        line = line.strip(FILLING + '"')
        text = line[1:].replace("=", ":", 1) if "=" in line.partition(":")[0] else line[1:]
        key, _, value = (part.strip() for part in text.partition(":"))
        if key.replace(" ", "").isalpha() and value:
            pairs[key.lower()] = value, f"{path}:{number}: {key.lower()}"
    return pairs


def _csv_step(path, comments, times):
    """Time step [s] from '# dt: 0.01', '# sampling: 100 Hz' or the time column."""
    where = path
    if "dt" in comments:
        text, where = comments["dt"]
        step = finite(text.removesuffix("s"), where)
    elif "sampling" in comments:
        text, where = comments["sampling"]
        step = 1.0 / positive(text.lower().removesuffix("hz"), where)
    elif times is not None:
        step = (times[-1] - times[0]) / (len(times) - 1)
    else:
        raise RecordError(f"{path}: no time step; give a time column [s] or a comment '# dt: 0.01' [s]")
    require_step(step, where)
    if times is not None:
        late = np.abs(times - times[0] - step * np.arange(len(times))) / step
        if late.max() > SPACING_TOLERANCE:
            raise RecordError(f"{path}: sample {late.argmax()}: times are not {step:g} s apart; equal steps needed")
    return step


def _columns_to_channels(path, names, rows, step, begins=None):
    """One channel for each column of accelerations; rows (n, columns) in m/s2."""
    return [
        Channel(path, step, rows[:, index], _CSV_DIRECTIONS[name], begins)
        for index, name in enumerate(names)
        if name in _CSV_DIRECTIONS
    ]
