# SPDX-License-Identifier: GPL-2.0-or-later
"""Short, strongly shaken houses against stored numbers: finds results that change unawares.

YADE_TIMBER_UPDATE_GOLDEN=1 writes the files anew; the change list then says what changed and why.
"""
import datetime
import json
import os
from pathlib import Path

import yade.config
import yade_timber as yt
from compare import assert_close
from yade import O
from timber_houses.run.observer import Observer
from timber_houses.scene import scenario
from yade_timber.scene.engines import find_engine
from timber_houses.motion import GroundMotion, default_motion

STRONG, VIOLENT = 17.6, 19.2  # [s] of the default motion
DURATION = 0.3  # [s]: short enough for rounding noise not to grow past the tolerance
BRITTLE_BRACES = """extends: storehouse
name: brittle
joint_types:
  bracing_plate: {law: brittle, kn: 69580, ks: 69580, strength: 6958, friction_share: null, softening_stretch: null,
                  ultimate_stretch: null}
"""
DAMAGED = ("broken_springs", "joint_yield", "joint_dashpot", "crushing", "friction")
RTOL, ATOL = 1e-6, 1e-9  # other compilers and libms round differently; observed on one machine: 0


def shaken_house(house, start, names, **more):
    """Numbers of a house after DURATION of the default motion from a time on. names: of elements"""
    motion = default_motion()
    cut = GroundMotion(motion.dt, motion.acceleration[round(start / motion.dt):], "cut")
    observed = Observer(scenario.build(scenario.Scenario("golden", house, cut, **more)))
    O.run(round(DURATION / O.dt), True)
    observed.read_samples()
    numbers = {"peak drift " + str(k): value for k, value in enumerate(observed.judge.main.peak)}
    numbers.update({"energy " + name: value for name, value in yt.energy().items()})
    numbers["contact points"] = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    for name in names:
        body = next(b for b in O.bodies if b.shape.name == name)
        numbers.update({f"{name} {axis}": value for axis, value in zip("xyz", body.state.pos - body.state.refPos)})
    return numbers


def compare(numbers, name):
    """Compare with the stored numbers of that name, or store them."""
    path = Path(__file__).with_name(f"{name}.json")
    if os.environ.get("YADE_TIMBER_UPDATE_GOLDEN"):
        content = {"made_by": "tests/golden/test_house.py", "date": datetime.date.today().isoformat(),
                   "yade": yade.config.version, "rtol": RTOL, "atol": ATOL, "numbers": numbers}
        path.write_text(json.dumps(content, indent=1) + "\n")
    golden = json.loads(path.read_text())["numbers"]
    assert list(numbers) == list(golden)
    for quantity, value in numbers.items():
        try:
            assert_close(value, golden[quantity], RTOL, ATOL)
        except AssertionError as problem:
            raise AssertionError(f"{quantity}: {problem}") from None


def test_shaken_house_equals_its_golden_numbers():
    """House B with 1 m of snow."""
    compare(shaken_house("B", STRONG, ("main.floor1", "main.beam2.NS.x0", "main.column1.x4y4"), snow_depth=1.0),
            "test_house")


def test_damaged_house_equals_its_golden_numbers(tmp_path):
    """Walls and plates yield, springs of braces break, dashpots of joints and of the sway work."""
    path = tmp_path / "brittle.yaml"
    path.write_text(BRITTLE_BRACES)
    numbers = shaken_house(str(path), VIOLENT, ("store.roof.east", "store.column1.x4y6", "store.brace1.EW.y0.0-1"),
                           scale=3.0, joint_damping=0.05)
    joints = find_engine(yt.JointEngine).joints
    numbers["broken springs"] = sum(sum(joint.broken) for joint in joints)
    numbers["walls that yield"] = sum(max(map(abs, joint.cycles[0]["largest"])) > joint.envelope[0][0]
                                      for joint in joints if joint.law == "wall")
    assert numbers["broken springs"] and numbers["walls that yield"]
    assert all(numbers[f"energy {term}"] > 1 for term in DAMAGED)
    compare(numbers, "damaged_house")
