# SPDX-License-Identifier: GPL-2.0-or-later
"""The three-storey house UBC3S under JMA Kobe, beside the independent program PB3D.

    yade -n -x scripts/validation/ubc3s.py --record NS_FILE,EW_FILE [--scales 0.5,1] [--end 18]
        [--out results/validation]

House: ubc3s.yaml. PB3D's values: docs/validation/ubc3s_reference.csv, which states motion and damping. Both drifts are
displacements of a floor's centre against that below, in mm; corners are those of the slab of 7.28 m between the outer
grid lines. The base shear is the change of momentum of all free members less the force of the ground motion, over
SAMPLE. The record is not shipped; of the reference it is the part from START to END, without vertical motion, and QUIET
after it. With an earlier end there are no residual drifts.
"""
import csv
import dataclasses
import sys
from pathlib import Path

import numpy as np

import timber_houses as th
import yade_timber as yt
from yade import O
from yade_timber.scene.engines import find_engine
from timber_houses.base.atomic_write import write_text
from timber_houses.base.joint_kinds import WALL_KINDS
from timber_houses.base.table import csv_text
from timber_houses.scene import scenario
from timber_houses.study.options import Parser, results_folder, run_script

START, END, QUIET = 4.0, 30.0, 3.0
"""[s]"""
SAMPLE, RESIDUAL = 0.01, 2.0
"""Interval of samples, and time at the end over which residual drifts are averaged. [s]"""
OMEGA = 2 * np.pi / 0.30
MASS_DAMPING, DAMPING_TIME = 1.5 * 0.02 * OMEGA, 0.5 * 0.02 / OMEGA
"""Rayleigh damping of PB3D, 2 % at 0.30 s: of masses [1/s], three quarters of it; of the tangent stiffness [s]."""
HALF = 3.64
"""Of the distance of the outer grid lines. [m]"""
DIRECTIONS = {"ew": 0, "ns": 1}
STOREYS = (1, 2, 3)
KEYS = ("peak_centre_mm", "peak_corner_mm", "residual_mm", "base_shear_kn")
REFERENCE = Path(sys.argv[0]).resolve().parents[2] / "docs" / "validation" / "ubc3s_reference.csv"


def motion_of(record, end):
    """The part of a record that the reference has, up to `end` [s], without its vertical component."""
    motion = th.motion(record, start=START, end=end)
    return dataclasses.replace(motion, acceleration=motion.acceleration * (1, 1, 0))


class Sampler:
    """Displacements of the slabs and the base shear of a scene."""

    def __init__(self, model, motion, scale):
        ids = {element.name: k for k, element in enumerate(model.elements)}
        slabs = [next(e for e in model.of_kind("floor") if e.storey == storey) for storey in STOREYS]
        self.bodies = [O.bodies[ids[slab.name]] for slab in slabs]
        self.free = [b for b in O.bodies if b.dynamic]
        self.mass = np.array([b.state.mass for b in self.free])
        self.motion, self.scale = motion, scale
        self.rows, self.shears, self.last = [], [], self._momentum()

    def _momentum(self):
        return self.mass @ np.array([tuple(b.state.vel)[:2] for b in self.free])

    def sample(self):
        places = [self._place(b) for b in self.bodies]
        self.rows.append(np.diff(np.vstack([np.zeros(3), places]), axis=0))
        momentum = self._momentum()
        time = O.time - SAMPLE + np.arange(0.05, 1, 0.1) * SAMPLE
        axis = self.motion.dt * np.arange(len(self.motion.acceleration))
        ground = [np.interp(time, axis, self.scale * self.motion.acceleration[:, k], right=0).mean() for k in (0, 1)]
        self.shears.append((momentum - self.last) / SAMPLE + self.mass.sum() * np.array(ground))
        self.last = momentum

    def damp(self, rate):
        """Impulses of dashpots between masses and ground over SAMPLE, which are in no base shear. rate: [1/s]"""
        left = np.exp(-rate * SAMPLE)
        for body in self.free:
            x, y, z = body.state.vel
            body.state.vel = (left * x, left * y, z)
            wx, wy, wz = body.state.angVel
            body.state.angVel = (wx, wy, left * wz)
        self.last = self._momentum()

    @staticmethod
    def _place(body):
        """Displacement east and north of a slab's centre [m], and its rotation about the vertical [rad]."""
        moved = body.state.pos - body.state.refPos
        turned = (body.state.ori * body.state.refOri.conjugate()).toRotationMatrix()
        return moved[0], moved[1], np.arctan2(turned[1, 0], turned[0, 0])

    def table(self, scale, is_whole):
        """Rows of the study's table, in mm and kN. is_whole: with residual drifts"""
        drifts, shears = 1e3 * np.array(self.rows), np.abs(self.shears).max(0) / 1e3
        last = round(RESIDUAL / SAMPLE)
        for storey in STOREYS:
            for name, axis in DIRECTIONS.items():
                centre, turn = drifts[:, storey - 1, axis], drifts[:, storey - 1, 2]
                corner = np.abs(np.concatenate([centre + HALF * turn, centre - HALF * turn])).max()
                shear = shears[axis] if storey == 1 else np.nan
                residual = centre[-last:].mean() if is_whole else np.nan
                yield (scale, storey, name), (np.abs(centre).max(), corner, residual, shear)


def damp_as_pb3d():
    """Dashpots of the walls alone, DAMPING_TIME times their tangent stiffness; Sampler.damp() has those of masses."""
    for joint in find_engine(yt.JointEngine).joints:
        if joint.kind in WALL_KINDS:
            joint.dampingTime = DAMPING_TIME


def run(scale, record, house, dt, damping, end):
    """Rows of a run at a factor on the record. damping: ratio of the sway [-]; None: as PB3D"""
    motion = motion_of(record, end)
    model = scenario.build(scenario.Scenario("ubc3s", house, motion=motion, scale=scale, dt=dt, duration=end - START,
                                             joint_damping=damping or 0.0))
    if damping is None:
        damp_as_pb3d()
    sampler, steps = Sampler(model, motion, scale), round(SAMPLE / dt)
    for _ in range(round((end - START + (QUIET if end == END else 0)) / SAMPLE)):
        O.run(steps, True)
        sampler.sample()
        if damping is None:
            sampler.damp(MASS_DAMPING)
    return list(sampler.table(scale, end == END))


def reference():
    """{(scale, storey, direction): values of KEYS} of PB3D."""
    lines = [line for line in REFERENCE.read_text().splitlines() if not line.startswith("#")]
    return {(float(row["scale"]), int(row["storey"]), row["direction"]): [float(row[key] or "nan") for key in KEYS]
            for row in csv.DictReader(lines)}


def text(value):
    return "" if np.isnan(value) else f"{value:.1f}"


def lines_of(rows):
    """Lines of the table: each value of the package, that of PB3D, and the ratio of the peak drifts of centres."""
    known = reference()
    for key, values in rows:
        other = known.get(key, [np.nan] * len(KEYS))
        pairs = [text(value) for pair in zip(values, other) for value in pair]
        ratio = values[0] / other[0]
        yield [f"{key[0]:g}", key[1], key[2], *pairs, "" if np.isnan(ratio) else f"{ratio:.2f}"]


def main():
    options = Parser(__doc__)
    options.add_argument("--record", required=True, metavar="NS,EW", help="the two files of the record")
    options.add_argument("--scales", default="0.5,1", metavar="X,...", help="factors on it (default %(default)s)")
    options.add_argument("--house", default="ubc3s", help="house file (default %(default)s)")
    options.add_argument("--dt", type=float, default=2e-4, metavar="S", help="time step [s] (default %(default)s)")
    options.add_argument("--damping", type=float, metavar="RATIO", help="of the sway (default: dashpots of PB3D) [-]")
    options.add_argument("--end", type=float, default=END, metavar="S", help="of the record [s] (default %(default)g)")
    options.add_argument("--out", type=results_folder, default=Path("results/validation"), metavar="DIR",
                         help="folder of the table (default %(default)s)")
    given = options.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    heads = ["scale", "storey", "direction", *(f"{who}{key}" for key in KEYS for who in ("", "pb3d_")), "ratio"]
    rows = []
    for scale in map(float, given.scales.split(",")):
        rows += run(scale, given.record, given.house, given.dt, given.damping, given.end)
        table = csv_text(heads, list(lines_of(rows)))
        write_text(given.out / "ubc3s.csv", table)
    print(table)


if __name__ == "__main__":
    run_script(main)
