# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of a joint type from a cyclic test, and a joint with them in three cycles (docs/fit_a_joint.md).

    yade -n -x scripts/examples/fit_joint.py

The points are an example; put those of your test in their place.
"""
import numpy as np
import yade_timber as yt
from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import ForceResetter

# A test of one fitting: envelope of the first cycles [m, N]; amplitude [m] and area [J] of a third cycle
stretch = np.array([0, 0.001, 0.002, 0.004, 0.008, 0.012, 0.020, 0.030])
force = np.array([0, 1700, 3200, 5400, 7000, 7400, 6900, 5200])
amplitude, area = 0.008, 24.0

top = force.argmax()
peak, up, down = force[top], slice(0, top + 1), slice(None, top - 1 if top else None, -1)
low, high = np.interp([0.1 * peak, 0.4 * peak], force[up], stretch[up])
k = 0.3 * peak / (high - low)                                     # secant between 10 and 40 % of the peak
end = np.interp(0.8 * peak, force[down], stretch[down])           # stretch at which 80 % are left
x = np.linspace(0, end, 1000)
work = np.interp(x, stretch, force).mean() * end                  # area under the curve up to there
F = k * (end - np.sqrt(end**2 - 2 * work / k))                    # elastic and plastic line of the same area
d_c = np.interp(F, force[down], stretch[down])                    # the curve falls below F here
d_u = d_c + (end - d_c) * F / (F - 0.8 * peak)                    # line through 80 % to no force
phi = area / (4 * F * (amplitude - F / k))
print(f"{{law: slip, per: joint, kn: {k:.3g}, ks: {k:.3g}, strength: {F:.0f}, friction_share: {phi:.2f}, "
      f"softening_stretch: {d_c:.4f}, ultimate_stretch: {d_u:.4f}}}")

base = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
column = O.bodies.append(yt.box((0.1, 0.1, 1), (0, 0, 0.5)))
O.dt, O.engines = 1e-4, yt.engines()
joint = yt.connect(base, column, [(0, 0, 0)], stiffness=(k, k), strength=F, slip=yt.SlipLaw(d_c, d_u, phi))
O.engines = [ForceResetter(), next(e for e in O.engines if isinstance(e, yt.JointEngine))]
start = O.bodies[column].state.pos


def pull(z):
    """Force of the joint [N] at the stretch z [m]."""
    O.bodies[column].state.pos = start + Vector3(0, 0, z)
    O.step()
    return -joint.forces[0][2]


turns = amplitude * np.array([0, 1, -1, 1, -1, 1, -1, 1])
path = np.concatenate([np.linspace(a, b, 200) for a, b in zip(turns, turns[1:])])
loop = [pull(z) for z in path][-400:]
print(f"third cycle: {abs(np.sum((loop[1:] + np.array(loop[:-1])) / 2 * np.diff(path[-400:]))):.1f} J")
