# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS body/rounded/polyhedron, from Debian's package. Floors are bodies that are not integrated.

The pair style has dashpots in place of a restitution: bodies with restitution 0 have c_n = (k_n m)^½ for the lightest
mass m, which is critical for four contact points; c_t = c_n where there is friction.
"""
import itertools
import math
import signal
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from mechanics.falling import matrices
from mechanics.program import LONGEST, NotPossible, Program, too_late
from mechanics.scene import Trajectory, box_inertia, sampling

STIFFNESS, RADIUS = 1e7, 0.001
"""Of a contact point [N/m]; of the edges [m]."""
SIGNS = np.array(list(itertools.product((-1, 1), repeat=3)))
EDGES = [(i, j) for i, j in itertools.combinations(range(8), 2) if np.abs(SIGNS[i] - SIGNS[j]).sum() == 2]
FACES = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
OUTPUT = "id x y z c_pose[1] c_pose[2] c_pose[3] c_pose[4] vx vy vz c_pose[5] c_pose[6] c_pose[7] fz"


def rotation(body):
    return matrices(np.array([body.orientation], float))[0]


def inertia(body):
    """About the centroid, in the world's axes. [kg m2]"""
    turn = rotation(body)
    return turn @ np.diag(box_inertia(body.mass or 1.0, body.extents)) @ turn.T


def body_lines(number, body):
    """Entry of the section Bodies: corners of the core, which the radius widens."""
    moments = inertia(body)
    corners = SIGNS * (np.array(body.extents) / 2 - RADIUS) @ rotation(body).T
    rows = [[number, 3, 6 + 24 + 2 * len(EDGES) + 4 * len(FACES) + 1], [8, len(EDGES), len(FACES)],
            [moments[k] for k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))], *corners, *EDGES, *FACES,
            [2 * RADIUS]]
    return [" ".join(map(str, row)) for row in rows]


def data_file(bodies):
    numbered = list(enumerate(bodies, 1))
    lines = ["bodies", "", f"{len(bodies)} atoms", f"{len(bodies)} bodies", "1 atom types", "-200 200 xlo xhi",
             "-200 200 ylo yhi", "-200 200 zlo zhi", "", "Atoms", ""]
    lines += [f"{n} 1 1 {body.mass or 1.0} {' '.join(map(str, body.position))}" for n, body in numbered]
    lines += ["", "Bodies", ""] + sum((body_lines(n, body) for n, body in numbered), []) + ["", "Velocities", ""]
    for n, body in numbered:
        lines.append(" ".join(map(str, (n, *body.velocity, *(inertia(body) @ np.array(body.spin))))))
    return "\n".join(lines) + "\n"


def group(name, numbers):
    return f"group {name} {'id ' + ' '.join(map(str, numbers)) if numbers else 'empty'}"


def input_script(scene, dt, bodies):
    every, count = sampling(scene, dt)
    light = min(body.mass for body in scene.bodies if body.mass)
    normal = 0.0 if scene.restitution else math.sqrt(STIFFNESS * light)
    tangential = normal if scene.friction else 0.0
    numbers = {body.name: n for n, body in enumerate(bodies, 1)}
    lines = ["units si", "boundary f f f", "atom_style body rounded/polyhedron 8 8", "atom_modify map array sort 0 0",
             "comm_modify vel yes", "read_data bodies.data",
             f"pair_style body/rounded/polyhedron {normal} {tangential} {scene.friction} 1 {RADIUS}",
             f"pair_coeff * * {STIFFNESS} 0", "neighbor 0.05 nsq", "neigh_modify delay 0 every 1 check yes",
             group("free", [numbers[body.name] for body in bodies if body.mass]), "group held subtract all free",
             "neigh_modify exclude group held held"]
    if scene.removed:
        lines += [group("extra", range(len(scene.bodies) + 1, len(bodies) + 1)), "delete_atoms group extra compress no"]
    lines += ["fix motion free nve/body", f"fix weight free gravity {scene.gravity} vector 0 0 -1"]
    if scene.shaking:
        omega = 2 * math.pi * scene.shaking[1]
        lines += [group("shaken", [numbers[body.name] for body in bodies if body.shaken]),
                  f"fix table shaken move wiggle {-scene.shaking[0] / omega**2} 0 0 {1 / scene.shaking[1]}"]
    for joint in scene.joints:
        length = math.dist(scene.body(joint.first).position, scene.body(joint.second).position)
        lines += [group("first", [numbers[joint.first]]), group("second", [numbers[joint.second]]),
                  f"fix spring first spring couple second {joint.stiffness} 0 0 0 {length}"]
    lines += ["compute pose all property/atom quatw quati quatj quatk angmomx angmomy angmomz",
              f"dump out all custom {every} out.dump {OUTPUT}", "dump_modify out sort id format float %.12g",
              f"timestep {dt}", "thermo 1000000", f"run {count}"]
    return "\n".join(lines) + "\n"


def product(first, second):
    """Of quaternions (n, 4)."""
    a, u, b, v = first[:, :1], first[:, 1:], second[:, :1], second[:, 1:]
    return np.hstack([a * b - np.sum(u * v, axis=1, keepdims=True), a * v + b * u + np.cross(u, v)])


def motion(body, rows):
    """(position, orientation, velocity, spin) of the dumped rows; their poses are of the principal axes."""
    start = rows[:1, 3:7] * (1, -1, -1, -1)
    pose = product(product(rows[:, 3:7], start), np.array([body.orientation], float))
    turn, moments = matrices(pose), box_inertia(body.mass or 1.0, body.extents)
    spin = np.einsum("nij,j,nkj,nk->ni", turn, 1 / moments, turn, rows[:, 10:13])
    return rows[:, :3], pose, rows[:, 7:10], spin


def read_dump(path, count):
    """(steps, rows (steps, bodies, columns))."""
    lines = path.read_text(encoding="ascii").splitlines()
    size = count + 9
    frames = [lines[k:k + size] for k in range(0, len(lines), size)]
    return (np.array([int(frame[1]) for frame in frames]),
            np.array([[list(map(float, line.split()[1:])) for line in frame[9:]] for frame in frames]))


def refuse(scene):
    if any(body.torque for body in scene.bodies):
        raise NotPossible("inertia is an input")
    if any(body.corners for body in scene.bodies):
        raise NotPossible("inertia is an input")
    if any(joint.kind != "spring" for joint in scene.joints):
        raise NotPossible("no joints but springs")
    if 0 < scene.restitution < 1:
        raise NotPossible("no restitution below 1")
    if sum(body.mass or 0 for body in scene.bodies) * scene.gravity / 4 > STIFFNESS * RADIUS:
        raise NotPossible("four points yield by more than the radius")


def run(scene, dt):
    refuse(scene)
    extra = [type(scene.bodies[0])(f"extra{k}", (50 + k, 0, 0), (0.3,) * 3, mass=1.0) for k in range(scene.removed)]
    bodies = (*scene.bodies, *extra)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "bodies.data").write_text(data_file(bodies), encoding="ascii")
        (Path(folder) / "in.lmp").write_text(input_script(scene, dt, bodies), encoding="ascii")
        done = subprocess.run(["bash", "-c", f"ulimit -t {LONGEST}; exec lmp -in in.lmp"], cwd=folder,
                              capture_output=True, text=True, env={"OMP_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"})
        if done.returncode in (-signal.SIGKILL, -signal.SIGXCPU):
            raise too_late()
        if done.returncode:
            raise RuntimeError([line for line in done.stdout.splitlines() if "ERROR" in line] or done.stderr)
        steps, rows = read_dump(Path(folder) / "out.dump", len(scene.bodies))
    each = {body.name: motion(body, rows[:, k]) for k, body in enumerate(scene.bodies)}
    support = None
    if scene.weighed:
        weighed = [body.name for body in scene.bodies].index(scene.weighed)
        support = rows[:, weighed, 13] + scene.body(scene.weighed).mass * scene.gravity
    return Trajectory(scene, steps * dt, *({name: parts[k] for name, parts in each.items()} for k in range(4)), support)


def program():
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "lammps"], capture_output=True, text=True,
                             check=True).stdout
    return Program("LAMMPS", version, f"body/rounded/polyhedron, k_n={STIFFNESS:g}N/m, c_n=c_t critical or 0", run,
                   (5e-5,), RADIUS, (("breaks", "no joints but springs"),))
