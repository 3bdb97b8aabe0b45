# SPDX-License-Identifier: GPL-2.0-or-later
"""YAML text -> tables and lists that remember file and line; `extends` merges a file into the one it extends: a file beside it or a shipped one."""

import re
from functools import reduce
from pathlib import Path

import yaml

from .errors import HouseError


SHIPPED = Path(__file__).resolve().parents[1] / "data" / "houses"


class Table(dict):
    """A mapping with `where` ("file:line") for itself and `at(key)` for each of its entries."""

    def __init__(self, items=(), where="", entries=None):
        super().__init__(items)
        self.where = where
        self.entries = dict(entries or {})

    def at(self, key):
        """"file:line" of entry `key`, or of the table when the entry was filled in by default."""
        return self.entries.get(key, self.where)


class Items(list):
    """A list with `where` ("file:line") for itself and `at(index)` for each of its items."""

    def __init__(self, items=(), where="", entries=()):
        super().__init__(items)
        self.where = where
        self.entries = list(entries)

    def at(self, index):
        return self.entries[index] if index < len(self.entries) else self.where


class _Loader(yaml.SafeLoader):
    """SafeLoader that also reads 1e7 as a number (YAML 1.2), which PyYAML takes for text."""


_Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"), list("-+.0123456789"))


def read_table(path):
    """File `path` with everything it extends merged in; raises HouseError with file and line."""
    tables = [table for _, table in _chain(Path(path))]
    return reduce(merge, reversed(tables))


def house_files(path):
    """The files that a house file consists of: itself, then what it extends. Raises HouseError."""
    return [file for file, _ in _chain(Path(path))]


def _chain(path):
    """[(file, table)] of a house file and what it extends."""
    links = []
    while path is not None:
        seen = [file for file, _ in links]
        if path.resolve() in [file.resolve() for file in seen]:
            raise HouseError(f"{path.name}:1: extends itself through {' -> '.join(file.name for file in seen)}; remove one 'extends'")
        links.append((path, _parse(path)))
        path = _extended(*links[-1])
    return links


def _extended(path, table):
    """The file that a file extends, or None; takes the entry out."""
    parent = table.pop("extends", None)
    if parent is None:
        return None
    if not isinstance(parent, str):
        raise HouseError(f"{table.at('extends')}: extends: expected the name of a file, got {parent!r}")
    found = next((p for p in (path.parent / parent, *shipped_paths(parent)) if p.is_file()), None)
    if found is None:
        raise HouseError(f"{table.at('extends')}: extends: no file '{parent}' beside {path.name}, and no shipped house of that name "
                         f"(base, {', '.join(shipped_houses())})")
    return found


def shipped_houses():
    """Names of the shipped houses that `load_house` takes, e.g. ['A', 'B', 'B1', ..., 'storehouse']."""
    return sorted(path.stem.removeprefix("model") for path in SHIPPED.glob("*.yaml") if path.stem != "base")


def shipped_paths(name):
    """Files that the name of a shipped house ('C2', 'base') or of its file may stand for."""
    return [SHIPPED / name] if name.endswith(".yaml") else [SHIPPED / f"model{name}.yaml", SHIPPED / f"{name}.yaml"]


def merge(base, change):
    """`change` laid over `base`: tables entry by entry, null takes an entry out, everything else is replaced as a whole."""
    result = Table(base, change.where, base.entries)
    for key, value in change.items():
        if value is None and key in base:
            del result[key]
            continue
        both = isinstance(value, Table) and isinstance(base.get(key), Table)
        result[key] = merge(base[key], value) if both else value
        result.entries[key] = change.at(key)
    return result


def _parse(path):
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as problem:
        reason = getattr(problem, "strerror", None) or "not UTF-8 text"
        raise HouseError(f"{path}: cannot be read: {reason}") from None
    loader = _Loader(text)
    try:
        value = _convert(loader, loader.get_single_node(), path.name)
    except RecursionError:
        raise HouseError(f"{path.name}:1: an entry contains itself, or entries are nested too deeply") from None
    except yaml.YAMLError as problem:
        raise HouseError(_syntax_message(problem, path.name)) from None
    if not isinstance(value, Table):
        raise HouseError(f"{path.name}:1: a house file is a table of keys, e.g. 'name: my house'")
    return value


def _syntax_message(problem, name):
    mark = getattr(problem, "problem_mark", None)
    line = mark.line + 1 if mark else 1
    reason = getattr(problem, "problem", None) or str(problem).splitlines()[0]
    return f"{name}:{line}: not valid YAML: {reason}"


def _convert(loader, node, name):
    """Composed YAML node -> Table, Items or scalar."""
    if isinstance(node, yaml.MappingNode):
        return _convert_mapping(loader, node, name)
    if isinstance(node, yaml.SequenceNode):
        values = [_convert(loader, child, name) for child in node.value]
        return Items(values, _where(node, name), [_where(child, name) for child in node.value])
    return None if node is None else loader.construct_object(node)


def _convert_mapping(loader, node, name):
    table = Table(where=_where(node, name))
    for key_node, value_node in node.value:
        key = _convert(loader, key_node, name)
        if not isinstance(key, str):
            raise HouseError(f"{_where(key_node, name)}: a key must be a word, got {key!r}")
        if key in table:
            raise HouseError(f"{_where(key_node, name)}: key '{key}' is given twice (first in line {table.at(key).rsplit(':', 1)[1]})")
        table[key] = _convert(loader, value_node, name)
        table.entries[key] = _where(key_node, name)
    return table


def _where(node, name):
    return f"{name}:{node.start_mark.line + 1}"


def parse_value(text, where):
    """One value (a number, a word, a list in brackets) whose every part is said to be at `where`; raises HouseError."""
    loader = _Loader(text)
    try:
        value = _convert(loader, loader.get_single_node(), where)
    except yaml.YAMLError:
        raise HouseError(f"{where}: '{text}' is no value; give a number, a word or [a, list]") from None
    return _moved(value, where)


def _moved(value, where):
    """Lists and tables with `where` in place of file and line."""
    if isinstance(value, Table):
        return Table({key: _moved(entry, where) for key, entry in value.items()}, where)
    return Items([_moved(entry, where) for entry in value], where) if isinstance(value, Items) else value
