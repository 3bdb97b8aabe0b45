# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Recorded frames: written and read back, damaged files, placements in a frame. Needs no YADE."""
import dataclasses
import json
import os

import h5py
import numpy as np
import pytest
from file_limit import file_limit
from small_frames import CUBE, frames
from timber_houses.recording import frames as files
from timber_houses.base.errors import RunError


def same(one, other):
    """Whether two values agree: arrays, lists of arrays or strings, data classes of them."""
    if dataclasses.is_dataclass(one):
        return all(same(a, b) for a, b in zip(vars(one).values(), vars(other).values()))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other))
    return np.array_equal(one, other)


@pytest.mark.parametrize("ended", [True, False])
@pytest.mark.parametrize("shaken", [True, False])
def test_written_is_read_back(tmp_path, ended, shaken):
    made = frames(ended, shaken)
    files.save(tmp_path / "frames.h5", made)
    read = files.load(tmp_path / "frames.h5")
    for field in dataclasses.fields(made):
        assert same(getattr(made, field.name), getattr(read, field.name)), field.name
    assert len(list(tmp_path.iterdir())) == 1


def test_comparison_can_fail():
    one, other = frames(), frames()
    other.position[7][2][0] += 1e-3
    assert same(one, one) and not same(one.position, other.position) and not same(["a"], ["b"])


def test_the_first_frame_alone_is_a_whole_file(tmp_path):
    """A run that is killed before its first checkpoint has no more than this."""
    made = frames(ended=False)
    for name in ("time", "position", "orientation", "load", "broken"):
        setattr(made, name, [])
    files.save(tmp_path / "frames.h5", made)
    assert files.load(tmp_path / "frames.h5").position.shape == (0, 3, 3)


@pytest.mark.parametrize("content", [None, b"", b"no HDF5 at all"])
def test_what_is_no_frames_file(tmp_path, content):
    path = tmp_path / "frames.h5"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(RunError, match="frames.h5: ") as raised:
        files.load(path)
    assert "\n" not in str(raised.value)


def test_another_hdf5_file(tmp_path):
    h5py.File(tmp_path / "other.h5", "w").close()
    with pytest.raises(RunError, match="no recorded frames"):
        files.load(tmp_path / "other.h5")


def damaged(path, change):
    """Save the sample's frames, change the HDF5 file in place."""
    files.save(path, frames())
    with h5py.File(path, "r+") as file:
        change(file)


def replace(name, data):
    def change(file):
        del file[name]
        file[name] = data

    return change


def change_summary(file, **changes):
    file.attrs["summary"] = json.dumps({**json.loads(file.attrs["summary"]), **changes})


def declare(name, shape):
    """A table of that shape of which nothing is stored."""

    def change(file):
        del file[name]
        file.create_dataset(name, shape=shape, dtype="f4", chunks=(1,) * len(shape))

    return change


@pytest.mark.parametrize("change", [
    lambda file: file.pop("joints"),
    lambda file: file["elements"].pop("kind"),
    lambda file: file.attrs.pop("ended"),
    lambda file: file.attrs.update(summary="{"),
    lambda file: file.attrs.update(summary="[]"),
    lambda file: file.attrs.update(summary='{"model": "A"}'),
    lambda file: change_summary(file, model=3),
    lambda file: change_summary(file, collapse_time_s="late"),
    lambda file: change_summary(file, events=3),
    lambda file: change_summary(file, events=[{"time_s": 1.0, "kind": "level", "facts": {"drift": 0.1}}]),
    lambda file: change_summary(file, structures={}),
    lambda file: change_summary(file, events=[{"time_s": "soon", "kind": "tilt", "facts": {"direction": "ns"}}]),
    lambda file: change_summary(file, events=[{"time_s": 1.0, "kind": "tilt", "facts": {"direction": 3}}]),
    lambda file: file["frames/position"].write_direct(np.full((61, 3, 3), np.inf, "f4")),
    lambda file: file["frames/position"].__setitem__((5, 1, 0), np.nan),
    lambda file: file["frames/orientation"].__setitem__((5, 1), np.nan),
    lambda file: file["frames/time"].__setitem__(3, np.nan),
    lambda file: file["elements/position"].__setitem__((0, 0), np.nan),
    replace("frames/position", np.zeros((2, 3, 3), "f4")),
    replace("elements/storey", np.zeros(2, int)),
    replace("elements/faces", np.full(72, 99)),
    lambda file: [replace(f"elements/{name}_start", np.array(starts))(file)
                  for name, starts in (("element", [0, 6, 18]), ("vertex", [0, 8, 24]))],
    replace("elements/faces", b"text"),
    replace("joints/a", np.array([0, 1, 99])),
    replace("contacts/pair", np.full((2, 2), -1)),
    replace("history/columns", np.zeros(7)),
    replace("history/rows", np.zeros(7)),
    declare("frames/position", (10**6, 10**5, 3)),
])
def test_damaged_or_hostile_tables(tmp_path, change):
    """One line; tables that only declare a size take no memory."""
    damaged(tmp_path / "frames.h5", change)
    with pytest.raises(RunError, match="frames.h5: ") as raised:
        files.load(tmp_path / "frames.h5")
    assert "\n" not in str(raised.value)


def test_a_removed_element(tmp_path):
    """NaN in all its numbers of a frame."""
    made = frames()
    made.position[5:, 1] = made.orientation[5:, 1] = np.nan
    files.save(tmp_path / "frames.h5", made)
    assert np.isnan(files.load(tmp_path / "frames.h5").position[5:, 1]).all()


def test_a_limit_of_the_file_size(tmp_path):
    """An error of the system, and the earlier file stays; a crash would follow at the end of this process."""
    files.save(tmp_path / "frames.h5", frames(ended=False))
    with file_limit(10_000), pytest.raises(OSError, match="too large"):
        files.save(tmp_path / "frames.h5", frames())
    assert files.load(tmp_path / "frames.h5").summary is None and len(list(tmp_path.iterdir())) == 1


def test_truncated_file(tmp_path):
    files.save(tmp_path / "frames.h5", frames())
    content = (tmp_path / "frames.h5").read_bytes()
    for share in (0.1, 0.5, 0.9):
        (tmp_path / "frames.h5").write_bytes(content[: int(share * len(content))])
        with pytest.raises(RunError, match="frames.h5: "):
            files.load(tmp_path / "frames.h5")


def test_pipe(tmp_path):
    os.mkfifo(tmp_path / "frames.h5")
    with pytest.raises(RunError, match="frames.h5: "):
        files.load(tmp_path / "frames.h5")


def test_repr_is_short():
    made = frames()
    assert all(
        len(repr(part)) < 300 and "\n" not in repr(part)
        for part in (made, *(getattr(made, name) for name in ("elements", "joints", "contacts", "motion", "history"))))


def test_corners_move_and_turn():
    """The upper box at the end: 1 m to the east, tipped by 0.3 rad towards the east."""
    made, c, s = frames(), np.cos(0.3), np.sin(0.3)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    assert np.allclose(made.corners(-1, 2), CUBE @ turn.T + (1, 0, 1.5), atol=1e-6)
    assert np.allclose(made.corners_at_start(2), CUBE + (0, 0, 1.5))


def test_corners_of_all_elements_are_those_of_each():
    made = frames()
    numbers = range(len(made.elements.name))
    for frame, single in ((None, made.corners_at_start), (1, lambda k: made.corners(1, k))):
        assert all(
            np.array_equal(corners, single(k)) for k, corners in zip(numbers, made.all_corners(frame), strict=True))


def test_joints_sit_on_their_first_element():
    made = frames()
    assert np.allclose(made.joint_places(-1), [[0, 0, 0], [0.5, 0, 1], [-0.5, 0, 1]])


def test_joint_states():
    made = frames()
    assert [list(made.joint_states(made.at(t))) for t in (0, 1.3, 2.0)] == [
        ["before", "whole", "whole"], ["before", "partly", "whole"], ["before", "broken", "partly"]]
