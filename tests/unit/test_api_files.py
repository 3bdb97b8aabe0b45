# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Houses, motions and finished runs as objects, without YADE: calls, refusals, short representations."""
import importlib
import inspect
import re
import shutil
from pathlib import Path

import pytest
import timber_houses as th
import yade_timber as yt
import frames_sample
from summaries import sample_summary
from timber_houses.base.errors import InputError
from timber_houses.house import build_house, load_house

ROOT = Path(__file__).resolve().parents[2]


def test_packages_are_called_and_still_packages():
    assert th.house("A").name == "A" and th.house.load_house is load_house
    assert importlib.import_module("timber_houses.run.identity").__name__ == "timber_houses.run.identity"
    assert list(inspect.signature(th.run).parameters) == ["house", "motion", "snow", "duration", "out", "options"]
    assert "Parameters" in th.run.__doc__ and "Parameters" in th.house.__doc__


def test_house_of_a_name_a_file_and_a_house(tmp_path):
    shutil.copy(th.house("storehouse").path, tmp_path / "mine.yaml")
    for given in ("C2", th.house("C2")):
        assert th.house(given).counts()["joints"] == 382
    assert th.house(tmp_path / "mine.yaml").counts() == th.house("storehouse").counts()
    assert th.house("A").counts(snow=1.0)["mass_snow"] > 0 == th.house("A").counts(snow=0)["mass_snow"]


def test_variant_of_a_house(tmp_path):
    house = th.house("B")
    more = house.variant(tmp_path / "more.yaml", braces=house.free_bays[:2], strength=1.5)
    assert more.name == "more" and more.counts()["braces"] == house.counts()["braces"] + 2
    strongest = [
        max(joint.strength for joint in h.model().joints if joint.kind == "column_beam") for h in (house, more)
    ]
    assert strongest[1] == 1.5 * strongest[0]


def test_a_variant_may_be_named_like_a_number(tmp_path):
    assert th.house("A").variant(tmp_path / "1e3.yaml").name == "1e3"


def test_a_variant_may_be_named_like_a_shipped_house(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert th.house("B").variant("B", strength=2).path == tmp_path / "B"


def test_drawing(tmp_path):
    assert (tmp_path / "b.png") in th.house("B").draw(tmp_path / "b.png")


def test_motions():
    motion = th.motion("shipped", scale=0.5)
    assert motion.pga_gal["ns"] == pytest.approx(0.5 * th.motion().pga_gal["ns"])
    assert th.motion(motion, azimuth=90).pga_gal["ew"] == pytest.approx(motion.pga_gal["ns"])
    assert th.motion(motion, pga=300).pga_gal["ew"] == pytest.approx(
        300)  # the smaller of the horizontal peaks is 300 gal at level


@pytest.mark.parametrize("call, words", [
    (lambda: th.house("D"), "unknown house 'D'"),
    (lambda: th.house("c2"), "did you mean 'C2'?"),
    (lambda: th.house(3), "unknown house '3'"),
    (lambda: th.house("B").variant("/nowhere/x.yaml"), "cannot be written"),
    (lambda: th.house("B").variant("x.yaml", settings=["snow=1=2"]), "snow"),
    (lambda: th.house("B").draw("/nowhere/x.png"), "cannot be written"),
    (lambda: th.motion("nowhere"), "no such file"),
    (lambda: th.motion(scale=-1), "motion: scale -1"),
    (lambda: th.motion(scale="2"), "motion: scale '2': must be a number"),
    (lambda: th.motion(scales=2), "did you mean 'scale'"),
    (lambda: th.motion(7), "motion 7: must be"),
    (lambda: th.motion(th.motion(), seed=3), "leave one of them out"),
    (lambda: th.load_run("/nowhere"), "no finished run"),
])
def test_refusals_are_one_line(call, words):
    with pytest.raises((InputError, TypeError)) as refusal:
        call()
    assert words in str(refusal.value) and "\n" not in str(refusal.value)


def test_damaged_summary(tmp_path):
    for text in ("", "[]", "{}", '{"model": 3}'):
        (tmp_path / "summary.json").write_text(text)
        with pytest.raises(InputError, match="cannot be read as the summary"):
            th.load_run(tmp_path)


def test_directions_of_a_summary_are_attributes(tmp_path):
    sample_summary(quantities={"base_shear": {"sustained": {"ns": 5.0, "ew": 6.0}}}).write(tmp_path)
    shear = th.load_run(tmp_path).summary.quantities.base_shear
    assert (shear.sustained.ns, shear.sustained.ew) == (5.0, 6.0) and shear.sustained == {"ns": 5.0, "ew": 6.0}
    with pytest.raises(AttributeError, match="there are ns, ew"):
        shear.sustained.north


def test_representations_are_short():
    model = build_house(load_house("C2"))
    frames = frames_sample.run()
    shown = (th.house("C2"), th.motion(), load_house("C2"), model, model.elements[0], model.joints[0], frames,
             frames.elements, frames.joints, frames.history)
    assert [type(value).__name__ for value in shown if len(repr(value)) > 300] == []


def test_version():
    """The same in the change list, the citation and the package; CMake reads it from the package."""
    assert re.search(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text(), re.M)[1] == yt.__version__
    assert f"## {yt.__version__}" in (ROOT / "CHANGELOG.md").read_text()
