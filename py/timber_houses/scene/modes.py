# SPDX-License-Identifier: GPL-2.0-or-later
"""Natural modes of the scene that is loaded in YADE: small vibrations about its present state, undamped, contacts
sticking.

K x = omega^2 M x with six degrees of freedom per free body. K has the present tangent stiffness of every contact point
and joint spring, and the geometric stiffness of their present forces, by which weight softens a frame (P-delta). A
negative omega^2 is an instability. Contacts that do not touch have no stiffness: the scene should have settled.
Yielding joints have the stiffness with which they unload; walls that have not yielded, on request, that of the first
line of their envelope.

Free motions are left out: of bodies that no springs join to a fixed body, and slower than SLOWEST.
Modes of equal omega^2 have shapes by convention, so that a scene has one result, whatever was computed before."""
from dataclasses import dataclass

import numpy as np
import yade.wrapper as yw
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh, splu
from yade_timber.plugin import compiled
from yade_timber.scene.background import between_steps
from yade_timber.scene.engines import find_engine

SHIFT = -1.0  # eigenvalues nearest to this are found first [1/s2]; below zero, since a wreck has many at zero
SEARCHED = 40  # number of modes that are looked at. [-]
PIVOT = 0.01  # smallest diagonal pivot over the largest entry of its column; an unstable scene may need others. [-]
SLOWEST = 60.0
"""Longest period of a mode, and longest 2 pi / sqrt(-omega^2) of an unstable one [s]; slower motions are free.
Observed: unbraced frames up to 4 s, rounding of free motions 1e8 s."""
EQUAL = 1e-6
"""Difference of omega^2 over omega^2 below which modes count as equal [-]; rounding turns the shapes of closer ones."""
O = yw.Omega()


@dataclass(frozen=True)
class Springs:
    """Linearised springs, P of them. body (P, 2) ids; arm (P, 2, 3) from the bodies' centres [m]; normal (P, 3);
    stiffness (P, 2) normal and tangential [N/m]; force (P, 3) on the second body [N]. World frame."""

    body: np.ndarray
    arm: np.ndarray
    normal: np.ndarray
    stiffness: np.ndarray
    force: np.ndarray


@dataclass(frozen=True)
class Mode:
    """omega2 [1/s2]; shape (N, 6): displacement [-], rotation [1/m] of bodies, of unit modal mass; mass (3,): effective
    [kg]."""

    omega2: float
    shape: np.ndarray
    mass: np.ndarray

    @property
    def period(self):
        """[s]; infinite for an unstable or free mode."""
        return 2 * np.pi / np.sqrt(self.omega2) if self.omega2 > 0 else np.inf


def springs(initial=False):
    """Springs of the scene as it is now. initial: walls, which have not yielded, have the stiffness at no drift"""
    pairs, values = compiled.packed_springs()
    values = np.frombuffer(values, "f8").reshape(-1, 14)
    arm, stiffness = values[:, :6].reshape(-1, 2, 3), values[:, 9:11]
    engine = find_engine(yw.JointEngine)
    if initial and engine is not None:
        lines = [joint.envelope[0] if joint.law == "wall" else (1.0, np.inf) for joint in engine.joints]
        shares = np.array([min(1.0, force / stretch / joint.kn) for (stretch, force), joint
                           in zip(lines, engine.joints)])[joint_of_springs(engine.joints)]
        stiffness = stiffness * np.concatenate([np.ones(len(stiffness) - len(shares)), shares])[:, None]
    return Springs(np.frombuffer(pairs, "i4").reshape(-1, 2), arm, values[:, 6:9], stiffness, values[:, 11:])


def joint_of_springs(joints):
    """Index of the joint of each unbroken spring; in Springs they stand behind those of the contacts."""
    return np.repeat(np.arange(len(joints)), [joint.broken.count(0) for joint in joints])


@between_steps()
def natural_modes(share=0.05, bodies=None, linearised=None):
    """Modes of effective mass east or north >= `share` of the free mass, unstable ones and long periods first.

    Only the SEARCHED lowest modes are looked at. Empty without springs. bodies: ids of those that move, default all;
    linearised: Springs, default those of the scene"""
    free = [b for b in O.bodies if b is not None and not b.state.blockedDOFs and (bodies is None or b.id in bodies)]
    mass, linearised = sum(b.state.mass for b in free), springs() if linearised is None else linearised
    free = _held(linearised, free)
    if not free:
        return []
    rows = {b.id: k for k, b in enumerate(free)}
    blocks = []  # masses [kg] and inertias in the world frame [kg m2]
    for b in free:
        axes = np.array(b.state.ori.toRotationMatrix())
        blocks += [b.state.mass * np.eye(3), axes @ np.diag(b.state.inertia) @ axes.T]
    K, M = stiffness_matrix(linearised, rows, len(free)), sparse.block_diag(blocks, "csc")
    omega2, vectors = _vibrations(K, M)
    ground = np.tile(np.eye(6)[:, :3], (len(free), 1))  # unit translations
    modes = []
    for group in _equal(omega2):
        vectors[:, group] = _by_convention(vectors[:, group], M @ ground)
        for vector in vectors[:, group].T:  # vectors are normalised: x' M x = 1
            shape = np.zeros((len(O.bodies), 6))
            shape[list(rows)] = vector.reshape(-1, 6)
            modes.append(Mode(float(omega2[group].mean()), shape, (vector @ (M @ ground)) ** 2))
    return sorted((mode for mode in modes if max(mode.mass[:2]) >= share * mass), key=lambda mode: mode.omega2)


def _held(linearised, free):
    """Those of the free bodies that springs join to a fixed one, directly or through others."""
    rows = {b.id: k for k, b in enumerate(free)}
    ground = len(free)  # stands for all fixed bodies
    one, two = np.array([rows.get(body, ground) for body in linearised.body.flat], int).reshape(-1, 2).T
    links = sparse.coo_matrix((np.ones(len(one)), (one, two)), shape=(ground + 1, ground + 1))
    _, part = connected_components(links, directed=False)
    return [b for b, of in zip(free, part) if of == part[ground]]


def _vibrations(K, M):
    """(omega2 (k,), vectors (n, k)) of the lowest modes, ascending; SEARCHED or more, none without convergence."""
    order, slowest = K.shape[0], (2 * np.pi / SLOWEST) ** 2
    start = np.random.default_rng(0).normal(size=order)  # ARPACK's own depends on earlier calls
    omega2, vectors, searched = np.empty(0), np.empty((order, 0)), 0
    try:
        factor = splu(K - SHIFT * M, "MMD_AT_PLUS_A", diag_pivot_thresh=PIVOT, options={"SymmetricMode": True})
        inverse = LinearOperator(K.shape, factor.solve, dtype=float)
        while len(omega2) < SEARCHED and searched < order - 1:
            searched = min(max(SEARCHED, searched + SEARCHED - len(omega2)), order - 1)
            omega2, vectors = eigsh(K, k=searched, M=M, sigma=SHIFT, which="LM", v0=start, OPinv=inverse)
            chosen = np.argsort(omega2, kind="stable")
            chosen = chosen[abs(omega2[chosen]) > slowest]
            omega2, vectors = omega2[chosen], vectors[:, chosen]
    except (ArpackError, RuntimeError):  # no convergence, or a singular factor
        return np.empty(0), np.empty((order, 0))
    return omega2, vectors


def _equal(omega2):
    """Slices of ascending omega2 whose neighbours are equal. [1/s2]"""
    ends = np.flatnonzero(np.diff(omega2) > EQUAL * abs(omega2[1:])) + 1
    bounds = [0, *ends.tolist(), len(omega2)]
    return [slice(a, b) for a, b in zip(bounds, bounds[1:])]


def _by_convention(vectors, momentum):
    """Shapes (n, k) of modes of one omega^2, of which any rotation is a solution.

    The first has all of the effective mass in the direction where that is largest, the second all that is left in the
    next direction, and so on. vectors (n, k); momentum (n, 3): of unit velocities of the ground"""
    shares = vectors.T @ momentum
    size = np.linalg.norm(shares, axis=0)
    directions = np.argsort(-np.round(size / max(size.max(), 1e-300), 6), kind="stable")
    return vectors @ np.linalg.qr(shares[:, directions], mode="complete")[0]


def stiffness_matrix(linearised, rows, count):
    """(6 count, 6 count) sparse symmetric matrix of Springs. rows: {body id: number of the free body}"""
    normal = linearised.normal[:, :, None] * linearised.normal[:, None, :]
    kn, ks = linearised.stiffness[:, 0, None, None], linearised.stiffness[:, 1, None, None]
    tangent = kn * normal + ks * (np.eye(3) - normal)
    ends = [np.concatenate([np.broadcast_to(np.eye(3), normal.shape), np.cross(linearised.arm[:, e, None], np.eye(3))],
                           axis=2) for e in (0, 1)]  # displacement = end @ x
    number = np.array([rows.get(body, -1) for body in linearised.body.flat]).reshape(-1, 2)
    blocks, places = [], []
    for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
        sign = 1 if i == j else -1
        blocks.append(sign * ends[i].transpose(0, 2, 1) @ tangent @ ends[j])
        places.append(number[:, [i, j]])
    for e, sign in ((0, -1), (1, 1)):
        blocks.append(_geometric(linearised.arm[:, e], sign * linearised.force))
        places.append(number[:, [e, e]])
    place, inner = np.concatenate(places), np.arange(6)
    free = (place >= 0).all(1)  # without blocks of fixed bodies
    block, place = np.concatenate(blocks)[free], place[free]
    row = np.broadcast_to(6 * place[:, 0, None, None] + inner[:, None], block.shape)
    column = np.broadcast_to(6 * place[:, 1, None, None] + inner, block.shape)
    return sparse.coo_matrix((block.ravel(), (row.ravel(), column.ravel())), shape=(6 * count, 6 * count)).tocsc()


def _geometric(arm, force):
    """(P, 6, 6) stiffness of constant forces at points of bodies: minus change of r x f with rotation, symmetric."""
    block = np.zeros((len(arm), 6, 6))
    outer, along = arm[:, :, None] * force[:, None, :], np.einsum("pi,pi->p", arm, force)
    block[:, 3:, 3:] = along[:, None, None] * np.eye(3) - (outer + outer.transpose(0, 2, 1)) / 2
    return block
