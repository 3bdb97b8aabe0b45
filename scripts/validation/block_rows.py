# SPDX-License-Identifier: GPL-2.0-or-later
"""Speed of the wave along rows of 40 falling blocks, beside the theory of rigid blocks (row_of_blocks.py).

    yade -n -x scripts/validation/block_rows.py [--out docs/validation] [--dt S]

Blocks turn about their front foot edges, which are joined to the base: no slip. They have no friction, and a damping
ratio that leaves no bounce.
Writes block_rows.csv and block_rows.png.
"""
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np
import yade.wrapper as yw
from matplotlib import pyplot

sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))  # YADE runs a script without setting __file__

import yade_timber as yt
from row_of_blocks import Row, touch_times, wave_speed
from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.table import csv_text
from timber_houses.study.options import Parser, positive, results_folder, run_script

O = yw.Omega()

HEIGHT, WIDTH, THICKNESS = 0.048, 0.024, 0.0075
"""Of a block; width across the row. [m]"""
PITCHES = (0.0149, 0.016, 0.02235, 0.0298)
"""[m]"""
NUMBER, LAST = 40, 10
"""Blocks of a row, and blocks at its end over which the speed is taken."""
DENSITY = 1040.0
"""[kg/m3]"""
FIRST_VELOCITY = 6.0
"""Of the first block at the start [rad/s]; the speed at the end of the row does not depend on it."""
RADIUS = 1e-4
"""Rounding of the edges: small beside the thickness, as the theory has sharp edges. [m]"""
HINGE_STIFFNESS = 1e6
"""Of each end of a foot edge [N/m]: it yields by micrometres."""
DAMPING_RATIO = 10.0
"""Of contacts: restitution 0.002 (docs/theory.md, section 5). [-]"""
DT = 1e-5
"""[s]"""


def place_block(row, number, material):
    """Append a block, numbered from 0; its upright front foot edge is at x = pitch * number. Returns its id."""
    centre = (number * row.pitch - row.thickness / 2, 0, row.height / 2)
    return O.bodies.append(yt.box((row.thickness, WIDTH, row.height), centre, material=material, radius=RADIUS))


def place_row(row, dt=DT):
    """Empty YADE and build the row. Returns the ids of the blocks."""
    O.reset()
    material = yt.timber(density=DENSITY, friction=0)
    length = row.number * row.pitch + row.height
    size, centre = (length + row.height, 2 * WIDTH, 0.01), (length / 2 - row.height, 0, -0.005)
    base = O.bodies.append(yt.box(size, centre, material=material, fixed=True))
    blocks = [place_block(row, number, material) for number in range(row.number)]
    O.engines = yt.engines(gravity=(0, 0, -row.gravity), damping_ratio=DAMPING_RATIO)
    O.dt = dt
    for number, block in enumerate(blocks):
        ends = [(number * row.pitch, y, 0) for y in (-WIDTH / 2, WIDTH / 2)]
        yt.connect(base, block, ends, stiffness=(HINGE_STIFFNESS, HINGE_STIFFNESS), strength=math.inf, damping_ratio=1)
    spin = row.first_velocity
    yt.set_velocity(O.bodies[blocks[0]], (spin * row.height / 2, 0, spin * row.thickness / 2), (0, spin, 0))
    return blocks


def angle(block, start):
    """Rotation about y, forwards, since the orientation `start`. [rad]"""
    turn = O.bodies[block].state.ori * start.conjugate()
    return 2 * math.atan2(turn[1], turn[3])


def measured_touch_times(row, dt=DT, sampling=1e-4):
    """Time at which each block reaches the touch angle, interpolated between samples; sampling: between them. [s]

    Raises RuntimeError if the wave stops.
    """
    blocks = place_row(row, dt)
    upright = [O.bodies[block].state.ori for block in blocks]
    steps, last = max(1, round(sampling / dt)), 3 * touch_times(row)[-1]
    times, before = [], [0.0] * row.number
    while len(times) < row.number:
        if O.time > last:
            raise RuntimeError(f"row of blocks: {len(times)} of {row.number} blocks fell within {last:.2f} s")
        for _ in range(steps):
            O.step()  # O.run waits for its end in naps of some 40 ms
        foremost = len(times)
        now = [angle(block, start) for block, start in zip(blocks[foremost:foremost + 2], upright[foremost:])]
        if now[0] >= row.touch_angle:
            times.append(O.time - steps * dt * (now[0] - row.touch_angle) / (now[0] - before[foremost]))
        before[foremost:foremost + len(now)] = now
    return np.array(times)


def compare(pitch, dt):
    """(row of the table: speeds of theory and package, [touch times of theory, of package])."""
    row = Row(HEIGHT, THICKNESS, pitch, NUMBER, FIRST_VELOCITY)
    times = touch_times(row), measured_touch_times(row, dt)
    expected, got = (wave_speed(pitch, each, LAST) for each in times)
    line = {"pitch_m": pitch, "theory_m_s": expected, "package_m_s": got, "difference": got / expected - 1, "dt_s": dt,
            "energy_residual": yt.energy_residual()}
    print(", ".join(f"{name} {value:.5g}" for name, value in line.items()), flush=True)
    return line, times


def draw(rows, path):
    """Speed from block to block along the rows. rows: [(pitch, times)]"""
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2), layout="constrained")
    for pitch, (theory, package) in rows:
        line, = axes.plot(np.arange(2, len(theory) + 1), pitch / np.diff(theory), label=f"pitch {1e3 * pitch:g} mm")
        axes.plot(np.arange(2, len(package) + 1), pitch / np.diff(package), "o", ms=3, color=line.get_color())
    axes.set(xlabel="block", ylabel="speed of the wave [m/s]", ylim=(0, None))
    axes.set_title("lines: rigid blocks in theory; points: package")
    axes.legend()
    with written_whole(path) as part:
        figure.savefig(part, dpi=130)


def main():
    options = Parser(__doc__)
    options.add_argument("--out", type=results_folder, default=Path("results/validation"), metavar="DIR",
                         help="folder of the table (default %(default)s)")
    options.add_argument("--dt", type=positive, default=DT, metavar="S", help="time step [s] (default %(default)g)")
    given = options.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    lines, rows = [], []
    for pitch in PITCHES:
        line, times = compare(pitch, given.dt)
        lines.append([f"{value:.5g}" for value in line.values()])
        rows.append((pitch, times))
    write_text(given.out / "block_rows.csv", csv_text(list(line), lines))
    draw(rows, given.out / "block_rows.png")
    print(f"written: {given.out}/block_rows.csv, block_rows.png")


if __name__ == "__main__":
    run_script(main)
