# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables: a line with the names of the columns, then one line per run. Two formats are read.

Columns separated by blanks (the format of yade-batch): `#` starts a comment, `*` is the default, `=` the value of the
line above; columns whose names begin with `!` belong to yade-batch and are ignored. Separated by commas (CSV): an empty
cell is the default. Relative paths are relative to the table's folder.
"""
import csv
import hashlib
import json
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from ...base.errors import RunError
from ...base.input_file import read_bytes
from ...house import HouseError, load_house
from ...base.options import option, options, read
from ...base.remedies import nearest
from ...motion import RecordError
from ...motion.readers import find_files
from ...motion.sequence import with_factor
from ...run.options import OptionSource, RunOptions

MAX_FILE_SIZE = 10_000_000
"""[bytes]"""
NO_EARTHQUAKE = "none"
"""Value of the column `record` for a run without an earthquake."""


@dataclass(frozen=True)
class HouseChanges:
    """Columns that change the house of a row."""

    set: str = option(str,
                      "changes of the house: key=value;key=value, keys as in house files, list items counted from 1")
    braces: str = option(str, "names of braces and walls to add to the house, separated by ;")
    strength: float = option(float, "factor on the strength of all joints (default 1)", default=1.0)


CHANGES = options(HouseChanges)
DECISIVE = {name: each for name, each in options(RunOptions).items() if each.metadata["decides"] and name != "quake"}
COLUMNS = {"house": DECISIVE["house"], **CHANGES, **DECISIVE}
"""{column: option}, without the column `description`. A run has an earthquake unless its record is NO_EARTHQUAKE."""
DESCRIPTION = "description"
NOT_UTF8 = "not UTF-8 text; save it as UTF-8 (in a spreadsheet: CSV UTF-8)"
MIXED = ("the first line has no commas, so blanks separate the columns: separate the names in it by commas, too, or the"
         " values here by blanks alone")
"""Remedy for a table with blanks in the first line and commas in others."""


class BatchError(RunError):
    """A table that cannot be run; the message is one line: table, line, column, admissible values."""


@dataclass(frozen=True)
class Row:
    """One run of a table. cells: {column: text} without defaults and without yade-batch's columns."""

    table: Path
    line: int
    cells: dict
    description: str = ""

    def where(self, column):
        """'runs.txt:5, column scale'."""
        return f"{self.table.name}:{self.line}, column {column}"

    def value(self, column):
        """The value of a column in its type, or its default. Raises RunError for text that is no such value."""
        return (read(COLUMNS[column], self.cells[column], f"{self.where(column)}:") if column in self.cells
                else COLUMNS[column].default)

    def options(self, house=None):
        """RunOptions of scripts/house.py. house: file in place of the row's. Raises RunError."""
        files = {"house": str(house or self.house), "record": self.record, "then": self.then}
        calm = self.cells.get("record") == NO_EARTHQUAKE
        if calm and "seed" in self.cells:
            raise BatchError(f"{self.where('seed')}: the column record is {NO_EARTHQUAKE}, without an earthquake")
        source = OptionSource(lambda column: f"{self.where(column)}:", f"the column record is {NO_EARTHQUAKE}")
        return RunOptions(quake=not calm, source=source,
                          **{column: self.value(column) for column in DECISIVE if column not in files}, **files)

    @property
    def house(self):
        """Name of a shipped house, or path of a house file; relative paths are relative to the table."""
        name = self.cells["house"]
        beside = self.table.parent / name
        is_path = "/" in name or name.endswith((".yaml", ".yml"))
        return str(beside) if is_path or beside.is_file() else name

    @property
    def record(self):
        """Files or prefix of the record; None: synthetic motion or no earthquake."""
        text = self.cells.get("record")
        return None if text in (None, NO_EARTHQUAKE) else self._beside(text)

    @property
    def then(self):
        """Records that follow the first, with factors; paths relative to the table. None: no sequence."""
        text = self.cells.get("then")
        return None if text is None else ";".join(self._beside(part.strip()) for part in text.split(";"))

    def _beside(self, record):
        return ",".join(str(self.table.parent / Path(part.strip()).expanduser()) for part in record.split(","))

    @property
    def name(self):
        """Name of the run and its folder: it follows from the content of the row, its house and its record."""
        label = self.description or Path(self.cells["house"]).stem
        following = [] if self.then is None else [with_factor(entry)[0] for entry in self.then.split(";")]
        digests = map(_record_digest, [self.record, *following])
        content = json.dumps([sorted(self.cells.items()), _house_text(self.house), *digests])
        return f"{re.sub(r'[^A-Za-z0-9._+=-]+', '_', label)[:60]}-{hashlib.sha256(content.encode()).hexdigest()[:8]}"


@lru_cache(maxsize=256)
def _house_text(house):
    """Content of a house file and those it extends; None for a house with errors, reported by the row's check."""
    try:
        return json.dumps(load_house(house).data, sort_keys=True)
    except HouseError:
        return None


@lru_cache(maxsize=256)
def _record_digest(record):
    try:
        paths = [] if record is None else find_files(record)
        return [hashlib.sha256(path.read_bytes()).hexdigest() for path in paths]
    except (RecordError, OSError):
        return None


# --- reading ----------------------------------------------------------------------------------------------------------


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
    separate = _csv_cells if "," in first else str.split
    heads = [head.rstrip("!") for head in separate(first)]
    body = [(number, line) for number, line in body if separate is str.split or set(separate(line)) != {"*"}]
    _check_heads(heads, f"{path.name}:{number}")
    rows, above = [], {}
    for number, line in body:
        cells = separate(line)
        if len(cells) != len(heads):
            raise BatchError(f"{path.name}:{number}: {len(cells)} values for {len(heads)} columns;"
                             f" {_remedy(first, line)}")
        if any(cell.endswith(",") for cell in cells):
            raise BatchError(f"{path.name}:{number}: values end in commas; {MIXED}")
        cells = _named(cells, heads, f"{path.name}:{number}")
        above = {head: _resolved(cell, above.get(head), f"{path.name}:{number}, column {head}")
                 for head, cell in cells}
        stated = {head: cell for head, cell in above.items() if cell != "*"}
        rows.append(Row(path, number, {h: c for h, c in stated.items() if h in COLUMNS}, stated.get(DESCRIPTION, "")))
        if "house" not in rows[-1].cells:
            raise BatchError(f"{rows[-1].where('house')}: every run needs a house")
    _check_repeated(rows)
    return rows


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


def _csv_cells(line):
    return [cell.strip() or "*" for cell in next(csv.reader([line], skipinitialspace=True))]


def _named(cells, heads, where):
    """[(head, cell)] of a line, without the empty columns that a spreadsheet adds, whose head is '*' as well."""
    for cell in (cell for cell, head in zip(cells, heads) if head == "*" and cell != "*"):
        raise BatchError(f"{where}: the value '{cell}' is in a column without a name")
    return [(head, cell) for head, cell in zip(heads, cells) if head != "*"]


def _check_heads(heads, where):
    heads = [head for head in heads if head != "*"]
    for head in heads:
        if not head.startswith("!") and head not in COLUMNS and head != DESCRIPTION:
            raise BatchError(f"{where}: unknown column '{head}', {nearest(head, [*COLUMNS, DESCRIPTION])}")
        if heads.count(head) > 1:
            raise BatchError(f"{where}: column '{head}' is given twice")
    if "house" not in heads:
        raise BatchError(f"{where}: no column 'house'")


def _resolved(cell, above, where):
    if cell == "=" and above is None:
        raise BatchError(f"{where}: '=' repeats the line above, and there is none")
    return above if cell == "=" else cell.strip("'\"")


def _check_repeated(rows):
    """Refuse two rows of one name: their content is the same, and they would share a folder."""
    lines = {}
    for row in rows:
        if row.name in lines:
            raise BatchError(f"{row.table.name}:{row.line}: the same run as in line {lines[row.name]}; remove one")
        lines[row.name] = row.line
