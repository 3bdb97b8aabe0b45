# SPDX-License-Identifier: GPL-2.0-or-later
"""HDF5 files of unknown origin: nothing is read before all that a file holds is of a stated layout.

A layout: {group: Group}, the root named ''. A file may lack parts of it. What else HDF5 can hold is refused: links,
data in other files, chunks and filters (nothing expands), types with a name, references, one object under two names.
The entries of each table lie in the file as they are, and all together take no more bytes than the file has."""
import math
import os
from contextlib import contextmanager
from dataclasses import dataclass, field

import h5py
import numpy as np
from h5py import h5a, h5d, h5l, h5o, h5s, h5t

from ..base.record_file import MAX_JSON, record

FAULTS = (OSError, LookupError, ValueError, TypeError, AttributeError, RuntimeError, MemoryError)
"""Errors of h5py, numpy or json for a file of another format."""
KINDS = {"number": "fiu", "whole": "iu", "flag": "b"}
"""Kinds of entries, but for 'text' (strings of variable length), as kinds of numpy."""
TEXT_ENTRY = 16  # of a string, in its table: length, address, number. [bytes]


@dataclass(frozen=True)
class Group:
    """tables: {name: (kind, length, ...)}, each length being a number, or a text that stands for one in the whole file;
    attributes: {name: kind}, single values"""

    tables: dict = field(default_factory=dict)
    attributes: dict = field(default_factory=dict)


@contextmanager
def opened(path, layout, missing=""):
    """h5py.File of a path. missing: remedy for a missing file. Raises RunError for what is no file, one of FAULTS for
    what is not of the layout."""
    with record(path, missing) as file, h5py.File(f"/proc/self/fd/{file.fileno()}", "r") as tables:
        _Inspection(file.fileno(), layout).file(tables)
        yield tables


class _Inspection:
    """An open file beside its layout. Raises ValueError, or what h5py raises."""

    def __init__(self, descriptor, layout):
        self.descriptor, self.layout, self.limit = descriptor, layout, os.fstat(descriptor).st_size
        self.addresses, self.lengths, self.size = set(), {}, 0

    def file(self, file):
        if file.userblock_size:
            raise ValueError("content before its tables")
        root = file["/"].id
        self.addresses.add(h5o.get_info(root).addr)
        self.group(root, "", self.layout.keys() - {""})

    def group(self, group, place, groups=()):
        """Inspect a group with its tables. place: its name; groups: names of those that it may hold."""
        known = self.layout[place]
        self.attributes(group, place, known.attributes)
        links = [name for name in (*known.tables, *groups) if group.links.exists(name.encode())]
        _require_no_others(group.get_num_objs() - len(links), place)
        for name in links:
            inner = f"{place}/{name}".lstrip("/")
            if name in groups:
                self.group(self.object(group, name, inner, h5o.TYPE_GROUP), inner)
            else:
                self.table(self.object(group, name, inner, h5o.TYPE_DATASET), inner, *known.tables[name])

    def object(self, group, name, place, kind):
        """The object that a group holds itself, under this name alone. kind: of h5o"""
        name = name.encode()
        if group.links.get_info(name).type != h5l.TYPE_HARD:
            raise ValueError(f"{place}: a link")
        info = h5o.get_info(group, name)
        if info.type != kind:
            raise ValueError(f"{place}: {'no group' if kind == h5o.TYPE_GROUP else 'no table'}")
        if info.addr in self.addresses:
            raise ValueError(f"{place}: one object under two names")
        self.addresses.add(info.addr)
        return h5o.open(group, name)

    def attributes(self, holder, place, known):
        present = [name for name in known if h5a.exists(holder, name.encode())]
        _require_no_others(h5a.get_num_attrs(holder) - len(present), place)
        for name in present:
            attribute = h5a.open(holder, name.encode())
            where = f"{place}, attribute {name}".lstrip(", ")
            if attribute.get_space().get_simple_extent_type() != h5s.SCALAR:
                raise ValueError(f"{where}: no single value")
            _require_kind(attribute.get_type(), known[name], where)
            if known[name] == "text" and len(h5py.AttributeManager(h5py.Group(holder))[name]) > MAX_JSON:
                raise ValueError(f"{where}: more than {MAX_JSON / 1e6:.0f} MB")

    def table(self, table, place, kind, *lengths):
        self.attributes(table, place, {})
        properties = table.get_create_plist()
        if properties.get_external_count():
            raise ValueError(f"{place}: its entries are in other files")
        if properties.get_layout() != h5d.CONTIGUOUS or properties.get_nfilters():
            raise ValueError(f"{place}: chunked, compressed or virtual")
        if table.get_space().get_simple_extent_type() != h5s.SIMPLE:
            raise ValueError(f"{place}: no table")
        shape, form = table.shape, table.get_type()
        _require_kind(form, kind, place, empty=0 in shape)
        self.dimensions(shape, lengths, place)
        text = kind == "text" and 0 not in shape
        size = math.prod(shape) * (TEXT_ENTRY if text else form.get_size())
        if size != table.get_storage_size() or size and table.get_offset() + size > self.limit:
            raise ValueError(f"{place}: its entries are not in the file")
        self.size += size + (self.text(table, size) if text else 0)
        if self.size > self.limit:
            raise ValueError(f"{place}: the tables declare more bytes than the file has")

    def dimensions(self, shape, lengths, place):
        """Compare a shape with the lengths of the layout; a text stands for the length at its first place."""
        if len(shape) != len(lengths):
            raise ValueError(f"{place}: {len(shape)} dimensions instead of {len(lengths)}")
        for length, known in zip(shape, lengths):
            wanted = known if isinstance(known, int) else self.lengths.setdefault(known, length)
            if length != wanted or length > self.limit:
                raise ValueError(f"{place}: {length} entries instead of {wanted}")

    def text(self, table, size):
        """Bytes of a table's strings, by their lengths: many entries may have one address."""
        entries = os.pread(self.descriptor, size, table.get_offset())
        return int(np.frombuffer(entries, "<u4")[::TEXT_ENTRY // 4].sum(dtype=np.int64))


def _require_no_others(count, place):
    if count:
        raise ValueError(f"{place or 'the file'}: {count} unknown entries or attributes")


def _require_kind(form, kind, place, empty=False):
    """form: TypeID. Without entries, numbers stand for any kind."""
    plain = h5t.TypeFloatID, h5t.TypeIntegerID, h5t.TypeEnumID if kind == "flag" else h5t.TypeStringID
    if form.committed() or not isinstance(form, plain):
        raise ValueError(f"{place}: entries of a foreign type")
    text = isinstance(form, h5t.TypeStringID)
    if text and not form.is_variable_str() or not empty and text != (kind == "text"):
        raise ValueError(f"{place}: no {kind}s")
    if not text and (form.get_size() > 8 or not empty and form.dtype.kind not in KINDS[kind]):
        raise ValueError(f"{place}: no {kind}s")
