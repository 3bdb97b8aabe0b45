# SPDX-License-Identifier: GPL-2.0-or-later
"""Identity of a run: everything that decides its results and nothing else. Damaged checkpoints: test_cli_errors; whole
runs: test_run.
"""
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yade.system as system
import yade.wrapper as yw
import yade_timber
from file_limit import file_limit
from timber_houses.base.errors import RunError
from timber_houses.base.options import options
from timber_houses.run import checkpoint
from timber_houses.run import identity as identities
from timber_houses.run.options import RunOptions
from timber_houses.motion import GroundMotion

O = yw.Omega()
SHOVE = GroundMotion(0.01, np.ones((9, 3)), "shove")
RUN = RunOptions(house="A", ground_motion=SHOVE, snow=0.5, scale=0.8, duration=3.0)
OTHER = {bool: True, int: 3, float: 0.25, str: "mean"}
"""A value of each kind of option that differs from its default."""


def identity(given=RUN):
    return identities.identity(identities.made_from(given))


def differences(given):
    """Properties in which the identities of two runs differ."""
    one, other = identity(), identity(given)
    return sorted(key for key in one.keys() | other.keys() if one.get(key) != other.get(key))


@pytest.mark.parametrize(
    "name, option",
    [(name, option) for name, option in options(RunOptions).items() if name not in ("house", "record", "then", "quake")]
)
def test_another_option(name, option):
    """Each option that decides results is part of the identity, no other; the duration may be lengthened."""
    decides = option.metadata["decides"] and name != "duration"
    assert differences(replace(RUN, **{name: OTHER.get(option.metadata["kind"],
                                                       Path("x"))})) == ([name] if decides else [])


@pytest.mark.parametrize("keys, change", [
    (["name"], {"name": "other"}),
    (["content of files", "house"], {"house": "B"}),
    (["ground_motion", "quake"], {"ground_motion": None}),
    (["ground_motion"], {"ground_motion": replace(SHOVE, acceleration=2 * SHOVE.acceleration)}),
    (["ground_motion"], {"ground_motion": replace(SHOVE, dt=0.02)}),
])
def test_another_run(keys, change):
    assert differences(replace(RUN, **change)) == keys


def test_content_of_files_counts_not_their_place(tmp_path):
    """House, the file that it extends, record, records that follow with their factors."""
    def written(folder, density=340, letter="x", factor=1):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "base.yaml").write_text(f"extends: A\nmaterials: {{timber: {{density: {density}}}}}\n")
        (tmp_path / folder / "mine.yaml").write_text("extends: base.yaml\n")
        (tmp_path / folder / "one.csv").write_text(letter)
        return identity(
            RunOptions(house=str(tmp_path / folder / "mine.yaml"), record=str(tmp_path / folder / "one.csv"),
                       then=f"{tmp_path / folder}/one.csv@{factor}"))

    one = written("a")
    assert written("b") == one
    assert "content of files" in one
    assert len(
        {str(each)
         for each in (one, written("c", density=341), written("d", letter="y"), written("e", factor=2))}) == 4


def test_another_package(monkeypatch):
    one = identity()
    monkeypatch.setattr(identities, "package", lambda: "another")
    assert [key for key in one if one[key] != identity()[key]] == ["package"]


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    """A copy of the application's folder, with the plugin's in it."""
    folder = tmp_path_factory.mktemp("package") / "timber_houses"
    for source, copy in ((Path(identities.__file__).resolve().parents[1], folder),
                         (Path(yade_timber.__path__[0]), folder / "plugin")):
        shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__", "*.so"))
    return folder


@pytest.mark.parametrize("name, decides", [
    ("base/colors.py", False),
    ("pictures/raster.py", False),
    ("pictures/player.py", False),
    ("data/player/page.css", False),
    ("study/driver.py", False),
    ("text/english.py", False),
    ("plugin/scene/engines.py", True),
    ("plugin/energy_terms.py", True),
    ("scene/scenario.py", True),
    ("run/runner.py", True),
    ("run/summary.py", True),
    ("house/build.py", True),
    ("motion/readers.py", True),
    ("recording/drift.py", True),
    ("base/time_step.py", True),
    ("data/houses/base.yaml", True),
])
def test_files_that_decide_results(package, name, decides):
    """A changed file changes the fingerprint of the package if, and only if, it decides results."""
    folder = package / "plugin" if name.startswith("plugin") else package
    before = identities.of_files(identities.decisive_files(folder))
    with open(package / name, "a") as file:
        file.write("\n# changed\n")
    assert (identities.of_files(identities.decisive_files(folder)) != before) is decides


def test_samples_of_a_finished_run_are_in_its_checkpoint(tmp_path):
    """Scene and samples are read back, and YADE still opens the file; one changed byte of the samples is found."""
    O.reset()
    path, samples = tmp_path / "a.yade", b"S\n\0" * 9
    checkpoint.save(path, {"name": "x"}, {"wall_s": 1.0})
    checkpoint.enclose(path, samples)
    assert checkpoint.load(path, {"name": "x"}) == ({"wall_s": 1.0}, samples)
    O.load(str(path), quiet=True)
    path.write_bytes(path.read_bytes().replace(samples, b"T" + samples[1:]))
    with pytest.raises(RunError, match="damaged"):
        checkpoint.load(path, {"name": "x"})


def test_another_users_checkpoint_is_not_loaded(tmp_path, monkeypatch):
    """It could harm the process."""
    O.reset()
    checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {"wall_s": 1.0})
    assert checkpoint.load(tmp_path / "a.yade", {"name": "x"}) == ({"wall_s": 1.0}, b"")
    owner = (tmp_path / "a.yade").stat().st_uid
    monkeypatch.setattr(checkpoint.os, "geteuid", lambda: owner + 1)
    with pytest.raises(RunError, match="another user; copy it"):
        checkpoint.load(tmp_path / "a.yade", {"name": "x"})


@pytest.mark.parametrize("nested", [False, True])
def test_a_forged_checkpoint_is_refused_before_it_is_loaded(tmp_path, monkeypatch, nested):
    """A PyRunner in the list of engines or in an engine; its command runs where nothing refuses it."""
    path, marker = tmp_path / "a.yade", tmp_path / "marker"
    runner = yw.PyRunner(command=f"open({str(marker)!r}, 'w')", iterPeriod=1, initRun=True)
    O.reset()
    O.engines = [yw.ParallelEngine([runner]) if nested else runner]
    checkpoint.save(path, {"name": "x"}, {})
    O.reset()
    with pytest.raises(RunError, match="a.yade: holds P.*, which no run of this package saves; run without --resume"):
        checkpoint.load(path, {"name": "x"})
    assert O.engines == [] and not marker.exists()
    monkeypatch.setattr(checkpoint, "CLASSES", checkpoint.CLASSES | {"PyRunner", "ParallelEngine"})
    checkpoint.load(path, {"name": "x"})
    O.step()
    assert marker.exists()
    O.reset()


def test_every_class_of_yade_has_a_name_that_is_checked(tmp_path):
    """An object of each kind of engine, in a binary file, is named with its namespace."""
    O.reset()
    for name in system.childClasses("Engine"):
        try:
            O.engines = [getattr(yw, name)()]
            O.save(str(tmp_path / "a.yade"), quiet=True)
        except Exception:  # an engine that needs arguments
            continue
        assert f"yade::{name}".encode() in (tmp_path / "a.yade").read_bytes(), name
    O.reset()


def test_a_limit_of_the_file_size(tmp_path):
    """Boost's error does not name it."""
    with file_limit(100), pytest.raises(OSError, match="File too large"):
        checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {})
    assert list(tmp_path.iterdir()) == []


def test_a_writer_that_fails_leaves_the_earlier_checkpoint(tmp_path, monkeypatch):
    """As on a full disk."""
    checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {})
    before = (tmp_path / "a.yade").read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("timber_houses.base.atomic_write.shutil.copyfileobj", full)
    with pytest.raises(OSError, match="No space"):
        checkpoint.save(tmp_path / "a.yade", {"name": "x"}, {})
    assert [path.name for path in tmp_path.iterdir()] == ["a.yade"] and (tmp_path / "a.yade").read_bytes() == before
