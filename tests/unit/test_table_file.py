# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""HDF5 files of unknown origin: what is not of the layout is refused in one line, before anything is read."""
import h5py
import numpy as np
import pytest
from h5py import h5p, h5s, h5t, h5z
from small_frames import frames
from timber_houses.base.errors import RunError
from timber_houses.recording import frames as files

WORDS = b"words of another file " * 20


@pytest.fixture
def path(tmp_path, monkeypatch):
    """Frames of the small run, beside another file with words of its own."""
    (tmp_path / "other.txt").write_bytes(WORDS)
    files.save(tmp_path / "frames.h5", frames())
    monkeypatch.chdir(tmp_path)
    return tmp_path / "frames.h5"


def refused(path, monkeypatch):
    """Message of a file that is refused before its tables are read."""
    def read(*_):
        raise AssertionError("read")

    with monkeypatch.context() as patch:
        patch.setattr(h5py.Dataset, "__getitem__", read)
        patch.setattr(files, "_load", read)
        with pytest.raises(RunError, match="frames.h5: ") as raised:
            files.load(path)
    assert "\n" not in str(raised.value) and "words" not in str(raised.value)
    return str(raised.value)


def test_what_a_run_writes_is_of_the_layout(path):
    """Of runs with and without breaks, joints, motion; of an unfinished one."""
    small = frames()
    small.breaks = {name: [] for name in small.breaks}
    files.save(path, small)
    assert files.load(path).breaks["time"].shape == (0,)
    for made in (frames(), frames(shaken=False), frames(ended=False)):
        files.save(path, made)
        assert len(files.load(path).time) == len(made.time)


def instead(name, **options):
    """A change that puts a table made with those options in the place of another."""
    def change(file):
        del file[name]
        file.create_dataset(name, **options)

    return change


def link(name, target):
    def change(file):
        del file[name]
        file[name] = target(file)

    return change


def virtual(file):
    layout = h5py.VirtualLayout((3,), "i8")
    layout[:] = h5py.VirtualSource("other.h5", "a", (3,))
    del file["joints/b"]
    file.create_virtual_dataset("joints/b", layout)


def filtered(file):
    """A filter of the user's own, whose code a reader would look for."""
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_chunk((3,))
    properties.set_filter(300, h5z.FLAG_OPTIONAL, ())
    del file["joints/b"]
    h5py.h5d.create(file["joints"].id, b"b", h5t.NATIVE_INT64, h5s.create_simple((3,)), properties)


def compact(file):
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_layout(h5py.h5d.COMPACT)
    del file["joints/b"]
    h5py.h5d.create(file["joints"].id, b"b", h5t.NATIVE_INT64, h5s.create_simple((3,)), properties)


def of_a_named_type(file):
    file["kind"] = np.dtype("i8")
    kind = file["kind"]
    del file["joints/b"], file["kind"]
    file["joints"].create_dataset("b", (3,), dtype=kind)


ATTACKS = {
    "external data": instead("joints/b", shape=(3,), dtype="i8", external=[("other.txt", 0, 24)]),
    "external text": instead("history/rows", shape=(3, 16), dtype="f8", external=[("other.txt", 0, 384)]),
    "virtual": virtual,
    "soft link": link("joints/b", lambda file: h5py.SoftLink("/joints/a")),
    "link to a missing place": link("joints/b", lambda file: h5py.SoftLink("/nowhere")),
    "cyclic soft link": link("joints", lambda file: h5py.SoftLink("/joints")),
    "external link": link("joints/b", lambda file: h5py.ExternalLink("other.h5", "/a")),
    "external group": link("joints", lambda file: h5py.ExternalLink("other.h5", "/")),
    "table under two names": link("joints/b", lambda file: file["joints/a"]),
    "group under two names": link("joints", lambda file: file["elements"]),
    "cyclic group": link("joints", lambda file: file["/"]),
    "unknown table": lambda file: file.create_dataset("joints/c", data=[1]),
    "unknown group": lambda file: file.create_group("more"),
    "group in a group": lambda file: file.create_group("joints/more"),
    "group for a table": lambda file: (file.pop("joints/b"), file.create_group("joints/b")),
    "table for a group": lambda file: (file.pop("joints"), file.create_dataset("joints", data=[1])),
    "named type": lambda file: file.__setitem__("joints/kind2", np.dtype("i8")),
    "type for a table": lambda file: (file.pop("joints/b"), file.__setitem__("joints/b", np.dtype("i8"))),
    "of a named type": of_a_named_type,
    "unknown attribute": lambda file: file.attrs.update(more=1),
    "attribute of a group": lambda file: file["joints"].attrs.update(more=1),
    "attribute of a table": lambda file: file["joints/a"].attrs.update(more=1),
    "large attribute": lambda file: file["motion"].attrs.update(dt=np.zeros(8000)),
    "text for a number": lambda file: file["motion"].attrs.update(dt="fast"),
    "texts in an attribute": lambda file: file.attrs.update(title=["a", "b"]),
    "number for a text": lambda file: file.attrs.update(title=3),
    "bytes for a text": lambda file: file.attrs.update(title=np.bytes_("a")),
    "reference in an attribute": lambda file: file.attrs.update(title=file.ref),
    "no value": lambda file: file.attrs.update(title=h5py.Empty("f")),
    "compressed": instead("history/rows", shape=(10**6, 16), dtype="f8", compression="gzip"),
    "chunked": instead("joints/b", data=np.zeros(3, int), chunks=(1,)),
    "growing": instead("joints/b", data=np.zeros(3, int), maxshape=(None,)),
    "filter of the user's": filtered,
    "compact": compact,
    "nothing stored": instead("frames/time", shape=(61,), dtype="f8"),
    "nothing stored of a large table": instead("frames/position", shape=(10**6, 10**5, 3), dtype="f4"),
    "lists": instead("joints/b", shape=(3,), dtype=h5py.vlen_dtype("i8")),
    "references": instead("joints/b", shape=(3,), dtype=h5py.ref_dtype),
    "regions": instead("joints/b", shape=(3,), dtype=h5py.regionref_dtype),
    "compound": instead("joints/b", data=np.zeros(3, [("a", "i4"), ("b", "i4")])),
    "arrays": instead("joints/b", shape=(3,), dtype=np.dtype(("i8", (2,)))),
    "opaque": instead("joints/b", data=np.zeros(3, "V8")),
    "complex": instead("joints/strength", data=np.zeros(3, complex)),
    "long numbers": instead("joints/strength", data=np.zeros(3, np.longdouble)),
    "fractions": instead("joints/b", data=np.zeros(3)),
    "enumeration": instead("joints/b", data=np.zeros(3, int), dtype=h5py.enum_dtype({"a": 0})),
    "fixed strings": instead("joints/name", data=np.array([b"a", b"b", b"c"])),
    "numbers for names": instead("joints/name", data=np.zeros(3)),
    "scalar": instead("joints/b", data=3),
    "no data": instead("joints/b", data=h5py.Empty("i8")),
    "more dimensions": instead("joints/b", data=np.zeros((3, 1), int)),
    "other lengths": instead("joints/b", data=np.zeros(4, int)),
    "other width": instead("joints/anchor", data=np.zeros((3, 4))),
    "length without width": instead("history/rows", shape=(10**12, 0), dtype="f8"),
}


@pytest.mark.parametrize("name", ATTACKS)
def test_refused_before_it_is_read(path, monkeypatch, name):
    """Each in a file whose other tables are whole, beside files of those names."""
    with h5py.File(path.with_name("other.h5"), "w") as other:
        other["a"] = np.arange(3)
    with h5py.File(path, "r+") as file:
        ATTACKS[name](file)
    refused(path, monkeypatch)


def test_many_entries_with_the_address_of_one_text(path, monkeypatch):
    """A table of 3000 entries that all stand for one text of 10 kB."""
    small = frames()
    count = 3000
    small.breaks = {"time": np.zeros(count), "joint": np.zeros(count, int), "spring": np.zeros(count, int),
                    "cause": ["x" * 10_000, *["y"] * (count - 1)], "force": np.zeros(count)}
    files.save(path, small)
    with h5py.File(path) as file:
        begin = file["breaks/cause"].id.get_offset()
    content = bytearray(path.read_bytes())
    content[begin:begin + 16 * count] = content[begin:begin + 16] * count
    path.write_bytes(content)
    assert "more bytes than the file" in refused(path, monkeypatch)


def test_content_before_the_tables(path, monkeypatch):
    with h5py.File(path, "w", userblock_size=512) as file:
        file.attrs["format"] = files.FORMAT
    assert "before its tables" in refused(path, monkeypatch)


@pytest.mark.parametrize("table", ["elements/vertex_start", "elements/face_start", "elements/element_start",
                                   "contacts/start"])
@pytest.mark.parametrize("change", [lambda a: a[::-1], lambda a: np.where(np.arange(len(a)) % 2, a[-1], 0),
                                    lambda a: a + 1, lambda a: a - 1])
def test_parts_in_order(path, table, change):
    """Parts that overlap would take more memory than the file."""
    with h5py.File(path, "r+") as file:
        values = change(file[table][()].astype("i8"))
        del file[table]
        file[table] = values
    with pytest.raises(RunError, match="frames.h5: "):
        files.load(path)
