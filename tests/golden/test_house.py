# SPDX-License-Identifier: GPL-2.0-or-later
"""A short, strongly shaken house against stored numbers: finds results that change unawares.

YADE_TIMBER_UPDATE_GOLDEN=1 writes the file anew; the change list then says what changed and why.
"""
import datetime
import json
import os
from pathlib import Path

import yade.config
import yade_timber as yt
from compare import assert_close
from yade import O
from timber_houses.scene import scenario
from yade_timber.scene.engines import find_engine
from timber_houses.motion import GroundMotion, default_motion

GOLDEN = Path(__file__).with_suffix(".json")
STRONG = 17.6  # [s] of the default motion
DURATION = 0.3  # [s]: short enough for rounding noise not to grow past the tolerance
RTOL, ATOL = 1e-6, 1e-9  # other compilers and libms round differently; observed on one machine: 0


def shaken_house():
    """Numbers of house B with 1 m of snow after DURATION of strong shaking."""
    motion = default_motion()
    first = round(STRONG / motion.dt)
    cut = GroundMotion(motion.dt, motion.acceleration[first:], "cut")
    scenario.build(scenario.Scenario("golden", "B", cut, snow_depth=1.0))
    O.run(round(DURATION / O.dt), True)
    monitor = find_engine(yt.HouseMonitor)
    numbers = {"peak drift " + str(k): value for k, value in enumerate(monitor.peak)}
    numbers.update({"energy " + name: value for name, value in yt.energy().items()})
    numbers["contact points"] = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    for name in ("main.floor1", "main.beam2.NS.x0", "main.column1.x4y4"):
        body = next(b for b in O.bodies if b.shape.name == name)
        numbers.update({f"{name} {axis}": value for axis, value in zip("xyz", body.state.pos - body.state.refPos)})
    return numbers


def write(numbers):
    content = {
        "made_by": "tests/golden/test_house.py",
        "date": datetime.date.today().isoformat(),
        "yade": yade.config.version,
        "rtol": RTOL,
        "atol": ATOL,
        "numbers": numbers,
    }
    GOLDEN.write_text(json.dumps(content, indent=1) + "\n")


def test_shaken_house_equals_its_golden_numbers():
    numbers = shaken_house()
    if os.environ.get("YADE_TIMBER_UPDATE_GOLDEN"):
        write(numbers)
    golden = json.loads(GOLDEN.read_text())["numbers"]
    assert list(numbers) == list(golden)
    for name, value in numbers.items():
        try:
            assert_close(value, golden[name], RTOL, ATOL)
        except AssertionError as problem:
            raise AssertionError(f"{name}: {problem}") from None
