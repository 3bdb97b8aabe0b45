# SPDX-License-Identifier: GPL-2.0-or-later
"""A user's scene of blocks and a joint: its log, the pictures of it, and logs that are refused."""
import json

import numpy as np
import pytest
import yade_timber as yt
from file_limit import file_limit
from timber_houses.base.errors import RunError
from timber_houses.pictures import player, sheets, vtk
from timber_houses.recording import append_log, frames
from yade import O, utils
from yade_timber import log

STEPS, DT, SPEED = 50, 2e-4, 0.5  # between frames; [s]; [m/s]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Log of a block that flies beside a post on a floor, joined by two springs; no gravity."""
    O.reset()
    floor = O.bodies.append(yt.box((3, 3, 0.2), (0, 0, -0.1), fixed=True))
    post = O.bodies.append(yt.box((0.12, 0.12, 2), (0, 0, 1)))
    block = O.bodies.append(yt.box((0.2, 0.3, 0.4), (1, 0, 1)))
    O.dt, O.engines = DT, yt.engines(gravity=(0, 0, 0))
    yt.connect(floor, post, [(-0.05, 0, 0), (0.05, 0, 0)], stiffness=(5e4, 5e4), strength=2000)
    yt.set_velocity(O.bodies[block], (SPEED, 0, 0))
    path = tmp_path_factory.mktemp("scene") / "blocks.log"
    record = yt.record(path)
    O.bodies.append(yt.box((1, 1, 1), (20, 0, 5)))  # later ones are left out
    for _ in range(30):
        O.run(STEPS, True)
        record.take()
        record.take()  # a time has one frame
    return path


def test_the_log_holds_the_movement(made):
    """float32 of positions of 1 m: 1e-7"""
    read = frames.load(made)
    assert np.allclose(read.time, np.arange(31) * STEPS * DT) and read.position.shape == (31, 3, 3)
    assert np.allclose(read.position[:, 2, 0], 1 + SPEED * np.asarray(read.time), rtol=0, atol=1e-6)
    assert read.title == "blocks" and read.elements.fixed.tolist() == [True, False, False]
    assert np.allclose(np.ptp(read.corners(0, 2), axis=0), (0.2, 0.3, 0.4))
    assert (read.joints.a, read.joints.b, read.joints.springs, read.joints.strength) == ([0], [1], [2], [2000])
    assert np.allclose(read.joint_places(0), [[0, 0, 0]]) and read.joint_states(-1).tolist() == ["whole"]


def test_pictures(made, tmp_path):
    read = frames.load(made)
    page = player.make([(made, read)], tmp_path / "player.html").read_text()
    assert "blocks" in page and "Not ended" not in page
    assert player.info(read)["origin"] == "yade-timber"  # whether the ground moves is unknown
    assert [player.info(read)["joint_list"][0]["place"], player.breaks(read)] == ["joint", []]
    files = vtk.export(tmp_path / "vtk", read, every=10)
    assert [file.read_text().count("<DataSet") for file in files] == [4, 4, 31]
    assert sheets.Stills(read).sheet(sheets.VIEWS[0], sheets.PRINT).artists


def test_erased_and_replaced_bodies(tmp_path):
    """A body that is gone is NaN, also when another one has its id; so are its contacts. A joint of it is broken."""
    O.reset()
    floor = O.bodies.append(yt.box((3, 3, 0.2), (0, 0, -0.1), fixed=True, name="floor"))
    first = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.5, 0, 0.1)))
    O.bodies.erase(first)
    posts = [O.bodies.append(yt.box((0.1, 0.1, 1), (x, 0, 0.5), name=f"post {x}")) for x in (-1, 0, 1)]
    O.dt, O.engines = DT, yt.engines()
    for post in posts:
        yt.connect(floor, post, [(O.bodies[post].state.pos[0], 0, 0)], strength=np.inf)
    O.run(20, True)
    O.bodies.erase(posts[0])
    record = yt.record(tmp_path / "a.log", "Posts")
    O.bodies.erase(posts[1])
    O.run(20, True)
    record.take()
    O.bodies.insertAtId(yt.box((1, 1, 1), (5, 5, 5)), posts[1])
    O.run(20, True)
    record.take()
    read = frames.load(tmp_path / "a.log")
    assert (read.title, read.elements.name, read.joints.strength.tolist()) == ("Posts", ["floor", "post 0", "post 1"],
                                                                               [np.inf] * 2)
    assert read.joints.b.tolist() == [1, 2] and np.isnan(read.position[1:, 1]).all()
    assert np.isfinite(read.position[:, [0, 2]]).all() and np.isfinite(read.position[0]).all()
    assert [state.tolist() for state in map(read.joint_states, range(3))] == [["whole"] * 2] + [["broken", "whole"]] * 2
    assert player.breaks(read) == [{"joint": 0, "time": pytest.approx(40 * DT), "cause": "broken", "force": 0.0,
                                    "springs": 1}]
    assert [set(pair.ravel().tolist()) for pair in read.contacts.pair] == [{0, 1, 2}, {0, 2}, {0, 2}]


def test_an_earlier_state_and_foreign_bodies_are_refused(tmp_path):
    O.reset()
    with pytest.raises(ValueError, match="a scene without bodies"):
        yt.record(tmp_path / "a.log")
    O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
    O.dt, O.engines = DT, yt.engines(gravity=(0, 0, 0))
    O.run(2, True)
    record = yt.record(tmp_path / "a.log")
    O.resetTime()
    with pytest.raises(ValueError, match="before the last frame"):
        record.take()
    O.reset()
    O.dt, O.engines = DT, yt.engines()
    O.run(5, True)
    with pytest.raises(ValueError, match="are gone"):
        record.take()
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    with pytest.raises(ValueError, match="body 0 is no RoundedPolyhedron"):
        yt.record(tmp_path / "b.log")


def entries(path):
    return list(append_log.read(path, log.OWN_SCENE))


def change(scene, place, value):
    """The description with another value at a place, a list of keys."""
    table, inner = json.loads(scene), None
    inner = table
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    return json.dumps(table).encode()


@pytest.mark.parametrize("place, value, reason", [
    (["foreign"], 1, "unknown"),
    (["joints", "foreign"], [1], "unknown"),
    (["joints"], [], "wrong type"),
    (["title"], None, "wrong type"),
    (["elements", "name"], "abc", "wrong type"),
    (["elements", "name"], ["a"], "2 entries|3 entries"),
    (["elements", "kind", 0], 3, "no texts"),
    (["elements", "fixed", 0], 0.5, "no flags"),
    (["elements", "position", 0, 0], float("nan"), "not finite"),
    (["elements", "vertices", 1, 0], float("inf"), "not finite"),
    (["elements", "position", 0], [1, 2], "inhomogeneous"),
    (["elements", "vertices", 1, 0], 10**400, "no numbers"),
    (["elements", "vertex_start", 1], 9000, "in order"),
    (["elements", "element_start", 0], 1, "in order"),
    (["elements", "faces", 1], 99, "outside"),
    (["joints", "a", 0], 3, "outside"),
    (["joints", "b", 0], -1, "outside"),
    (["joints", "a", 0], 2**32 + 1, "outside"),
    (["joints", "springs", 0], 2**64, "no wholes"),
    (["joints", "strength", 0], None, "no numbers"),
])
def test_a_changed_description_is_refused(made, tmp_path, place, value, reason):
    (kind, time, scene), *rest = entries(made)
    refused(tmp_path, [(kind, time, change(scene, place, value)), *rest], reason)


@pytest.mark.parametrize("kind, content", [(log.FRAME, b""), (log.FRAME, bytes(8)), (log.CONTACTS, bytes(12)),
                                           (log.SCENE, b"{}"), (b"X", b"")])
def test_a_foreign_entry_is_refused(made, tmp_path, kind, content):
    refused(tmp_path, [*entries(made), (kind, 1.0, content)], "cannot read")


def test_other_logs_are_refused(made, tmp_path):
    refused(tmp_path, [], "no description")
    refused(tmp_path, entries(made)[1:], "no description")
    refused(tmp_path, entries(made), "an unfinished run is shown from its frames.h5", "a run's fingerprint")


def refused(folder, records, reason, owner=log.OWN_SCENE):
    path = folder / "other.log"
    path.write_bytes(log.packed(log.RUN, 0.0, owner.encode()) + b"".join(log.packed(*entry) for entry in records))
    with pytest.raises(RunError, match=reason) as caught:
        frames.load(path)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


def test_a_frame_that_finds_no_space_is_written_later(tmp_path):
    """As on a full disk: the error names the file's size, frames before and after it are complete."""
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (2 * k, 0, 0)) for k in range(40)])
    O.dt, O.engines = DT, yt.engines()
    record = yt.record(tmp_path / "a.log")
    O.run(5, True)
    with file_limit(record.path.stat().st_size + 100), pytest.raises(OSError, match="too large"):
        record.take()
    O.run(5, True)
    record.take()
    assert np.allclose(frames.load(record.path).time, [0, 10 * DT])


def test_a_torn_end_is_not_read(made, tmp_path):
    content = made.read_bytes()
    path = tmp_path / "torn.log"
    path.write_bytes(content[:-5])
    read = frames.load(path)
    assert len(read.time) == 31 and len(read.contacts.time) == 30
