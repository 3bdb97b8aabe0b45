# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""docs/house_files.md documents exactly the keys of the schema, with their ranges and defaults."""
import re
from pathlib import Path

import pytest
from timber_houses.house.layout import HOUSE, node
from timber_houses.house.schema import (REQUIRED, Choice, Either, Flag, ListOf, MapOf, Number, Pair, Record, Text,
                                        Variants)

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "house_files.md"
HEADING = re.compile(r"^#+ .*`([^`]*)`$")
ROW = re.compile(r"^\| (`[\w.\[\]]+`(?:, `[\w.\[\]]+`)*)(?: \(([\w, ]+)\))? \| (.*?) \| (.*?) \| (.+) \|$")
KEY = re.compile(r"`(?:([\w.\[\]]+)\.)?(\w+)`")


def tables(field, path=""):
    """(path, Record) of every table of the schema; `[]` list, `*` a name chosen by the user, `{key: x}` one of several
    forms.
    """
    if isinstance(field, ListOf):
        yield from tables(field.item, path + "[]")
    elif isinstance(field, MapOf):
        yield from tables(field.item, path + ".*")
    elif isinstance(field, Either):
        yield from tables(field.table, path)
    elif isinstance(field, Variants):
        for option, form in field.options.items():
            yield from tables(form,
                              f"{path.removesuffix('}')}{', ' if path.endswith('}') else ' {'}{field.key}: {option}}}")
    elif isinstance(field, Record):
        yield path, field
        for key, entry in field.fields.items():
            yield from tables(entry, f"{path}.{key}".lstrip("."))


def value_words(field):
    """Admissible values of a key, as worded on the page."""
    if isinstance(field, Number):
        if field is node:
            return "node"
        off = ", false" if field.off else ""
        return f"{'whole, ' if field.whole else ''}{field._range().removeprefix(' in ')}{off}"
    if isinstance(field, Pair):
        return f"list of 2 ({value_words(field.first)}; {value_words(field.second)})"
    if isinstance(field, Either):
        return f"{value_words(field.listed)}, or table"
    if isinstance(field, ListOf):
        one = ", or one" if field.scalar else ""
        return f"list of {f'{field.length} ' if field.length else ''}({value_words(field.item)}){one}"
    words = {Text: "text", Flag: "true, false", Record: "table", MapOf: "table of names", Variants: "table"}
    return ", ".join(f"`{option}`" for option in field.options) if isinstance(field, Choice) else words[type(field)]


def default_words(field):
    """The default, as worded on the page."""
    if field.default is REQUIRED:
        return "required"
    if field.default is None or field.default == ():
        return "none"
    if field.default == {}:
        return "its defaults"
    return str(field.default).lower() if isinstance(field, Flag) else f"{field.default}" or "empty"


def stated_in(path):
    """Keys whose entries the path states: {'layer', 'type'} of 'stack[] {layer: roof, type: hip}'."""
    return set(re.findall(r"(\w+): ", path[path.rindex("{"):])) if path.endswith("}") else set()


def schema_rows():
    """{path of a table: {key: (value, default)}} without keys that the path states. A table that occurs in several
    places has the path of the first.
    """
    seen, rows = set(), {}
    for path, record in tables(HOUSE):
        if id(record) not in seen:
            seen.add(id(record))
            rows[path] = {key: (value_words(field), default_words(field)) for key, field in record.fields.items()
                          if key not in stated_in(path)}
    return rows


def forms(path):
    """Paths of a heading, in which ` | ` separates forms with common keys."""
    choice = re.search(r"\w+(?: \| \w+)+", path)
    return [path.replace(choice[0], form) for form in choice[0].split(" | ")] if choice else [path]


def has_row(path, names):
    """Whether a row applies to the form of a path. names: of the row's forms, 'hip, gable'; None: all forms."""
    return names is None or not set(names.split(", ")).isdisjoint(re.findall(r": (\w+)", path))


def page_rows():
    """{path: {key: (value, default)}} of the page; a form has the keys of all headings that name it, except those of
    other forms, as `key` (hip). A row may have several keys. A key `a.b` of a table is the key `b` of its table `a`.
    """
    rows, here = {}, []
    for line in PAGE.read_text().splitlines():
        heading, row = HEADING.match(line), ROW.match(line)
        if heading:
            here = forms(heading[1].replace("the file", ""))
        for path in (path for path in here if row and has_row(path, row[2])):
            for inner, key in KEY.findall(row[1]):
                table = rows.setdefault(f"{path}.{inner}".lstrip(".") if inner else path, {})
                assert key not in table, f"{key} stands twice"
                table[key] = (row[3], row[4])
    return rows


@pytest.mark.parametrize("path", schema_rows())
def test_table_is_documented_as_it_is(path):
    assert page_rows().get(path) == schema_rows()[path]


def test_forms_share_keys():
    assert forms("a {layer: roof, type: hip | flat}") == ["a {layer: roof, type: hip}", "a {layer: roof, type: flat}"]
    assert forms("a") == ["a"]
    assert has_row("a {layer: roof, type: hip}", "hip, gable") and has_row("a {law: snow}", None)
    assert not has_row("a {layer: roof, type: flat}", "hip, gable")
    assert stated_in("a {layer: roof, type: hip}") == {"layer", "type"} and stated_in("a {layer: floor}.b[]") == set()


def test_page_invents_nothing():
    assert set(page_rows()) == set(schema_rows())
