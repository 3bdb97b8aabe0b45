# SPDX-License-Identifier: GPL-2.0-or-later
"""Text of record files: lines, numbers, tables, dates; a channel. `where` opens messages: file, line, member.

String methods instead of regular expressions keep the time of a line proportional to its length."""
import re
import warnings
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from ..base.input_file import read_bytes, shown
from .networks import other_binary
from .record import RecordError, RecordWarning

MAX_FILE_SIZE = 10_000_000  # of one file. [bytes]
MAX_LINE = 1000  # characters of one line
MAX_SAMPLES = 200_000  # samples of one component: 33 minutes at 100 Hz
MAX_NUMBER = 1e15  # largest absolute value of a number in a record, of any unit
MIN_STEP, MAX_STEP = 1e-4, 1.0  # time steps of accelerographs. [s]
YEARS = range(1800, 2200)  # years of records
COMMENT = ("#", '"#')
"""Beginnings of a comment; a spreadsheet quotes it."""
UP = "up"  # direction of a vertical channel, positive upwards; `DOWN` is positive downwards
DOWN = "down"
NAMES = {0.0: "ns n north northsouth y", 90.0: "ew e east eastwest x", UP: "ud u up v ver vert vertical z",
         DOWN: "dn dwn down"}
"""{direction: names of components}."""


@dataclass(frozen=True)
class Channel:
    """One component of a record, as stored in its file.

    path       file
    dt         time step [s]
    values     (n,) [m/s2]
    direction  azimuth in degrees clockwise from north in which the motion is positive, UP, DOWN,
               or None where the file does not state it
    begins     date and time of the first sample, or None where the file does not state it"""

    path: Path
    dt: float
    values: np.ndarray = field(repr=False)
    direction: float | str | None
    begins: datetime | None = None


def read_lines(path):
    """Lines of a text file, UTF-8 or CP932. Raises RecordError for another, too large file or too long a line."""
    try:
        raw = read_bytes(path, MAX_FILE_SIZE)
    except OSError as error:
        raise RecordError(f"{path}: cannot be read ({error.strerror})") from None
    for encoding in ("utf-8-sig", "cp932"):
        try:
            text = raw.decode(encoding).rstrip("\x1a")  # DOS's end of a file
        except UnicodeDecodeError:
            continue
        if "\0" not in text and text.strip():
            break
    else:
        raise RecordError(f"{path}: {other_binary(raw)}")
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if len(line) > MAX_LINE:
            raise RecordError(f"{path}:{number}: a line of {len(line)} characters; at most {MAX_LINE}")
    if len(lines) > 2 * MAX_SAMPLES:
        raise RecordError(f"{path}: {len(lines)} lines; at most {2 * MAX_SAMPLES}; cut the record")
    return lines


def finite(text, where):
    """A finite number of at most MAX_NUMBER. Raises RecordError."""
    try:
        value = np.nan if "_" in text else float(_with_e(text))  # Python reads 1_000 as 1000
    except ValueError:
        value = np.nan
    if not abs(value) <= MAX_NUMBER:
        raise RecordError(f"{where}: {shown(text.strip())} is not a finite number up to {MAX_NUMBER:g}")
    return value


def _with_e(text):
    return re.sub(r"(?<=[0-9.])[dD](?=[-+0-9])", "E", text) if "D" in text or "d" in text else text


def positive(text, where):
    """A finite number > 0. Raises RecordError."""
    value = finite(text, where)
    if value <= 0.0:
        raise RecordError(f"{where}: {value:g}; it must be > 0")
    return value


def whole(text, where):
    """A whole number >= 0 of at most 9 digits. Raises RecordError."""
    text = text.strip()
    if not text.isdecimal() or len(text) > 9:
        raise RecordError(f"{where}: {shown(text)} is not a whole number of at most 9 digits")
    return int(text)


def numbers(path, lines, first):
    """All blank-separated numbers of `lines`, numbered from `first`. (n,) Raises RecordError with file and line."""
    tokens = []
    for number, line in enumerate(lines, first):
        tokens += _with_e(line).split()
        _require_few_samples(len(tokens), f"{path}:{number}")
    try:
        values = np.array(tokens if not any("_" in token for token in tokens) else [], dtype=float)
        if len(values) >= 2 and np.abs(values).max() <= MAX_NUMBER:
            return values
    except ValueError:
        pass
    for number, line in enumerate(lines, first):
        for token in line.split():
            finite(token, f"{path}:{number}")
    raise RecordError(f"{path}: {len(tokens)} samples; a record needs at least 2")


def table(path, lines, first, columns, delimiter, texts=()):
    """Rows of `columns` separated numbers, quoted or not, without blank lines and comments. (n, columns)

    texts: columns of other content: 0

    Raises RecordError for a row of another length or a value that is not a finite number."""
    rows = []
    for number, line in enumerate(lines, first):
        if line.startswith(COMMENT):
            continue
        cells = [cell.strip(' \t"') for cell in line.split(delimiter)]
        while len(cells) > columns and not cells[-1]:
            cells.pop()
        if not any(cells):
            continue
        where = f"{path}:{number}"
        if len(cells) != columns:
            raise RecordError(f"{where}: {len(cells)} values; the header names {columns} columns")
        rows.append([0.0 if k in texts else finite(cell, where) for k, cell in enumerate(cells)])
        _require_few_samples(len(rows), where)
    if len(rows) < 2:
        raise RecordError(f"{path}: {len(rows)} samples; a record needs at least 2")
    return np.array(rows)


def _require_few_samples(count, where):
    if count > MAX_SAMPLES:
        raise RecordError(f"{where}: more than {MAX_SAMPLES} samples; cut the record")


def require_count(path, got, stated, meaning, other=""):
    """Refuse a record whose number of samples differs from the one in its header. other: form to convert it to"""
    if got != stated:
        kind = "truncated" if got < stated else "too long"
        convert = other and f", or convert it to {other}"
        raise RecordError(f"{path}: {kind}, {got} samples; {meaning} says {stated}; get the file again or correct that"
                          f" number{convert}")


def require_step(dt, where):
    """Refuse a time step that no accelerograph has. [s]"""
    if not MIN_STEP <= dt <= MAX_STEP:
        raise RecordError(f"{where}: time step {dt:g} s; it must be between {MIN_STEP:g} and {MAX_STEP:g} s")
    return dt


_CLOCK = re.compile(r"\D*(\d+)" + r"\D+(\d+)" * 4 + r"(?:\D+(\d+(?:\.\d*)?))?")
"""Year, month, day, hour, minute and, in any number of digits, seconds."""
CENTURY_TURN = 69  # years of two digits from here on are 19xx, smaller ones 20xx (POSIX)


def clock(text, where):
    """Date and time from 'year month day hour minute [second]' with any separators; None, with a warning, else."""
    match = _CLOCK.match(text)
    try:
        year, month, day, hour, minute = map(int, match.groups()[:5])
        if len(match[1]) == 2:
            year += 1900 if year >= CENTURY_TURN else 2000
        seconds = float(match[6] or 0.0)
        if year in YEARS and seconds < 61.0:
            return datetime(year, month, day, hour, minute) + timedelta(seconds=seconds)
    except (ValueError, OverflowError, AttributeError):
        pass
    problem = (f"{shown(text.strip())} is not a date and time like 2004/10/23 17:56:00 of the years {YEARS[0]} to"
               f" {YEARS[-1]}")
    warnings.warn(f"{where}: {problem}; the record is read without it", RecordWarning, stacklevel=2)
    return None


def direction_of(name):
    """Direction from a component's name ('090', 'N-S', 'UP', ...: towards north, east, up), or None."""
    key = "".join(c for c in name.lower() if c.isascii() and c.isalnum())
    try:
        azimuth = float(name)
    except ValueError:
        azimuth = float("nan")
    if abs(azimuth) <= 360 and key[:1].isdecimal():
        return azimuth % 360
    bearing = re.fullmatch(r"([ns])(\d{1,2})([ew])", key)  # N10E: 10 degrees from north towards east
    if bearing:
        away = float(bearing[2]) * (1 if bearing[3] == "e" else -1)
        return (away if bearing[1] == "n" else 180 - away) % 360
    channel = re.fullmatch(r"[hbe][nlhg]([nez])|(ns|ew|ud)[12]", key)  # HNE of a network; NS2 of KiK-net
    key = channel[1] or channel[2] if channel else key
    return next((direction for direction, names in NAMES.items() if key in names.split()), None)
