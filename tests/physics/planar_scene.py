# SPDX-License-Identifier: GPL-2.0-or-later
"""A plane frame (planar_frame.py) as a scene in YADE: same x and z; the prisms extend along y."""
import numpy as np
import yade.wrapper as yw
import yade_timber as yt

O = yw.Omega()
UNBREAKABLE = 1e12
"""[N]"""


def extruded(part):
    """Corners (2n, 3) of a prism [m]."""
    return np.array([[x, y, z] for y in (-part.width / 2, part.width / 2) for x, z in part.corners])


def append_parts(parts, timber):
    """Append prisms (list of planar_frame.Part) of one material (planar_frame.Timber)."""
    material = yt.timber(timber.young, timber.poisson, timber.density, timber.friction)
    for part in parts:
        O.bodies.append(yt.polyhedron(extruded(part), material, fixed=part.fixed, name=part.name))


def build_frame(frame, dt=1e-4, **options):
    """Empty YADE and build the frame; body ids are the indices of its parts. options: of `yade_timber.engines`."""
    O.reset()
    append_parts(frame.parts, frame.timber)
    O.engines = yt.engines(**options)
    O.dt = dt
    for tie in frame.ties:
        a, b = frame.index[tie.first], frame.index[tie.second]
        half = min(frame.parts[a].width, frame.parts[b].width) / 2
        points = [[x, y, z] for y in (-half, half) for x, z in tie.points]
        yt.connect(a, b, points, stiffness=(tie.stiffness, tie.stiffness), strength=UNBREAKABLE)


def advance(duration):
    """Run for a time [s], rounded to steps."""
    O.run(round(duration / O.dt), True)


def recorded(duration, every, probe):
    """Run for a time [s] and return (m, ...) values of probe() at its start and after each `every` seconds."""
    rows = [probe()]
    for _ in range(round(duration / every)):
        for _ in range(round(every / O.dt)):
            O.step()
        rows.append(probe())
    return np.array(rows)


def positions():
    """Positions (n, 3) of all bodies [m]."""
    return np.array([b.state.pos for b in O.bodies])


def start_in_mode(parts, shape):
    """Give the parts (ids of the free ones) the velocities of a mode shape: (x, z, angle) for each, [m/s], [rad/s]."""
    for k, (x, z, angle) in zip(parts, shape.reshape(-1, 3)):
        yt.set_velocity(O.bodies[int(k)], (x, 0, z),
                        (0, -angle, 0))  # angles are positive from x to z: negative about y
