# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 6: weight, equilibrium, arches and frames, against statics and the linear model of planar_frame.py.

At half the default time step: with the default, stacks and wedges keep 1e-8 J, as the sweeps end before they converge.
"""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from cases import G
from planar_frame import Frame, LinearFrame, Part, Tie, Timber, rectangle
from planar_scene import advance, append_parts, build_frame, positions, recorded, start_in_mode
from rows import Registry, Row
from scipy.optimize import brentq
from undamped import undamp
from yade.minieigenHP import Vector3
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.scene import scenario
from yade_timber.scene import engines

case = Registry()
O = yw.Omega()
DT = DEFAULT_DT / 2


def weight():
    """Weight of all free bodies. [N]"""
    return G * sum(b.state.mass for b in O.bodies if b.dynamic)


def load_on_fixed():
    """Downward sum of the contact and joint forces on the fixed bodies. [N]"""
    fixed = {b.id for b in O.bodies if not b.dynamic}
    total = np.zeros(3)
    for i in O.interactions:
        for point in yt.contacts(i.id1, i.id2) if i.isReal and (i.id1 in fixed) != (i.id2 in fixed) else []:
            on_second = point["normal_force"] * point["normal"] + point["shear_force"]
            total += np.array(on_second) * (1 if i.id2 in fixed else -1)
    engine = engines.find_engine(yw.JointEngine)
    for joint in engine.joints if engine else []:
        if (joint.id1 in fixed) != (joint.id2 in fixed):
            total += sum((np.array(f) for f in joint.forces), np.zeros(3)) * (1 if joint.id1 in fixed else -1)
    return -total[2]


# --- a stack ----------------------------------------------------------------------------------------------------------
def build_stack(blocks, widths=(0.35, 0.30)):
    """A stack of blocks of 10 cm on a fixed plate, alternately of two widths [m]."""
    O.reset()
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    for k in range(blocks):
        w = widths[k % 2]
        O.bodies.append(yt.box((w, w, 0.1), (0, 0, 0.05 + 0.1 * k)))
    O.engines = yt.engines()
    O.dt = DT


@case
def stack_at_rest(duration=10.0, blocks=20):
    """A stack settles in the first two seconds; then it does not move, and the force on the plate is its weight to
    rounding.
    """
    build_stack(blocks)
    advance(2)
    settled = positions()
    advance(duration - 2)
    note = f"stack of {blocks}, {duration:g} s"
    # Weight: remaining oscillation, 4e-12 after 10 s, and rounding, 3e-14 after 60 s. Creep: remainder of the
    # settlement, 2e-8 m, constant until 60 s. Energy: remaining oscillation, 3e-17 J (velocities of 1e-9 m/s), 3e-23 J
    # after 20 s. Sweeps in one direction only would increase the creep tenfold.
    return [Row("6", "stack: force on the plate [N]", weight(), load_on_fixed(), bound=1e-11, dt=DT, note=note),
            Row("6", "stack: creep after 2 s [m]", 0, abs(positions() - settled).max(), bound=1e-7, dt=DT, note=note),
            Row("6", "stack: kinetic energy [J]", 0, yt.energy()["kinetic"], bound=1e-15, dt=DT, note=note)]


# --- arch and wedge ---------------------------------------------------------------------------------------------------
TAPER = np.radians(15)
"""Inclination of the wedge faces of arch and wedge from the vertical. [rad]"""


def arch_parts():
    """A wedge between two blocks on a plate; each face of the wedge lies inside a face of a block."""
    half = lambda z: 0.15 + (z - 0.4) * np.tan(TAPER)
    key = np.array([[-half(0.25), 0.25], [half(0.25), 0.25], [half(0.55), 0.55], [-half(0.55), 0.55]])
    left = np.array([[-0.7, 0], [-half(0), 0], [-half(0.7), 0.7], [-0.7, 0.7]])
    right = (left * [-1, 1])[::-1]
    plate = rectangle(-3, -0.3, 3, 0)
    return [Part("plate", plate, 1.0, True), Part("left", left, 0.4), Part("right", right, 0.4), Part("key", key, 0.3)]


def critical_friction(parts):
    """Friction coefficient below which the arch opens.

    When it opens, all faces slide. The force on a wedge face is inclined by TAPER + phi from the horizontal: the thrust
    on each block is W/2 cot(TAPER + phi), W the weight of the wedge. The friction under a block of weight Wa is
    tan(phi) (Wa + W/2).
    """
    frame = Frame(parts, [], [("plate", "left")])
    wedge, block = frame.mass[3], frame.mass[1]
    excess = lambda mu: wedge / 2 / np.tan(TAPER + np.arctan(mu)) - mu * (block + wedge / 2)
    return brentq(excess, 0.01, 2)


def run_parts(parts, friction, duration):
    """Run a scene of prisms; returns the displacements (n, 3) and the largest displacement in the second half of the
    time. [m]
    """
    O.reset()
    append_parts(parts, Timber(friction=friction))
    O.engines = yt.engines()
    O.dt = DT
    start = positions()
    advance(duration / 2)
    half = positions()
    advance(duration / 2)
    return positions() - start, abs(positions() - half).max()


@case
def arch_opens_at_the_limit():
    """Three blocks stand with slightly more friction than the limit, and slide with slightly less."""
    parts = arch_parts()
    limit = critical_friction(parts)
    rows = []
    # The elastic displacement of the faces before friction is mobilised (0.1 mm of 300 mm) is far below the margin of 5
    # %; the arch stands at 2 % above the limit, too. The creep of a standing arch is rounding.
    for share, stands in ((0.95, False), (1.05, True), (3.0, True)):
        moved, creep = run_parts(parts, share * limit, 2.0)
        rows.append(Row("6", f"arch: stands at {share:g} of the critical friction {limit:.4f} [-]", float(stands),
                        float(-moved[3, 2] < 1e-3), bound=0, dt=DT))
        if stands:
            rows.append(Row("6", f"arch at {share:g}: creep in the second second [m]", 0, creep, bound=1e-12, dt=DT))
    return rows


def wedge_parts(layers=8, inner=0.15, outer=0.25, height=0.1):
    """Layers of four blocks between two fixed slopes, open below: two inner boxes and two outer blocks with a sloping
    face.
    """
    half = lambda z: inner + outer + (z - layers * height / 2) * np.tan(TAPER)
    low, high = -0.3, layers * height + 0.3
    slope = np.array([[half(low), low], [half(low) + 0.3, low], [half(high) + 0.3, high], [half(high), high]])
    parts = [Part("slope", slope, 0.6, True), Part("slope", (slope * [-1, 1])[::-1], 0.6, True)]
    for z, top in [(k * height, (k + 1) * height) for k in range(layers)]:
        end = np.array([[inner, z], [half(z), z], [half(top), top], [inner, top]])
        box = rectangle(0, z, inner, top)
        parts += [Part("block", corners, 0.4) for corners in (end, (end * [-1, 1])[::-1], box, (box * [-1, 1])[::-1])]
    return parts


@case
def wedge_of_32():
    """32 blocks between slopes stand with friction 0.7 and fall with friction 0.05."""
    _, creep = run_parts(wedge_parts(), 0.7, 1.0)
    kinetic = yt.energy()["kinetic"]
    force = load_on_fixed()
    total = weight()
    fallen, _ = run_parts(wedge_parts(), 0.05, 0.5)
    # Weight and creep to rounding, as for the stack. Observed creep: 7e-16 m.
    return [
        Row("6", "wedge of 32: force on the slopes [N]", total, force, bound=1e-10, dt=DT, note="friction 0.7"),
        Row("6", "wedge of 32: creep in 0.5 s [m]", 0, creep, bound=1e-12, dt=DT, note="friction 0.7"),
        Row("6", "wedge of 32: kinetic energy [J]", 0, kinetic, bound=1e-18, dt=DT, note="friction 0.7"),
        Row("6", "wedge of 32: falls with friction 0.05 [-]", 1, float(fallen[:, 2].min() < -0.1), bound=0, dt=DT),
    ]


# --- one-bay frames ---------------------------------------------------------------------------------------------------
SPAN, HEIGHT, COLUMN = 1.82, 2.4, 0.105
"""Distance of the column axes; height and side of the columns. [m]"""
CORNER_FITTING, BRACING_PLATE = 58800.0, 69580.0
"""Stiffness of one spring (paper, Table 1). [N/m]"""


def brace_corners(start, end, depth):
    """Corners (4, 2) of a bar between two points of the plane [m]."""
    along = (end - start) / np.linalg.norm(end - start)
    across = depth / 2 * np.array([-along[1], along[0]])
    return np.array([start - across, end - across, end + across, start + across])


def one_bay_frame(braced):
    """Two columns and a beam on a fixed plate; the brace is supported by its joints alone, so that the frame is linear.
    """
    half = COLUMN / 2
    parts = [
        Part("plate", rectangle(-0.5, -0.2, SPAN + 0.5, 0), 0.4, True),
        Part("left", rectangle(-half, 0, half, HEIGHT), COLUMN),
        Part("right", rectangle(SPAN - half, 0, SPAN + half, HEIGHT), COLUMN),
        Part("beam", rectangle(-0.2, HEIGHT, SPAN + 0.2, HEIGHT + 0.2), 0.15),
    ]
    ends = lambda x, z: np.array([[x - half, z], [x + half, z]])
    ties = [Tie("plate", "left", ends(0, 0), CORNER_FITTING), Tie("plate", "right", ends(SPAN, 0), CORNER_FITTING)]
    ties += [
        Tie("left", "beam", ends(0, HEIGHT), CORNER_FITTING),
        Tie("right", "beam", ends(SPAN, HEIGHT), CORNER_FITTING)
    ]
    if braced:
        corners = brace_corners(np.array([0.2, 0.1]), np.array([SPAN - 0.2, HEIGHT - 0.1]), 0.09)
        parts.append(Part("brace", corners, 0.045))
        ties.append(Tie("plate", "brace", corners[[0, 3]], BRACING_PLATE))
        ties.append(Tie("brace", "beam", corners[[1, 2]], BRACING_PLATE))
    pairs = [("plate", "left"), ("plate", "right"), ("left", "beam"), ("right", "beam")]
    return Frame(parts, ties, pairs)


BEAM = 3
"""Body id of the beam."""


def beam_at():
    """Horizontal position of the beam. [m]"""
    return O.bodies[BEAM].state.pos[0]


def lateral_stiffness(frame, model, name, push=1.0, steps=50):
    """Quasi-static horizontal force on the beam; force over displacement against the linear model."""
    build_frame(frame, DT)
    advance(3)
    before = recorded(1, 1e-2, beam_at).mean()
    for k in range(steps):
        O.forces.setPermF(BEAM, Vector3(push * (k + 1) / steps, 0, 0))
        advance(0.04)
    advance(1)
    got = push / (recorded(2, 1e-2, beam_at).mean() - before)
    x = 3 * list(model.bodies).index(BEAM)
    load = np.zeros(len(model.rest))
    load[x] = push
    # The rotation of the feet is 8 % of that at uplift, and Hertz's law is not linear: 0.08^2 / 9 = 7e-4; observed 7e-5
    # with a third of the force. Remaining oscillation of the brace in its undamped joints: 1e-8 m in 1e-5 m.
    return Row("6", f"{name} frame: lateral stiffness [N/m]", push / model.deflection(load)[x], got, bound=2e-3, dt=DT)


def lowest_frequency(frame, model, name, cycles):
    """Free vibration in the lowest mode without dashpots: frequency against the eigenvalue of the linear model."""
    build_frame(frame, DT)
    advance(3)
    undamp()
    frequencies, shapes = model.modes()
    shape = shapes[:, 0] / shapes[3 * list(model.bodies).index(BEAM), 0]
    rest, every = beam_at(), DT
    start_in_mode(model.bodies, 1e-5 * 2 * np.pi * frequencies[0] * shape)
    vibration = recorded(cycles / frequencies[0], every, beam_at) - rest
    got = vibration_frequency(every * np.arange(len(vibration)), vibration)
    # The amplitude is 10 um of 300 um at uplift; the error of the linear Hertz stiffness grows with its square.
    # Observed: 5e-5.
    return Row("6", f"{name} frame: lowest frequency [Hz]", frequencies[0], got, bound=1e-3, dt=DT)


def vibration_frequency(times, x):
    """Frequency between the first and the last upward crossing of zero. [Hz]"""
    k = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    ups = times[k] - x[k] * (times[k + 1] - times[k]) / (x[k + 1] - x[k])
    return (len(ups) - 1) / (ups[-1] - ups[0])


@case
def frames():
    """Lateral stiffness and lowest frequency of a one-bay frame, without and with a brace."""
    rows = []
    for name, cycles in (("unbraced", 8), ("braced", 12)):
        frame = one_bay_frame(name == "braced")
        model = LinearFrame(frame)
        rows += [lateral_stiffness(frame, model, name), lowest_frequency(frame, model, name, cycles)]
    return rows


# --- the house --------------------------------------------------------------------------------------------------------
@case
def house_weight(settle=0.5, average=0.2):
    """House C2 with 1 m of snow: the force on the fixed foundation is its weight."""
    scenario.build(scenario.Scenario("weight", "C2", snow_depth=1.0, dt=DT))
    advance(settle)
    forces = []
    for _ in range(10):
        advance(average / 10)
        forces.append(load_on_fixed())
    # Remaining oscillation: light beams of the entrance in their undamped joints, snow on its soft springs. Observed:
    # 1.3e-4 (C2), 1e-6 averaged after 1.2 s.
    return [Row("6", "house C2 with snow: force on the foundation [N]", weight(), np.mean(forces), bound=1e-3, dt=DT,
                note="mean of 0.2 s after 0.5 s")]
