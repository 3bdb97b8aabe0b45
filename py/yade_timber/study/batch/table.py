# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables in yade-batch's format: a line with the names of the columns, then one line a run, all without blanks inside.

`#` starts a comment, `*` is the default, `=` the value of the line above; quotes around words are allowed. Columns that
start with `!` are yade-batch's own (`!THREADS`). Relative paths are taken from the table's folder.
"""

import hashlib
import json
import re
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path

from ...base.errors import RunError
from ...house import HouseError, load_house
from ...house.schema import nearest
from ...motion import MotionRequest, RecordError
from ...motion.readers import find_files

NO_EARTHQUAKE = "none"
"""What stands in the column `record` of a run without earthquake."""

OWN = {
    "house": (str, "shipped house or house file"),
    "set": (str, "changes of the house: key=value;key=value, keys as in house files, list items counted from 1"),
    "braces": (str, "braces added to the house by their names, separated by ;"),
    "strength": (float, "factor on the strength of all joints (default 1)"),
    "snow": (float, "depth of the snow on the roofs [m] (default: the house's own)"),
    "dt": (float, "time step [s]"),
    "duration": (float, "simulated time [s] (default: the motion's; without an earthquake 30)"),
}
MOTION = {f.name: (f.metadata["kind"], f.metadata["help"]) for f in fields(MotionRequest)}
COLUMNS = {**OWN, **MOTION}
"""{column: (type, what it says)}; `description` comes beside these."""

DESCRIPTION = "description"
_SHELL_SAFE = re.compile(r"[\w./+=,@-]+")


class BatchError(RunError):
    """A table that cannot be used; the message is one line: table, line, column, what is admissible."""


@dataclass(frozen=True)
class Row:
    """One run of a table. cells: {column: text} of what was given, without defaults and without yade-batch's columns."""

    table: Path
    line: int
    cells: dict
    description: str = ""

    def where(self, column):
        """'runs.txt:5, column scale'."""
        return f"{self.table.name}:{self.line}, column {column}"

    def value(self, column, default=None):
        """The typed value of a column, or the default. Raises BatchError for what is no such value."""
        if column not in self.cells:
            return default
        text, kind = self.cells[column], COLUMNS[column][0]
        try:
            return _FLAGS[text.lower()] if kind is bool else kind(text)
        except (ValueError, KeyError):
            wanted = {int: "a whole number", float: "a number", bool: "yes or no"}[kind]
            raise BatchError(f"{self.where(column)}: '{text}' is not {wanted}; {COLUMNS[column][1]}") from None

    @property
    def house(self):
        """Shipped house, or path of a house file: beside the table, wherever the process runs."""
        given = self.cells["house"]
        beside = self.table.parent / given
        is_path = "/" in given or given.endswith((".yaml", ".yml"))
        return str(beside) if is_path or beside.is_file() else given

    @property
    def record(self):
        """Files or prefix of the record; None: synthetic motion or no earthquake."""
        given = self.cells.get("record")
        return None if given in (None, NO_EARTHQUAKE) else ",".join(str(self.table.parent / part) for part in given.split(","))

    @property
    def name(self):
        """Name of the run and its folder: it changes when the row, its house or its record does, not when rows move."""
        label = self.description or Path(self.cells["house"]).stem
        content = json.dumps([sorted(self.cells.items()), _house_text(self.house), _record_digest(self.record)])
        return f"{re.sub(r'[^A-Za-z0-9._+=-]+', '_', label)[:60]}-{hashlib.sha256(content.encode()).hexdigest()[:8]}"


_FLAGS = {"yes": True, "true": True, "1": True, "no": False, "false": False, "0": False}


@lru_cache(maxsize=256)
def _house_text(house):
    """Everything a house file says, with what it extends; an unusable one has its error at run time."""
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
    lines = _lines(path)
    if not lines:
        raise BatchError(f"{path}: empty; the first line names columns: house, {', '.join(list(COLUMNS)[1:4])}, ...")
    (number, header), *body = lines
    heads = [head.rstrip("!") for head in header]
    _check_heads(heads, f"{path.name}:{number}")
    rows, above = [], {}
    for number, cells in body:
        if len(cells) != len(heads):
            raise BatchError(f"{path.name}:{number}: {len(cells)} values for {len(heads)} columns; values hold no blanks")
        above = {head: _resolved(cell, above.get(head), f"{path.name}:{number}, column {head}") for head, cell in zip(heads, cells)}
        given = {head: cell for head, cell in above.items() if cell != "*"}
        rows.append(Row(path, number, {h: c for h, c in given.items() if h in COLUMNS}, given.get(DESCRIPTION, "")))
        if "house" not in rows[-1].cells:
            raise BatchError(f"{rows[-1].where('house')}: every run needs a house")
    _check_twins(rows)
    return rows


def _lines(path):
    """[(line number, words)] of the lines that say something."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as problem:
        raise BatchError(f"{path}: cannot be read: {getattr(problem, 'strerror', None) or 'not UTF-8 text'}") from None
    if text and not text.endswith("\n"):
        raise BatchError(f"{path}: its last line has no line end, which makes yade-batch lose a character; add one")
    words = [(number, re.sub(r"\s*#.*", "", line).split()) for number, line in enumerate(text.splitlines(), 1)]
    return [(number, cells) for number, cells in words if cells]


def _check_heads(heads, where):
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


def _check_twins(rows):
    """Two rows of one name would share a folder; their content is the same."""
    seen = {}
    for row in rows:
        if row.name in seen:
            raise BatchError(f"{row.table.name}:{row.line}: the same run as in line {seen[row.name]}; remove one")
        seen[row.name] = row.line


def check_shell_safe(path):
    """yade-batch hands paths to a shell as they are. Raises BatchError for one that would not survive."""
    if not _SHELL_SAFE.fullmatch(str(path)):
        raise BatchError(f"{path}: yade-batch takes no blanks or other signs of the shell in a path; use letters, digits and . _ - + = , @ /")
