// SPDX-License-Identifier: GPL-2.0-or-later
/// Shape, bounding box and materials of the elements.
#pragma once
#include <kernel/polyhedron.hpp>
#include <pch.hpp>

namespace yade {

class RoundedPolyhedron : public Shape {
public:
	/// From the attributes, made by postLoad. Equal elements share it: what a step reads of a house's shapes stays small.
	shared_ptr<const timber::RoundedPolyhedron> geometry { new timber::RoundedPolyhedron };
	Real                      volume = 0; ///< of the sharp polyhedron [m3]

	void postLoad(RoundedPolyhedron&);
	/// (volume, centroid, inertia matrix about it for unit density, quaternion of the principal axes), frame of the vertices.
	boost::python::tuple massProperties() const;
	/// Faces as lists of vertex indices, counter-clockwise seen from outside.
	boost::python::list  faces() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(RoundedPolyhedron, Shape,
		"Convex polyhedron with rounded vertices and edges (paper, section 2.2): its faces moved inwards by :yref:`radius<RoundedPolyhedron.radius>`, plus a ball of that radius. "
		"The vertices are in the body frame: origin in the centroid, axes along the principal axes; ``yade_timber.polyhedron`` makes such a body from vertices in the world frame. "
		"Raises an error for vertices that are no corners of a convex polyhedron.",
		((vector<Vector3r>, vertices, , Attr::triggerPostLoad, "Corners of the sharp polyhedron, body frame. [m]"))
		((Real, radius, 0, Attr::triggerPostLoad, "Rounding radius; 0 takes 10 % of the shortest edge. [m] (paper, section 2.2)"))
		((string, name, , , "Name of the element, for reports. [-]"))
		((string, kind, , , "Kind of the element: column, beam, brace, ... [-]")),
		createIndex();,
		.def("massProperties", &RoundedPolyhedron::massProperties, "(volume [m3], centroid [m], inertia about it for unit density [m5], principal axes as Quaternion), frame of the vertices.")
		.def("faces", &RoundedPolyhedron::faces, "Faces as lists of vertex indices, counter-clockwise seen from outside. [-]")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(RoundedPolyhedron, Shape);
};
REGISTER_SERIALIZABLE(RoundedPolyhedron);

/// Distance by which the bounding box of an element is larger than the element, on all sides: `margin`, or more for one that is fast,
/// so that it does not leave its box within a few steps; 0 for other shapes, whose boxes others make. dt: time step [s]. [m]
Real boxMargin(const Body& b, Real margin, Real dt);

class Bo1_RoundedPolyhedron_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;
	FUNCTOR1D(RoundedPolyhedron);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Bo1_RoundedPolyhedron_Aabb, BoundFunctor, "Axis-aligned bounding box of a :yref:`RoundedPolyhedron`.",
		((Real, margin, 5e-3, , "Distance by which the box is larger on all sides, so that the collider need not run in every step, see :yref:`CollisionTrigger`; up to twenty times as much for bodies that are fast. [m]"))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Bo1_RoundedPolyhedron_Aabb);

/// Common base: YADE finds the functor of two different materials in either order only through a base class.
class ElementMat : public Material {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ElementMat, Material, "What elements are made of; use :yref:`TimberMat` or :yref:`SnowMat`.",
		((Real, friction, 0.5, Attr::triggerPostLoad, "Coulomb friction coefficient; a pair has the smaller one of its two materials. [-]")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(ElementMat, Material);
};
REGISTER_SERIALIZABLE(ElementMat);

class TimberMat : public ElementMat {
public:
	void postLoad(TimberMat&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(TimberMat, ElementMat, "Timber, or any other stiff material in Hertz contact (paper, section 3.1).",
		((Real, young, 90e3 * 9.8e4, Attr::triggerPostLoad, "Young's modulus: 90e3 kgf/cm2, with the paper's 9.8 N per kgf. [Pa] (paper, section 3.1)"))
		((Real, poisson, 0.4, Attr::triggerPostLoad, "Poisson's ratio. [-] (paper, section 3.1)")),
		createIndex(); density = 340;
	);
	// clang-format on
	REGISTER_CLASS_INDEX(TimberMat, ElementMat);
};
REGISTER_SERIALIZABLE(TimberMat);

class SnowMat : public ElementMat {
public:
	void postLoad(SnowMat&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SnowMat, ElementMat, "Snow as clumps in linear contact (paper, section 3.1 (2)).",
		((Real, stiffnessPerMass, 3.948e4, Attr::triggerPostLoad, "Contact stiffness, normal and tangential, per kilogram of the snow element. [N/m/kg] (paper, Table 1)")),
		createIndex(); density = 90;
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SnowMat, ElementMat);
};
REGISTER_SERIALIZABLE(SnowMat);

} // namespace yade
