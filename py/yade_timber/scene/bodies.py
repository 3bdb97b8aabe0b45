# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies: rounded convex polyhedra of timber or snow. Needs a running YADE."""
import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Quaternion, Vector3

TIMBER_DENSITY = 340.0
"""Japanese cypress. [kg/m3] (paper, section 3.4)"""
TIMBER_YOUNG = 90e3 * 9.8e4
"""90e3 kgf/cm2 with the paper's 9.8 N per kgf. [Pa] (paper, section 3.1)"""


def timber(young=TIMBER_YOUNG, poisson=0.4, density=TIMBER_DENSITY, friction=0.5, label=""):
    """Material of timber elements: Young's modulus [Pa], Poisson's ratio [-], density [kg/m3], friction coefficient [-].

    A pair of materials has the smaller of its two friction coefficients. Raises ValueError outside the physical range.
    """
    return yw.TimberMat(young=young, poisson=poisson, density=density, friction=friction, label=label)


def snow(density=90.0, stiffness_per_kg=3.948e4, friction=0.5, label=""):
    """Material of snow elements: density [kg/m3], contact stiffness per mass [N/m/kg] (paper, Table 1), friction [-]."""
    return yw.SnowMat(density=density, stiffnessPerMass=stiffness_per_kg, friction=friction, label=label)


def to_digits(corners):
    """Corners to 13 digits of their extent: equal elements in different places of a street get equal numbers and share their geometry. [m]"""
    digit = 10.0 ** (np.floor(np.log10(np.abs(corners).max())) - 12)
    return np.round(corners / digit) * digit + 0.0  # no negative zeros


def polyhedron(vertices, material=None, fixed=False, radius=None, name="", kind="", color=None):
    """Body of any convex shape; append it to `O.bodies`.

    vertices  (n, 3) corners in the world frame [m]
    material  from `timber()` or `snow()`; default timber
    fixed     whether it never moves
    radius    rounding radius [m]; None: 10 % of the shortest edge (paper, section 2.2)
    Raises ValueError when the vertices are no corners of a convex polyhedron or the radius leaves no core, TypeError for a
    material of another kind.
    """
    if material is not None and not isinstance(material, (yw.TimberMat, yw.SnowMat)):
        raise TypeError(f"material {type(material).__name__}: it must come from timber() or snow()")
    vertices = np.asarray(vertices, float)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise ValueError(f"vertices of shape {vertices.shape}: they must be (n, 3), n >= 4")
    if radius is not None and not radius > 0:
        raise ValueError(f"radius = {radius} m: it must be > 0, or None for 10 % of the shortest edge")
    origin = vertices.mean(0)  # far from the world's origin the moments would lose digits
    raw = yw.RoundedPolyhedron(vertices=[Vector3(*(v - origin)) for v in vertices], radius=radius or 0)
    volume, centroid, inertia, axes = raw.massProperties()
    axes = Quaternion(axes)
    corners = np.array([axes.conjugate() * (Vector3(*(v - origin)) - centroid) for v in vertices])
    local = [Vector3(*v) for v in to_digits(corners)]
    turned = axes.conjugate().toRotationMatrix() * inertia * axes.toRotationMatrix()

    body = yw.Body()
    body.shape = yw.RoundedPolyhedron(vertices=local, radius=radius or 0, name=name, kind=kind)
    if color is not None:
        body.shape.color = Vector3(*color)
    body.material = material if material is not None else timber()
    density = body.material.density
    body.state.mass = density * volume
    body.state.inertia = density * Vector3(turned[0, 0], turned[1, 1], turned[2, 2])
    body.state.pos = body.state.refPos = Vector3(*origin) + centroid
    body.state.ori = body.state.refOri = axes
    body.bound = yw.Aabb()
    body.aspherical = True
    if fixed:
        body.dynamic = False
    return body


def box(extents, centre, orientation=None, material=None, fixed=False, radius=None, name="", kind="", color=None):
    """Rectangular parallelepiped: extents (3,) full edge lengths [m], centre (3,) [m], orientation a Quaternion or None.

    The rest as in `polyhedron`. Raises ValueError for extents that are not all finite and > 0.
    """
    extents, centre = np.asarray(extents, float), np.asarray(centre, float)
    if extents.shape != (3,) or not (np.isfinite(extents).all() and (extents > 0).all()):
        raise ValueError(f"extents = {extents}: they must be three finite lengths > 0")
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * extents
    if orientation is not None:
        corners = np.array([orientation * Vector3(*c) for c in corners])
    return polyhedron(corners + centre, material, fixed, radius, name, kind, color)


def set_velocity(body, velocity, angular_velocity=(0, 0, 0)):
    """Give a body a velocity (3,) [m/s] and angular velocity (3,) [rad/s], world frame: the integrator goes by its momenta."""
    body.state.vel, body.state.angVel = Vector3(*velocity), Vector3(*angular_velocity)
    body.state.angMom = angular_momentum(body)


def angular_momentum(body):
    """I omega of a body, world frame. [kg m2/s]"""
    local = body.state.ori.conjugate() * body.state.angVel
    return body.state.ori * Vector3(*(local[k] * body.state.inertia[k] for k in range(3)))
