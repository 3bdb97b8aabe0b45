# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 1: impacts against Hertz's closed form and against the one-dimensional equation of motion.

A contact lasts some milliseconds: the impact at 1 m/s has 150 steps of 1e-5 s (the paper) or 15 steps of 1e-4 s.
"""
import numpy as np
import yade_timber as yt
from cases import DENSITY, hertz_constant, octahedron, scene, steps, turned
from rows import Registry, Row, series, worst
from scipy.integrate import solve_ivp
from scipy.special import beta
from yade.minieigenHP import Vector3

case = Registry()
HALF = 0.3
"""Half diagonal of the octahedron. [m]"""
DURATION = 2 * 0.4 * beta(0.4, 0.5)
"""t v / d of a Hertz impact: 2 int_0^1 dx / sqrt(1 - x^2.5) = 2.9433 [-]"""
SPEEDS = (0.01, 0.1, 1.0, 10.0)
"""[m/s]"""
UNITS = {"duration": "s", "overlap": "m", "force": "N", "restitution": "-"}

CORNER = HALF - (np.sqrt(3) - 1) * 0.1 * HALF * np.sqrt(2)
"""Distance of an octahedron's rounded corner from its centre: moving the faces in by r moves the corner by sqrt(3) r, r
= 10 % of an edge. [m]
"""


def edge(width):
    """Distance of a square bar's rounded edge from its centre: moving the faces in by r = width/10 moves the edge by
    sqrt(2) r. [m]
    """
    return width / np.sqrt(2) - (np.sqrt(2) - 1) * 0.1 * width


class Impact:
    """Central impact of two frictionless bodies along z.

    kind      'plate' (corner on a fixed plate), 'block' (corner on a free block), 'edges' (crossed edges of two free
    bars),
              'flat' (face on a fixed plate: four points at once)
    points    number of contact points
    mass      of Eq. 43 [kg]; constant: c of F = c n^1.5 at one point [N/m^1.5]
    touching  distance of the centres at which the rounded bodies begin to touch [m]
    """

    def __init__(self, kind):
        octahedral = 4 / 3 * HALF**3
        table = {
            "plate": (octahedral, 0.4, 0.1 + CORNER),
            "block": (octahedral, 0.36, 0.3 + CORNER),
            "edges": (0.2 * 0.2 * 0.6, 0.3 * 0.3 * 0.5, edge(0.3) + edge(0.2)),
            "flat": (0.4 * 0.3 * 0.2, 0.4, 0.2),
        }
        volume, other, self.touching = table[kind]
        self.kind, self.points = kind, 4 if kind == "flat" else 1
        masses = DENSITY * volume, DENSITY * other
        self.mass = masses[0] if kind in ("plate", "flat") else masses[0] * masses[1] / sum(masses)
        self.constant = hertz_constant(volume, other)

    def bodies(self, upper=None):
        smooth = yt.timber(friction=0)
        upper = upper or smooth
        if self.kind == "edges":
            low = yt.box((0.5, 0.3, 0.3), (0, 0, 0), turned((1, 0, 0), np.pi / 4), smooth)
            return low, yt.box((0.2, 0.6, 0.2), (0, 0, 2), turned((0, 1, 0), np.pi / 4), upper)
        if self.kind == "block":
            low = yt.box((1, 0.6, 0.6), (0, 0, 0), None, smooth)
        else:
            low = yt.box((2, 1, 0.2), (0, 0, 0), None, smooth, fixed=True)
        if self.kind == "flat":
            return low, yt.box((0.4, 0.3, 0.2), (0, 0, 2), None, upper)
        return low, octahedron(HALF, (0, 0, 2), material=upper)

    def closed_form(self, v):
        """Undamped: duration [s], overlap [m] and force at one point [N] at the peak, restitution [-]."""
        depth = (5 * self.mass * v**2 / (4 * self.points * self.constant)) ** 0.4
        return {"duration": DURATION * depth / v, "overlap": depth, "force": self.constant * depth**1.5,
                "restitution": 1.0}

    def run(self, v, dt, span, phase=0.3, upper=None, **options):
        """Impact at v [m/s] that lasts less than 3 span [s]: the same quantities as closed_form().

        phase: fraction of a step at which the contact begins.
        """
        gap = v * (int(0.1 * span / dt) + phase) * dt
        low, high = scene(self.bodies(upper), dt, gravity=(0, 0, 0), health_check=0, **options)
        high.state.pos, high.state.vel = Vector3(0, 0, self.touching + gap), Vector3(0, 0, -v)

        def probe():
            contacts = yt.contacts(0, 1)
            largest = max((c["normal_force"] for c in contacts), default=0.0)
            return self.touching - (high.state.pos - low.state.pos)[2], largest, len(contacts)

        overlap, force, count = steps(int(3.2 * span / dt), probe).T
        assert count.max() == self.points and count[-1] == 0, "unexpected number of contact points"
        out = (overlap[-2] -
               overlap[-1]) / dt  # free flight before and after: both ends of the contact are extrapolated
        separation = len(overlap) * dt + overlap[-1] / out
        return {"duration": separation - gap / v, "overlap": peak(overlap), "force": peak(force),
                "restitution": out / v}


def peak(samples):
    """Height of the parabola through the largest sample and its neighbours."""
    k = int(np.argmax(samples))
    a, b, c = samples[k - 1], samples[k], samples[k + 1]
    return b + (a - c) ** 2 / (8 * (2 * b - a - c))


def dashpot_restitution(power, points=1, ratio=1.0):
    """Restitution of m n'' = -points max(0, e_n + C n'), e_n ~ n^power, C = 2 ratio sqrt(m K_n), K_n = de_n/dn (Eqs.
    23, 37-41).

    Units in which m, v and the factor of the spring are 1; the coefficient does not depend on them (power = 1.5:
    Hertz). When the sum of spring and dashpot becomes tensile, the force is zero and the velocity constant.
    """

    def total(n, speed):
        n = max(n, 0.0)
        return n**power + 2 * ratio * np.sqrt(power * n ** (power - 1)) * speed

    def separated(t, y):
        return total(*y) if t > 1e-6 else 1.0

    separated.terminal, separated.direction = True, -1
    run = solve_ivp(lambda t, y: (y[1], -points * total(*y)), (0, 50), (0, 1), rtol=1e-12, atol=1e-14, events=separated,
                    method="DOP853")
    return -run.y_events[0][0][1]


@case
def hertz_three_decades():
    """Undamped, 200 steps per contact: the leapfrog error is (1/200)^2 / 2 = 1.3e-5 at any speed. Observed: 1.3e-5 to
    1.6e-5.
    """
    rows = []
    for kind in ("plate", "block", "edges", "flat"):
        impact = Impact(kind)
        expected = [impact.closed_form(v) for v in SPEEDS]
        got = [impact.run(v, e["duration"] / 200, e["duration"], damping_ratio=0) for v, e in zip(SPEEDS, expected)]
        for what in UNITS:
            pairs = [(e[what], g[what]) for e, g in zip(expected, got)]
            rows.append(worst("1", f"Hertz impact, {kind}, worst of 0.01-10 m/s: {what} [{UNITS[what]}]", pairs,
                              bound=3e-5, note="200 steps per contact; leapfrog error (dt/duration)^2 / 2"))
    return rows


def convergence(name, dts, bounds, least_order, note, **options):
    """Corner on a plate at 1 m/s, undamped: every quantity for several time steps."""
    impact = Impact("plate")
    expected = impact.closed_form(1.0)
    runs = [impact.run(1.0, dt, expected["duration"], damping_ratio=0, **options) for dt in dts]
    rows = []
    for what, bound in bounds.items():
        rows += series("1", f"Hertz impact, {name}: {what} [{UNITS[what]}]", expected[what], [r[what] for r in runs],
                       dts, bound, least_order, note=note)
    return rows


@case
def hertz_closed_form_converges():
    """Contact of 1.49 ms. Second order; observed at 1.25e-5 s: 3.5e-5, 2.9e-5, 4.4e-5."""
    bounds = {"duration": 5e-5, "overlap": 5e-5, "force": 8e-5}
    return convergence("closed form (Eq. 37)", (5e-5, 2.5e-5, 1.25e-5, 6.25e-6), bounds, 1.8, "leapfrog")


@case
def hertz_increment_form_converges():
    """First order: each step uses the stiffness at its end, too large in loading and too small in unloading, which adds
    energy.

    Observed at 1.25e-5 s: 8e-3, 1e-2, 1e-2, some 300 times the error of the closed form. At 1e-4 s the energy of the
    separating point bounds the error of the restitution.
    """
    bounds = {"duration": 0.012, "overlap": 0.015, "restitution": 0.015}
    return convergence("increment form (Eq. 38)", (5e-5, 2.5e-5, 1.25e-5), bounds, 0.7,
                       "stiffness at the end of the step", increment=True)


def worst_phase(impact, v, dt, span, expected, **options):
    """Restitution with the largest error of 8 fractions of a step at which the contact begins."""
    got = [impact.run(v, dt, span, phase=k / 8, **options)["restitution"] for k in range(8)]
    return max(got, key=lambda g: abs(g - expected))


@case
def restitution_with_the_papers_dashpot():
    """Critical dashpot: 0.1196 for one point and 0.0410 for four at any speed.

    The dashpot force begins with infinite slope (C ~ n^(1/4)), so that the error depends on the fraction of a step at
    which the contact begins: order 1.25, largest error 3e-4 (one point) and 7e-4 (four) with 1600 steps per undamped
    contact.
    """
    rows = []
    for kind in ("plate", "flat"):
        impact = Impact(kind)
        expected = dashpot_restitution(1.5, impact.points)
        pairs = []
        for v in SPEEDS:
            span = impact.closed_form(v)["duration"]
            pairs.append((expected, worst_phase(impact, v, span / 1600, span, expected)))
        rows.append(worst("1", f"restitution, critical dashpot, {kind}, worst of 0.01-10 m/s [-]", pairs, bound=1e-3,
                          note="scipy DOP853; 1600 steps per contact, worst of 8 phases"))
    return rows


@case
def restitution_converges():
    """One point at 1 m/s, undamped contact of 1.49 ms; explicit dashpots as in the paper (sweeps = 0), and implicit
    ones.
    """
    impact = Impact("plate")
    span, expected, dts = impact.closed_form(1.0)["duration"], dashpot_restitution(1.5), (
        2e-5, 1e-5, 5e-6, 2.5e-6, 1.25e-6
    )
    rows = []
    for name, sweeps, bound, least in (("implicit", 4, 1e-3, 1.0), ("explicit", 0, 6e-3, 0.7)):
        got = [worst_phase(impact, 1.0, dt, span, expected, sweeps=sweeps) for dt in dts]
        rows += series("1", f"restitution, critical dashpot, {name} [-]", expected, got, dts, bound, least,
                       note="scipy DOP853; worst of 8 phases of a step")
    return rows


def rebound(impact, v, dt, phase, **options):
    """Velocity after the impact over the one before; dt may exceed the contact's duration."""
    high = scene(impact.bodies(), dt, gravity=(0, 0, 0), health_check=0, **options)[1]
    high.state.pos, high.state.vel = Vector3(0, 0, impact.touching + v * (1 + phase) * dt), Vector3(0, 0, -v)
    return steps(int(3 * impact.closed_form(v)["duration"] / dt) + 10, lambda: high.state.vel[2])[-1] / v


@case
def restitution_of_short_contacts():
    """One point at 1 m/s, of which the undamped contact lasts 19 steps down to a fifth of one: the solver takes the
    velocity of separation from the closed form. Observed, for the worst of 8 phases: 8e-12, the tolerance of the
    independent solution.
    """
    impact, rows = Impact("plate"), []
    span = impact.closed_form(1.0)["duration"]
    for ratio in (1.0, 0.3):
        expected = dashpot_restitution(1.5, ratio=ratio)
        for count in (19, 10, 5, 2, 1, 0.5, 0.2):
            got = [rebound(impact, 1.0, span / count, k / 8, damping_ratio=ratio) for k in range(8)]
            name = f"restitution, damping ratio {ratio:g}, contact of {count:g} steps [-]"
            worst_one = max(got, key=lambda g: abs(g - expected))
            rows.append(Row("1", name, expected, worst_one, bound=1e-9, dt=span / count,
                            note="scipy DOP853; worst of 8 phases of a step"))
    return rows


@case
def snow_impact():
    """Linear law: half a period pi sqrt(m/K) and depth v sqrt(m/K) undamped; with the critical dashpot exp(-2), when
    spring and dashpot cancel at t = 2 sqrt(m/K).

    Undamped with 400 steps: leapfrog shortens the period by (w dt)^2 / 24 = 2.6e-6. Damped: C does not vanish at n = 0,
    so that the order is 1. Observed: 5e-4 for the worst phase.
    """
    impact, rate = Impact("plate"), np.sqrt(3.948e4)
    span, snow = np.pi / rate, yt.snow(friction=0)
    free = impact.run(1.0, span / 400, span, upper=snow, damping_ratio=0)
    rows = [Row("1", f"snow impact: {what} [{UNITS[what]}]", value, free[what], bound=1e-5, dt=span / 400,
                note="leapfrog") for what, value in (("duration", span), ("overlap", 1 / rate))]
    dts, expected = [span / 800 / 2**k for k in range(4)], np.exp(-2)
    got = [worst_phase(impact, 1.0, dt, span, expected, upper=snow) for dt in dts]
    return rows + series("1", "snow impact: restitution, critical dashpot [-]", expected, got, dts, 1e-3, 0.8,
                         note="closed form exp(-2); worst of 8 phases of a step")
