# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of a whole step of a house against an empty YADE step with the same bodies, in one process.

    yade -j1 -n -x scripts/bench/benchmark_step.py [--house C2] [--snow 1] [--blocks 15] [--steps 300] [--engines] [--out FOLDER]

The empty step has ForceResetter, InsertionSortCollider, InteractionLoop without functors and NewtonIntegrator. Both are timed in turns, in
CPU time of the process (with one thread: nothing else on the machine counts), in two states of the house: at rest, and in strong shaking; at
rest also as runs have it, with RestSkipper, which computes one step of each grain.
"""
import argparse
import sys
import time
from pathlib import Path

import yade.wrapper as yw

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

from bench_tools import SETTLING, STATES, cpu_per_step, interleaved, machine, markdown_table, publish, wall_per_step  # noqa: E402
from yade_timber.scene import scenario  # noqa: E402
from yade_timber.scene import engines as scene  # noqa: E402
from yade_timber.motion import default_motion  # noqa: E402

O = yw.Omega()

EMPTY, HOUSE, DEFAULT = "empty step", "whole step", "empty step, collider in each step"
SKIPPED = "at rest, as in runs (RestSkipper)"
REST = 4.0
"""Simulated time until RestSkipper skips [s]."""
GRAINS = 100
"""Of RestSkipper in a block. The last one, in which YADE stops, is not skipped."""
QUIET = -1e3
"""A start of the ground motion that lies far ahead [s]."""
HEADS = ("state", "bodies", "interactions", "contact points", "empty step [us]", "whole step [us]", "ratio", "empty, collider in each step [us]")


def arguments():
    parser = argparse.ArgumentParser(prog="benchmark_step.py", description=__doc__.splitlines()[0])
    parser.add_argument("--house", default="C2", help="shipped house or YAML file (default %(default)s)")
    parser.add_argument("--snow", type=float, default=1.0, metavar="M", help="snow depth [m] (default %(default)g)")
    parser.add_argument("--dt", type=float, default=scenario.DEFAULT_DT, metavar="S", help="time step [s] (default %(default)g)")
    parser.add_argument("--blocks", type=int, default=15, help="blocks of each kind (default %(default)s)")
    parser.add_argument("--steps", type=int, default=300, help="steps per block (default %(default)s)")
    parser.add_argument("--engines", action="store_true", help="also YADE's table of the time spent in each engine")
    parser.add_argument("--out", type=Path, help="folder whose performance.md and step.csv get the result")
    return parser.parse_args()


def build_house(options, start, skipping):
    """The house in the current scene, `start` seconds into the ground motion, settled."""
    scenario.build(scenario.Scenario("step", options.house, default_motion(), options.snow, dt=options.dt, options={} if skipping else {"skip_rest": 0}))
    scene.find_engine(yw.GroundMotionEngine).start = -start
    O.run(round((REST if skipping else SETTLING) / options.dt), True)


def bodies_now():
    """What a scene with the same bodies needs: [(shape, material, position, orientation, mass, inertia, dynamic)]."""
    return [(b.shape, b.material, b.state.pos, b.state.ori, b.state.mass, b.state.inertia, b.dynamic) for b in O.bodies]


def build_empty(placed, dt, verlet):
    """The same bodies in the current scene with the empty step; verlet: how far boxes are enlarged so that the collider may sleep [m]."""
    for shape, material, position, orientation, mass, inertia, dynamic in placed:
        body = yw.Body()
        body.shape, body.material, body.bound, body.aspherical = shape, material, yw.Aabb(), True
        body.state.mass, body.state.inertia, body.state.pos, body.state.ori = mass, inertia, position, orientation
        body.dynamic = dynamic
        O.bodies.append(body)
    collider = yw.InsertionSortCollider([yw.Bo1_RoundedPolyhedron_Aabb(margin=scene.BOUND_MARGIN if verlet == 0 else 0)], verletDist=verlet)
    O.engines = [yw.ForceResetter(), collider, yw.InteractionLoop([], [], []), yw.NewtonIntegrator(damping=0, exactAsphericalRot=True)]
    O.dt = dt
    O.step()


def in_scene(number, per_step, steps):
    """Time of a block of steps in one of YADE's scenes."""

    def measure():
        O.switchToScene(number)
        return per_step(steps)

    return measure


def skipping_per_step(steps):
    """CPU time per step of a run that may skip steps [s]."""
    since = time.process_time()
    O.run(steps, True)
    return (time.process_time() - since) / steps


def engine_table(steps):
    """YADE's own table of the present scene: what each engine takes of a step."""
    from yade import timing

    O.timingEnabled = True
    timing.reset()
    cpu_per_step(steps)
    timing.stats()
    O.timingEnabled = False


def measure(options, name, start, skipping=False):
    """One row of the table for one state of the house."""
    O.reset()
    build_house(options, start, skipping)
    skipper = scene.find_engine(yw.RestSkipper)
    placed = bodies_now()
    scenes = {HOUSE: 0}
    for kind, verlet in ((EMPTY, scene.BOUND_MARGIN), (DEFAULT, 0.0)):
        scenes[kind] = O.addScene()
        O.switchToScene(scenes[kind])
        build_empty(placed, options.dt, verlet)
    per_step = cpu_per_step if O.numThreads == 1 else wall_per_step
    calls = {kind: in_scene(number, per_step, options.steps) for kind, number in scenes.items()}
    if skipping:
        calls[HOUSE] = in_scene(scenes[HOUSE], skipping_per_step, GRAINS * skipper.stride)
        skipped = skipper.skipped
    times = interleaved(calls.items(), options.blocks)
    if skipping and skipper.skipped - skipped < 0.98 * options.blocks * GRAINS * (skipper.stride - 1) * options.dt:
        sys.exit("error: the house was not at rest")
    O.switchToScene(scenes[HOUSE])
    points = sum(len(i.geom.points) for i in O.interactions if i.isReal)
    if options.engines:
        print(f"\n{name}:")
        engine_table(options.steps)
    return name, len(placed), O.interactions.countReal(), points, times[EMPTY] * 1e6, times[HOUSE] * 1e6, times[HOUSE] / times[EMPTY], times[DEFAULT] * 1e6


def section(options, rows):
    """Text of the results page."""
    shown = [(r[0], r[1], r[2], r[3], f"{r[4]:.1f}", f"{r[5]:.1f}", f"{r[6]:.2f}", f"{r[7]:.1f}") for r in rows]
    return (
        f"## Whole step\n\nHouse {options.house}, {options.snow:g} m of snow, dt = {options.dt:g} s: median of {options.blocks} blocks of {options.steps} steps, "
        f"in turns. {machine()}.\n\n{markdown_table(HEADS, shown)}"
    )


def main():
    options = arguments()
    rows = [measure(options, name, start) for name, start in STATES.items()]
    rows.append(measure(options, SKIPPED, QUIET, skipping=True))
    publish(options.out, "step", section(options, rows), HEADS, rows)


main()
