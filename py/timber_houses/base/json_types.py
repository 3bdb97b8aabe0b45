# SPDX-License-Identifier: GPL-2.0-or-later
"""Dataclasses <-> tables of JSON. Types of fields: str, bool, int, float, dict, list[X], dict[str, X], dataclasses, and
X | None.

A class with another form has a class method `decoded(value, path)`. Entries that no field has are left out."""
from dataclasses import MISSING, field, fields, is_dataclass
from functools import cache
from types import UnionType
from typing import Any, get_args, get_origin, get_type_hints


def optional() -> Any:
    """Field of an entry that is written only if it is not None."""
    return field(default=None, metadata={"omitted": True})


def further() -> Any:
    """Field of further entries, a dict that is written beside the other fields."""
    return field(default_factory=dict, metadata={"others": True})


def encode(value):
    """Tables, lists and plain values of dataclasses in any depth."""
    if isinstance(value, dict):
        return {key: encode(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [encode(entry) for entry in value]
    if not is_dataclass(value):
        return value
    entries = {}
    for part in fields(value):
        entry = encode(getattr(value, part.name))
        if "others" in part.metadata:
            entries |= entry
        elif entry is not None or "omitted" not in part.metadata:
            entries[part.name] = entry
    return entries


def leaves(table, path=""):
    """(path, value) of the entries of nested tables that are no tables: ('energy.dissipated.friction', 98605.2)."""
    for key, value in table.items():
        place = f"{path}.{key}".lstrip(".")
        yield from leaves(value, place) if isinstance(value, dict) else [(place, value)]


def decode(kind, value, path="content"):
    """Value of a type from JSON. path: its place in messages. Raises ValueError for a missing or wrong entry."""
    if hasattr(kind, "decoded"):
        return kind.decoded(value, path)
    if is_dataclass(kind):
        return kind(**_arguments(kind, require(value, dict, path), path))
    origin, parts = get_origin(kind), get_args(kind)
    if origin is UnionType:
        return None if value is None else decode(parts[0], value, path)
    if origin is list:
        return [decode(parts[0], entry, f"{path}.{k}") for k, entry in enumerate(require(value, list, path))]
    if origin is dict:
        return {key: decode(parts[1], entry, f"{path}.{key}") for key, entry in require(value, dict, path).items()}
    return require(value, kind, path)


def require(value, kind, path):
    """The value, if it is of a type of JSON. Raises ValueError."""
    fits = isinstance(value, (int, float) if kind is float else kind) and (kind is bool or not isinstance(value, bool))
    if not fits:
        raise ValueError(f"{path}: {value!r:.40} is of a wrong type")
    return value


@cache
def types(kind):
    """[(field, type)] of the fields that the constructor of a dataclass takes."""
    hints = get_type_hints(kind)
    return [(part, hints[part.name]) for part in fields(kind) if part.init]


def _arguments(kind, entries, path):
    names, arguments = {part.name for part in fields(kind)}, {}
    for part, hint in types(kind):
        if "others" in part.metadata:
            arguments[part.name] = decode(hint, {key: entry for key, entry in entries.items() if key not in names},
                                          path)
        elif part.name in entries:
            arguments[part.name] = decode(hint, entries[part.name], f"{path}.{part.name}")
        elif part.default is MISSING:
            raise ValueError(f"{path}.{part.name}: missing")
    return arguments
