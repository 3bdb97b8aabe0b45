// SPDX-License-Identifier: GPL-2.0-or-later
/// Shape and bounding box of the elements.
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

} // namespace yade
