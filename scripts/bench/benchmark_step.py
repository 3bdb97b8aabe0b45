# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of a complete step of a house against an empty YADE step with the same bodies, in one process.

    yade -j1 -n -x scripts/bench/benchmark_step.py [--house C2] [--blocks 15] [--steps 300] [--out FOLDER]

The empty step has ForceResetter, InsertionSortCollider, InteractionLoop without functors and NewtonIntegrator. Both are
measured alternately, in CPU time of the process (with several threads: wall time), with the house at rest and in strong
shaking. At rest they are also measured with RestSkipper, as in runs.
"""
import sys
import time
from pathlib import Path

import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import SETTLING, STATES, cpu_per_step, interleaved, parser, publish, wall_per_step
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines
from timber_houses.study.options import run_script

SNOW = 1.0
"""Depth [m]."""
NO_MARGIN = 1e-9
"""Of boxes that the collider extends. [m]"""
O = yw.Omega()

EMPTY, HOUSE = "empty step", "whole step"
SKIPPED = "at rest, as in runs (RestSkipper)"
REST = 8.0
"""Simulated time until RestSkipper skips steps [s]."""
STRIDES = 100
"""Strides of RestSkipper in a block. The last one, in which YADE stops, is not skipped."""
QUIET = -1e3
"""Start of the run long before the ground motion [s]."""
HEADS = ("state", "bodies", "interactions", "contact points", "empty step [us]", "whole step [us]", "ratio")


def arguments():
    return parser(__doc__, blocks=15, steps=300).parse_args()


def build_house(options, start, skipping):
    """The house in the current scene, `start` seconds into the ground motion, settled."""
    scenario.build(scenario.Scenario("step", options.house, default_motion(), SNOW, dt=DEFAULT_DT,
                                     options={} if skipping else {"skip_rest": 0}))
    engines.find_engine(yw.GroundMotionEngine).start = -start
    O.run(round((REST if skipping else SETTLING) / DEFAULT_DT), True)


def bodies_now():
    """Properties of all bodies: [(shape, material, position, orientation, mass, inertia, dynamic)]."""
    return [(b.shape, b.material, b.state.pos, b.state.ori, b.state.mass, b.state.inertia, b.dynamic) for b in O.bodies]


def build_empty(placed):
    """The same bodies in the current scene, with the engines of an empty step."""
    for shape, material, position, orientation, mass, inertia, dynamic in placed:
        body = yw.Body()
        body.shape, body.material, body.bound, body.aspherical = shape, material, yw.Aabb(), True
        body.state.mass, body.state.inertia, body.state.pos, body.state.ori = mass, inertia, position, orientation
        body.dynamic = dynamic
        O.bodies.append(body)
    collider = yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb(margin=NO_MARGIN)],
                                        verletDist=engines.BOUND_MARGIN)
    O.engines = [yw.ForceResetter(), collider, yw.InteractionLoop([], [], []),
                 yw.NewtonIntegrator(damping=0, exactAsphericalRot=True)]
    O.dt = DEFAULT_DT
    O.step()


def in_scene(number, per_step, steps):
    """A function that measures a block of steps in one of YADE's scenes."""

    def measure():
        O.switchToScene(number)
        return per_step(steps)

    return measure


def skipping_per_step(steps):
    """CPU time per step of a run with RestSkipper [s]."""
    since = time.process_time()
    O.run(steps, True)
    return (time.process_time() - since) / steps


def measure(options, name, start, skipping=False):
    """One row of the table: a state of the house."""
    O.reset()
    build_house(options, start, skipping)
    skipper = engines.find_engine(yw.RestSkipper)
    placed = bodies_now()
    scenes = {HOUSE: 0, EMPTY: O.addScene()}
    O.switchToScene(scenes[EMPTY])
    build_empty(placed)
    per_step = cpu_per_step if O.numThreads == 1 else wall_per_step
    calls = {kind: in_scene(number, per_step, options.steps) for kind, number in scenes.items()}
    if skipping:
        calls[HOUSE] = in_scene(scenes[HOUSE], skipping_per_step, STRIDES * skipper.stride)
        skipped = skipper.skipped
    times = interleaved(calls.items(), options.blocks)
    if skipping and skipper.skipped - skipped < 0.98 * options.blocks * STRIDES * (skipper.stride - 1) * DEFAULT_DT:
        raise RunError("the house was not at rest")
    O.switchToScene(scenes[HOUSE])
    points = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    return (name, len(placed), O.interactions.countReal(), points, times[EMPTY] * 1e6, times[HOUSE] * 1e6,
            times[HOUSE] / times[EMPTY])


def main():
    options = arguments()
    rows = [measure(options, name, start) for name, start in STATES.items()]
    rows.append(measure(options, SKIPPED, QUIET, skipping=True))
    title = f"Step of house {options.house} with {SNOW:g} m of snow, medians of {options.blocks} blocks"
    publish(options.out, "step", title, HEADS, rows)


run_script(main)
