# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables: a line with the names of the columns, then one line per run. Two formats are read.

Columns separated by blanks (the format of yade-batch): `#` starts a comment, `*` is the default, `=` the value of the
line above; columns whose names begin with `!` belong to yade-batch and are ignored. Separated by commas (CSV): an empty
cell is the default. Relative paths are relative to the table's folder."""
import csv
import re
from pathlib import Path

from ...base.input_file import is_file, read_bytes
from ...base.options import read
from ...base.remedies import nearest
from ...run.options import OptionSource, RunOptions
from .rows import COLUMNS, HOUSE_CHANGES, NO_EARTHQUAKE, BatchError, HouseChanges, Row

MAX_FILE_SIZE = 10_000_000  # [bytes]
DESCRIPTION = "description"
NOT_UTF8 = "not UTF-8 text; save it as UTF-8 (in a spreadsheet: CSV UTF-8)"
MIXED = ("the first line has no commas, so blanks separate the columns: separate the names in it by commas, too, or the"
         " values here by blanks alone")
"""Remedy for a table with blanks in the first line and commas in others."""


def read_table(path):
    """Rows of a table, in its order. Raises BatchError."""
    path = Path(path).absolute()
    lines = _text_lines(path)
    if not lines:
        raise BatchError(f"{path}: empty; the first line names columns: house, {', '.join(list(COLUMNS)[1:4])}, ...")
    (number, first), *body = lines
    if ";" in first:
        raise BatchError(f"{path.name}:{number}: columns are separated by semicolons; separate them by commas or"
                         " blanks")
    separate = _csv_cells if "," in first else lambda line, where: line.split()
    heads = [head.rstrip("!") for head in separate(first, f"{path.name}:{number}")]
    _check_heads(heads, f"{path.name}:{number}")
    rows, above = [], {}
    for number, line in body:
        cells = separate(line, f"{path.name}:{number}")
        if "," in first and set(cells) == {"*"}:
            continue
        if len(cells) != len(heads):
            raise BatchError(f"{path.name}:{number}: {len(cells)} values for {len(heads)} columns;"
                             f" {_remedy(first, line)}")
        if any(cell.endswith(",") for cell in cells):
            raise BatchError(f"{path.name}:{number}: values end in commas; {MIXED}")
        for head, cell in zip(heads, cells):
            if head == "*" != cell:  # an empty column that a spreadsheet adds has the head '*' as well
                raise BatchError(f"{path.name}:{number}: the value '{cell}' is in a column without a name")
            if cell == "=" and head not in above:
                raise BatchError(f"{path.name}:{number}, column {head}: '=' repeats the line above, and there is none")
        above = {head: above[head] if cell == "=" else cell.strip("'\"") for head, cell in zip(heads, cells)
                 if head != "*"}
        rows.append(_row({head: cell for head, cell in above.items() if cell != "*"}, path, number))
    _check_repeated(rows)
    return rows


def _row(cells, path, number):
    """Row of {column: text} without defaults. Raises RunError for a text that is no value of its column."""
    place = f"{path.name}:{number}"
    if "house" not in cells:
        raise BatchError(f"{place}, column house: every run needs a house")
    values = {name: read(each, cells[name], f"{place}, column {name}:") for name, each in COLUMNS.items()
              if name in cells}
    changes = {name: values.pop(name) for name in HOUSE_CHANGES if name in values}
    changes |= {name: tuple(filter(None, text.split(";"))) for name, text in changes.items() if isinstance(text, str)}
    house = path.parent / values["house"]
    if "/" in values["house"] or house.suffix in (".yaml", ".yml") or is_file(house):  # no shipped house
        values["house"] = str(house)
    calm = values.get("record") == NO_EARTHQUAKE
    if calm and "seed" in values:
        raise BatchError(f"{place}, column seed: the column record is {NO_EARTHQUAKE}, without an earthquake")
    if calm:
        del values["record"]
    values |= {name: ";".join(_beside(part.strip(), path.parent) for part in values[name].split(";"))
               for name in ("record", "then") if name in values}
    source = OptionSource(lambda column: f"{place}, column {column}:", f"the column record is {NO_EARTHQUAKE}")
    return Row(RunOptions(quake=not calm, source=source, **values), HouseChanges(**changes),
               cells.get(DESCRIPTION, ""), place, number)


def _beside(record, folder):
    """Files or prefix of a record, relative to the table's folder."""
    return ",".join(str(folder / Path(part.strip()).expanduser()) for part in record.split(","))


def _text_lines(path):
    """[(line number, text)] of the lines that are not empty, without comments."""
    try:
        text = read_bytes(path, MAX_FILE_SIZE).decode("utf-8-sig")
    except (OSError, ValueError) as problem:
        raise BatchError(f"{path}: cannot be read: {getattr(problem, 'strerror', None) or NOT_UTF8}") from None
    lines = [(number, _without_comment(line)) for number, line in enumerate(text.splitlines(), 1)]
    return [(number, line) for number, line in lines if line.strip()]


def _without_comment(line):
    """A comment begins with a # at the start of the line or after a blank, outside double quotes."""
    for part in re.finditer(r'"[^"]*"?|(?<!\S)#', line):
        if part[0] == "#":
            return line[: part.start()].rstrip()
    return line


def _remedy(first, line):
    """Remedy for a line with too few or too many values. first: line of the table"""
    if "," in first:
        return ('the first line has commas, which separate the values here, too: write decimal points (1.5) and put a'
                ' value with commas in quotes ("a,b")')
    if "," in line and len(line.split(",")) == len(first.split()):
        return MIXED
    return "blanks separate the columns: values contain none, * stands for a default"


def _csv_cells(line, where):
    try:
        return [cell.strip() or "*" for cell in next(csv.reader([line], skipinitialspace=True))]
    except csv.Error as problem:
        raise BatchError(f"{where}: {problem}") from None


def _check_heads(heads, where):
    heads = [head for head in heads if head != "*"]
    for head in heads:
        if not head.startswith("!") and head not in COLUMNS and head != DESCRIPTION:
            raise BatchError(f"{where}: unknown column '{head}', {nearest(head, [*COLUMNS, DESCRIPTION])}")
        if heads.count(head) > 1:
            raise BatchError(f"{where}: column '{head}' is given twice")
    if "house" not in heads:
        raise BatchError(f"{where}: no column 'house'")


def _check_repeated(rows):
    """Refuse two rows of one name: their content is the same, and they would share a folder."""
    lines = {}
    for row in rows:
        if row.name in lines:
            raise BatchError(f"{row.place}: the same run as in line {lines[row.name]}; remove one")
        lines[row.name] = row.line
