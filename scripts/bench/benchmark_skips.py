# SPDX-License-Identifier: GPL-2.0-or-later
"""Optimisations that skip unneeded work: time with and without each of them, and the difference of the results.

    yade -j1 -n -x scripts/bench/benchmark_skips.py [--house C2] [--steps 2000] [--blocks 9] [--out FOLDER]

CPU time, measured alternately with and without, each time in a new scene. Difference of the results: largest distance
between the final positions of an element.
"""
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import yade_timber as yt
from bench_tools import parser, publish
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines
from timber_houses.study.options import run_script

O = yw.Omega()

RESTING = 10.0
"""Simulated time of the scene at rest [s]."""
STRONG = 18.5
"""Start of the shaken scenes in the time of the ground motion [s]."""
HEADS = ("skipped work", "scene", "with the skip", "without", "speed-up", "largest distance of positions [m]")


def arguments():
    return parser(__doc__, blocks=9, steps=2000).parse_args()


# --- scenes: each returns the function that is measured, with or without the skip -------------------------------------
def shaken(options, **changes):
    """The house in strong shaking."""
    scenario.build(
        scenario.Scenario("skips", options.house, default_motion(), 1.0, options={"skip_rest": 0, **changes})
    )
    engines.find_engine(yw.GroundMotionEngine).start = -STRONG
    return lambda: O.run(options.steps, True)


def rest(options, skip):
    scenario.build(scenario.Scenario("skips", options.house, snow_depth=1.0, options={} if skip else {"skip_rest": 0}))

    def run():
        while O.time < RESTING - O.dt / 2:
            O.step()

    return run


def collider(options, skip):
    run = shaken(options)
    if not skip:
        O.engines = [e.collider if isinstance(e, yw.CollisionTrigger) else e for e in O.engines]
    return run


def pairs(options, skip):
    run = shaken(options)
    if not skip:
        O.engines = [e.loop if isinstance(e, yw.ContactLoop) else e for e in O.engines]
    return run


def joints(options, skip):
    """All joints broken, with or without the engine that visits them."""
    run = shaken(options)
    for joint in engines.find_engine(yw.JointEngine).joints:
        joint.broken = [1] * len(joint.broken)
    if skip:
        O.engines = [e for e in O.engines if not isinstance(e, yw.JointEngine)]
    return run


def fixed(options, skip):
    """Two hundred blocks in a row, a millimetre apart, without loads: fixed or free."""
    O.reset()
    O.bodies.append([yt.box((0.1, 0.1, 0.1), (0.101 * k, 0, 0), fixed=skip) for k in range(200)])
    O.engines = yt.engines(gravity=(0, 0, 0))
    O.dt = DEFAULT_DT
    return lambda: O.run(options.steps, True)


CASES = {  # (skipped work, scene) -> build
    ("steps while the house rests and the ground is quiet (RestSkipper)", f"at rest under snow, {RESTING:g} s"): rest,
    ("the collider, until a body may have left its bounding box, and YADE's dispatch",
     "strong shaking, snow"): collider,
    ("pairs that cannot touch, and YADE's dispatch", "strong shaking, snow"): pairs,
    ("the joint engine when all joints are broken", "strong shaking, snow, no joints"): joints,
    ("fixed bodies: no integration, no pairs", "200 blocks side by side"): fixed,
}


# --- runs -------------------------------------------------------------------------------------------------------------
def timed(build, options, skip):
    """(CPU time of the run [s], final positions of all bodies [m])."""
    run = build(options, skip)
    since = time.process_time()
    run()
    return time.process_time() - since, np.array([list(b.state.pos) for b in O.bodies])


def measure(case, build, options):
    """A row of the table, times in seconds."""
    runs = {True: [], False: []}
    for _ in range(options.blocks):
        for skip in runs:
            runs[skip].append(timed(build, options, skip))
    cpu = {skip: statistics.median(time for time, _ in found) for skip, found in runs.items()}
    distance = np.abs(runs[True][0][1] - runs[False][0][1]).max()
    return (*case, cpu[True], cpu[False], cpu[False] / cpu[True], distance)


def main():
    options = arguments()
    rows = [measure(case, build, options) for case, build in CASES.items()]
    title = f"Skipped work, house {options.house}, {options.steps} steps, CPU time [s]"
    publish(options.out, "skips", title, HEADS, rows)


run_script(main)
