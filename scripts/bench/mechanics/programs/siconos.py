# SPDX-License-Identifier: GPL-2.0-or-later
"""Siconos, from Debian's python3-siconos (which needs python3-scipy and python3-h5py): Bullet's contact points,
Moreau's time stepping, its nonsmooth Gauss-Seidel solver. Spins are of the body's axes there.
"""
import math
import os
import signal
import subprocess
import tempfile
from contextlib import contextmanager
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy; small matrices gain nothing by threads

import numpy as np
from siconos import kernel, numerics
from siconos.io.mechanics_run import MechanicsHdf5Runner
from siconos.mechanics.collision.tools import Contactor

from mechanics.falling import matrices
from mechanics.program import LONGEST, NotPossible, Program, too_late
from mechanics.scene import Trajectory, box_inertia, sampling

MARGIN = 1e-3
"""Inside margin of a shape [m]; its default, 0.04 in a box, rounds edges."""
ITERATIONS, TOLERANCE = 1000, 1e-8
JOINTS = {"weld": "FixedJointR", "ball": "KneeJointR", "hinge": "PivotJointR"}


@contextmanager
def quiet():
    """Its solvers print to the process's standard output."""
    kept = os.dup(1)
    with open(os.devnull, "w", encoding="ascii") as nothing:
        os.dup2(nothing.fileno(), 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)


def late(*_):
    raise too_late()


@contextmanager
def time_limit():
    signal.signal(signal.SIGPROF, late)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def add_body(out, body, scene):
    shape = f"shape of {body.name}"
    if body.extents:
        out.add_primitive_shape(shape, "Box", body.extents, insideMargin=MARGIN, outsideMargin=0.0)
    else:
        out.add_convex_shape(shape, body.corners, insideMargin=MARGIN, outsideMargin=0.0)
    mass = body.mass or (1.0 if body.shaken else None)
    moving = {}
    if mass:
        spin = matrices(np.array([body.orientation], float))[0].T @ np.array(body.spin)
        moving = {"mass": mass, "velocity": [*body.velocity, *spin]}
        if body.extents:
            moving["inertia"] = np.diag(box_inertia(mass, body.extents))
    out.add_object(body.name, [Contactor(shape)], translation=body.position, orientation=body.orientation, **moving)
    if body.shaken:
        acceleration, frequency = scene.shaking
        omega = 2 * math.pi * frequency
        peaks = [-acceleration / omega] + [0.0] * 5
        out.add_boundary_condition("shaking", body.name, indices=list(range(6)), bc_class="HarmonicBC", a=[0.0] * 6,
                                   b=peaks, omega=[omega] * 6, phi=[0.0] * 6)


def add_joint(out, joint, number, scene):
    fixed = scene.body(joint.first).mass is None
    points = [] if joint.kind == "weld" else [np.mean(joint.points, axis=0)]
    axes = [[0, 1, 0]] if joint.kind == "hinge" else []
    out.add_joint(f"joint{number}", joint.second, None if fixed else joint.first, points, axes, JOINTS[joint.kind],
                  absolute=True)


def refuse(scene):
    if any(joint.kind == "spring" for joint in scene.joints):
        raise NotPossible("no springs")
    if scene.removed:
        raise NotPossible("no removal before the first step")
    if scene.name == "reversed":
        raise NotPossible("its files sort bodies by name")


def load(out, scene):
    out.add_Newton_impact_friction_nsl("contact", mu=scene.friction, e=scene.restitution)
    for body in scene.bodies:
        add_body(out, body, scene)
    for k, joint in enumerate(scene.joints):
        add_joint(out, joint, k, scene)


def forces(scene):
    """Gravity, which it applies to every body, with the force or torque of a scene."""
    torque = sum(body.torque for body in scene.bodies)

    def apply(body):
        body.setFExtPtr([0, 0, -body.scalarMass() * scene.gravity])
        if torque:
            body.setMExtPtr([0, 0, torque])

    return apply


def solve(path, scene, dt):
    """Returns (dynamic, velocities, contacts, {name: id}) as the program's file has them."""
    every, count = sampling(scene, dt)
    with MechanicsHdf5Runner(io_filename=path, mode="w") as out:
        load(out, scene)
    options = None
    if not scene.joints:
        options = kernel.solver_options_create(numerics.SICONOS_FRICTION_3D_NSGS)
        options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = ITERATIONS
        options.dparam[numerics.SICONOS_DPARAM_TOL] = TOLERANCE
    with MechanicsHdf5Runner(io_filename=path, mode="r+") as out:
        out.run(t0=0, T=(count + 0.5) * dt, h=dt, solver_options=options, set_external_forces=forces(scene),
                output_frequency=every, verbose=False, verbose_progress=False)
        ids = {name: int(out.instances()[name].attrs["id"]) for name in out.instances()}
        return np.array(out.dynamic_data()), np.array(out.velocities_data()), np.array(out.contact_forces_data()), ids


def motion(body, places, velocities, times):
    """(position, orientation, velocity, spin) of a body; fixed ones have no rows."""
    if not len(places):
        rows = np.ones((len(times), 1))
        return rows * body.position, rows * body.orientation, 0 * rows * body.position, 0 * rows * body.position
    start = [*body.velocity, *(matrices(np.array([body.orientation], float))[0].T @ np.array(body.spin))]
    both = np.vstack([[start], velocities[:, 2:]])
    spin = np.einsum("nij,nj->ni", matrices(places[:, 5:9]), both[:, 3:])
    return places[:, 2:5], places[:, 5:9], both[:, :3], spin


def run(scene, dt):
    refuse(scene)
    with tempfile.TemporaryDirectory() as folder, quiet(), time_limit():
        dynamic, velocities, contacts, ids = solve(str(Path(folder) / "scene.hdf5"), scene, dt)
    times = np.unique(dynamic[:, 0])
    each = {body.name: motion(body, dynamic[dynamic[:, 1] == ids[body.name]],
                              velocities[velocities[:, 1] == ids[body.name]], times) for body in scene.bodies}
    support = None
    if scene.weighed:  # impulses, of the only body that has contacts
        support = np.array([abs(contacts[contacts[:, 0] == time][:, 13].sum()) / dt for time in times])
    return Trajectory(scene, times, *({name: parts[k] for name, parts in each.items()} for k in range(4)), support)


def program():
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "python3-siconos"], capture_output=True,
                             text=True, check=True).stdout
    return Program("Siconos", f"python3-siconos {version}", f"margins {1e3 * MARGIN:g} mm, NSGS to {TOLERANCE:g}", run,
                   (1 / 240, 1 / 1000), lacks=(("breaks", "no strength of joints"),))
