# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies: rounded convex polyhedra of timber or snow. Needs a running YADE."""
import math
import re
from contextlib import contextmanager
from functools import lru_cache

import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Quaternion, Vector3

from . import arguments
from .background import follow_velocity
from .queries import imposed_velocities

O = yw.Omega()
KEPT = 4096  # number of shapes whose moments are kept: a house is built twice, lots of a town share members. [-]
LEAST_RADIUS = 1e-4  # smallest rounding radius that a caller may give, that of the tolerance for flush faces. [m]
_TIMBER, _SNOW = yw.TimberMat(), yw.SnowMat()  # the paper's values


def timber(young=_TIMBER.young, poisson=_TIMBER.poisson, density=_TIMBER.density, friction=_TIMBER.friction, label="",
           bearing=None):
    """Material of timber elements.

    Parameters
    ----------
    young : float
        Young's modulus. [Pa]
    poisson : float
        Poisson's ratio. [-]
    density : float
        [kg/m3]
    friction : float
        Friction coefficient [-]; a pair of materials has the smaller of its two coefficients.
    label : str
    bearing : float, optional
        Bearing strength, at which contacts yield [Pa]: about 6e6 for softwood across the grain. A pair has the smaller
        one. By default contacts are elastic, as in the paper and as for stone or steel.

    Returns
    -------
    TimberMat

    Raises
    ------
    ValueError
        Outside the physical range.
    """
    return yw.TimberMat(young=arguments.number("timber: young", young, "Pa"),
                        poisson=arguments.number("timber: poisson", poisson),
                        density=arguments.number("timber: density", density, "kg/m3"),
                        friction=arguments.number("timber: friction", friction),
                        bearing=(math.inf if bearing is None
                                 else arguments.positive("timber: bearing", bearing, "Pa", infinite=True)),
                        label=arguments.text("timber: label", label))


def snow(density=_SNOW.density, stiffness_per_kg=_SNOW.stiffnessPerMass, friction=_SNOW.friction, label=""):
    """Material of snow elements.

    Parameters
    ----------
    density : float
        [kg/m3]
    stiffness_per_kg : float
        Contact stiffness per mass of the lighter element [N/m/kg] (paper, Table 1).
    friction : float
        Friction coefficient. [-]
    label : str

    Returns
    -------
    SnowMat
    """
    return yw.SnowMat(density=arguments.number("snow: density", density, "kg/m3"),
                      stiffnessPerMass=arguments.number("snow: stiffness_per_kg", stiffness_per_kg, "N/m/kg"),
                      friction=arguments.number("snow: friction", friction), label=arguments.text("snow: label", label))


def polyhedron(vertices, material=None, fixed=False, radius=None, name="", kind="", color=None):
    """Body of any convex shape; append it to ``O.bodies``.

    Parameters
    ----------
    vertices : (n, 3) array_like
        Corners in the world frame. [m]
    material : TimberMat or SnowMat, optional
        From `timber` or `snow`; by default timber.
    fixed : bool
        Whether it never moves.
    radius : float, optional
        Rounding radius [m]; by default 10 % of the shortest edge (paper, section 2.2).
    name, kind : str
        For pictures and tables.
    color : (3,) array_like, optional
        RGB, 0 to 1; by default YADE's.

    Returns
    -------
    Body

    Raises
    ------
    ValueError
        When the vertices are no corners of a convex polyhedron, or the radius is not below that of the inscribed
        sphere.
    TypeError
        For a material of another kind.
    """
    material = (timber() if material is None
                else arguments.instance("material", material, (yw.TimberMat, yw.SnowMat), "from timber() or snow()"))
    fixed = arguments.flag("fixed", fixed)
    radius = 0 if radius is None else arguments.positive("radius", radius, "m")
    if 0 < radius < LEAST_RADIUS:
        arguments.refuse(ValueError, "radius", radius,
                         f"at least {LEAST_RADIUS:g} m: contacts carry no more than at an overlap of both radii")
    name, kind = arguments.text("name", name), arguments.text("kind", kind)
    look = {} if color is None else {"color": arguments.vector("color", color)}
    body = principal_body(arguments.points("vertices", vertices), material.density, radius=radius, name=name, kind=kind,
                          **look)
    body.material = material
    body.bound = yw.Aabb()
    body.dynamic = not fixed
    return body


PLACE = re.compile(r"(vert(?:ex|ices) (\d+)(?: and \d+ are the same point)?) \([^()]*\)")
"""Of an error: a vertex, by its number, and its position."""


@contextmanager
def named_as_given(vertices):
    """Context in which an error of a shape has the positions of these vertices (n, 3) [m], by their numbers."""
    try:
        yield
    except (ValueError, RuntimeError) as problem:
        text = PLACE.sub(lambda place: f"{place[1]} ({', '.join(f'{x:.9g}' for x in vertices[int(place[2])])})",
                         str(problem))
        raise type(problem)(text) from None


def principal_body(vertices, density, radius, **look):
    """Body with the principal axes of inertia. vertices (n, 3) world [m]; radius, 0: default; look: of shape"""
    origin = vertices.mean(0)  # far from the world's origin the moments would lose digits
    with named_as_given(vertices):
        volume, centroid, moments, axes, corners = _principal((vertices - origin).tobytes(), radius)
    body = yw.Body()
    body.shape = yw.RoundedPolyhedron(vertices=corners, radius=radius, **look)
    body.state.mass = density * volume
    body.state.inertia = density * moments
    body.state.pos = body.state.refPos = Vector3(*origin) + centroid
    body.state.ori = body.state.refOri = axes
    body.aspherical = True
    return body


@lru_cache(maxsize=KEPT)
def _principal(numbers, radius):
    """(volume [m3], centroid [m], moments of inertia over the density [m5], axes, corners in these [m]) of vertices."""
    vertices = [Vector3(*v) for v in np.frombuffer(numbers).reshape(-1, 3)]
    volume, centroid, inertia, axes = yw.RoundedPolyhedron(vertices=vertices, radius=radius).massProperties()
    axes = Quaternion(axes)
    corners = np.array([axes.conjugate() * (v - centroid) for v in vertices])
    digit = 10.0 ** (np.floor(np.log10(np.abs(corners).max())) - 12)  # equal elements anywhere share their geometry
    rounded = np.round(corners / digit) * digit + 0.0  # no negative zeros
    principal = axes.conjugate().toRotationMatrix() * inertia * axes.toRotationMatrix()
    return volume, centroid, Vector3(*principal.diagonal()), axes, [Vector3(*v) for v in rounded]


def box(extents, centre, orientation=None, material=None, fixed=False, radius=None, name="", kind="", color=None):
    """Rectangular parallelepiped; append it to ``O.bodies``.

    Parameters
    ----------
    extents : (3,) array_like
        Full edge lengths. [m]
    centre : (3,) array_like
        World frame. [m]
    orientation : Quaternion, optional
        From the body's to the world's axes.
    material, fixed, radius, name, kind, color
        As in `polyhedron`.

    Returns
    -------
    Body

    Raises
    ------
    ValueError
        For extents that are not all finite and > 0.
    """
    form = "three finite lengths > 0 [m]"
    extents = arguments.numbers_of_shape("extents", extents, (3,), form)
    if not (extents > 0).all():
        arguments.refuse(ValueError, "extents", extents, form)
    centre = np.array(arguments.vector("centre", centre, "m"))
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * extents
    if orientation is not None:
        arguments.instance("orientation", orientation, Quaternion, "a Quaternion or None")
        corners = np.array([orientation * Vector3(*c) for c in corners])
    return polyhedron(corners + centre, material, fixed, radius, name, kind, color)


def set_velocity(body, velocity, angular_velocity=(0, 0, 0)):
    """Give a body a velocity, and the angular momentum that the integrator needs; the energy is booked as imposed.

    Parameters
    ----------
    body : Body or int
        The body, or its id.
    velocity : (3,) array_like
        World frame. [m/s]
    angular_velocity : (3,) array_like
        World frame. [rad/s]
    """
    if not isinstance(body, yw.Body):
        body = O.bodies[arguments.present_ids("set_velocity", body)[0]]
    velocity = arguments.vector("velocity", velocity, "m/s")
    angular_velocity = arguments.vector("angular_velocity", angular_velocity, "rad/s")
    with imposed_velocities():
        body.state.vel, body.state.angVel = velocity, angular_velocity
        follow_velocity(body.state)
