# SPDX-License-Identifier: GPL-2.0-or-later
"""Small schema checker: one-line errors with file and line, admissible range, nearest known key.

A schema is made of Number, Text, Flag, Choice, ListOf, MapOf, Record and Variants. Each has `default`
(REQUIRED = must be given) and `check(value, where, name)`, which returns the value, checked and with
defaults filled in, or raises HouseError.
"""

import difflib
import math
import re
from dataclasses import dataclass

from .errors import HouseError
from .reading import Items, Table

REQUIRED = object()
NAME = r"[\w-]+"
"""Names that the user chooses: dots and brackets lead to what is inside (changes of single keys, names of braces)."""
OTHER_UNITS = {"m": (("mm", 1e-3), ("cm", 1e-2)), "kg/m3": (("g/cm3", 1e3),), "Pa": (("MPa", 1e6), ("GPa", 1e9)),
               "N/m": (("kN/m", 1e3), ("N/mm", 1e3), ("kN/mm", 1e6)), "N": (("kN", 1e3),), "rise over run": (("sun (tenths)", 0.1),)}
"""Units that people write by mistake: unit of the schema -> (unit, factor)."""


def fail(where, name, text):
    raise HouseError(f"{where}: {name}: {text}")


def nearest(word, known):
    """"did you mean 'x'?" for a misspelt word, else the list of what is known."""
    close = difflib.get_close_matches(str(word), list(known), 1, 0.6)
    return f"did you mean '{close[0]}'?" if close else f"known: {', '.join(known)}"


@dataclass(frozen=True)
class Number:
    """A finite number (infinite only where `high` is and `infinite` is set) in [low, high], or (low, high] when `open_low`."""

    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    open_low: bool = False
    infinite: bool = False
    whole: bool = False
    default: object = REQUIRED

    def check(self, value, where, name):
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            fail(where, name, f"expected a number{self._range()}, got {value!r}")
        wrong_kind = math.isnan(value) or (math.isinf(value) and not self.infinite) or (self.whole and value != int(value))
        if wrong_kind or not self._admits(value):
            fail(where, name, f"must be a{' whole' if self.whole else ''} number{self._range()}, got {value!r}{self._other_units(value)}")
        return int(value) if self.whole else float(value)

    def _admits(self, value):
        return self.low <= value <= self.high and not (self.open_low and value == self.low)

    def _other_units(self, value):
        """Words for a value that would be admissible in another unit of the trade, e.g. a section of 105."""
        meant = [f"{value!r} {unit} = {value * factor:g}" for unit, factor in OTHER_UNITS.get(self.unit, ()) if self._admits(value * factor)]
        return f"; in {self.unit}: {' or '.join(meant)}" if meant else ""

    def _range(self):
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.low) and math.isinf(self.high):
            return f" [{self.unit}]" if self.unit else ""
        return f" in {'(' if self.open_low else '['}{self.low:g}, {self.high:g}]{unit}"


@dataclass(frozen=True)
class Text:
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, str) or not value.strip():
            fail(where, name, f"expected a text, got {value!r}")
        return value


@dataclass(frozen=True)
class Flag:
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, bool):
            fail(where, name, f"expected true or false, got {value!r}")
        return value


@dataclass(frozen=True)
class Choice:
    options: tuple
    default: object = REQUIRED

    def check(self, value, where, name):
        if value not in self.options:
            fail(where, name, f"'{value}' is unknown, {nearest(value, self.options)}")
        return value


@dataclass(frozen=True)
class ListOf:
    """A list of `item`; `scalar` allows one item without brackets; `length` fixes the number of items."""

    item: object
    length: int = 0
    scalar: bool = False
    default: object = REQUIRED

    def check(self, value, where, name):
        if self.scalar and not isinstance(value, list):
            value = Items([value], where, [where])
        if not isinstance(value, list):
            fail(where, name, f"expected a list, got {value!r}")
        if self.length and len(value) != self.length:
            fail(where, name, f"expected {self.length} items, got {len(value)}")
        checked = [self.item.check(v, value.at(i), f"{name}[{i + 1}]") for i, v in enumerate(value)]
        return Items(checked, value.where, value.entries)


@dataclass(frozen=True)
class MapOf:
    """A table whose keys the user chooses; every entry follows `item`."""

    item: object
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name, f"expected a table of names, got {value!r}")
        for key in value:
            if not re.fullmatch(NAME, key):
                fail(value.at(key), name, f"'{key}' is no name: take letters, digits, _ and -")
        checked = {k: self.item.check(v, value.at(k), f"{name}.{k}" if name else k) for k, v in value.items()}
        return Table(checked, value.where, value.entries)


@dataclass(frozen=True)
class Record:
    """A table with known keys. `one_of`: exactly one of these optional keys must be given."""

    fields: dict
    one_of: tuple = ()
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name or "house", f"expected a table with {', '.join(self.fields)}, got {value!r}")
        self._check_keys(value, name)
        checked = {key: _field(field, key, value, name) for key, field in self.fields.items()}
        return Table(checked, where, value.entries)

    def _check_keys(self, value, name):
        for key in value:
            if key not in self.fields:
                fail(value.at(key), name or "house", f"unknown key '{key}', {nearest(key, self.fields)}")
        given = [key for key in self.one_of if key in value]
        if self.one_of and len(given) != 1:
            got = " and ".join(given) if given else "none"
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
    """Tables told apart by the entry `key`, e.g. `layer: columns`."""

    key: str
    options: dict
    default: object = REQUIRED

    def check(self, value, where, name):
        if not isinstance(value, Table):
            fail(where, name, f"expected a table with '{self.key}', got {value!r}")
        if self.key not in value:
            fail(where, name, f"key '{self.key}' is missing (one of {', '.join(self.options)})")
        kind = value[self.key]
        if not isinstance(kind, str) or kind not in self.options:
            fail(value.at(self.key), f"{name}.{self.key}", f"'{kind}' is unknown, {nearest(kind, self.options)}")
        return self.options[kind].check(value, where, name)
