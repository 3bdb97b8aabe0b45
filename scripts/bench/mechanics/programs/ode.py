# SPDX-License-Identifier: GPL-2.0-or-later
"""ODE, from Debian's libode-dev: ode.cpp is compiled on first use. Boxes alone."""
import math
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from mechanics.program import NotPossible, NotRun, Program
from mechanics.scene import Trajectory, sampling

SOURCE = Path(__file__).with_suffix(".cpp")
FOLDER = tempfile.TemporaryDirectory()
PROGRAM = Path(FOLDER.name) / "ode"


def compiled():
    if not PROGRAM.exists():
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "ode"], capture_output=True, text=True, check=True)
        subprocess.run(["g++", "-std=c++17", "-O2", str(SOURCE), "-o", str(PROGRAM), *flags.stdout.split()], check=True)
    return PROGRAM


def described(scene, dt):
    """The text that ode.cpp reads."""
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


def run(scene, dt):
    if any(body.corners for body in scene.bodies):
        raise NotRun("hulls")
    if any(joint.strength for joint in scene.joints):
        raise NotPossible("no strength of joints")
    done = subprocess.run([compiled()], input=described(scene, dt), capture_output=True, text=True, timeout=900)
    if done.returncode:
        raise RuntimeError(f"the program ends with status {done.returncode}: {done.stderr}")
    numbers = np.array([list(map(float, line.split())) for line in done.stdout.splitlines()])
    each = {body.name: numbers[:, 2 + 13 * k:15 + 13 * k] for k, body in enumerate(scene.bodies)}
    parts = [{name: rows[:, a:b] for name, rows in each.items()} for a, b in ((0, 3), (3, 7), (7, 10), (10, 13))]
    return Trajectory(scene, numbers[:, 0], *parts, numbers[:, 1], math.nan)


def program():
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libode-dev"], capture_output=True, text=True,
                             check=True).stdout
    return Program("ODE", f"libode {version}", "dWorldStep, 8 contacts a pair", run, (1 / 60, 1 / 240, 1 / 1000))
