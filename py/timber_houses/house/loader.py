# SPDX-License-Identifier: GPL-2.0-or-later
"""House files -> tables. `extends` merges a file into the one that it extends: a file beside it or a shipped one."""
import warnings
from copy import deepcopy
from functools import lru_cache
from pathlib import Path

from ..base.input_file import is_file, read_bytes, shown
from . import btlx
from .errors import HouseError
from .limits import MAX_FILE_SIZE, MAX_FILES, MAX_NODES
from .parser import Items, Table, house_text, parse_table, plain

COMMON = ("base", "paper", "plated", "frame", "cad")
"""Shipped files that houses extend: materials and joints; frame of the paper's houses; joints with metal plates; joints
of frames of single members, and from CAD."""
BTLX = ".btlx"
SUFFIXES = (".yaml", ".yml", BTLX)  # of house files that another file names
ADDS = "+"  # ending of a key whose list is added to the inherited one
SHIPPED = Path(__file__).resolve().parents[1] / "data" / "houses"
KEPT = 64  # number of files whose tables are kept: a run asks for its house several times, a study for variants. [-]


def load_table(path):
    """File `path` with everything it extends merged in; raises HouseError with file and line."""
    *files, (_, table) = _chain(Path(path))
    for file, change in reversed(files):
        table = merge(table, change, quiet=file.parent == SHIPPED)
    table.pop("extends", None)
    return deepcopy(table)


def house_files(path):
    """The files that a house file consists of: itself, then the files that it extends. Raises HouseError."""
    return [file for file, _ in _chain(Path(path))]


def _chain(path):
    """[(file, table)] of a house file and the files that it extends."""
    links, nodes_left, where = [], MAX_NODES, f"{path.name}:1"
    while path is not None:
        files = [file for file, _ in links]
        if path.resolve() in [file.resolve() for file in files]:
            raise HouseError(f"{where}: extends: the file extends itself through"
                             f" {' -> '.join(file.name for file in files)}; remove one 'extends'")
        if len(links) == MAX_FILES:
            raise HouseError(f"{where}: extends: a chain of more than {MAX_FILES} files; merge some of them")
        table, nodes = _table(_content(path), path, nodes_left)
        links.append((path, table))
        nodes_left, where = nodes_left - nodes, table.at("extends")
        path = _extended(path, table)
    return links


@lru_cache(maxsize=KEPT)
def _table(content, path, nodes_left):
    """(table, number of YAML values) of the content of a file, the first time with its warnings; callers share it."""
    if path.suffix.lower() == BTLX:
        return btlx.btlx_table(content, path.name), 0
    return parse_table(_text(content, path), path.name, nodes_left)


def btlx_text(path):
    """YAML of a house file of what is read of a BTLx file. Raises HouseError."""
    if path.suffix.lower() != BTLX:
        raise HouseError(f"{shown(str(path))}: is no BTLx file; its name must end in {BTLX}")
    return house_text(plain(_table(_content(path), path, 0)[0]), in_lines=True)


def text_of(path):
    return _text(_content(path), path)


def _text(content, path):
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        raise HouseError(f"{path}: cannot be read: not UTF-8 text; save it as UTF-8") from None


def _content(path):
    try:
        return read_bytes(path, btlx.MAX_FILE_SIZE if path.suffix.lower() == BTLX else MAX_FILE_SIZE)
    except OSError as problem:
        raise HouseError(f"{path}: cannot be read: {problem.strerror}") from None


def _extended(path, table):
    """The file that a file extends, or None."""
    parent = table.get("extends")
    if parent is None:
        return None
    if not isinstance(parent, str):
        raise HouseError(f"{table.at('extends')}: extends: expected the name of a file, got {shown(parent)}")
    file = next((p for p in (path.parent / parent, *shipped_paths(parent)) if is_file(p)), None)
    if file is None:
        raise HouseError(f"{table.at('extends')}: extends: no file {shown(parent)} beside {path.name}, and no shipped"
                         f" house of that name ({', '.join([*COMMON, *shipped_houses()])})")
    require_house_file(file, f"{table.at('extends')}: extends")
    return file


def require_house_file(path, where):
    """Refuse a file that is no house file by its name: messages about its content would quote it."""
    if path.resolve().suffix not in SUFFIXES:
        raise HouseError(f"{where}: {shown(path.name)} is not a house file; its name must end in"
                         f" {' or '.join(SUFFIXES)}")


def shipped_houses():
    """Names of the shipped houses that `load_house` takes, e.g. ['A', 'B', 'B1', ..., 'storehouse']."""
    return sorted(path.stem.removeprefix("model") for path in SHIPPED.glob("*.yaml") if path.stem not in COMMON)


def shipped_paths(name):
    """Possible files of a shipped house, from its name ('C2', 'base') or its file's name."""
    return [SHIPPED / name] if name.endswith(".yaml") else [SHIPPED / f"model{name}.yaml", SHIPPED / f"{name}.yaml"]


def merge(base, change, path="", quiet=False):
    """`change` over `base`: tables entry by entry, null removes an entry, the list of `key+` is added to that of `key`,
    all else is replaced as a whole. path: of the tables; quiet: say nothing of replaced lists. Raises HouseError."""
    result = Table(base, change.where, base.entries)
    for key, value in change.items():
        if value is None:
            result.pop(key, None)
            continue
        where, name = change.at(key), f"{path}.{key}".lstrip(".")
        if key.endswith(ADDS):
            key = key.removesuffix(ADDS)
            value = added(result.get(key), value, where, name)
        elif isinstance(value, Table):
            below = base[key] if isinstance(base.get(key), Table) else Table()
            value = merge(below, value, name, quiet)
        elif not quiet:
            note_replaced(base.get(key), value, where, name)
        result[key], result.entries[key] = value, where
    return result


def added(items, more, where, name):
    """Items of both lists. name: of the key in messages, with its +"""
    for value in (items, more):
        if not isinstance(value, (list, type(None))):
            raise HouseError(f"{where}: {name}: adds to a list, got {shown(value)}")
    both = [entry for entry in (items, more) if entry is not None]
    return Items(sum(map(list, both), []), where, sum((entry.entries for entry in both), []))


_noted: set = set()  # replacements that were noted: a run reads its house file several times


def note_replaced(items, value, where, name):
    """Warn of a list of tables, as walls or braces, that another one replaces."""
    replaced = isinstance(items, list) and any(isinstance(item, Table) for item in items) and items != value
    if replaced and value and (where, name) not in _noted:
        _noted.add((where, name))
        warnings.warn(f"{where}: {name} replaces the {len(items)} inherited entries; {name}{ADDS} adds to them",
                      stacklevel=2)
