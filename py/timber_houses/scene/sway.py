# SPDX-License-Identifier: GPL-2.0-or-later
"""Damping of the sway of a house: damping times of the joints of its walls (docs/theory.md, section 4).

The scene that is loaded has settled under its own weight. Its first sway modes E-W and N-S, each of unit modal mass,
have with the dashpots of all contacts and joints the power P and the damping ratio

    zeta_m = P / (2 omega_m) + sum over joints tau_j E_jm / (2 omega_m)        E_jm = phi_m' K_j phi_m

The stated ratio gives one time tau for each mode. A joint has their mean, weighted by its energies E_jm in both modes.
Where contacts carry most of the elastic energy, as in braced houses, joints cannot add the rest: tau is limited."""
import numpy as np
import scipy  # submodules load on first use; most runs need no optimize
import yade.wrapper as yw
from yade_timber.plugin import compiled
from yade_timber.scene.engines import find_engine

from . import modes

HORIZONTAL = (0, 1)  # components east and north
MOST = 2.0
"""Largest time over that of a house whose joints have all of the elastic energy, 2 zeta / omega. [-] Larger: joints of
braced houses would be overdamped once contacts have opened; smaller: less than the stated ratio where sheets join
slender members (their joints have 0.7 to 0.9 of the energy)."""
O = yw.Omega()


def damping_times(ratio, bodies, chosen):
    """(J,) damping times with which the sway of a structure has a damping ratio. [s]

    Zero where contacts alone have the ratio, and for a structure without stable sway. bodies: ids of those of the
    structure; chosen: (J,) bool, its joints among those of the scene"""
    linearised = modes.springs(initial=True)
    sway = sway_modes(bodies, linearised)
    if not sway:
        return np.zeros(len(chosen))
    energies = np.column_stack([*joint_energies(linearised, sway)]) * chosen[:, None]
    omega = np.sqrt([mode.omega2 for mode in sway])
    own = np.array([compiled.dashpot_power(mode.shape.tobytes()) for mode in sway]) / (2 * omega)
    total = energies.sum(1, keepdims=True)
    weights = np.divide(energies, total, out=np.zeros_like(energies), where=total > 0)
    limits = 0, MOST * 2 * ratio / omega
    found = scipy.optimize.lsq_linear(energies.T @ weights / (2 * omega[:, None]), ratio - own, limits).x
    return np.array([float(f"{time:.3g}") for time in weights @ found])  # the same on all processors


def sway_modes(bodies, linearised):
    """Modes of these bodies, all others fixed, that move most of their mass E-W and N-S; one where they are the same,
    none unstable."""
    found = [mode for mode in modes.natural_modes(bodies=bodies, linearised=linearised) if mode.omega2 > 0]
    most = [max(found, key=lambda mode: mode.mass[axis], default=None) for axis in HORIZONTAL]
    return [mode for k, mode in enumerate(most) if mode is not None and mode not in most[:k]]


def joint_energies(linearised, sway):
    """(J,) twice the elastic energy of the joints in each mode of `sway`. linearised: Springs of the scene"""
    joints = find_engine(yw.JointEngine).joints
    owner = modes.joint_of_springs(joints)
    first = len(linearised.body) - len(owner)  # behind those of the contacts
    body, arm = linearised.body[first:], linearised.arm[first:]
    normal, shear = linearised.stiffness[first:].T
    for shape in (mode.shape for mode in sway):
        ends = shape[body, :3] + np.cross(shape[body, 3:], arm)
        stretch = ends[:, 1] - ends[:, 0]
        along = (stretch * linearised.normal[first:]).sum(1) ** 2
        yield np.bincount(owner, normal * along + shear * ((stretch**2).sum(1) - along), len(joints))
