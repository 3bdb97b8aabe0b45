# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts, energies and stable time step of the scene that is loaded in YADE."""
from contextlib import contextmanager

import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Vector3

from ..energy_terms import IMPOSED, SUPPLIED
from ..plugin import compiled
from . import arguments
from .background import between_steps
from .engines import find_engine

TAG = f"yade-timber {IMPOSED}"
"""Tag of the scene: energy that velocities have brought in which `set_velocity` imposed. [J]"""
O = yw.Omega()


class Points(list):
    """Contact points; a short table at the prompt."""

    def __repr__(self):
        rows = (f"{' '.join(f'{x:9.4f}' for x in p['position'])}  {p['overlap'] * 1e6:10.4g}  {p['normal_force']:11.4g}"
                f"  {p['shear_force'].norm():11.4g}"
                for p in self)
        return "\n".join(["position x, y, z [m]           overlap [um]   normal [N]    shear [N]", *rows])


class Energies(dict):
    """Terms of the energy balance; a short table at the prompt."""

    def __repr__(self):
        return "\n".join(f"{name:17} {value:11.4g} J" for name, value in self.items())


@between_steps()
def contacts(id1, id2):
    """Contact points between two bodies, with the forces of the last step.

    Parameters
    ----------
    id1, id2 : int or Body
        The bodies, or their ids.

    Returns
    -------
    list of dict
        For each point, world frame: ``position`` [m], ``normal`` (from body 1 to body 2) [-], ``overlap`` [m],
        ``crushed`` (its plastic part) [m], ``normal_force`` (elastic and dashpot, >= 0) [N], ``shear_force`` (3,) on
        body 2 [N]. Empty when the bodies do not touch.

    Raises
    ------
    ValueError
        For an id that no body ever had.
    """
    id1, id2 = arguments.ids_of("contacts", id1, id2)
    interaction = O.interactions[id1, id2] if O.interactions.has(id1, id2) else None
    if interaction is None or not interaction.isReal:
        return Points()
    sign = 1 if interaction.id1 == id1 else -1
    forces = {f[0]: f[1:] for f in interaction.phys.points}
    points = Points()
    for position, normal, overlap, feature in interaction.geom.points:
        elastic, shear, dashpot, crushed = forces.get(feature, (0.0, Vector3.Zero, Vector3.Zero, 0.0))
        along = dashpot.dot(normal)
        points.append({"position": position, "normal": sign * normal, "overlap": overlap,
                       "crushed": crushed, "normal_force": elastic + along,
                       "shear_force": sign * (shear + dashpot - along * normal)})
    return points


def energy():
    """Terms of the energy balance of the scene now.

    Returns
    -------
    dict
        Energies [J]: ``kinetic``; ``gravity`` (potential, from the reference placement); ``elastic_contacts`` (from the
        placement of bodies in contact), ``elastic_joints``; ``ground_motion`` (work done by it), ``imposed_velocity``
        (by `set_velocity`, and by fixed bodies that move); dissipated: ``dashpot_normal``, ``dashpot_shear``,
        ``friction``, ``crushing`` (contacts at their bearing strength), ``broken_springs``, ``lost_contacts`` (points
        that vanished under load), ``joint_dashpot``, ``joint_yield``.
        The sum of all terms but ``ground_motion`` and ``imposed_velocity``, minus these two, is constant, unless
        engines of other packages apply forces (``ForceEngine``, ``AxialGravityEngine``): no term has their work.
    """
    contacts = find_engine(yw.ContactForces)
    return Energies(compiled.energy() | {IMPOSED: _booked() + (contacts.imposedWork if contacts else 0.0)})


def _booked():
    """Energy that velocities have brought in so far which `set_velocity` imposed. [J]"""
    return float(O.tags[TAG]) if TAG in O.tags.keys() else 0.0


def energy_residual(terms=None):
    """Residual of the energy balance; zero at the start of a scene at rest, also after `set_velocity`.

    Parameters
    ----------
    terms : dict
        From `energy` (default: those of the present state).

    Returns
    -------
    float
        [J]
    """
    terms = energy() if terms is None else terms
    arguments.instance("energy_residual: terms", terms, dict, "the dictionary that energy() returns")
    supplied, others = (sum(value for name, value in terms.items() if (name in SUPPLIED) == wanted)
                        for wanted in (True, False))
    return others - supplied


@contextmanager
def imposed_velocities():
    """Context between two steps: energy that velocities bring when they are set is booked as imposed."""
    with between_steps():
        before = energy_residual()
        yield
        O.tags[TAG] = repr(_booked() + energy_residual() - before)


def stable_dt(safety=0.5):
    """Largest stable time step of the elastic contacts and joints as they are now.

    Parameters
    ----------
    safety : float
        Factor on the result. [-]

    Returns
    -------
    float
        [s]; infinite when nothing touches.

    Notes
    -----
    2 / omega_max of the linearised scene (leapfrog; paper, Eq. 44 for one contact), with omega_max^2 the largest
    eigenvalue of M^-1 K by power iteration over all contact points and joint springs. It is sharp for explicit springs
    without dashpots (sweeps=0);
    implicit contacts and joints (the default) are stable beyond it. Contacts that do not touch yet do not count: call
    it after a few steps, or leave a safety for impacts.
    """
    arguments.positive("stable_dt: safety", safety)
    solver = find_engine(yw.ContactForces)
    if solver is None:
        raise ValueError("stable_dt: set O.engines = yade_timber.engines(...) first")
    squared = solver.largestEigenvalue()
    return safety * 2 / np.sqrt(squared) if squared > 0 else np.inf
