# SPDX-License-Identifier: GPL-2.0-or-later
"""Free motion and impacts."""
from dataclasses import replace

import numpy as np

from mechanics.rows import EXACT, add, constant
from mechanics.scene import G, Body, Scene, box_inertia

CUBE = (0.2, 0.2, 0.2)
"""[m]"""
FLOOR = Body("floor", (0, 0, -0.5), (24, 4, 1))


def matrices(quaternions):
    """Rotation matrices (n, 3, 3) of quaternions (n, 4)."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1)[:, None]).T
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)


# --- free motion ------------------------------------------------------------------------------------------------------
def fall(radius):
    return [Scene("free_fall", 1.0, (Body("cube", (0, 0, 0), CUBE, mass=1.0),))]


def fallen(run):
    """[m]"""
    return float(-run.position["cube"][-1, 2])


add(key="free_fall", title="free fall, 1 s", unit="m", scenes=fall, measure=fallen, expected=constant(G / 2),
    bound=EXACT, relative=True, source="g t² / 2", fault=lambda scene: replace(scene, gravity=9.6))

TUMBLER = Body("box", (0, 0, 0), (0.1, 0.3, 0.6), mass=10.0, spin=(3.0, 4.0, 5.0))
"""Spins near its intermediate axis, about which rotation is unstable."""


def tumble(radius):
    return [Scene("tumbling", 10.0, (TUMBLER,), gravity=0.0, sample=0.02)]


def angular_momenta(run):
    """World frame (n, 3). [N m s]"""
    turn, inertia = matrices(run.orientation["box"]), box_inertia(TUMBLER.mass, TUMBLER.extents)
    return np.einsum("nij,j,nkj,nk->ni", turn, inertia, turn, run.spin["box"])


def spin_energy(run):
    """Energy at the end over that at the start."""
    energies = np.einsum("ni,ni->n", angular_momenta(run), run.spin["box"])
    return float(energies[-1] / np.dot(TUMBLER.spin, np.array(TUMBLER.spin) * box_inertia(10.0, TUMBLER.extents)))


def momentum_change(run):
    """Largest change of the angular momentum over its length."""
    start = np.array(TUMBLER.spin) * box_inertia(TUMBLER.mass, TUMBLER.extents)
    return float(np.linalg.norm(angular_momenta(run) - start, axis=1).max() / np.linalg.norm(start))


def braked(scene):
    """1 % less spin."""
    return replace(scene, bodies=(replace(TUMBLER, spin=tuple(0.98 * x for x in TUMBLER.spin)),))


add(key="tumbling_energy", title="tumbling box: energy", unit="-", scenes=tumble, measure=spin_energy,
    expected=constant(1.0), bound=EXACT, source="free rotation conserves energy", fault=braked)
add(key="tumbling_momentum", title="tumbling box: momentum change", unit="-", scenes=tumble, measure=momentum_change,
    expected=constant(0.0), bound=EXACT, source="free rotation conserves angular momentum", fault=braked)

# --- impacts ----------------------------------------------------------------------------------------------------------
HEIGHTS = np.linspace(0.5, 1.0, 20)
"""Of the lower faces at the start [m]: impacts at twenty phases of a step."""


def drop(name, restitution):
    cubes = [Body(f"cube{k}", (k - 9.5, 0, height + 0.1), CUBE, mass=1.0) for k, height in enumerate(HEIGHTS)]
    return Scene(name, 0.95, (FLOOR, *cubes), restitution=restitution, sample=0.001)


def drop_half(radius):
    return [drop("drop_half", 0.5)]


def drop_elastic(radius):
    return [drop("drop_elastic", 1.0)]


def after_impact(run):
    """[(drop height, index of a sample 20 ms after the touch)] of each cube."""
    return [(f"cube{k}", height, run.at(np.sqrt(2 * height / run.scene.gravity) + 0.02))
            for k, height in enumerate(HEIGHTS)]


def rebounds(run):
    """Highest point after the first impact over the height of fall, of each cube."""
    return np.array([(run.position[name][k:, 2].max() - 0.1) / height for name, height, k in after_impact(run)])


def mean_rebound(run):
    return float(rebounds(run).mean())


def highest_rebound(run):
    return float(rebounds(run).max())


def mean_spin(run):
    """[rad/s]"""
    return float(np.mean([np.linalg.norm(run.spin[name][k]) for name, _, k in after_impact(run)]))


def less_bouncy(scene):
    return replace(scene, restitution=0.9 * scene.restitution)


def tilted_cubes(scene):
    """Every cube turned by 0.05 rad about y."""
    turn = (np.cos(0.025), 0.0, np.sin(0.025), 0.0)
    return replace(scene, bodies=(scene.bodies[0], *(replace(body, orientation=turn) for body in scene.bodies[1:])))


add(key="drop_half", title="flat drop, e 0.5: rebound", unit="-", scenes=drop_half,
    measure=mean_rebound, expected=constant(0.25), bound=0.0125, source="e²", fault=less_bouncy)
add(key="drop_elastic", title="flat drop, e 1: highest rebound", unit="-", scenes=drop_elastic,
    measure=highest_rebound, expected=constant(1.0), bound=0.05, source="e²", fault=less_bouncy)
add(key="drop_spin", title="flat drop, e 0.5: spin", unit="rad/s", scenes=drop_half,
    measure=mean_spin, expected=constant(0.0), bound=0.1, source="symmetry", fault=tilted_cubes)

SIZE = 0.5
"""Edge of colliding cubes. [m]"""


def collision(shift):
    """Two cubes that meet face on face, shifted by a share of their edge across the motion."""
    offset = shift * SIZE
    first = Body("first", (-0.55 * SIZE, 0, 0), (SIZE,) * 3, mass=10.0, velocity=(1.0, 0, 0))
    second = Body("second", (0.55 * SIZE, offset, offset), (SIZE,) * 3, mass=10.0, velocity=(-1.0, 0, 0))
    return Scene(f"collision_{shift:g}", 0.2, (first, second), friction=0.0, restitution=1.0, gravity=0.0)


def collide_flush(radius):
    return [collision(0.0)]


def collide_shifted(radius):
    return [collision(1e-4)]


def collision_energy(run):
    """Kinetic energy at the end over that at the start; 0 without an impact."""
    inertia = box_inertia(10.0, (SIZE,) * 3)[0]
    energy = sum(10.0 * np.dot(run.velocity[name][-1], run.velocity[name][-1])
                 + inertia * np.dot(run.spin[name][-1], run.spin[name][-1]) for name in ("first", "second"))
    return float(energy / 20.0) if run.velocity["first"][-1, 0] < 0 else 0.0


for key, title, scenes in (("collision_flush", "flush cubes collide, e 1: energy", collide_flush),
                           ("collision_shifted", "shifted by 1e-4: energy", collide_shifted)):
    add(key=key, title=title, unit="-", scenes=scenes, measure=collision_energy, expected=constant(1.0), bound=0.05,
        source="e = 1", fault=less_bouncy)

# --- inertia ----------------------------------------------------------------------------------------------------------
CORNERS = tuple((0.1 * x, 0.1 * y, 0.1 * z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))
TORQUE = 0.01
"""[N m]"""


def twist(radius):
    return [Scene("hull_inertia", 1.0, (Body("hull", (0, 0, 0), corners=CORNERS, mass=1.0, torque=TORQUE),), gravity=0)]


def inertia_ratio(run):
    """Moment of inertia about z, of torque and spin, over m a² / 6."""
    spin = run.spin["hull"][-1, 2]
    return float(TORQUE * run.times[-1] / spin / box_inertia(1.0, CUBE)[2]) if spin else np.inf


add(key="hull_inertia", title="hull: inertia over exact", unit="-", scenes=twist,
    measure=inertia_ratio, expected=constant(1.0), bound=EXACT, source="m a² / 6",
    fault=lambda scene: replace(scene, bodies=(replace(scene.bodies[0], mass=1.02),)))
