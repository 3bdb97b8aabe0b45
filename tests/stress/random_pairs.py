# SPDX-License-Identifier: GPL-2.0-or-later
"""Random impacts: many separate pairs of random convex polyhedra in one scene, and the outcome of each."""
from dataclasses import dataclass

import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from yade.minieigenHP import Matrix3, Quaternion, Vector3

O = yw.Omega()

SIZES = (5e-3, 5.0)
"""Range of the longest semi-axis of a body, 1:1000 [m]."""
LARGEST_SPEED = 50.0
"""[m/s]"""
LARGEST_MASS_RATIO = 1e6
"""[-]"""
PLACED = 3e-4
"""Largest initial overlap; bodies that are placed deeper than 0.5 mm are refused. [m]"""
STEP_SHARE = 0.1
"""Time step of a pair times the angular frequency of one contact point on the lighter body [-]. Eight points whose arms
quarter the effective mass have sqrt(32) = 5.7 times this frequency: omega dt < 0.6 (stable: 2)."""
TRAVEL_SHARE = 0.1
"""Displacement of the fastest point in a time step over the sum of rounding radii [-]: no body passes through a thin
one in a step.
"""
ROTATION = 0.02
"""Rotation of the lighter body in a time step [rad]."""
TRAVEL = 15
"""Displacement of the slowest pair of a batch over its sum of rounding radii [-], in at most MOST_STEPS steps."""
MOST_STEPS = 1500


@dataclass
class Pair:
    """Two bodies before their impact. Body 2 moves; body 1 may be fixed."""

    bodies: list
    velocity: np.ndarray  # (2, 3) [m/s]
    spin: np.ndarray  # (2, 3) [rad/s]
    dt: float  # [s]
    reach: float  # radius of a ball that contains both at the start [m]
    speed: float  # of approach [m/s]
    kind: str


# --- shapes -----------------------------------------------------------------------------------------------------------
def direction(random):
    v = random.normal(size=3)
    return v / np.linalg.norm(v)


def rotation(random):
    """Uniform rotation matrix."""
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q * np.linalg.det(q)


def corners(random, size):
    """Corners (n, 3) of a random body about the origin, and its kind; size: longest semi-axis [m]."""
    kind = random.choice(["lump", "box", "plate", "needle", "sliver"])
    axes = {
        "plate": [1, random.uniform(0.3, 1), 1e-2], "needle": [1, 1e-2, 1e-2],
        "sliver": [1, 10**random.uniform(-2, 0), 1e-3]
    }.get(kind, 10.0**random.uniform([0, -1, -1], 0))
    count = 4 if kind == "sliver" else random.integers(4, 13)
    on_box = kind == "box" or (kind in ("plate", "needle") and random.random() < 0.5)
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    unit = signs if on_box else np.array([direction(random) for _ in range(count)])
    return (unit * axes * size) @ rotation(random).T, str(kind)


def shape(random, size):
    """Like `corners`, of a body that the package accepts; many slivers are degenerate and refused."""
    while True:
        points, kind = corners(random, size)
        try:
            yt.polyhedron(points)
            return points, kind
        except (ValueError, RuntimeError):
            continue


# --- one pair ---------------------------------------------------------------------------------------------------------
def outward_normals(body):
    """Unit normals (n, 3) of the faces, and the faces as sets of corners."""
    corners = np.array(body.shape.vertices)
    faces = [np.array(face) for face in body.shape.faces()]
    normals = np.array([np.cross(corners[f[1]] - corners[f[0]], corners[f[2]] - corners[f[0]]) for f in faces])
    return normals / np.linalg.norm(normals, axis=1)[:, None], [set(f) for f in faces]


def feature(random, body):
    """A random point of the surface on a face, edge or corner: (point, outward direction) in the body frame."""
    normals, faces = outward_normals(body)
    kind, first = random.integers(3), random.integers(len(faces))
    if kind == 0:
        outward = normals[first]
    elif kind == 1:
        beside = [k for k, face in enumerate(faces) if len(face & faces[first]) == 2]
        share = random.uniform(0.1, 0.9)
        outward = share * normals[first] + (1 - share) * normals[random.choice(beside)]
    else:
        outward = direction(random)
    outward = outward / np.linalg.norm(outward)
    corners = np.array(body.shape.vertices)
    heights = corners @ outward
    outermost = corners[heights > heights.max() - 1e-6 * np.ptp(heights)]
    return random.dirichlet(np.ones(len(outermost))) @ outermost, outward


def rotation_between(random, a, b):
    """A rotation matrix that maps the unit vector a to b, with a random rotation about b."""
    def frame(z, x):
        x = x - (x @ z) * z
        x /= np.linalg.norm(x)
        return np.column_stack([x, np.cross(z, x), z])

    return frame(b, direction(random)) @ frame(a, direction(random)).T


def make_pair(random, overlap):
    """Two bodies, a random feature of one approaching one of the other. overlap: initial overlap over that of one
    contact point at their speed [-]."""
    sizes = SIZES[0] * (SIZES[1] / SIZES[0]) ** random.random(2)
    (first, kind1), (second, kind2) = shape(random, sizes[0]), shape(random, sizes[1])
    snow, fixed = random.random() < 0.2, random.random() < 0.2
    bodies = with_masses(random, first, second, snow, fixed)
    (point1, outward1), (point2, outward2) = (feature(random, body) for body in bodies)
    rotation_2 = rotation_between(random, outward2, -outward1)
    bodies[0].state.ori = bodies[0].state.refOri = Quaternion.Identity
    bodies[1].state.ori = bodies[1].state.refOri = Quaternion(Matrix3(*rotation_2.flatten()))
    radii = sum(b.shape.radius for b in bodies)
    speed = LARGEST_SPEED * 10 ** random.uniform(-3, 0)
    if snow:  # the springs of snow are soft: at a higher speed a body would be penetrated
        speed *= min(1.0, radii / impact_scale(bodies, speed, snow)[0])
    light = int(np.argmin([b.state.mass if b.dynamic else np.inf for b in bodies]))
    spin = np.zeros((2, 3))
    spin[light] = direction(random) * speed * random.uniform(0, 1) / reach_of(bodies[light])
    largest_overlap, stiffness = impact_scale(bodies, speed, snow)
    dt = min(STEP_SHARE / np.sqrt(stiffness * mobility(bodies, largest_overlap)), TRAVEL_SHARE * radii / (3 * speed),
             ROTATION / max(np.linalg.norm(spin[light]), 1e-9))
    gap = -min(overlap * largest_overlap, PLACED) if overlap else 3 * speed * dt
    for body, position in zip(bodies, (-point1, gap * outward1 - rotation_2 @ point2)):
        body.state.pos = body.state.refPos = Vector3(*position)
    velocity = np.array([np.zeros(3), -speed * outward1 + 0.3 * speed * direction(random)])
    reach = max(body.state.pos.norm() + reach_of(body) for body in bodies)
    return Pair(bodies, velocity, spin, dt, reach, speed, f"{kind1}-{kind2}" + " snow" * snow + " fixed" * fixed)


def with_masses(random, first, second, snow, fixed):
    """Two bodies with a random mass ratio of up to LARGEST_MASS_RATIO; either is the heavier one."""
    ratio = LARGEST_MASS_RATIO ** random.uniform(-1, 1)
    bodies = [yt.polyhedron(points) for points in (first, second)]
    density = 340 * np.array([1, ratio * bodies[0].state.mass / bodies[1].state.mass])
    density *= 340 / density.min()  # no body is lighter than timber
    materials = [yt.timber(density=density[0]), yt.snow(density=density[1]) if snow else yt.timber(density=density[1])]
    return [
        yt.polyhedron(points, material, fixed=fixed and k == 0)
        for k, (points, material) in enumerate(zip((first, second), materials))
    ]


def reach_of(body):
    """Distance of the farthest corner from the centre [m]."""
    return max(v.norm() for v in body.shape.vertices)


def shift(body, displacement):
    body.state.pos = body.state.refPos = body.state.pos + Vector3(*displacement)


def mobility(bodies, overlap):
    """Largest 1/m + a^2/I of the free bodies [1/kg], with their smallest moment of inertia I and half the overlap as
    arm a. A contact point is at the centre of the overlap, which may be far outside a needle in the rounding of a large
    body."""
    return max(1 / b.state.mass + (overlap / 2) ** 2 / min(b.state.inertia) for b in bodies if b.dynamic)


def impact_scale(bodies, speed, snow):
    """(overlap [m], stiffness [N/m]) at the peak of an impact of the lighter body at that speed [m/s] with one contact
    point.
    """
    mass = min(b.state.mass for b in bodies if b.dynamic)
    if snow:
        stiffness = bodies[1].material.stiffnessPerMass * bodies[1].state.mass
        return speed * np.sqrt(mass / stiffness), stiffness
    modulus = bodies[0].material.young / (2 * (1 - bodies[0].material.poisson**2))
    radius = 1 / sum((3 * b.state.mass / b.material.density / (4 * np.pi)) ** (-1 / 3) for b in bodies)
    overlap = min((15 * mass * speed**2 / (16 * modulus * np.sqrt(radius))) ** 0.4, sum(b.shape.radius for b in bodies))
    return overlap, 2 * modulus * np.sqrt(radius * overlap)


# --- a scene of pairs -------------------------------------------------------------------------------------------------
def steps_for(pairs, dt):
    """Number of steps for the impact of the slowest pair."""
    durations = [TRAVEL * sum(b.shape.radius for b in pair.bodies) / pair.speed for pair in pairs]
    return min(MOST_STEPS, round(max(durations) / dt))


def load(pairs, **options):
    """Empty YADE and put the pairs on a line, separate from each other. The smallest of their time steps is used.
    Returns the number of steps."""
    O.reset()
    O.dt = min(pair.dt for pair in pairs)
    steps = steps_for(pairs, O.dt)
    margin = 3 * LARGEST_SPEED * steps * O.dt
    x = 0.0
    for pair in pairs:
        x += pair.reach + margin
        for body, velocity, spin in zip(pair.bodies, pair.velocity, pair.spin):
            shift(body, (x, 0, 0))
            O.bodies.append(body)
            yt.set_velocity(body, velocity, spin)
        x += pair.reach + margin
    O.engines = yt.engines(health_check=0, gravity=(0, 0, 0), **options)
    return steps


def kinetic(body):
    s = body.state
    return (s.mass * s.vel.squaredNorm() + s.angMom.dot(s.angVel)) / 2 if body.dynamic else 0.0


def elastic(first, second):
    """Energy stored in a pair's contact springs [J]."""
    if not O.interactions.has(first, second):
        return 0.0
    interaction = O.interactions[first, second]
    if not interaction.isReal:
        return 0.0
    return sum(point_energy(interaction.phys, *both) for both in zip(interaction.geom.points, interaction.phys.points))


def point_energy(phys, point, force):
    """W = F n / 2 of a linear and 2/5 F n of a Hertz spring, n from F (the force of a contact with initial overlap
    belongs to a smaller overlap); beyond the limit of F, F times the additional overlap; and the energy of the
    tangential spring [J]."""
    normal, shear = force[1], force[2]
    if normal <= 0:
        return 0.0
    if isinstance(phys, yw.SnowPhys):
        share, power, overlap = 0.5, 1.0, normal / phys.stiffness
    else:
        share, power, overlap = 0.4, 1.5, (normal / (4 / 3 * phys.modulus * np.sqrt(phys.radius))) ** (2 / 3)
    beyond = max(0.0, point[2] - overlap) if overlap > phys.overlapLimit * (1 - 1e-9) else 0.0
    return share * normal * overlap + normal * beyond + shear.squaredNorm(
    ) * overlap / (2 * phys.shearRatio * power * normal)


def momenta(bodies):
    """Linear momentum, and angular momentum about the first body's reference position (2, 3) [kg m/s, kg m2/s]."""
    about = bodies[0].state.refPos
    linear = sum((b.state.mass * b.state.vel for b in bodies), Vector3.Zero)
    angular = sum((b.state.mass * (b.state.pos - about - O.dt / 2 * b.state.vel).cross(b.state.vel) + b.state.angMom
                   for b in bodies), Vector3.Zero)
    return np.array([linear, angular])


@dataclass
class Outcome:
    """Outcome of an impact. gain: energy after over energy before; momentum: change over the largest possible exchange
    [-].
    """

    kind: str
    energy: float  # before [J]
    gain: float
    momentum: float
    angular: float
    touched: bool
    fastest: float  # speed after [m/s]
    finite: bool


def outcomes(pairs, **options):
    """Run a batch: list of Outcome."""
    steps = load(pairs, **options)
    before = [[kinetic(b) for b in pair.bodies] for pair in pairs]
    initial_momenta = [momenta(pair.bodies) for pair in pairs]
    O.step()
    stored = [elastic(2 * k, 2 * k + 1) for k in range(len(pairs))]
    for _ in range(steps):
        O.step()
    return [outcome(k, pair, sum(before[k]) + stored[k], initial_momenta[k]) for k, pair in enumerate(pairs)]


def outcome(k, pair, energy, initial_momenta):
    after = sum(map(kinetic, pair.bodies)) + elastic(2 * k, 2 * k + 1)
    linear, angular = momenta(pair.bodies) - initial_momenta
    free = all(b.dynamic for b in pair.bodies)
    scale = np.sqrt(2 * energy * min(b.state.mass for b in pair.bodies if b.dynamic))
    arm = sum(map(reach_of, pair.bodies))
    states = [b.state for b in pair.bodies]
    finite = all(np.isfinite([*s.pos, *s.vel, *s.angVel]).all() for s in states)
    touched = any(s.vel != Vector3(*v) for s, v in zip(states, pair.velocity))
    return Outcome(pair.kind, energy, after / energy, np.linalg.norm(linear) / scale if free else 0.0,
                   np.linalg.norm(angular) / (scale * arm) if free else 0.0, touched, max(s.vel.norm() for s in states),
                   finite)


def impacts(count, seed, batch=100, **options):
    """Outcomes of that many random impacts, a quarter of them with initial overlap."""
    random = np.random.default_rng(seed)
    pairs = [make_pair(random, random.uniform(0, 1) if k % 4 == 0 else 0.0) for k in range(count)]
    pairs.sort(key=lambda pair: pair.dt)
    return [found for k in range(0, count, batch) for found in outcomes(pairs[k : k + batch], **options)]


# --- bounds -----------------------------------------------------------------------------------------------------------
ENERGY_BOUND = 1e-3
"""Gain of energy over the initial energy [-]. Dashpots and friction dissipate; the splitting of the free rotation has
an oscillating error of the order of ROTATION^2 = 4e-4. Observed: 2e-5, for needles without contact. One of 30 000
impacts (seed 2) exceeds the bound: a needle with moments of inertia of 5000:1, without contact, that rotates about its
axis much faster than assumed: 1 %, 5e-5 at half the step."""
MOMENTUM_BOUND = 1e-11
"""Change of momentum over that of the lighter body with the total energy [-]: rounding in 1500 steps, mass ratio 1e6.
Observed: 1e-12.
"""
ANGULAR_BOUND = 1e-5
"""The same for angular momentum, with the reach as arm [-]: differences of orbital momenta at distances of up to 1e4
reaches. Observed: 1e-7.
"""


def expect_sound(found):
    """Raise AssertionError that lists outcomes that are not finite, gain energy or change the momentum."""
    wrong = [o for o in found if not (o.finite and o.gain <= 1 + ENERGY_BOUND and o.momentum <= MOMENTUM_BOUND
                                      and o.angular <= ANGULAR_BOUND)]
    assert not wrong, f"{len(wrong)} of {len(found)}:\n" + "\n".join(map(str, wrong[:10]))
