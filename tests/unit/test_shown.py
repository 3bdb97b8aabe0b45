# SPDX-License-Identifier: GPL-2.0-or-later
"""Lines and tables of objects at the prompt; bodies given as Body or id; the hint on YADE's default time step."""
import subprocess

import pytest
import yade_timber as yt
from yade import O
from yade_timber.plugin import class_names

SCENE = """
import yade_timber as yt
from yade import O
O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
O.engines = yt.engines()
{step}
O.run(2, True)
"""


@pytest.fixture(autouse=True)
def scene():
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    column = O.bodies.append(yt.box((0.105, 0.105, 2.73), (0, 0, 1.365)))
    O.dt, O.engines = 1e-4, yt.engines()
    return O.bodies[plate], O.bodies[column]


def test_each_class_has_a_short_line():
    for name in class_names:
        line = repr(getattr(yt, name)())
        assert line.startswith(f"<{name}") and "\n" not in line and len(line) <= 120


def test_a_joint_shows_its_state(scene):
    joint = yt.connect(*scene, [(0.05, 0, 0), (-0.05, 0, 0)], kind="column_sill", strength=23500)
    assert repr(joint) == "<TimberJoint column_sill: bodies 0 and 1, 2 springs, load 0 of 23.5 kN a spring, intact>"
    assert repr(joint.springs).splitlines()[1:] == [f"{k:6}  {0:10} {0:10} {0:10}  {0:12}  intact" for k in (0, 1)]
    assert isinstance(joint.springs, list) and joint.springs[1]["stretch"] == 0
    joint.broken = [1, 0]
    assert [row.split()[-1] for row in repr(joint.springs).splitlines()[1:]] == ["broken", "intact"]
    assert repr(joint).endswith("1 broken>")
    assert repr(scene[1].shape) == "<RoundedPolyhedron: 8 vertices, 0.105 x 0.105 x 2.73 m, radius 0.0105 m>"


def test_bodies_and_ids_are_accepted(scene):
    O.run(500, True)
    assert yt.contacts(*scene) == yt.contacts(0, 1) != []
    assert len(repr(yt.contacts(0, 1)).splitlines()) == 1 + len(yt.contacts(0, 1))
    yt.set_velocity(1, (1, 2, 3))
    assert tuple(scene[1].state.vel) == (1, 2, 3)
    assert len(repr(yt.energy()).splitlines()) == len(yt.energy())
    with pytest.raises(ValueError, match="no body 7"):
        yt.set_velocity(7, (0, 0, 0))
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, z)) for z in (0, 3)])
    with pytest.raises(ValueError, match="body 0 is not in the scene"):
        yt.connect(*scene, [(0, 0, 0)])


@pytest.mark.parametrize("step", ["", "O.dt = 1e-4"])
def test_the_default_step_is_told(tmp_path, step):
    script = tmp_path / "scene.py"
    script.write_text(SCENE.format(step=step))
    done = subprocess.run(["yade", "-n", "-x", script], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr.count("YADE's default") == (not step)
