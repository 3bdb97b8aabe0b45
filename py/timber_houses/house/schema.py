# SPDX-License-Identifier: GPL-2.0-or-later
"""Schema checker with one-line errors: file and line, key, problem, admissible range, nearest known key.

Each part of a schema has `default` (REQUIRED: must be given) and `check(value, where, name)`, which returns the value
with defaults filled in. `where`: "file:line"; `name`: path of the key."""
import math
import re
from dataclasses import dataclass
from typing import Any

from ..base.gravity import GRAVITY
from ..base.input_file import shown
from ..base.remedies import decimal_point, nearest
from .errors import HouseError
from .limits import MAX_ITEMS, MAX_NAME, MAX_NAMES, MAX_TEXT
from .parser import Items, Table

REQUIRED = object()
NAME = r"[\w-]+"
"""Names that the user chooses. Dots and brackets are reserved for paths to single keys and for names of braces."""
OTHER_UNITS = {"m": (("mm", 1e-3), ("cm", 1e-2)), "kg/m3": (("g/cm3", 1e3),), "Pa": (("MPa", 1e6), ("GPa", 1e9)),
               "N/m": (("kN/m", 1e3), ("N/mm", 1e3), ("kN/mm", 1e6)), "N": (("kN", 1e3),),
               "N/m per rad": (("kN/m per rad", 1e3),), "rad": (("%", 1e-2),),
               "kN/m2": (("N/m2", 1e-3), ("kg/m2", GRAVITY / 1000)), "rise over run": (("sun (tenths)", 0.1),)}
"""Units often used by mistake: unit of the schema -> (unit, factor)."""
_FRACTION = re.compile(r"(\d{1,9}(?:\.\d{1,9})?) ?/ ?(\d{1,9}(?:\.\d{1,9})?)")


def fail(where, name, problem):
    raise HouseError(f"{where}: {name}: {problem}")


@dataclass(frozen=True)
class Number:
    """A finite number (infinite if `high` and `infinite` allow) in [low, high], or (low, high]; in rad also 1/120."""

    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    infinite: bool = False
    whole: bool = False
    off: bool = False  # whether `false` is admissible
    default: object = REQUIRED

    def check(self, value, where, name):
        if self.off and value is False:
            return False
        fraction = self.unit == "rad" and isinstance(value, str) and _FRACTION.fullmatch(value)
        if fraction and float(fraction[2]):
            value = float(fraction[1]) / float(fraction[2])
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            wanted = f"a number{self._range()}{' or false' if self.off else ''}"
            fail(where, name, f"expected {wanted}, got {shown(value)}{decimal_point(value)}")
        if not self._admits(value) or math.isinf(value) and not self.infinite or self.whole and value != int(value):
            kind = "a whole number" if self.whole else "a number"
            fail(where, name, f"must be {kind}{self._range()}, got {value!r}{self._other_units(value)}")
        return int(value) if self.whole else float(value)

    def _admits(self, value):
        return self.low <= value <= self.high and not (self.open_low and value == self.low)

    def _other_units(self, value):
        """Hint for a value that would be admissible in another usual unit, e.g. a section of 105."""
        meant = [f"{value!r} {unit} = {value * factor:g}" for unit, factor in OTHER_UNITS.get(self.unit, ())
                 if self._admits(value * factor)]
        return f"; in {self.unit}: {' or '.join(meant)}" if meant else ""

    def _range(self):
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.low) and math.isinf(self.high):
            return f" [{self.unit}]" if self.unit else ""
        return f" in {'(' if self.open_low else '['}{self.low:g}, {self.high:g}]{unit}"


@dataclass(frozen=True)
class Text:
    """A text of printable characters; runs of blanks and line breaks become one blank."""

    default: object = REQUIRED
    most: int = MAX_TEXT

    def check(self, value, where, name):
        if not isinstance(value, str) or not value.strip():
            fail(where, name, f"expected a text, got {shown(value)}")
        text = " ".join(value.split())
        if len(text) > self.most:
            fail(where, name, f"a text of {len(text)} characters; at most {self.most}")
        if not text.isprintable():
            fail(where, name, f"{shown(value)} has control characters or halves of character pairs; remove them")
        return text


@dataclass(frozen=True)
class Flag:
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, bool):
            fail(where, name, f"expected true or false, got {shown(value)}")
        return value


@dataclass(frozen=True)
class Choice:
    options: tuple
    default: object = REQUIRED

    def check(self, value, where, name):
        if value not in self.options:
            fail(where, name, f"{shown(value)} is unknown, {nearest(value, self.options)}")
        return value


@dataclass(frozen=True)
class Pair:
    """A list of two different items."""

    first: Any
    second: Any
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, list) or len(value) != 2:
            got = f"{len(value)} items" if isinstance(value, list) else shown(value)
            fail(where, name, f"expected a list of two items, got {got}")
        checked = [field.check(v, value.at(i), f"{name}[{i + 1}]")
                   for i, (field, v) in enumerate(zip((self.first, self.second), value))]
        return Items(checked, value.where, value.entries)


@dataclass(frozen=True)
class ListOf:
    """A list of `item`; `scalar` allows one item without brackets; `length` fixes their number, `least` and
    `most` limit it."""

    item: Any
    length: int = 0
    scalar: bool = False
    least: int = 0
    most: int = MAX_ITEMS
    default: object = REQUIRED

    def check(self, value, where, name):
        if self.scalar and not isinstance(value, list):
            value = Items([value], where, [where])
        if not isinstance(value, list):
            fail(where, name, f"expected a list, got {shown(value)}")
        if self.length and len(value) != self.length:
            remedy = "; write decimal points, not commas" if len(value) > self.length else ""
            fail(where, name, f"expected {self.length} items, got {len(value)}{remedy}")
        if len(value) < self.least:
            fail(where, name, f"a list of {len(value)} items; at least {self.least}, or remove the entry")
        if len(value) > self.most:
            fail(where, name, f"a list of {len(value)} items; at most {self.most}")
        checked = [self.item.check(v, value.at(i), f"{name}[{i + 1}]") for i, v in enumerate(value)]
        return Items(checked, value.where, value.entries)


@dataclass(frozen=True)
class Either:
    """A list, or a table."""

    listed: ListOf
    table: Any
    default: object = REQUIRED

    def check(self, value, where, name):
        return (self.table if isinstance(value, Table) else self.listed).check(value, where, name)


@dataclass(frozen=True)
class MapOf:
    """A table whose keys the user chooses; every entry follows `item`. `most` limits their number."""

    item: Any
    default: object = REQUIRED
    most: int = MAX_NAMES

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name, f"expected a table of names (name: ...), got {shown(value)}")
        if len(value) > self.most:
            fail(where, name, f"{len(value)} entries; at most {self.most}")
        for key in value:
            if len(key) > MAX_NAME or not re.fullmatch(NAME, key):
                fail(value.at(key), name,
                     f"{shown(key)} is not a valid name; use at most {MAX_NAME} letters, digits, _ and -")
        checked = {k: self.item.check(v, value.at(k), f"{name}.{k}" if name else k) for k, v in value.items()}
        return Table(checked, value.where, value.entries, name)


@dataclass(frozen=True)
class Record:
    """A table with known keys. `one_of`: exactly one of these optional keys must be given."""

    fields: dict
    one_of: tuple = ()
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name or "house", f"expected a table with {', '.join(self.fields)}, got {shown(value)}")
        self._check_keys(value, name)
        checked = {key: _field(field, key, value, name) for key, field in self.fields.items()}
        return Table(checked, where, value.entries, name)

    def _check_keys(self, value, name):
        for key in value:
            if key not in self.fields:
                fail(value.at(key), name or "house", f"unknown key {shown(key)}, {nearest(key, self.fields)}")
        present = [key for key in self.one_of if key in value]
        if self.one_of and len(present) != 1:
            got = " and ".join(present) if present else "none"
            fail(value.where, name, f"give exactly one of {', '.join(self.one_of)}; got {got}")


def _field(field, key, value, name):
    """Entry `key` of a record: checked, or its default (a default table is itself filled with defaults)."""
    path = f"{name}.{key}" if name else key
    if key in value:
        return field.check(value[key], value.at(key), path)
    if field.default is REQUIRED:
        fail(value.where, name or "house", f"key '{key}' is missing")
    if isinstance(field, Record) and field.default is not None:
        return field.check(Table(field.default, value.where), value.where, path)
    return Items(field.default, value.where) if isinstance(field.default, (list, tuple)) else field.default


@dataclass(frozen=True)
class Variants:
    """Tables distinguished by their entry `key`, e.g. `layer: columns`."""

    key: str
    options: dict
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name, f"expected a table with '{self.key}', got {shown(value)}")
        if self.key not in value:
            fail(where, name, f"key '{self.key}' is missing (one of {', '.join(self.options)})")
        kind = value[self.key]
        if not isinstance(kind, str) or kind not in self.options:
            fail(value.at(self.key), f"{name}.{self.key}", f"{shown(kind)} is unknown, {nearest(kind, self.options)}")
        return self.options[kind].check(value, where, name)
