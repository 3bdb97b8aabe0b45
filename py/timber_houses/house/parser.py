# SPDX-License-Identifier: GPL-2.0-or-later
"""YAML text -> tables and lists that know their file and line; only numbers, texts and flags, limited in size."""
import re

import yaml

from ..base.input_file import shown
from .errors import HouseError
from .limits import MAX_DEPTH, MAX_NODES, MAX_NUMBER_LENGTH

TAG = "tag:yaml.org,2002:"
_PLAIN_TYPES = {TAG + name for name in ("null", "bool", "int", "float", "str")}
_EXPONENT = re.compile(r"^[-+]?(\d+(\.\d*)?|\.\d+)[eE][-+]?\d+$")


class Table(dict):
    """A mapping with `where` ("file:line") for itself and `at(key)` for each of its entries; once checked with `path`,
    that of its key from the house on: 'structures.main.braces'."""

    def __init__(self, items=(), where="", entries=None, path=""):
        super().__init__(items)
        self.where, self.path = where, path
        self.entries = dict(entries or {})

    def at(self, key):
        """"file:line" of entry `key`, or of the table when the entry is a default."""
        return self.entries.get(key, self.where)

    def refuse(self, key, problem):
        """Raise HouseError for the value of an entry, or None: for the table."""
        raise HouseError(f"{self.at(key)}: {self.path if key is None else f'{self.path}.{key}'.lstrip('.')}: {problem}")


class Items(list):
    """A list with `where` ("file:line") for itself and `at(index)` for each of its items."""

    def __init__(self, items=(), where="", entries=()):
        super().__init__(items)
        self.where = where
        self.entries = list(entries)

    def at(self, index):
        return self.entries[index] if index < len(self.entries) else self.where


def parse_table(text, file, max_nodes=MAX_NODES):
    """(Table, number of YAML values) of a file's text; raises HouseError with file and line."""
    try:
        parser = _Parser(text, file, None, max_nodes)
        value = parser.value()
    except yaml.YAMLError as problem:
        mark = getattr(problem, "problem_mark", None)
        line = mark.line + 1 if mark else text.count("\n", 0, getattr(problem, "position", 0)) + 1
        reason = getattr(problem, "problem", None) or str(problem).splitlines()[0]
        raise HouseError(f"{file}:{line}: not valid YAML: {reason}") from None
    if not isinstance(value, Table):
        raise HouseError(f"{file}:1: a house file is a table of keys, e.g. 'name: my house'")
    return value, parser.values


def parse_value(text, where):
    """One value (a number, a word, a list in brackets), all of it from the source `where`; raises HouseError."""
    try:
        return _Parser(text, "", where, MAX_NODES).value()
    except yaml.YAMLError:
        raise HouseError(f"{where}: {shown(text)} is not a value; give a number, a word or [a, list]") from None


class _Parser(yaml.SafeLoader):
    """Composes YAML nodes and converts them; `source`, if given, replaces file and line."""

    def __init__(self, text, file, source, max_nodes):
        self.file, self.source, self.max_nodes, self.text = file, source, max_nodes, text
        self.nodes = self.values = self.depth = 0
        super().__init__(text)

    def value(self):
        """The document as Table, Items or scalar."""
        try:
            node = self.get_single_node()
        except (ValueError, OverflowError) as problem:  # escapes beyond Unicode, versions of thousands of digits
            if isinstance(problem, HouseError):
                raise
            raise yaml.scanner.ScannerError(None, None, "a number or an escape out of range", self.get_mark()) from None
        return self._convert(node, 0)

    def compose_node(self, parent, index):
        """Limits size and depth before the rest of the text is scanned."""
        self.nodes += 1
        self.depth += 1
        self._check_size(self.nodes, self.depth, self.get_mark())
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node

    def _check_size(self, count, depth, mark):
        if count > self.max_nodes:
            raise HouseError(f"{self._where(mark)}: more than {MAX_NODES} values, aliases and extended files included;"
                             " make the house smaller")
        if depth > MAX_DEPTH:
            raise HouseError(f"{self._where(mark)}: nested more than {MAX_DEPTH} levels deep, or an entry contains"
                             " itself; remove levels")

    def _convert(self, node, depth):
        if node is None:
            return None
        self.values += 1
        self._check_size(self.values, depth, node.start_mark)
        if isinstance(node, yaml.MappingNode) and node.tag == TAG + "map":
            return self._table(node, depth)
        if isinstance(node, yaml.SequenceNode) and node.tag == TAG + "seq":
            sources = [self._where(child.start_mark) for child in node.value]
            self._refuse_mixed_commas(node)
            return Items([self._convert(child, depth + 1) for child in node.value], self._where(node.start_mark),
                         sources)
        if isinstance(node, yaml.ScalarNode) and node.tag in _PLAIN_TYPES:
            return self._scalar(node)
        raise HouseError(f"{self._where(node.start_mark)}: unsupported type {shown(node.tag.replace(TAG, '!!'))}; "
                         "write a number, a text, true or false without a tag")

    def _refuse_mixed_commas(self, node):
        """`[0, 2,73]` reads as 0, 2 and 73; in `[0,1]` no comma has a blank."""
        items = node.value if node.flow_style else []
        pairs = [(a, b) for a, b in zip(items, items[1:]) if is_number(a) and is_number(b)]
        gaps = [self.text[a.end_mark.index : b.start_mark.index] for a, b in pairs]
        if "," in gaps and any(gap != "," for gap in gaps):
            a, b = pairs[gaps.index(",")]
            raise HouseError(f"{self._where(a.start_mark)}: '{shown(a.value)[1:-1]},{shown(b.value)[1:-1]}' in a list"
                             " whose other commas have a blank; write a decimal point, or a blank after each comma")

    def _table(self, node, depth):
        table = Table(where=self._where(node.start_mark))
        previous = None
        for key_node, value_node in node.value:
            where = self._where(key_node.start_mark)
            _refuse_decimal_comma(where, key_node, previous, value_node)
            key = self._convert(key_node, depth + 1)
            if not isinstance(key, str):
                raise HouseError(f"{where}: a key must be a word, got {shown(key)}")
            if key in table:
                raise HouseError(f"{where}: key {shown(key)} is given twice (first in line"
                                 f" {table.at(key).rsplit(':', 1)[-1]}); remove one")
            previous = table[key] = self._convert(value_node, depth + 1)
            table.entries[key] = where
        return table

    def _scalar(self, node):
        kind, text = node.tag.removeprefix(TAG), node.value
        if kind in ("null", "str"):
            return None if kind == "null" else text
        where = self._where(node.start_mark)
        if kind == "bool":
            if text.lower() not in self.bool_values:
                raise HouseError(f"{where}: {shown(text)} is not true or false")
            return self.bool_values[text.lower()]
        if len(text) > MAX_NUMBER_LENGTH:
            raise HouseError(f"{where}: a number of {len(text)} characters; at most {MAX_NUMBER_LENGTH}")
        return self._number(kind, text, node, where)

    def _number(self, kind, text, node, where):
        """Decimal numbers only: few users know 010 (octal), 0x10 and 1:30 (base 60) of YAML 1.1."""
        digits = text.lstrip("+-")
        other_base = ":" in text or kind == "int" and len(digits) > 1 and digits[0] == "0"
        try:
            if not other_base:
                return self.construct_yaml_int(node) if kind == "int" else self.construct_yaml_float(node)
        except (ValueError, IndexError):
            pass
        raise HouseError(f"{where}: {shown(text)} is not a decimal number; write it like 12, 0.105 or 1e7")

    def _where(self, mark):
        return self.source or f"{self.file}:{mark.line + 1}"


def is_number(node):
    """Whether a node is a number as written: 2, -0.5"""
    return isinstance(node, yaml.ScalarNode) and node.tag in (TAG + "int", TAG + "float")


def _refuse_decimal_comma(where, key_node, previous, value_node):
    """`{height: 2,73}` reads as height 2 and a key 73 without a value."""
    is_number = (isinstance(key_node, yaml.ScalarNode) and re.fullmatch(r"\d{1,20}", key_node.value)
                 and isinstance(previous, int))
    if is_number and isinstance(value_node, yaml.ScalarNode) and not value_node.value:
        raise HouseError(f"{where}: '{previous},{key_node.value}' has a decimal comma; write a decimal point:"
                         f" {previous}.{key_node.value}")


_Parser.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag in _PLAIN_TYPES]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}  # dates are texts
_Parser.add_implicit_resolver(TAG + "float", _EXPONENT,
                              list("-+.0123456789"))  # 1e7 is a number in YAML 1.2, a text for PyYAML


class _Writer(yaml.SafeDumper):
    """Quotes texts that the parser would read as numbers."""


_Writer.add_implicit_resolver(TAG + "float", _EXPONENT, list("-+.0123456789"))


def plain(value):
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    return [plain(entry) for entry in value] if isinstance(value, list) else value


def house_text(data, in_lines=False):
    """YAML of the content of a house file. in_lines: a line for each innermost table or list"""
    return yaml.dump(data, Dumper=_Writer, sort_keys=False, width=110, default_flow_style=None if in_lines else False)
