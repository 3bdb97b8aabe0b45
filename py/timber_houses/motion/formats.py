# SPDX-License-Identifier: GPL-2.0-or-later
"""The file formats: each reader converts the lines of one file into channels.

K-NET and KiK-net: see knet.py.
PEER AT2: four header lines, the fourth in several forms, values in g.
Peknold's El Centro: prose header ("1559 points at equal spacing of 0.02 sec"), values in g.
JMA CSV: six "KEY = value" lines, a row with the names of the columns, values in gal.
Plain CSV: '#' comments with "key: value", a row with the names of the columns, rows."""
import re

from ..base.input_file import shown
from . import knet
from .columns import DIRECTIONS, FILLING, channels_of, column_name, equal_step, uncommented
from .networks import PLAIN_CSV, other_text
from .record import RecordError, unit_factor
from .text import (COMMENT, Channel, clock, direction_of, finite, numbers, positive, require_count, require_step, table,
                   whole)

AT2_HEADER_LINES = 20  # lines in which the number of samples of an AT2 file is searched
JMA_HEADER_LINES = 30  # lines in which the row of column names of a JMA file is searched
_PEKNOLD = "points at equal spacing of"


def sniff(lines):
    """Reader of the format of the lines, or None."""
    head = "\n".join(line for line in lines[:AT2_HEADER_LINES] if not line.startswith(COMMENT))
    start = next((line for line in lines if line.strip(FILLING)), "").strip().strip('"')
    if lines[0].strip().strip('"').startswith("Origin Time"):
        return knet.read_ascii
    if knet.is_csv(lines):
        return knet.read_csv
    if start.upper().startswith("SITE CODE"):
        return _jma
    if "NPTS" in head or _PEKNOLD in head.lower():
        return _at2
    return _plain_csv if _csv_columns(lines) else None


def parse(path, lines, units=None, stated=False):
    """Channels of a file. units: where it states none; stated: the caller states the directions. Raises RecordError."""
    reader = sniff(lines)
    if reader is None:
        raise RecordError(f"{path}: {other_text(lines)}; read are K-NET or KiK-net ASCII and CSV, PEER AT2, JMA CSV and"
                          " plain CSV")
    return reader(path, lines, units, *([stated] if reader is _at2 else []))


# --- PEER AT2 -----------------------------------------------------------------------------------


def _at2(path, lines, units, stated):
    """PEER AT2 and Peknold's variant: one channel, in g unless the header states another unit."""
    count, dt, first, where = _at2_header(path, lines)
    header = lines[:first]
    for number, line in enumerate(header, 1):
        quantity, _, rest = line.strip().lower().partition(" ")
        if quantity in ("velocity", "displacement") and rest.startswith("time"):
            raise RecordError(f"{path}:{number}: {quantity} record; it must be acceleration")
    factor = _stated_unit(path, [unit for unit in map(_unit_in, header) if unit], units)
    values = numbers(path, lines[first:], first + 1)
    require_count(path, len(values), whole(count, f"{where}: NPTS"), "NPTS", PLAIN_CSV)
    step = require_step(finite(dt, f"{where}: DT"), f"{where}: DT")
    return [Channel(path, step, values * factor, None if stated else _at2_direction(path, header))]


def _at2_header(path, lines):
    """(number of samples and time step as text, index of the first line of data, file:line of both)."""
    head = list(enumerate(lines[:AT2_HEADER_LINES], 1))
    for number, line in head:
        if pair := _count_and_step(line):
            return *pair, number, f"{path}:{number}"
    for number, line in head:  # 'n points at equal spacing of s sec'
        before, phrase, after = line.lower().partition(_PEKNOLD)
        if phrase and before.strip() and after.strip():
            first = next((i for i, row in enumerate(lines) if _is_numeric(row)), len(lines))
            return before.split()[-1], after.split()[0], first, f"{path}:{number}"
    number = next((number for number, line in head if {"npts", "dt"} <= set(_words(line, ",=:"))), None)
    absent = f"without 'NPTS= n, DT= s' or 'n s NPTS, DT' in {AT2_HEADER_LINES} lines"
    problem = absent if number is None else "with NPTS and DT in another form"
    place = path if number is None else f"{path}:{number}"
    raise RecordError(f"{place}: AT2 header {problem}; write 'NPTS= n, DT= s SEC', NPTS first, or convert it to"
                      f" {PLAIN_CSV}")


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
            rest = (words[i + 2 :] if words[i + 1 : i + 2] and words[i + 1] in ("of", "are", "is", "in")
                    else words[i + 1 :])
            return rest[0].rstrip(".") if rest and rest[0][0].isalpha() else None
    return None


def _stated_unit(path, in_file, stated):
    """m/s2 per unit, from the units in the file and the caller's; refuses none and contradiction."""
    units = [*in_file, *([] if stated is None else [stated])]
    if not units:
        raise RecordError(f"{path}: no unit stated; state it in the file or as units= (gal, m/s2 or g)")
    factors = {unit_factor(unit, path) for unit in units}
    if len(factors) > 1:
        raise RecordError(f"{path}: units contradict each other ({', '.join(units)}); state one")
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
        raise RecordError(f"{path}: direction is {in_title} in the title but {in_name} in the file name; state"
                          " component=")
    return in_title if in_title is not None else in_name


# --- JMA CSV ------------------------------------------------------------------------------------


def _jma(path, lines, units):
    """JMA CSV, old and new headers: the keys in any order, then NS, EW, UD (and time) by name."""
    keys, names, first = _jma_header(path, lines)
    sampling = keys.get("SAMPLING RATE", keys.get("SAMPLING FREQ"))
    if sampling is None:
        raise RecordError(f"{path}: JMA header without SAMPLING RATE")
    rate, where = positive(sampling[0].lower().partition("hz")[0], sampling[1]), sampling[1]
    unit = keys.get("UNIT", ("", ""))[0].partition("(")[0].partition(",")[0].strip()
    factor = _stated_unit(path, [unit] if unit else [], units)
    rows = table(path, lines[first:], first + 1, len(names), ",")
    begins = clock(*keys["INITIAL TIME"]) if keys.get("INITIAL TIME", ("", ""))[0] else None
    return channels_of(path, names, rows * factor, require_step(1.0 / rate, where), begins)


def _jma_header(path, lines):
    """({key: (value, file:line: key)}, [column names], index of the first row); a value is the rest of its line."""
    keys = {}
    for index, line in enumerate(lines[:JMA_HEADER_LINES]):
        names = [column_name(cell)[0] for cell in line.split(",") if cell.strip()]
        if {"ns", "ew", "ud"} <= set(names):
            return keys, names, index + 1
        key, _, value = line.replace('"', "").partition("=" if "=" in line else ",")
        key = " ".join(key.upper().split()).rstrip(".")
        keys[key] = value.strip(FILLING), f"{path}:{index + 1}: {shown(key)}"
    raise RecordError(f"{path}: JMA header without a row that names NS, EW and UD in its first {JMA_HEADER_LINES}"
                      " lines")


# --- plain CSV ----------------------------------------------------------------------------------

_UNIQUE = ("dt", "sampling", "units", "unit", "samples")  # comments that decide how the numbers are read
_SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, None: 1.0}


def _plain_csv(path, lines, units):
    """CSV with named columns: ns, ew, ud (one or more), optionally time [s] or [ms], and a stated unit."""
    header_index, names, units_of, delimiter = _csv_columns(lines)
    comments = _csv_comments(path, lines[:header_index])
    in_file = [comments[key][0] for key in ("units", "unit") if key in comments]
    in_file += [units_of[name] for name in names if units_of[name] and name != "time"]
    factor = _stated_unit(path, in_file, units)
    first = header_index + 1
    rows = table(path, lines[first:], first + 1, len(names), delimiter)
    unit, times = units_of.get("time"), None
    if unit not in _SECONDS:
        raise RecordError(f"{path}: time in {shown(unit)}; s or ms")
    if "time" in names:
        times = rows[:, names.index("time")] * _SECONDS[unit]
    step = equal_step(path, comments, times)
    if "samples" in comments:
        require_count(path, len(rows), whole(*comments["samples"]), "'# samples:'")
    return channels_of(path, names, rows * factor, step)


def _csv_columns(lines):
    """(index of the row of names, names, {name: unit or None}, delimiter), or None without such a row. It is the first
    row, or the comment before the first row where that has numbers (as of numpy.savetxt)."""
    for index, line in enumerate(lines):
        if line.startswith(COMMENT) or not line.strip(FILLING):
            continue
        return _named_columns(index, line) or (_named_columns(index - 1, uncommented(lines[index - 1])) if index
                                               else None)
    return None


def _named_columns(index, line):
    delimiter = next((d for d in (",", ";", "\t") if d in line), ",")
    cells = [column_name(cell) for cell in line.rstrip(FILLING).split(delimiter)]
    names = [name for name, _ in cells]
    admissible = set(names) <= {*DIRECTIONS, "time"} and len(set(names)) == len(names)
    return (index, names, dict(cells), delimiter) if admissible and not set(names) <= {"time"} else None


def _csv_comments(path, lines):
    """{key: (value, file:line: key)} of the lines '# key: value' or '# key = value' before the row of names."""
    pairs = {}
    for number, line in enumerate(lines, 1):
        if not line.startswith(COMMENT):
            continue
        line = line.strip(FILLING + '"')
        text = line[1:].replace("=", ":", 1) if "=" in line.partition(":")[0] else line[1:]
        key, _, value = (part.strip() for part in text.partition(":"))
        if not key.replace(" ", "").isalpha() or not value:
            continue
        key, where = key.lower(), f"{path}:{number}: {key.lower()}"
        if key in _UNIQUE and pairs.get(key, (value,))[0] != value:
            raise RecordError(f"{where}: {shown(value)} contradicts {shown(pairs[key][0])} before it; state one")
        pairs[key] = value, where
    return pairs
