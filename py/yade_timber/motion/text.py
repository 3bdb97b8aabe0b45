# SPDX-License-Identifier: GPL-2.0-or-later
"""What all record formats share: text of a file, its numbers, and one channel of a record."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from .record import RecordError

UP = "up"
"""Direction of a vertical channel, positive upwards; `DOWN` is positive downwards."""
DOWN = "down"


@dataclass(frozen=True)
class Channel:
    """One component of a record as its file gives it.

    path       file
    dt         time step [s]
    values     (n,) [m/s2]
    direction  azimuth in degrees clockwise from north in which the motion is positive, UP, DOWN,
               or None where the file does not say
    begins     date and time of the first sample, or None where the file does not say
    """

    path: Path
    dt: float
    values: np.ndarray = field(repr=False)
    direction: float | str | None
    begins: datetime | None = None


def read_lines(path):
    """Lines of a text file, UTF-8 or CP932. Raises RecordError when there is no such text."""
    try:
        raw = Path(path).read_bytes()
    except OSError as error:
        raise RecordError(f"{path}: cannot be read ({error.strerror})") from None
    for encoding in ("utf-8-sig", "cp932"):
        try:
            text = raw.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text and text.strip():
            return text.splitlines()
    raise RecordError(f"{path}: empty or not a text file; a record must be text in UTF-8 or CP932")


def finite(text, where):
    """A finite number. Raises RecordError opening with `where` (file, line)."""
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise RecordError(f"{where}: '{text.strip()}' is not a finite number")
    return value


def numbers(path, lines, first):
    """All blank-separated numbers of `lines`; `first` is the number (from 1) of the first of them.

    Returns (n,). Raises RecordError with file and line for what is not a finite number.
    """
    try:
        values = np.array(" ".join(lines).split(), dtype=float)
        if np.isfinite(values).all():
            return values
    except ValueError:
        pass
    for number, line in enumerate(lines, first):
        for token in line.split():
            finite(token, f"{path}, line {number}")
    raise RecordError(f"{path}: numbers could not be read")


def table(path, lines, first, columns, delimiter):
    """Rows of `columns` separated numbers -> (n, columns); blank lines are skipped.

    Raises RecordError with file and line for a row of another length or what is not a finite number.
    """
    rows = []
    for number, line in enumerate(lines, first):
        cells = [cell.strip() for cell in line.split(delimiter)]
        while len(cells) > columns and not cells[-1]:
            cells.pop()
        if not any(cells):
            continue
        where = f"{path}, line {number}"
        if len(cells) != columns:
            raise RecordError(f"{where}: {len(cells)} values; the header names {columns} columns")
        rows.append([finite(cell, where) for cell in cells])
    if len(rows) < 2:
        raise RecordError(f"{path}: {len(rows)} samples; a record needs at least 2")
    return np.array(rows)


def require_count(path, got, stated, meaning):
    """Refuse a record whose number of samples is not the one that its header states."""
    if got != stated:
        word = "truncated" if got < stated else "too long"
        raise RecordError(f"{path}: {word}, {got} samples; {meaning} says {stated}")


def require_step(dt, where):
    """Refuse a time step that no accelerograph has; 1 microsecond to 1 second. [s]"""
    if not 1e-6 <= dt <= 1.0:
        raise RecordError(f"{where}: time step {dt:g} s; it must be between 1e-6 and 1 s")
    return dt


def clock(words, where):
    """Date and time from 'year month day hour minute second' with any signs between. Raises RecordError."""
    numbers_ = re.findall(r"[\d.]+", words)
    try:
        year, month, day, hour, minute = map(int, numbers_[:5])
        return datetime(year, month, day, hour, minute) + timedelta(seconds=float(numbers_[5]))
    except (ValueError, IndexError):
        raise RecordError(f"{where}: '{words.strip()}' is no date and time; it must be like 2004/10/23 17:56:00") from None


def direction_of(word):
    """Direction from a component's name ('090', 'N-S', 'UP', ...) or None.

    Compass words: towards north, east and up. An azimuth is a whole number of degrees from 0 to 360.
    """
    key = re.sub(r"[^a-z0-9]", "", word.lower())
    if key in ("ns", "n", "north", "northsouth", "y"):
        return 0.0
    if key in ("ew", "e", "east", "eastwest", "x"):
        return 90.0
    if key in ("ud", "u", "up", "v", "ver", "vert", "vertical", "z"):
        return UP
    if key in ("dn", "dwn", "down"):
        return DOWN
    if re.fullmatch(r"\d{1,3}", key) and int(key) <= 360:
        return float(int(key))
    return None
