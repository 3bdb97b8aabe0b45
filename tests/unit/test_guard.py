# SPDX-License-Identifier: GPL-2.0-or-later
"""The import guard refuses each kind of wrong host and accepts the right one."""
import importlib
from pathlib import Path

import pytest
import yade.wrapper
import yade_timber
from yade_timber import host

MODULE = Path(yade_timber.__path__[0]) / "_yade_timber.so"
PLUGIN = yade_timber.plugin.compiled
FIELDS = PLUGIN.layout_fields()


@pytest.fixture
def record():
    return host.build_record(MODULE)


@pytest.fixture
def facts():
    return host.host_facts()


def test_right_host(record, facts):
    host.check_build(record, facts)
    assert host.check_layout(PLUGIN, yade.wrapper, record, facts) == len(FIELDS) > 35
    host.check_containers(PLUGIN, yade.wrapper, record, facts)


def test_record_in_the_file_is_the_loaded_modules_record(record):
    assert PLUGIN.build_record().startswith(host.RECORD_MARK.decode() + "{")
    assert all(f'"{key}":"{value}"' in PLUGIN.build_record() for key, value in record.items())


def test_wrong_version(record, facts):
    with pytest.raises(ImportError,
                       match=r"built for YADE 2099\.1.*this is YADE " + facts["yade"] + r".*scripts/setup"):
        host.check_build({**record, "yade": "2099.1"}, facts)


def test_wrong_python(record, facts):
    with pytest.raises(ImportError, match=r"built for Python 3\.99.*scripts/setup"):
        host.check_build({**record, "python": "3.99"}, facts)


def test_wrong_features(record, facts):
    with pytest.raises(ImportError, match=r"\+SPH -MPI.*scripts/setup"):
        host.check_build(record, {**facts, "features": facts["features"].replace("MPI", "SPH")})


@pytest.mark.parametrize("shift", [-8, 8, 16])
def test_shifted_layout(record, facts, shift):
    with pytest.raises(ImportError,
                       match=r"Body\.id .*" + facts["yade"] + ".*" + record["headers"] + ".*scripts/setup"):
        host.check_layout(PLUGIN, yade.wrapper, record, facts, shift=shift)


class ShiftedClass:
    """The module, but with the members of one class displaced."""

    def __init__(self, owner, shift):
        self.owner, self.shift = owner, shift

    def __getattr__(self, name):
        return getattr(PLUGIN, name)

    def read_field(self, index, instance, shift):
        return PLUGIN.read_field(index, instance, self.shift if FIELDS[index][0] == self.owner else shift)


@pytest.mark.parametrize("owner", sorted({field[0] for field in FIELDS}))
def test_each_class_is_watched(record, facts, owner):
    with pytest.raises(ImportError, match=owner + r"\."):
        host.check_layout(ShiftedClass(owner, -8), yade.wrapper, record, facts)


def test_nan_is_a_difference(record, facts):
    with pytest.raises(ImportError, match=r"State\.mass"):
        host.check_value("State.mass", 1.0, float("nan"), record, facts)


def test_file_without_record(tmp_path):
    (tmp_path / "_yade_timber.so").write_bytes(b"\x7fELF nothing of ours")
    with pytest.raises(ImportError, match="no build record"):
        host.load("other", tmp_path)


def test_missing_module(tmp_path):
    with pytest.raises(ImportError, match="missing.*scripts/setup"):
        host.load("other", tmp_path)


def test_module_of_another_yade_is_not_even_loaded(tmp_path, facts):
    """The file is refused by its record: this one could not be loaded, being cut off after it."""
    content = MODULE.read_bytes()
    end = content.find(b"}", content.find(host.RECORD_MARK))
    version = facts["yade"].encode()
    patched = content[: end + 1].replace(b'"yade":"' + version, b'"yade":"' + b"9" * len(version))
    (tmp_path / "_yade_timber.so").write_bytes(patched)
    with pytest.raises(ImportError, match="built for YADE 9+"):
        host.load("other", tmp_path)


@pytest.fixture
def attempts(tmp_path, monkeypatch):
    """Names of the modules that host.import_module tries; the first one fails with the complaint `attempts.complaint`,
    if there is one.
    """

    class Attempts(list):
        complaint = None

    made = Attempts()

    def import_module(name, package):
        made.append(name)
        if made.complaint and len(made) == 1:
            raise ImportError(made.complaint)
        return name

    monkeypatch.setattr(importlib, "import_module", import_module)
    (tmp_path / "x86_64_v3").mkdir()
    (tmp_path / "x86_64_v3" / "_yade_timber.so").touch()
    return made


def test_faster_module(tmp_path, attempts):
    assert host.import_module("other", tmp_path) == ".x86_64_v3._yade_timber"
    assert len(attempts) == 1


def test_faster_module_on_another_processor(tmp_path, attempts):
    attempts.complaint = "CPU ISA level is lower than required"
    assert host.import_module("other", tmp_path) == "._yade_timber"
    assert attempts == [".x86_64_v3._yade_timber", "._yade_timber"]


def test_faster_module_that_is_damaged(tmp_path, attempts):
    attempts.complaint = "invalid ELF header"
    with pytest.raises(ImportError, match="ELF"):
        host.import_module("other", tmp_path)
