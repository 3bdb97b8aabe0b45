# SPDX-License-Identifier: GPL-2.0-or-later
"""Programs in C++ of this folder, which read a scene of boxes from their input and print its trajectory."""
import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from mechanics.scene import Trajectory, sampling

FOLDER = tempfile.TemporaryDirectory()


def compiled(name):
    """NAME.cpp compiled with the flags of the library NAME; on first use."""
    made = Path(FOLDER.name) / name
    if not made.exists():
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", name], capture_output=True, text=True, check=True)
        subprocess.run(["g++", *flags.stdout.split(), "-std=c++17", "-O2", str(Path(__file__).with_name(f"{name}.cpp")),
                        "-o", str(made), *flags.stdout.split()], check=True)
    return made


def described(scene, dt):
    """The text that the programs read."""
    every, count = sampling(scene, dt)
    peak, frequency = scene.shaking or (0, 0)
    lines = [[dt, count, every, scene.friction, scene.restitution, scene.gravity, peak, frequency, scene.removed,
              scene.weighed or "-", len(scene.bodies), len(scene.joints)]]
    for body in scene.bodies:
        kind = "free" if body.mass else "shaken" if body.shaken else "fixed"
        lines.append([body.name, kind, body.mass or 0, *body.position, *body.orientation, *body.velocity, *body.spin,
                      *body.extents, body.force_rate, body.torque])
    for joint in scene.joints:
        lines.append([joint.kind, joint.first, joint.second, *np.mean(joint.points, axis=0), joint.stiffness])
    return "\n".join(" ".join(map(str, line)) for line in lines)


def ran(program, text, scene):
    """The trajectory that a program prints for this text."""
    done = subprocess.run([program], input=text, capture_output=True, text=True, timeout=900)
    if done.returncode:
        raise RuntimeError(f"the program ends with status {done.returncode}: {done.stderr}")
    numbers = np.array([list(map(float, line.split())) for line in done.stdout.splitlines()])
    each = {body.name: numbers[:, 2 + 13 * k:15 + 13 * k] for k, body in enumerate(scene.bodies)}
    parts = [{name: rows[:, a:b] for name, rows in each.items()} for a, b in ((0, 3), (3, 7), (7, 10), (10, 13))]
    return Trajectory(scene, numbers[:, 0], *parts, numbers[:, 1], math.nan)


def debian_version(package):
    return subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True,
                          check=True).stdout
