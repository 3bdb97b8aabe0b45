# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 4: yielding joints (law slip): loops, pinching, energy to failure, an oscillator that yields. Without contact
and gravity.

A spring yields at F = 3 kN and y = F / k = 3 mm; its strength falls from 8 mm to zero at 20 mm. With values per joint,
each of the n springs has 1/n of stiffness and strength: the joint as a whole follows the same curve.
"""
import numpy as np
import yade_timber as yt
from cases import O, steps
from joint_cases import HEAVY, PULLS, joined
from rows import Registry, Row, series
from yade.minieigenHP import Vector3

case = Registry()
STIFFNESS, STRENGTH, SOFTENING, ULTIMATE, SHARE = 1e6, 3000.0, 0.008, 0.02, 0.3
"""k [N/m], F [N], d_c [m], d_u [m], friction share [-]."""
LIMIT = STRENGTH / STIFFNESS
"""Elastic limit y. [m]"""
SPEED = 0.1
"""[m/s]"""
SPRINGS = {"spring": 4, "joint": 1}
"""Number of springs with the values given. [-]"""


def yielding(dt, per="spring", share=SHARE, **options):
    """A column above a beam, with a yielding joint between them."""
    slip = yt.SlipLaw(SOFTENING, ULTIMATE, share)
    return joined(dt, (STIFFNESS, STIFFNESS), STRENGTH, per, slip=slip, **options)


def backbone(stretch):
    """Force of a spring at first loading [N]."""
    strength = STRENGTH if stretch <= SOFTENING else STRENGTH * max(0.0, (ULTIMATE - stretch) / (ULTIMATE - SOFTENING))
    return min(STIFFNESS * stretch, strength)


def cycle(turns, per="spring", dt=1e-4, share=SHARE, direction=(0, 0, 1)):
    """A fixed beam and a column led to these stretches one after the other [m]: (m, 3) stretch along the direction [m],
    force of the joint [N] and dissipated energy [J] of each step."""
    _, column, joint = yielding(dt, per, share, density=HEAVY, fixed=True)
    engine, along = O.engines[1], Vector3(*direction)

    def probe():
        return joint.stretches[0].dot(along), sum(joint.forces, Vector3.Zero).dot(along), engine.yielded

    rows, here = [], 0.0
    for there in turns:
        column.state.vel = np.sign(there - here) * SPEED * along
        rows.append(steps(round(abs(there - here) / SPEED / dt), probe))
        here = there
    return np.vstack(rows)


def work(rows):
    """Work of the forces over the steps, trapezoidal rule [J]."""
    return float(((rows[1:, 1] + rows[:-1, 1]) / 2 * np.diff(rows[:, 0])).sum())


@case
def loop_area():
    """Steady cycles of amplitude a, on the plateau and softened: area of the loop 4 phi F g (a - F g / k), from the
    friction part alone.

    Turning points and kinks lie on steps. What remains is the recoil of the column of 1.6e10 kg: 1e-8 m in the cycle.
    """
    rows, dt = [], 1e-4
    for per, count in SPRINGS.items():
        for a in (0.006, 0.014):
            path = cycle((a, -a, a, -a, a), per, dt)
            cut = round(a / SPEED / dt) + round(2 * a / SPEED / dt)
            loop = path[cut : cut + round(4 * a / SPEED / dt) + 1]
            limit = backbone(a) / STIFFNESS
            area = count * 4 * SHARE * backbone(a) * (a - limit)
            name = f"yielding joint, per {per}, steady cycle of {1000 * a:g} mm"
            rows.append(Row("4", f"{name}: area of the loop [J]", area, work(loop), bound=1e-6, dt=dt,
                            note="recoil of the column"))
            rows.append(Row("4", f"{name}: energy dissipated [J]", area, loop[-1, 2] - loop[0, 2], bound=1e-6, dt=dt,
                            note="recoil of the column"))
    return rows


@case
def pinching():
    """From a = 14 mm back through the slack to -a and to a again. Slip part: k (|d| - s) beyond the slack s = a - F g /
    k, else 0. Friction part:
    a parallelogram. Largest difference of the joint's force from their sum, over F: the recoil of the column, 1e-8 m of
    3 mm.
    """
    a, dt = 0.014, 1e-4
    force, rows = backbone(a), []
    limit, slack = force / STIFFNESS, a - force / STIFFNESS
    for share in (0.0, SHARE, 1.0):
        path = cycle((a, -a, a), share=share, dt=dt)[round(a / SPEED / dt) :]
        half = round(2 * a / SPEED / dt)
        off = 0.0
        for k, (stretch, got, _) in enumerate(path):
            back = 1 if k <= half else -1
            friction = -back * force if back * stretch < a - 2 * limit else back * (
                force - STIFFNESS * (a - back * stretch)
            )
            slip = np.sign(stretch) * STIFFNESS * max(0.0, abs(stretch) - slack)
            off = max(off, abs(got / 4 - share * friction - (1 - share) * slip))
        rows.append(Row("4", f"yielding joint, friction share {share:g}, pinching path: largest error / F [-]", 0,
                        off / STRENGTH, bound=1e-5, dt=dt, note="recoil of the column"))
    return rows


@case
def energy_to_failure():
    """Tension, compression and shear to the ultimate stretch: F (d_c + d_u) / 2 - F^2 / 2k for each spring, no energy
    left to release.

    The springs break in the first step beyond d_u: the stretch is too large by at most 10 um of 20 mm. The dissipated
    energy is exact for steps of any length; the trapezoidal work is off by k step^2 / 8 = 1e-5 J at each of two kinks.
    """
    rows, dt = [], 1e-4
    area = STRENGTH * (SOFTENING + ULTIMATE) / 2 - STRENGTH**2 / (2 * STIFFNESS)
    for per, count in SPRINGS.items():
        for cause, direction in PULLS.items():
            _, column, joint = yielding(dt, per, density=HEAVY, fixed=True)
            start, column.state.vel, engine = column.state.pos, SPEED * Vector3(*direction), O.engines[1]
            done, before = 0.0, np.zeros(2)
            while not joint.isBroken:
                stretch = (column.state.pos - start).norm()
                O.step()
                now = np.array((stretch, sum(f.norm() for f in joint.forces)))
                done, before = done + (now[1] + before[1]) / 2 * (now[0] - before[0]), now
            assert [b.cause for b in engine.breaks] == [cause] * 4, engine.breaks
            name = f"yielding joint, {cause} to failure, per {per}"
            rows += [
                Row("4", f"{name}: stretch [m]", ULTIMATE, stretch, bound=5.1e-4, dt=dt,
                    note="displacement in one step"),
                Row("4", f"{name}: energy dissipated [J]", count * area, engine.yielded, bound=1e-12, dt=dt,
                    note="rounding"),
                Row("4", f"{name}: work of the forces [J]", count * area, done, bound=1e-5, dt=dt,
                    note="kinks within a step"),
                Row("4", f"{name}: energy released [J]", 0, engine.released, bound=0, dt=dt, note="exact"),
            ]
    return rows


def oscillate(dt, speed, duration=0.5):
    """A column above a fixed beam starts at `speed` [m/s] with unstretched springs: (largest stretch [m], largest
    residual over the energy [-], share of the energy that is dissipated [-])."""
    _, column, joint = yielding(dt, fixed=True)
    yt.set_velocity(column, (0, 0, speed))
    start = column.state.mass * speed**2 / 2
    residuals = steps(round(duration / dt), lambda: yt.energy_residual())
    return max(joint.largestStretches), abs(residuals).max() / start, yt.energy()["joint_yield"] / start


@case
def oscillator_that_yields():
    """Largest stretch: m v^2 / 2 = 4 (F y / 2 + F (R - y)), before the strength falls. The energy balance closes with
    the second order of the trapezoidal rule; kinks lie at any fraction of a step, so that single residuals scatter
    about the order.
    """
    dts, rows, speed = (2e-4, 1e-4, 5e-5, 2.5e-5), [], 4.5
    runs = [oscillate(dt, speed) for dt in dts]
    mass = yielding(1e-4)[1].state.mass
    stretch = LIMIT / 2 + mass * speed**2 / (8 * STRENGTH)
    assert LIMIT < stretch < SOFTENING, stretch
    rows += series("4", "oscillator that yields: largest stretch [m]", stretch, [run[0] for run in runs], dts, 1e-3,
                   note="leapfrog")
    rows += series("4", "oscillator that yields: residual / energy [-]", 0, [run[1] for run in runs], dts, 1e-3, 1.0,
                   note="leapfrog; kinks within a step")
    rows.append(Row("4", "oscillator that yields: share of the energy dissipated (> 0.5) [-]", 1,
                    float(runs[-1][2] > 0.5), bound=0))
    return rows
