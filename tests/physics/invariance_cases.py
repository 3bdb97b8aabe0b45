# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 8: what must not change a run. Forces as slopes of their energies: slope_cases.py; save and load: saving_cases.py."""
import os
import shutil
import subprocess
import tempfile

import numpy as np
import small_scene
import yade.wrapper as yw
import yade_timber as yt
from planar_scene import advance
from rows import Registry, Row
from scipy.spatial.transform import Rotation
from small_scene import NAMES, vertical

case = Registry()
O = yw.Omega()
DURATION = 0.4
"""The block slides 0.3 m, hits the column and comes to rest; the frame swings. [s]"""
SCHEMES = {"implicit": {"dt": 1e-4}, "explicit": {"dt": 2e-5, "sweeps": 0}}


def final_places(order=NAMES, turn=np.eye(3), shift=(0, 0, 0), **options):
    """Final positions (4, 3) in the order of NAMES, turned and shifted back [m]."""
    ids = small_scene.load(order, turn, shift, **options)
    advance(DURATION)
    return (small_scene.placements(ids[n] for n in NAMES)[:, :3] - np.asarray(shift, float)) @ turn


@case
def placement_of_the_scene():
    """Turned, mirrored and moved scenes end in the same place, turned, mirrored and moved."""
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
    odd = Rotation.from_rotvec([0.3, -0.5, 0.8]).as_matrix()
    # Rounding, grown by an impact: 1e-16 m at the start became 1e-12 m. A quarter turn is not exact to the bit either: the
    # bodies' frames are turned by a quaternion of sqrt(1/2). At 1 km positions are rounded to 1e-13 m, static overlaps of 5 um
    # to 2e-8 of themselves: 5e-10 m was seen.
    changes = [
        ("turned by 90 degrees", {"turn": quarter}, 1e-9),
        ("mirrored", {"turn": np.diag([-1.0, 1, 1])}, 1e-9),
        ("turned by an odd angle about the vertical", {"turn": vertical(0.7)}, 1e-9),
        ("turned about an odd axis, gravity too", {"turn": odd}, 1e-9),
        ("moved by 1 km", {"shift": (600, -700, 390)}, 1e-7),
    ]
    rows = []
    for scheme, options in SCHEMES.items():
        straight = final_places(**options)
        for name, change, bound in changes:
            off = abs(final_places(**change, **options) - straight).max()
            rows.append(Row("8", f"{name}, {scheme} dashpots: distance [m]", 0, off, bound=bound, dt=options["dt"]))
    return rows


@case
def order_of_bodies():
    """Ids reversed: every pair is seen from its other body, and the sweeps over the contacts run in another order."""
    rows = []
    # Explicit: rounding. Implicit: Gauss-Seidel sweeps end before they have converged, at a change of 1e-3 of the impulses: 2.3e-6 m
    # was seen after 0.3 m of way, 4e-7 m with a tolerance of 1e-4; with no more than four sweeps (50 are allowed) 1.1e-4 m.
    for scheme, bound in (("explicit", 1e-10), ("implicit", 2e-5)):
        options = SCHEMES[scheme]
        off = abs(final_places(NAMES[::-1], **options) - final_places(**options)).max()
        rows.append(Row("8", f"bodies in reverse order, {scheme} dashpots: distance [m]", 0, off, bound=bound, dt=options["dt"]))
    return rows


@case
def far_apart_pairs():
    """A second scene 100 m away does not change a bit of the first."""
    small_scene.load()
    advance(DURATION)
    alone = small_scene.as_hex()
    O.reset()
    ids = small_scene.append()
    far = {"turn": vertical(1.0), "shift": (100, 30, 0)}
    other = small_scene.append(**far)
    O.engines, O.dt = yt.engines(), SCHEMES["implicit"]["dt"]
    small_scene.join(ids)
    small_scene.join(other, **far)
    advance(DURATION)
    different = sum(a != b for a, b in zip(alone, small_scene.as_hex()))
    return [Row("8", "second scene 100 m away: numbers of the first that differ [-]", 0, different, bound=0, dt=O.dt, note="of 52, all bits")]


def in_other_process(threads, duration=DURATION):
    """Final state of the small scene from a YADE of its own: (threads it had, list of hexadecimal numbers)."""
    script = os.path.abspath(small_scene.__file__)
    path = os.pathsep.join([os.path.dirname(os.path.dirname(yt.__file__)), os.environ.get("PYTHONPATH", "")])
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            [shutil.which("yade"), f"-j{threads}", "-n", "-x", script, str(duration)], cwd=folder, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, timeout=120
        )
    lines = {line.split()[0]: line.split()[1:] for line in run.stdout.splitlines() if line.startswith(("threads ", "state "))}
    if run.returncode or len(lines) != 2:
        raise RuntimeError(f"yade -j{threads} failed:\n{run.stdout}\n{run.stderr}")
    return int(lines["threads"][0]), lines["state"]


@case
def one_thread_or_two(duration=DURATION):
    """Sums go island by island in the order of ids: not a bit depends on the number of threads. (test_run.py compares a whole house.)"""
    (few, one), (many, two) = in_other_process(1, duration), in_other_process(2, duration)
    return [
        Row("8", "threads of the second run [-]", 2 * few, many, bound=0),
        Row("8", "1 and 2 threads: numbers that differ [-]", 0, sum(a != b for a, b in zip(one, two)), bound=0, dt=1e-4, note="of 52, all bits"),
    ]
