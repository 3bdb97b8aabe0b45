# SPDX-License-Identifier: GPL-2.0-or-later
"""What is skipped because a scene does not need it: time with and without each skip, and whether the result stays the same.

    yade -j1 -n -x scripts/bench/benchmark_skips.py [--house C2] [--steps 2000] [--rounds 3] [--out FOLDER]

CPU time; with and without in turns, each in a scene built anew. The same result: the largest distance between the elements' places
at the end. Candidates kept between steps are measured by benchmark_peers.py ('nothing cached').
"""
import argparse
import statistics
import sys
import time
from pathlib import Path

import numpy as np
import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import machine, markdown_table, publish  # noqa: E402
import yade_timber as yt  # noqa: E402
from yade_timber.scene import scenario  # noqa: E402
from yade_timber.scene import engines as scene  # noqa: E402
from yade_timber.recording.frames import steps_between  # noqa: E402
from yade_timber.motion import GroundMotion, default_motion  # noqa: E402
from yade_timber.run.recorder import Recorder  # noqa: E402

O = yw.Omega()

RESTING = 10.0
"""Simulated time of the scene at rest [s]."""
STRONG = 18.5
"""Where in the ground motion the shaken scenes begin [s]."""
HEADS = ("what is skipped", "scene", "with the skip", "without", "gain", "largest distance of places [m]")


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark_skips.py", description=__doc__.splitlines()[0])
    parser.add_argument("--house", default="C2", help="shipped house or YAML file (default %(default)s)")
    parser.add_argument("--steps", type=int, default=2000, help="steps of the shaken scenes (default %(default)s)")
    parser.add_argument("--rounds", type=int, default=3, help="rounds; medians count (default %(default)s)")
    parser.add_argument("--out", type=Path, help="folder whose performance.md and skips.csv get the result")
    return parser.parse_args()


# --- scenes: each returns what is timed, with or without the skip --------------------------------------------------------
def shaken(options, snow_depth=1.0, **changes):
    """The house in strong shaking."""
    scenario.build(scenario.Scenario("skips", options.house, default_motion(), snow_depth, options={"skip_rest": 0, **changes}))
    scene.find_engine(yw.GroundMotionEngine).start = -STRONG
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


def energies(options, skip):
    return shaken(options, track_energy=not skip)


def joints(options, skip):
    """The scene without its joints, but for the engine that would ask each of them."""
    run = shaken(options)
    for joint in scene.find_engine(yw.JointEngine).joints:
        joint.broken = [1] * len(joint.broken)
    if skip:
        O.engines = [e for e in O.engines if not isinstance(e, yw.JointEngine)]
    return run


def snow(options, skip):
    """The house without snow."""
    run = shaken(options, snow_depth=0.0)
    if skip:
        loop = next(e for e in O.engines if isinstance(e, yw.ContactLoop))
        for dispatcher in (loop.loop.physDispatcher, loop.loop.lawDispatcher):
            dispatcher.functors = [f for f in dispatcher.functors if "Snow" not in type(f).__name__]
    return run


def motion(options, skip):
    """The house on still ground, without the engine of ground motion or with one that has nothing but zeros."""
    zeros = None if skip else GroundMotion(0.01, np.zeros((1000, 3)))
    scenario.build(scenario.Scenario("skips", options.house, zeros, options={"skip_rest": 0}))
    return lambda: O.run(options.steps, True)


def frames(options, skip):
    """What a run script does besides, unless it is called with --no-frames."""
    case = scenario.Scenario("skips", options.house, default_motion(), 1.0, options={"skip_rest": 0})
    model = scenario.build(case)
    scene.find_engine(yw.GroundMotionEngine).start = -STRONG
    recorder = None if skip else Recorder(case, model, "skips")

    def run():
        for _ in range(options.steps // steps_between(O.dt)):
            O.run(steps_between(O.dt), True)
            if recorder:
                recorder.take(O.time)

    return run


def fixed(options, skip):
    """Two hundred blocks in a row, a millimetre apart, which nothing pushes: fixed, or free to move."""
    O.reset()
    O.bodies.append([yt.box((0.1, 0.1, 0.1), (0.101 * k, 0, 0), fixed=skip) for k in range(200)])
    O.engines = yt.engines(gravity=(0, 0, 0))
    O.dt = scenario.DEFAULT_DT
    return lambda: O.run(options.steps, True)


CASES = {  # words, scene -> build
    ("rest: grains of steps while the house rests and the ground is quiet", f"at rest under snow, {RESTING:g} s"): rest,
    ("the collider, until a body may have left its box, and with it YADE's dispatch", "strong shaking, snow"): collider,
    ("pairs that cannot touch, and YADE's dispatch", "strong shaking, snow"): pairs,
    ("energies that nobody asks for", "strong shaking, snow"): energies,
    ("the engine of joints, where all are broken", "strong shaking, snow, no joints"): joints,
    ("fixed bodies: neither moved nor paired", "200 blocks side by side"): fixed,
    ("functors of snow (they stay: YADE ends the process where a pair of materials has none)", "strong shaking, no snow"): snow,
    ("the ground motion, where there is none", "still ground, no snow"): motion,
    ("recorded frames that nobody asks for", "strong shaking, snow"): frames,
}


# --- runs ----------------------------------------------------------------------------------------------------------------
def timed(build, options, skip):
    """(CPU time of the run [s], places of all bodies at its end [m])."""
    run = build(options, skip)
    since = time.process_time()
    run()
    return time.process_time() - since, np.array([list(b.state.pos) for b in O.bodies])


def measure(words, build, options):
    """A row of the table, times in seconds."""
    seen = {True: [], False: []}
    for _ in range(options.rounds):
        for skip in seen:
            seen[skip].append(timed(build, options, skip))
    spent = {skip: statistics.median(t for t, _ in runs) for skip, runs in seen.items()}
    distance = np.abs(seen[True][0][1] - seen[False][0][1]).max()
    return (*words, spent[True], spent[False], spent[False] / spent[True], distance)


def section(options, rows):
    shown = [(*row[:2], f"{row[2]:.2f} s", f"{row[3]:.2f} s", f"{row[4]:.2f}", f"{row[5]:.1g}") for row in rows]
    return (
        f"## What is skipped\n\nHouse {options.house}, CPU time of {options.steps} steps or of the time named, medians of {options.rounds} runs in turns. {machine()}. "
        f"What is kept between steps for a pair (candidates) is in the next table: 'nothing cached'.\n\n{markdown_table(HEADS, shown)}"
    )


def main():
    options = arguments()
    rows = [measure(words, build, options) for words, build in CASES.items()]
    publish(options.out, "skips", section(options, rows), HEADS, rows)


main()
