# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared by all physics cases: scenes, runs, and the closed forms of the paper's contact law. Needs a running YADE.

Expected values follow from the paper's equations, implemented here a second time. The package provides positions,
velocities and forces only.
"""
import importlib
import pathlib

import numpy as np
import yade.wrapper as yw
import yade_timber as yt
from yade.minieigenHP import Quaternion, Vector3

O = yw.Omega()
G = 9.81
"""[m/s2]"""
YOUNG, POISSON, DENSITY = 90e3 * 9.8e4, 0.4, 340.0
"""Timber of the paper, section 3.1 and 3.4. [Pa, -, kg/m3]"""


def scene(bodies, dt, **options):
    """Empty YADE, then load these bodies with the package's engines. dt [s]; options as in `yade_timber.engines`."""
    O.reset()
    O.bodies.append(bodies)
    O.dt = dt
    O.engines = yt.engines(**options)
    return bodies


def integrate_first():
    """Put the integrator first: a velocity set between two steps then acts on positions and contact forces in the same
    step.
    """
    O.engines = [O.engines[-1]] + O.engines[:-1]


def steps(count, probe=None, every=1):
    """Compute `count` steps; returns the values of probe() after each `every` steps as an array."""
    rows = []
    for k in range(count):
        O.step()
        if probe is not None and (k + 1) % every == 0:
            rows.append(probe())
    return np.array(rows)


def run_until(stop, limit):
    """Step until stop() is true; returns the number of steps. RuntimeError after `limit` steps."""
    for k in range(limit):
        O.step()
        if stop():
            return k + 1
    raise RuntimeError(f"not reached in {limit} steps")


def octahedron(half_diagonal, centre, **options):
    """Regular octahedron with a corner straight below its centre of mass. [m]"""
    return yt.polyhedron(np.vstack([np.eye(3), -np.eye(3)]) * half_diagonal + np.asarray(centre, float), **options)


def turned(axis, angle):
    """Quaternion: angle [rad] about axis."""
    return Quaternion(Vector3(*axis).normalized(), angle)


def angle_about(body, axis):
    """Rotation of a body about a fixed axis from orientation zero. [rad] Valid for motion about that axis."""
    q = body.state.ori
    return 2 * np.arctan2(Vector3(q[0], q[1], q[2]).dot(Vector3(*axis)), q[3])


def spin(body, omega):
    """Give a body an angular velocity. [rad/s]"""
    yt.set_velocity(body, body.state.vel, omega)


def equivalent_modulus():
    """E* of two timber elements (Eq. 35). [Pa]"""
    return YOUNG / (2 * (1 - POISSON**2))


def hertz_constant(volume1, volume2):
    """c of F = c n^1.5 at one contact point (Eqs. 35-37), spheres of the same volumes. volume [m3]; returns [N/m^1.5].
    """
    r1, r2 = (3 * np.array([volume1, volume2]) / (4 * np.pi)) ** (1 / 3)
    return 4 / 3 * equivalent_modulus() * np.sqrt(r1 * r2 / (r1 + r2))


def shear_stiffness(constant, overlap):
    """K_s of a timber contact point (Eqs. 39, 40): K_n = dF/dn = 1.5 c sqrt(n), over 2 (1 + nu). [N/m]"""
    return 1.5 * constant * np.sqrt(overlap) / (2 * (1 + POISSON))


def all_cases():
    """Every case of every `*_cases.py` beside this file, in the order of the file names."""
    folder = pathlib.Path(__file__).parent
    modules = [importlib.import_module(path.stem) for path in sorted(folder.glob("*_cases.py"))]
    return [function for module in modules for function in module.case.functions]
