# SPDX-License-Identifier: GPL-2.0-or-later
"""Shear of a wall whose boards are nailed to the frame, from tests of single nails. Lengths in m, forces in N.

Frame and boards stay straight. The frame shears by the angle gamma, a board turns by a part of it so that the nails'
work is least. A nail at (x, y) from the board's centre then slips by gamma Ixy / Ix y along the board's width and by
gamma Ixy / Iy x along its height:

    Ix = sum y^2, Iy = sum x^2, Ixy = 1 / (1/Ix + 1/Iy)      M = k Ixy gamma
    Zxy = Ixy gamma / (slip of the corner nail)              My = Pv Zxy            the corner nail yields
    Zpxy = sum of the slips / gamma                          Mu = Pv Zpxy           all nails yield

over all boards, each with its own Ixy. The boards shear as well, by M / (G V) with their volume V. The wall's shear is
M over its height H:

    K = 1 / (1/(k Ixy) + 1/(G V)) / H      gamma_v = Mu / (H K)      gamma_u = gamma_v + (du - Pv/k) Zpxy / Ixy
    mu = gamma_u / gamma_v                 Pa = min(My / H, 0.2 sqrt(2 mu - 1) Mu / H, K / 150)

Source: allowable stress design of post-and-beam houses (Japan Housing and Wood Technology Center), 3.3, detailed
calculation of walls with boards; the formulas follow from the mechanics above."""
from dataclasses import dataclass

import numpy as np

CODE_DRIFT = 1 / 150  # drift up to which the allowable shear is within the stiffness. [rad]


@dataclass(frozen=True)
class NailedWall:
    """stiffness K [N/rad]; yield and ultimate moment [N m]; drifts gamma_v and gamma_u [rad]; height [m]."""

    stiffness: float
    yield_moment: float
    ultimate_moment: float
    yield_drift: float
    ultimate_drift: float
    height: float

    @property
    def ductility(self):
        return self.ultimate_drift / self.yield_drift

    @property
    def strength(self):
        """Shear at which all nails yield. [N]"""
        return self.ultimate_moment / self.height

    @property
    def allowable(self):
        """[N]"""
        return min(self.yield_moment / self.height, 0.2 * (2 * self.ductility - 1) ** 0.5 * self.strength,
                   CODE_DRIFT * self.stiffness)


def nailed_wall(nails):
    """NailedWall of the table `nails` of a wall type."""
    board = nails["board"]
    arrays = []
    for x, y in (_positions(nails, height).T for height in board["heights"]):
        ix, iy = (y**2).sum(), (x**2).sum()
        of_board = ix * iy / (ix + iy)
        slips = np.hypot(y / ix, x / iy) * of_board
        arrays.append((of_board, of_board / slips.max(), slips.sum()))
    ixy, zxy, zpxy = np.sum(arrays, axis=0)
    height = sum(board["heights"]) if nails["height"] is None else nails["height"]
    shear = board["shear_modulus"] * board["thickness"] * board["width"] * sum(board["heights"])
    stiffness = 1 / (1 / (nails["k"] * ixy) + 1 / shear) / height
    ultimate = nails["Pv"] * zpxy
    drift = ultimate / height / stiffness
    slip = nails["du"] - nails["Pv"] / nails["k"]
    return NailedWall(stiffness, nails["Pv"] * zxy, ultimate, drift, drift + slip * zpxy / ixy, height)


def _positions(nails, height):
    """(n, 2) nails of a board from its centre: along its edges, with an inner spacing on the vertical centre line."""
    half = np.array([nails["board"]["width"], height]) / 2 - nails["board"]["edge"]
    sides, ends = _line(half[1], nails["spacing"]), _line(half[0], nails["spacing"])[1:-1]
    points = [(x, y) for x in (-half[0], half[0]) for y in sides] + [(x, y) for x in ends for y in (-half[1], half[1])]
    if nails["inner_spacing"] is not None:
        points += [(0.0, y) for y in _line(half[1], nails["inner_spacing"])[1:-1]]
    return np.array(points)


def _line(half, spacing):
    """Nails at equal distances, about the spacing, from -half to half."""
    return np.linspace(-half, half, max(1, round(2 * half / spacing)) + 1)
