# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene as JSON for other solvers: every field of it in closed form."""
import json

import numpy as np
import pytest
import yade_timber as yt
from compare import assert_close
from scipy.spatial.transform import Rotation
from yade import O, utils
from yade.minieigenHP import Quaternion, Vector3

CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
SIDES = {frozenset(np.flatnonzero(CORNERS[:, axis] == side).tolist()) for axis in range(3) for side in (-0.5, 0.5)}
SIZES = {"plate": (2, 1, 0.2), "post": (0.2, 0.3, 0.6)}  # [m]
CENTRES = {"plate": (0.3, -0.2, -0.1), "post": (0.5, -0.1, 0.3)}
TURNS = {"plate": (0, 0, 0), "post": (0, 0, 0.4)}  # rotation vectors [rad]
POINTS = [(0.45, -0.15, 0.0), (0.55, -0.15, 0.0), (0.5, 0.0, 0.0)]  # of springs [m]
NORMAL = (0.6, 0.0, -0.8)
SHIFT, LEAN = (0.03, -0.02, 0.05), (0.3, -0.2, 0.1)
"""Where the post has gone since it was joined [m], and by what it has turned (rotation vector) [rad]."""
GRAVITY = (0.5, -1.0, -9.0)  # [m/s2]
OAK = {"law": "timber", "young": 1.1e10, "poisson": 0.3, "density": 700.0, "friction": 0.35}
CEDAR = {"law": "timber", "young": 7e9, "poisson": 0.45, "density": 320.0, "friction": 0.6}


def matrix(turn):
    """Rotation matrix of a rotation vector [rad]."""
    return Rotation.from_rotvec(turn).as_matrix()


def quaternion(turn):
    """The same as YADE's Quaternion."""
    x, y, z, w = Rotation.from_rotvec(turn).as_quat()
    return Quaternion(w, x, y, z)


def timber(values, label):
    """TimberMat of the values of OAK or CEDAR."""
    return yt.timber(values["young"], values["poisson"], values["density"], values["friction"], label)


def corners(name):
    """Corners (8, 3) of a box where it was put [m]."""
    return (CORNERS * SIZES[name]) @ matrix(TURNS[name]).T + CENTRES[name]


def carried(points):
    """Where points of the post are now. (n, 3) [m]"""
    return (np.asarray(points) - CENTRES["post"]) @ matrix(LEAN).T + CENTRES["post"] + SHIFT


def body(name, material, **options):
    """Append a box; returns its id."""
    return O.bodies.append(yt.box(SIZES[name], CENTRES[name], quaternion(TURNS[name]), material, name=name, **options))


def written(folder):
    """What export_scene writes."""
    yt.export_scene(str(folder / "scene.json"))
    return json.loads((folder / "scene.json").read_text())


@pytest.fixture
def scene(tmp_path):
    """A fixed plate of oak and a post of cedar with two joints, one of them unbreakable and of the whole; the post has
    moved since.
    """
    O.reset()
    plate = body("plate", timber(OAK, "oak"), fixed=True, kind="floor")
    post = body("post", timber(CEDAR, "cedar"), radius=0.015, kind="column")
    O.dt, O.engines = 1e-4, yt.engines(gravity=GRAVITY)
    yt.connect(post, plate, POINTS, NORMAL, stiffness=(3e4, 2e4), strength=np.inf, per="joint", kind="foot",
               name="foot 1")
    torn = yt.connect(plate, post, POINTS[:2], NORMAL, stiffness=(4e4, 5e4), strength=600.0, damping_ratio=0.05)
    torn.broken = [0, 1]
    state = O.bodies[post].state
    state.pos, state.ori = state.pos + Vector3(*SHIFT), quaternion(LEAN) * state.ori
    return written(tmp_path)


def test_head(scene):
    assert list(scene) == ["format", "units", "gravity", "materials", "friction", "elements", "joints"]
    assert (scene["format"], scene["units"]) == ("yade-timber scene 1", "SI; world frame x east, y north, z up")
    assert scene["gravity"] == list(GRAVITY)


def test_materials(scene):
    assert scene["materials"] == {"oak": OAK, "cedar": CEDAR}
    assert sorted(scene["friction"]) == [
        ["cedar", "cedar", 0.6], ["cedar", "oak", 0.35], ["oak", "oak", 0.35]
    ]  # the smaller one


def test_elements(scene):
    plate, post = scene["elements"]
    described = {"id": 0, "name": "plate", "kind": "floor", "density": 700.0, "fixed": True, "material": "oak"}
    assert {key: plate[key] for key in described} == described
    described = {"id": 1, "name": "post", "kind": "column", "density": 320.0, "fixed": False, "material": "cedar"}
    assert {key: post[key] for key in described} == described
    assert set(plate) == set(post) == {*described, "vertices", "faces", "radius"}
    assert_close([plate["radius"], post["radius"]], [0.02, 0.015], rtol=1e-12)  # 10 % of the shortest edge; as given


def test_vertices_are_in_the_world(scene):
    plate, post = (element["vertices"] for element in scene["elements"])
    assert_close(plate, corners("plate"), atol=1e-12)  # corners are kept to 13 digits of the box's size
    assert_close(post, carried(corners("post")), atol=1e-12)


def test_faces_are_closed_and_outward(scene):
    for element in scene["elements"]:
        places, faces = np.array(element["vertices"]), element["faces"]
        assert len(faces) == 6 and {frozenset(face) for face in faces} == SIDES
        edges = [(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1])]
        assert len(set(edges)) == 24 and set(edges) == {(b, a) for a, b in edges}  # each edge once in either direction
        fans = [places[[face[0], a, b]] for face in faces for a, b in zip(face[1:], face[2:])]
        assert_close(
            sum(np.linalg.det(fan - places.mean(0)) for fan in fans) / 6, np.prod(SIZES[element["name"]]),
            rtol=1e-10)  # > 0: outward


def test_joints(scene):
    whole, torn = scene["joints"]
    described = {
        "elements": [1, 0], "stiffness": [3e4, 2e4], "strength": None, "reading": "joint", "damping_ratio": 0.0,
        "damping_time": 0.0, "initial_damping": False,
        "broken": [False] * 3, "kind": "foot", "name": "foot 1", "slip": None, "wall": None
    }
    assert {key: whole[key] for key in described} == described
    described = {
        "elements": [0, 1], "stiffness": [4e4, 5e4], "strength": 600.0, "reading": "spring", "damping_ratio": 0.05,
        "damping_time": 0.0, "initial_damping": False,
        "broken": [False, True], "kind": "", "name": "", "slip": None, "wall": None
    }
    assert {key: torn[key] for key in described} == described and torn["broken"][1] is True  # no 1
    assert set(whole) == set(torn) == {*described, "points", "normal"}


def test_springs_stand_where_their_first_element_is(scene):
    whole, torn = scene["joints"]
    assert_close(whole["points"], carried(POINTS), atol=1e-12)
    assert_close(whole["normal"], matrix(LEAN) @ NORMAL, atol=1e-12)
    assert_close(torn["points"], POINTS[:2], atol=1e-12)
    assert_close(torn["normal"], NORMAL, atol=1e-12)


def test_yielding_joint(tmp_path):
    """Parameters, and the history of each spring; plastic stretches are in the frame of the first element."""
    O.reset()
    post = body("post", timber(CEDAR, "cedar"))
    plate = body("plate", timber(OAK, "oak"), fixed=True)
    O.dt, O.engines = 1e-4, yt.engines()
    joint = yt.connect(post, plate, POINTS[:2], stiffness=(1e5, 1e5), strength=600.0, slip=yt.SlipLaw(0.01, 0.03, 0.25))
    yt.scene.attributes._update_attributes(
        joint, {"plasticStretches": [(0.001, 0, 0.002), (0, 0, 0)], "largestStretches": [0.008, 0.001]})
    O.bodies[post].state.ori = quaternion(LEAN)
    slip = written(tmp_path)["joints"][0]["slip"]
    assert (slip["friction_share"], slip["softening_stretch"], slip["ultimate_stretch"]) == (0.25, 0.01, 0.03)
    assert slip["largest"] == [0.008, 0.001]
    assert_close(slip["plastic"], [matrix(LEAN) @ (0.001, 0, 0.002), (0, 0, 0)], atol=1e-12)


def test_names_of_materials(tmp_path):
    """Equal values share a name, others with the same label get one of their own; without a label the law is the name.
    """
    O.reset()
    waxed = {**OAK, "friction": 0.25}
    for k, material in enumerate([timber(OAK, "wood"), timber(OAK, "beam"), timber(waxed, "wood"), yt.timber(),
                                  yt.snow(80.0, 3e4, 0.2)]):
        O.bodies.append(yt.box((1, 1, 1), (2 * k, 0, 0), material=material))
    content = written(tmp_path)
    assert [element["material"] for element in content["elements"]] == ["wood", "wood", "wood'", "timber", "snow"]
    assert content["materials"]["wood'"] == waxed
    assert content["materials"]["snow"] == {"law": "snow", "stiffness_per_kg": 3e4, "density": 80.0, "friction": 0.2}
    assert content["joints"] == [] and content["gravity"] == [0, 0, 0]  # without engines
    coefficients = {(a, b): c for a, b, c in content["friction"]}
    assert len(content["friction"]) == len(coefficients) == 10
    assert coefficients["snow", "wood'"] == 0.2
    assert coefficients["timber", "wood'"] == 0.25


def test_joint_of_a_body_taken_out(tmp_path):
    O.reset()
    plate, post = body("plate", timber(OAK, "oak"), fixed=True), body("post", timber(CEDAR, "cedar"))
    O.engines = yt.engines()
    yt.connect(plate, post, POINTS)
    O.bodies.erase(plate)
    content = written(tmp_path)
    assert content["joints"] == [] and [element["id"] for element in content["elements"]] == [post]


def test_body_of_another_kind(tmp_path):
    O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 1))
    with pytest.raises(ValueError, match="body 0 is no RoundedPolyhedron"):
        written(tmp_path)
    assert not list(tmp_path.iterdir())
