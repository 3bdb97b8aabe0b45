# SPDX-License-Identifier: GPL-2.0-or-later
"""CSV files."""
import csv
import io
from itertools import zip_longest

from .errors import RunError
from .record_file import MAX_TABLE, read_record


def read_csv(path):
    """(header, list of rows), cells as text. Raises RunError."""
    content = read_record(path, limit=MAX_TABLE)
    try:
        header, *rows = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""))
    except (ValueError, csv.Error) as problem:
        raise RunError(f"{path}: cannot be read as a table: {problem}") from None
    return header, rows


def read_rows(path):
    """[{column: text}] of a CSV file. Raises RunError."""
    header, lines = read_csv(path)
    return [dict(zip_longest(header, line)) for line in lines if line]


def csv_text(header, rows):
    """Text of a CSV file: floats with 12 significant digits, zero without a sign; texts as in `inert`. Letters beyond
    ASCII need a byte order mark for spreadsheets."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([f"{value + 0.0:.12g}" if isinstance(value, float) else inert(value) for value in row]
                     for row in rows)
    content = text.getvalue()
    return content if content.isascii() else f"\ufeff{content}"


FORMULA = ("=", "+", "-", "@", "\t", "\r")  # beginnings of a cell that spreadsheets evaluate


def inert(value):
    """A text that a spreadsheet would take for a formula, with an apostrophe before it; other values as they are."""
    if not isinstance(value, str) or not value.startswith(FORMULA) or len(value) == 1:
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value
