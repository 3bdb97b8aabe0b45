# SPDX-License-Identifier: GPL-2.0-or-later
"""Variants of a house for studies: changed keys, added braces, a factor on the strength of joints."""
import re

from ..base.input_file import shown
from .bays import BayName
from .description import checked, house_path
from .errors import HouseError
from .limits import MAX_DEPTH
from .loader import ADDS, added, load_table, note_replaced
from .parser import Items, Table, parse_value, plain
from .schema import NAME

_STEP = re.compile(rf"({NAME})((?:\[\d{{1,6}}\])*)")
MIN_FACTOR, MAX_FACTOR = 1e-3, 1e3  # range of the factor on the joints' strength


def changed_house(name_or_path, settings=(), braces=(), strength=1.0, where="{}".format):
    """The merged and changed tables of a house file, checked against the schema, as dicts and lists.

    Parameters
    ----------
    name_or_path : str or Path
        Shipped house or house file.
    settings : sequence of str
        Keys of the house file, list items from 1: 'joint_types.corner_fitting.strength=7000',
        'friction[1].coefficient=0.3'. A list is added to the present one by 'structures.main.walls+=[...]'.
    braces : sequence of str
        Names of braces and walls to add: 'main.brace1.EW.y0.3-4' (storey 1, along x at y node 0, foot at 3),
        'main.wall1.EW.y0.3-4.plywood'.
    strength : float
        Factor on the strength of all joint types. [-]
    where : callable
        Function of 'set', 'braces' or 'strength' that gives the source of this change for messages.

    Raises
    ------
    HouseError
    """
    path = house_path(name_or_path)
    data = load_table(path)
    checked(data, path)
    for text in settings:
        _set(data, text, where("set"))
    checked(data, path)
    for name in braces:
        _fill(data, name, where("braces"))
    checked(data, path)
    if not MIN_FACTOR <= strength <= MAX_FACTOR:
        raise HouseError(f"{where('strength')}: {strength:g}: the factor on the joints' strength must be in"
                         f" [{MIN_FACTOR:g}, {MAX_FACTOR:g}]")
    for table in (*data["joint_types"].values(), *data["joints"].values()):
        if table.get("strength") is not None:
            table["strength"] *= strength
    return plain(data)


def _set(data, text, where):
    key, sign, value = text.partition("=")
    if not sign:
        raise HouseError(f"{where}: {shown(text)}: write key=value")
    *steps, last = _steps(key.removesuffix(ADDS), where)
    node = data
    for step in steps:  # a missing entry of a table becomes an empty table, checked later
        node = node.setdefault(step, Table(where=where)) if _has_entry(node, step, key, where) else node[step]
    parsed = parse_value(value, where)
    is_entry = _has_entry(node, last, key, where)
    present = node.get(last) if is_entry else node[last]
    if key.endswith(ADDS):
        parsed = added(present, parsed, where, key)
    else:
        note_replaced(present, parsed, where, key)
    node.entries[last if is_entry else slice(last, last + 1)] = where if is_entry else [where]
    node[last] = parsed


def _steps(key, where):
    """'a.b[2].c' -> ['a', 'b', 1, 'c']."""
    steps, parts = [], key.split(".")
    if len(parts) > MAX_DEPTH:
        raise HouseError(f"{where}: {shown(key)}: more than {MAX_DEPTH} levels")
    for part in parts:
        match = _STEP.fullmatch(part)
        if match is None:
            raise HouseError(f"{where}: {shown(key)} is not a key; write it like materials.timber.density or"
                             " friction[1].coefficient")
        steps += [match.group(1), *(int(number) - 1 for number in re.findall(r"\d+", match.group(2)))]
    return steps


def _has_entry(node, step, key, where):
    """True for an entry of a table, False for an item of a list; HouseError where `step` is neither."""
    if isinstance(step, str) and isinstance(node, Table):
        return True
    if not isinstance(step, int) or not isinstance(node, Items):
        raise HouseError(f"{where}: {key}: there is no table or list at"
                         f" '{step if isinstance(step, str) else f'[{step + 1}]'}'")
    if not 0 <= step < len(node):
        raise HouseError(f"{where}: {key}: there is no item [{step + 1}]; the list has {len(node)}")
    return False


def _fill(data, text, where):
    """Add the brace or wall of that name."""
    bay = BayName.read(text)
    if bay is None:
        raise HouseError(f"{where}: {shown(text)}: write a brace like main.brace1.EW.y0.3-4 or a wall like"
                         " main.wall2.NS.x8.6-7.plywood")
    if bay.structure not in data["structures"]:
        raise HouseError(f"{where}: {text}: unknown structure '{bay.structure}'; known:"
                         f" {', '.join(data['structures'])}")
    table, place = data["structures"][bay.structure], {"along": bay.along, "at": bay.at, "storeys": bay.storey}
    if bay.type:
        lines = table.setdefault("walls", Items((), where))
        lines.append(Table({**place, "from": bay.start, "to": bay.end, "type": bay.type}, where))
    else:
        lines = table.setdefault("braces", Table(where=where)).setdefault("lines", Items((), where))
        lines.append(Table({**place, "runs": Items([Items([bay.start, bay.end], where)], where)}, where))
    lines.entries.append(where)
