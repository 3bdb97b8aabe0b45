# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Sequences of ground motions: joined in time, with their own factors and time steps; command line and tables."""
import numpy as np
import pytest
from timber_houses.motion import GroundMotion, MotionRequest, RecordError, joined, read_motion, write_csv
from timber_houses.motion.processing import in_axes, interpolation_error, scaled, trim, turned
from timber_houses.motion.sequence import common_step, following, with_then
from timber_houses.study.batch.table import read_table


def motion(dt, n, name="a", seed=0):
    return GroundMotion(dt, np.random.default_rng(seed).normal(size=(n, 3)), name, f"{name}.csv")


def test_motions_follow_each_other_after_the_gap():
    first, second = motion(0.01, 300), motion(0.01, 200, "b", 1)
    both = joined([first, second], [1.0, 0.5], 5.0)
    assert both.dt == 0.01 and len(both) == 300 + 500 + 200 and both.name == "a then b"
    assert np.array_equal(both.acceleration[:300], first.acceleration)
    assert not both.acceleration[300:800].any()
    assert np.array_equal(both.acceleration[800:], 0.5 * second.acceleration)
    assert [(part.source, part.start, part.duration, part.scale)
            for part in both.parts] == [("a.csv", 0.0, 3.0, 1.0), ("b.csv", 8.0, 2.0, 0.5)]
    assert both.parts[1].pga_gal["ns"] == pytest.approx(0.5 * second.pga_gal["ns"])


def test_parts_of_a_processed_sequence():
    """Scaled by two: factors and peaks double. From 2 s on: times are earlier, the first motion is shorter. Turned by
    90 degrees: N-S becomes E-W.
    """
    both = joined([motion(0.01, 300), motion(0.01, 200, "b", 1)], [1.0, 0.5], 5.0)
    double, cut, side = scaled(both, 2.0).parts, trim(both, 2.0).parts, turned(both, 90.0).parts
    assert [part.scale for part in double] == [2.0, 1.0]
    assert double[1].pga_gal["ud"] == pytest.approx(2 * both.parts[1].pga_gal["ud"])
    assert [(part.start, part.duration) for part in cut] == pytest.approx([(0.0, 1.0), (6.0, 2.0)])
    assert cut[0].pga_gal == motion(0.01, 300).__class__(0.01, both.acceleration[200:300]).pga_gal
    assert len(trim(both, 5.0).parts) == 1
    assert [part.pga_gal["ew"] for part in side] == pytest.approx([part.pga_gal["ns"] for part in both.parts])


def test_interpolation_error_of_a_sequence():
    """Samples between those of a motion, on its straight lines, do not reduce the error; another motion does by its
    larger peak."""
    coarse, fine = motion(0.02, 300), motion(0.005, 400, "b", 1)
    alone = interpolation_error(coarse)
    assert interpolation_error(joined([coarse, fine], [1.0, 1e-6])) == pytest.approx(alone)
    peak = np.abs(coarse.acceleration).max() / (4 * np.abs(fine.acceleration).max())
    assert interpolation_error(joined([coarse, fine], [1.0, 4.0])) == pytest.approx(
        max(alone * peak, interpolation_error(fine)))
    assert interpolation_error(joined([coarse, fine], [1.0, 1e-6]), 0.02) == 0


def test_parts_of_a_sequence_in_other_axes():
    """East becomes south, north becomes east."""
    both = joined([motion(0.01, 50, "a", 1), motion(0.01, 50, "b", 2)], [1.0, 0.5])
    axes = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]]).T
    for before, after in zip(both.parts, in_axes(both, axes).parts):
        assert after.pga_gal == pytest.approx(
            {"ew": before.pga_gal["ns"], "ns": before.pga_gal["ew"], "ud": before.pga_gal["ud"]})


def test_different_steps_keep_the_straight_lines_between_samples():
    """0.01 and 0.004 s have the common step 0.002 s; at every old sample the value is the old one, between them it lies
    on the line.
    """
    first, second = motion(0.01, 101), motion(0.004, 51, "b", 1)
    both = joined([first, second], [1.0, 1.0], 2.0)
    assert both.dt == pytest.approx(0.002, rel=1e-12)
    assert both.acceleration[:501:5] == pytest.approx(first.acceleration, abs=1e-12)
    assert both.acceleration[2] == pytest.approx(0.6 * first.acceleration[0] + 0.4 * first.acceleration[1], abs=1e-12)
    assert both.acceleration[501 + 1000 :: 2] == pytest.approx(second.acceleration, abs=1e-12)
    assert both.parts[1].start == pytest.approx(0.002 * 1501, rel=1e-12)


@pytest.mark.parametrize("steps, common", [((0.00781249, 0.00781249), 0.00781249), ((0.01, 0.005), 0.005),
                                           ((0.01, 0.02, 0.004), 0.002), ((0.01, 0.01), 0.01),
                                           ((1 / 120, 0.01), 1 / 600)])
def test_common_step(steps, common):
    assert common_step(steps, "x") == pytest.approx(common, rel=1e-12)


def test_steps_without_a_common_one():
    with pytest.raises(RecordError, match="--resample"):
        common_step([0.01, 0.00999], "a and b")


@pytest.mark.parametrize("text, found", [("b.csv", [("b.csv", 1.0)]),
                                         ("b.NS,b.EW@0.8; c", [("b.NS,b.EW", 0.8), ("c", 1.0)]),
                                         ("me@host/b.csv", [("me@host/b.csv", 1.0)])])
def test_records_with_their_factors(text, found):
    assert following(text, "--then") == found


@pytest.mark.parametrize("words, found",
                         [("house.py C --record a then b@0.8 --snow 1", "house.py C --record a --snow 1 --then b@0.8"),
                          ("--record a then b then c", "--record a --then b;c"),
                          ("--record a --then b", "--record a --then b"), ("C --quake then", "C --quake --then ")])
def test_then_as_a_word(words, found):
    assert " ".join(with_then(words.split())) == found


@pytest.mark.parametrize("text", ["", "b@", "b@-1", "b@x", "@2", "b;;c", "b@nan"])
def test_wrong_records(text):
    with pytest.raises(RecordError, match="--then"):
        MotionRequest(then=text).check()


def test_gap_belongs_to_a_sequence():
    with pytest.raises(RecordError, match="--gap belongs to a sequence; give --then"):
        MotionRequest(gap=3.0).check()


@pytest.fixture
def files(tmp_path):
    for name, seed in (("fore", 0), ("main", 1)):
        write_csv(motion(0.01, 500, name, seed), tmp_path / f"{name}.csv")
    return tmp_path


def test_a_request_processes_each_record(files):
    """Scaled to 100 gal each, the second then doubled; cut to two seconds each."""
    request = MotionRequest(record=str(files / "fore.csv"), then=f"{files / 'main.csv'}@2", pga=100.0, end=2.0, gap=1.0)
    request.check()
    found = request.motion(2.5e-4)
    assert found.duration == pytest.approx(2.01 + 1.0 + 2.01)
    assert [max(part.pga_gal["ns"], part.pga_gal["ew"]) for part in found.parts] == pytest.approx([100, 200])


def test_resampled_records_have_one_step(files):
    found = MotionRequest(record=str(files / "fore.csv"), then=str(files / "main.csv"), resample=True).motion(1e-3)
    assert found.dt == 1e-3 and len(found.parts) == 2


def test_the_column_of_a_table(files):
    """Paths relative to the table; the name of the run depends on the content of the second record."""
    path = files / "runs.txt"
    path.write_text("house record then gap\nC fore.csv main.csv@0.8 3\n")
    row, = read_table(path)
    found = row.options
    assert found.then == f"{files / 'main.csv'}@0.8" and found.gap == 3.0
    assert following(found.then, "then")[0][1] == 0.8 and read_motion(found.record).dt == pytest.approx(0.01)
    before = row.name
    write_csv(motion(0.01, 500, "main", 2), files / "main.csv")
    assert read_table(path)[0].name != before
